"""What `check` and the check after a build take for another package, and what makes no difference."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from unittest import mock

import pytest
from support.networks import RC_FOLDER, edit, set_keys

from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.analysis.checks.fingerprint import fingerprint
from urdfsync.analysis.checks.results import CheckOptions
from urdfsync.common.dependencies import program
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config

OMC = Tool("omc")
MODEL = "modelica/Ladder/Elements/R2.mo"


@pytest.fixture
def project(project: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The project, built, with libraries of which one needs another."""
    append("urdfsync.toml", '[check]\nlibrary = "libraries"\n')
    for name in ("Modelica", "ModelicaServices", "Complex"):
        append(f"libraries/{name} 4.1.0/package.mo", f"package {name} end {name};\n")
    append("path/Pumps/package.mo", "package Pumps\n  import Tanks;\nend Pumps;\n")
    append("path/Tanks.mo", "package Tanks\nend Tanks;\n")
    append("path/Unused.mo", "package Unused\nend Unused;\n")
    monkeypatch.setenv("MODELICAPATH", str(project / "path"))
    loaded = config.load(Path("urdfsync.toml"))
    assert not [result for result in build(loaded, loaded.robots, BuildOptions()) if result.failed]
    edit(MODEL, "end R2;", "  Pumps.Small p;\nend R2;")
    return project


def append(file: str, text: str) -> None:
    path = Path(file)
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a") as stream:
        stream.write(text)


def now(physics: bool = False, tools: tuple[Tool, ...] = (Tool(),)) -> str | None:
    loaded = config.load(Path("urdfsync.toml"))
    return fingerprint(loaded, loaded.robots[0], CheckOptions(physics=physics, tools=tools))


@pytest.mark.parametrize(("change", "matters"), [
    (lambda: append(MODEL, "// mine\n"), True),
    (lambda: append("modelica/Ladder/package.order", "Mine\n"), True),
    (lambda: append("modelica/Mine.mo", "model Mine\n  Ladder.Ladder it;\nend Mine;\n"), True),
    (lambda: append("modelica/Other.mo", "model Other\nend Other;\n"), False),
    (lambda: append("ladder.json", " "), True),
    (lambda: append("libraries/Complex 4.1.0/Mine.mo", "// a new file\n"), True),
    (lambda: append("path/Tanks.mo", "// used by a library that is used\n"), True),
    (lambda: append("path/Unused.mo", "// not used\n"), False),
    (lambda: shutil.rmtree("path/Pumps"), True),
    (lambda: shutil.rmtree("libraries"), True),
])  # fmt: skip
def test_what_a_check_rests_on_changes_it(project: Path, change: Callable[[], None], matters: bool) -> None:
    before = now()
    assert before is not None
    assert now() == before
    change()
    assert (now() != before) == matters


def test_so_do_another_tool_another_distribution_and_another_wish(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = [now(), now(physics=True), *(now(tools=tools) for tools in ((OMC,), (Tool(), OMC)))]
    (tmp_path / "site/numbers-2.0.dist-info").mkdir(parents=True)
    monkeypatch.syspath_prepend(tmp_path / "site")
    found.append(now())
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.state", lambda *_: ["99"])
    found.append(now())
    assert len(set(found)) == 6


def test_so_does_another_line_of_a_domain(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Which is no part of urdfsync, and says no version."""
    before = now()
    copy = tmp_path / "rc_domain.py"
    copy.write_text((RC_FOLDER / "rc_domain.py").read_text() + "# a line\n")
    monkeypatch.setattr("rc_domain.__file__", str(copy))
    assert now() not in (before, None)


@pytest.mark.parametrize("place", ["code", "library", "templates"])
def test_so_does_another_line_of_urdfsync_its_library_or_the_templates(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    """Whoever develops urdfsync does not change the version."""
    file = tmp_path / place / "__init__.py"
    file.parent.mkdir()
    before = now()
    for line in ("# one line\n", "# another line\n"):
        file.write_text(line)
        if place == "code":
            monkeypatch.setattr(program, "_PACKAGE", str(file.parent))
        elif place == "library":
            monkeypatch.setattr("urdfsync.analysis.checks.fingerprint.find_own_library", lambda *_: file.parent)
        else:
            set_keys(templates=json.dumps(str(file.parent)))
            append("urdfsync.toml", '[check]\nlibrary = "libraries"\n')
        found = now()
        assert found not in (before, None)
        before = found


def test_contents_count_and_neither_sizes_nor_times(project: Path) -> None:
    before, file = now(), Path("path/Tanks.mo")
    status = file.stat()
    file.write_text(file.read_text().replace("package Tanks", "package tanks"))
    os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert now() != before
    file.write_text(file.read_text().replace("package tanks", "package Tanks"))
    assert now() == before


def test_a_library_of_the_users_counts_with_what_his_model_needs_of_it(project: Path) -> None:
    """The part does not mention the robot, and is not where libraries are looked for."""
    append("Plant/package.mo", "within;\npackage Plant\nend Plant;\n")
    append("Plant/Cell.mo", "within Plant;\nmodel Cell\n  Ladder.Ladder it;\n  Part part;\nend Cell;\n")
    append("Plant/Part.mo", "within Plant;\nmodel Part\nend Part;\n")
    append("Plant/Resources/table.txt", "1 2\n")
    before = now()
    append("Plant/Part.mo", "// changed\n")
    assert now() != before
    before = now()
    append("Plant/Resources/table.txt", "3 4\n")
    assert now() != before


def test_a_library_with_a_link_to_a_folder_is_not_known_whole(project: Path, tmp_path: Path) -> None:
    """What is behind the link may change, and may be all of the disk: so nothing is remembered."""
    (tmp_path / "elsewhere").mkdir()
    Path("path/Pumps/Resources").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    assert now() is None


def test_what_can_not_be_read_has_none(project: Path) -> None:
    Path("ladder.json").unlink()
    assert now() is None


def test_a_mistake_that_a_source_meets_is_left_to_the_check(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keys of all robots are asked for before the first one is checked."""
    monkeypatch.setattr("urdfsync.engine.sources.source.read_source", mock.Mock(side_effect=RecursionError("too deep")))
    assert now() is None
