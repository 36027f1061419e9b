"""The folder of the last build: a build deletes in it only what it can render itself."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
import tomli
import tomli_w
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import MANIFEST, configure, edit
from support.replay import contents

from urdfsync.engine.result import Exit
from urdfsync.files import digest
from urdfsync.state.store import Store

OWN = {"Pump.mo": b"within Mine;\nmodel Pump\nend Pump;\n", "Resources/table.csv": b"1,2\n", "package.order": b"Pump\n"}
"""A package of the user's own."""


def rewrite(manifest: Path, **changes: Any) -> None:
    document = tomli.loads(manifest.read_text())
    manifest.write_text(tomli_w.dumps({**document, **changes}))


def move(project: Path, package: str = "Filter") -> None:
    edit(project / "urdfsync.toml", '"Ladder"', f'"{package}"')


@pytest.fixture
def hostile(execute: Execute, project: Path) -> Path:
    """A clone whose manifest says that a package of the user's is where the robot was."""
    execute("build")
    for name, content in OWN.items():
        (project / "modelica/Mine" / name).parent.mkdir(parents=True, exist_ok=True)
        (project / "modelica/Mine" / name).write_bytes(content)
    rewrite(
        project / MANIFEST,
        package="Mine",
        folder="modelica/Mine",
        orders={"package.order": ["Pump"]},
        files={
            "Pump.mo": {"owner": "", "role": "model", "base": digest(OWN["Pump.mo"])},
            "Resources/table.csv": {"owner": "", "role": "import", "base": digest(OWN["Resources/table.csv"])},
        },
    )
    shutil.rmtree(project / "modelica/Ladder")
    return project


COMMANDS = "build, build --full, build --repair, build --dry-run, build --check, status, diff, resolve --all --take"
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


def test_a_strangers_manifest_moves_no_edits(execute: Execute, hostile: Path) -> None:
    mine = hostile / "modelica/Mine/Ladder.mo"
    mine.write_text("within Mine;\nmodel Ladder\nend Ladder;\n")
    written = digest(b"what urdfsync wrote")
    rewrite(hostile / MANIFEST, files={"Ladder.mo": {"owner": "circuit ladder", "role": "model", "base": written}})
    execute("build", code=Exit.CONFLICT)
    assert mine.read_text() == "within Mine;\nmodel Ladder\nend Ladder;\n"


def test_what_stays_is_told_once(hostile: Path, execute: Execute) -> None:
    said = " ".join(execute("build").err.split())
    assert (
        "the package moved from modelica/Mine to modelica/Ladder; what you wrote or edited, and what that needs, "
        "stayed behind: modelica/Mine/Pump.mo, modelica/Mine/Resources/table.csv, modelica/Mine/package.order; "
        "take over what you need, then delete the old folder [left-behind]"
    ) in said
    assert "left-behind" not in execute("build").err


@pytest.mark.parametrize("left_out", [("base", "stamp"), ()], ids=["clone", "copy"])
def test_a_clone_takes_its_package_along(
    execute: Execute, project: Path, tmp_path: Path, left_out: Sequence[str]
) -> None:
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


def test_a_recorded_line_of_the_parents_order_is_the_packages_own(project: Path, execute: Execute) -> None:
    configure("create_parents = true\n")
    move(project, "Plant.Ladder")
    execute("build")
    order = project / "modelica/Plant/package.order"
    order.write_text("Ladder\nPump\n")
    rewrite(project / MANIFEST, orders={"../package.order": ["Ladder", "Pump"]})
    assert "[broken-state]" in execute("build", code=2).err
    assert order.read_text() == "Ladder\nPump\n"


def test_a_manifest_with_a_name_that_no_robot_can_have_is_no_state(execute: Execute, project: Path) -> None:
    execute("build")
    (project / ".urdfsync/robots/...toml").write_text((project / MANIFEST).read_text())
    _rename_robot(project)
    (project / MANIFEST).unlink()
    ignore = (project / ".urdfsync/.gitignore").read_bytes()
    execute("build")
    assert (project / ".urdfsync/.gitignore").read_bytes() == ignore
    assert Store(project).names() == ["filter"]
