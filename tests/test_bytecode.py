"""Compiled templates in the user's cache folder: taken if they are right and whole, else made again."""

from __future__ import annotations

import marshal
import os
import stat
from pathlib import Path

import jinja2
import platformdirs
import pytest

from urdfsync import bytecode
from urdfsync.check.cache import UserCache
from urdfsync.render import Renderer


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder for caches of a user."""
    folder = tmp_path / "cache"
    folder.mkdir()
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder))
    return folder


@pytest.fixture
def templates(tmp_path: Path) -> Path:
    folder = tmp_path / "templates"
    folder.mkdir()
    (folder / "t.jinja").write_text("a << x >>\n")
    return folder


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the templates that were compiled."""
    found: list[str] = []
    real = jinja2.Environment.compile

    def compile_(self: jinja2.Environment, source: str, name: str, filename: str) -> object:
        found.append(name)
        return real(self, source, name, filename)

    monkeypatch.setattr(jinja2.Environment, "compile", compile_)
    return found


def render(templates: Path) -> str:
    """What a process of its own would render."""
    return Renderer([templates]).render("t.jinja", {"x": 1})


def kept(home: Path) -> list[Path]:
    return sorted((home / "urdfsync/templates").iterdir())


def test_a_template_is_compiled_once(home: Path, templates: Path, compiled: list[str]) -> None:
    assert [render(templates), render(templates)] == ["a 1\n", "a 1\n"]
    assert compiled == ["t.jinja"]
    assert len(kept(home)) == 1


def test_a_changed_template_is_compiled_again(home: Path, templates: Path, compiled: list[str]) -> None:
    render(templates)
    (templates / "t.jinja").write_text("b << x >>\n")
    assert [render(templates), render(templates)] == ["b 1\n", "b 1\n"]
    assert compiled == ["t.jinja"] * 2
    assert len(kept(home)) == 1, "the new one takes the place of the old one"


def test_another_program_compiles_for_itself(
    home: Path, templates: Path, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    render(templates)
    monkeypatch.setattr(bytecode, "_maker", lambda: b"another version")
    assert render(templates) == "a 1\n"
    assert compiled == ["t.jinja"] * 2


def test_a_damaged_file_is_no_code(home: Path, templates: Path, compiled: list[str]) -> None:
    render(templates)
    (file,) = kept(home)
    whole = file.read_bytes()
    wrong = marshal.dumps(compile("root = None", "x", "exec"))
    for content in (b"", whole[:20], whole[:-1], whole + b"\0", whole[:32] + wrong):
        file.write_bytes(content)
        assert render(templates) == "a 1\n"
        assert file.read_bytes() == whole
    assert len(compiled) == 6


def test_without_a_folder_templates_are_compiled_all_the_same(home: Path, templates: Path) -> None:
    (home / "urdfsync").write_text("no folder")
    assert render(templates) == "a 1\n"
    (home / "urdfsync").unlink()
    (home / "urdfsync").mkdir()
    (home / "urdfsync/templates").write_text("no folder")
    assert render(templates) == "a 1\n"


@pytest.mark.parametrize("mode", [0o777, 0o775, 0o702])
@pytest.mark.parametrize("place", ["urdfsync/templates", "urdfsync", "."])
def test_a_folder_that_others_may_write_to_is_not_used(home: Path, templates: Path, place: str, mode: int) -> None:
    render(templates)
    (home / place).chmod(mode)
    assert bytecode.of_user() is None
    assert render(templates) == "a 1\n"


@pytest.mark.parametrize("place", ["urdfsync/templates", "urdfsync", "."])
def test_a_folder_of_another_user_is_not_used(
    home: Path, templates: Path, place: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    render(templates)
    foreign, real = (home / place).stat(), bytecode._is_own
    monkeypatch.setattr(bytecode, "_is_own", lambda status: not os.path.samestat(status, foreign) and real(status))
    assert bytecode.of_user() is None


def test_a_file_that_others_may_write_to_is_not_run(home: Path, templates: Path, compiled: list[str]) -> None:
    render(templates)
    kept(home)[0].chmod(0o664)
    assert render(templates) == "a 1\n"
    assert compiled == ["t.jinja"] * 2


def test_folders_are_made_for_this_user_alone(home: Path, templates: Path) -> None:
    before = os.umask(0o002)
    try:
        render(templates)
    finally:
        os.umask(before)
    modes = [stat.S_IMODE((home / place).stat().st_mode) for place in ("urdfsync", "urdfsync/templates")]
    assert modes == [0o700, 0o700]
    assert bytecode.of_user() is not None


def test_code_without_a_sandbox_is_not_run_in_one(home: Path, templates: Path, compiled: list[str]) -> None:
    (templates / "t.jinja").write_text("<< x.__class__.__name__ >>")
    marks = {"variable_start_string": "<<", "variable_end_string": ">>"}
    loader = jinja2.FileSystemLoader(str(templates))
    plain = jinja2.Environment(loader=loader, bytecode_cache=bytecode.of_user(), **marks)  # type: ignore[arg-type]
    assert plain.get_template("t.jinja").render(x=1) == "int"
    assert len(kept(home)) == 1
    with pytest.raises(jinja2.exceptions.SecurityError):
        render(templates)
    assert compiled == ["t.jinja"] * 2


@pytest.mark.parametrize("place", ["", "relative/folder"])
def test_a_place_that_is_none_is_not_used(place: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", place)
    found = bytecode._base()
    assert found == (tmp_path / ".cache" if not place else Path(place))
    if place:
        assert bytecode.of_user() is None


def test_it_is_where_the_cache_of_checks_is(home: Path, templates: Path) -> None:
    assert bytecode._base() == platformdirs.user_cache_path()
    render(templates)
    cache = UserCache.default()
    assert kept(home)[0].parent == cache.templates
    assert cache.clear() > 0
    assert not cache.templates.exists()
