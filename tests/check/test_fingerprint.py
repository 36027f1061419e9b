"""What `check` and the check after a build take for another package, and what makes no difference."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from support.networks import edit

from urdfsync import config
from urdfsync.check import fingerprint as fingerprints
from urdfsync.check.fingerprint import fingerprint
from urdfsync.check.results import CheckOptions
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions

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


def now(physics: bool = False) -> str | None:
    loaded = config.load(Path("urdfsync.toml"))
    return fingerprint(loaded, loaded.robots[0], CheckOptions(physics=physics))


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


def test_so_do_another_tool_another_urdfsync_and_another_wish(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = [now(), now(physics=True)]
    monkeypatch.setattr(fingerprints, "__version__", "99")
    found.append(now())
    monkeypatch.setattr("urdfsync.check.compilers.installed_version", lambda *_: "99")
    found.append(now())
    assert len(set(found)) == 4


def test_what_can_not_be_read_has_none(project: Path) -> None:
    Path("ladder.json").unlink()
    assert now() is None
