"""Compiled templates in the user's cache folder: used if nobody else can write them, else made again."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from pathlib import Path

import jinja2
import platformdirs
import pytest

from urdfsync import template_cache
from urdfsync.render import Renderer, _Sandbox

needs_owners = pytest.mark.skipif(not hasattr(os, "getuid"), reason="needs owners and modes of files")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder for caches of a user, in a home that only the user may write to."""
    folder = tmp_path / "home" / ".cache"
    folder.mkdir(parents=True)
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


def cached(home: Path) -> list[Path]:
    return sorted((home / "urdfsync/templates").iterdir())


def test_a_template_is_compiled_once_for_each_of_its_texts(home: Path, templates: Path, compiled: list[str]) -> None:
    assert [render(templates), render(templates)] == ["a 1\n", "a 1\n"]
    assert compiled == ["t.jinja"]
    (templates / "t.jinja").write_text("b << x >>\n")
    assert [render(templates), render(templates)] == ["b 1\n", "b 1\n"]
    assert compiled == ["t.jinja"] * 2
    assert len(cached(home)) == 1, "the new one takes the place of the old one"


def test_a_damaged_file_is_made_again(home: Path, templates: Path, compiled: list[str]) -> None:
    render(templates)
    (file,) = cached(home)
    whole = file.read_bytes()
    damaged = (b"", whole[:20], whole[:-1], whole[: len(whole) // 2], b"\0" * len(whole), whole[:30] + b"\0" * 99)
    for content in damaged:
        file.write_bytes(content)
        assert render(templates) == "a 1\n"
        assert file.read_bytes() == whole
    assert len(compiled) == 1 + len(damaged)


PLACES = ("urdfsync/templates", "urdfsync", ".", "..")


def _foreign(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give it to another user; if only root may do so, all is another user's."""
    if os.getuid() == 0:
        os.chown(path, 65534, -1)
    else:
        monkeypatch.setattr(os, "getuid", lambda: 65534)


def _linked(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put it where others may replace it, with a link in its place."""
    shared = path.parents[2] / "shared"
    shared.mkdir()
    shared.chmod(0o777)
    path.rename(shared / path.name)
    path.symlink_to(shared / path.name)


def _mode(bits: int) -> Callable[[Path, pytest.MonkeyPatch], None]:
    return lambda path, _: path.chmod(bits)


@needs_owners
@pytest.mark.parametrize(
    ("place", "change"),
    [
        *((place, _mode(bits)) for place in PLACES for bits in (0o777, 0o775, 0o702)),
        *((place, _foreign) for place in (*PLACES, "urdfsync/templates/*")),
        ("urdfsync", _linked),
        ("urdfsync/templates/*", _mode(0o664)),
    ],
)
def test_what_others_may_write_or_have_written_is_not_used(
    home: Path,
    templates: Path,
    compiled: list[str],
    place: str,
    change: Callable[[Path, pytest.MonkeyPatch], None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    render(templates)
    (path,) = cached(home) if place.endswith("*") else [home / place]
    change(path, monkeypatch)
    assert render(templates) == "a 1\n"
    assert compiled == ["t.jinja"] * 2


@needs_owners
def test_folders_and_files_are_made_for_this_user_alone(home: Path, templates: Path, compiled: list[str]) -> None:
    before = os.umask(0o002)
    try:
        assert [render(templates), render(templates)] == ["a 1\n", "a 1\n"]
    finally:
        os.umask(before)
    places = [home / "urdfsync", home / "urdfsync/templates", *cached(home)]
    assert [stat.S_IMODE(place.stat().st_mode) for place in places] == [0o700, 0o700, 0o600]
    assert compiled == ["t.jinja"]


def test_code_for_another_sandbox_is_not_run(home: Path, templates: Path, compiled: list[str]) -> None:
    class Unsafe(_Sandbox):
        sandboxed = False

    (templates / "t.jinja").write_text("<< x.__class__.__name__ >>")
    marks = {"variable_start_string": "<<", "variable_end_string": ">>"}
    loader = jinja2.FileSystemLoader(str(templates))
    plain = jinja2.Environment(loader=loader, bytecode_cache=template_cache.find_cache(Unsafe), **marks)  # type: ignore[arg-type]
    assert plain.get_template("t.jinja").render(x=1) == "int"
    assert len(cached(home)) == 1
    with pytest.raises(jinja2.exceptions.SecurityError):
        render(templates)
    assert compiled == ["t.jinja"] * 2


def test_a_relative_folder_is_not_used(tmp_path: Path, templates: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name, appauthor: Path("relative", name))
    assert render(templates) == "a 1\n"
    assert not Path("relative").exists()


@pytest.mark.parametrize("place", ["urdfsync", "urdfsync/templates"])
def test_without_a_folder_templates_are_compiled_all_the_same(home: Path, templates: Path, place: str) -> None:
    (home / place).parent.mkdir(exist_ok=True)
    (home / place).write_text("no folder")
    assert render(templates) == "a 1\n"
