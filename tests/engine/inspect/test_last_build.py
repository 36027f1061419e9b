"""The folder of the last build: no text in it is deleted but what is recorded and stored."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import MANIFEST, configure, edit, own_model, resistor, run
from support.replay import contents
from support.states import rewrite

from urdfsync.common.files import text_hash
from urdfsync.project.state import bases
from urdfsync.project.state.store import Store

OWN = {"Pump.mo": b"within Mine;\nmodel Pump\nend Pump;\n", "Resources/table.csv": b"1,2\n", "package.order": b"Pump\n"}
"""A package of the user's own."""


def store(project: Path, text: str) -> None:
    """Add a text to the bases."""
    sha256 = text_hash(text.encode())
    file = project / f".urdfsync/bases/ladder/{sha256[0]}"
    file.write_bytes(file.read_bytes() + bases.dumps({sha256: text}))


def move(project: Path, package: str = "Filter") -> None:
    edit(project / "urdfsync.toml", '"Ladder"', f'"{package}"')


@pytest.fixture
def hostile(execute: Execute, project: Path) -> Path:
    """A clone whose record says that a package of the user's is where the robot was."""
    execute("build")
    for name, content in OWN.items():
        (project / "modelica/Mine" / name).parent.mkdir(parents=True, exist_ok=True)
        (project / "modelica/Mine" / name).write_bytes(content)
    record = text_hash(OWN["Pump.mo"])
    rewrite(project / MANIFEST, package="Mine", folder="modelica/Mine", files={"modelica/Mine/Pump.mo": record})
    shutil.rmtree(project / "modelica/Ladder")
    return project


COMMANDS = "build, build --full, build --dry-run, build --check, status, diff, resolve --all --take"
HOOKS = [pytest.param(command, marks=NEEDS_GIT) for command in ("hook build", "hook check")]


@pytest.mark.parametrize("command", [*COMMANDS.split(", "), *HOOKS])
def test_a_strangers_manifest_deletes_nothing_of_the_users(
    execute: Execute, hostile: Path, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if command.startswith("hook"):
        Repository(hostile, monkeypatch).git("add", "-A")
    execute(*command.split(), code=None)
    assert contents(hostile / "modelica/Mine") == OWN
    execute("build", code=None)
    assert contents(hostile / "modelica/Mine") == OWN


def test_a_text_that_a_stranger_has_recorded_and_stored_is_put_aside(execute: Execute, hostile: Path) -> None:
    """Each clone believes the committed state, so that all decide the same; what one did not write, it never loses."""
    store(hostile, OWN["Pump.mo"].decode())
    assert "[put-aside]" in execute("build", code=None).err
    assert OWN["Pump.mo"] in contents(hostile / ".urdfsync/aside").values()


def test_a_package_moves_together_with_new_templates(execute: Execute, project: Path) -> None:
    execute("build")
    own_model("  Real heat;")
    move(project)
    execute("build")
    assert not (project / "modelica/Ladder").exists()


@pytest.mark.parametrize("left_out", [("deps",), ()], ids=["clone", "copy"])
def test_a_clone_moves_its_package(execute: Execute, project: Path, tmp_path: Path, left_out: Sequence[str]) -> None:
    execute("build")
    clone = tmp_path / "clone"
    shutil.copytree(project, clone, ignore=shutil.ignore_patterns(*left_out))
    for folder in (clone, project):
        move(folder)
        execute("build", "--config", str(folder / "urdfsync.toml"))
        assert not (folder / "modelica/Ladder").exists()
    assert contents(clone / "modelica/Filter") == contents(project / "modelica/Filter")


def _rename_robot(project: Path) -> None:
    edit(project / "urdfsync.toml", "[robots.ladder]", "[robots.filter]")


def _move_output(project: Path) -> None:
    configure('output = "packages"\n')


@pytest.mark.parametrize("steps", [[_rename_robot, move], [move, _rename_robot], [_move_output], [_move_output, move]])
def test_renamed_robots_and_moved_packages_take_their_files_along(
    execute: Execute, project: Path, steps: Sequence[Callable[[Path], None]]
) -> None:
    execute("build")
    for step in steps:
        step(project)
        execute("build")
    (package,) = (path.parent for path in project.rglob("package.mo") if path.parent.name != "Elements")
    assert package.name == ("Filter" if move in steps else "Ladder")
    assert Store(project).names() == ["filter" if _rename_robot in steps else "ladder"]


def test_changes_are_told_since_the_recorded_model_if_there_is_one(project: Path) -> None:
    run()
    resistor(120)
    changes = run(dry=True).changes
    assert changes is not None
    assert [change.path for change in changes.changes] == [("R1", "ohm")]
    rewrite(project / MANIFEST, snapshot=None)
    assert run(dry=True).changes is None
