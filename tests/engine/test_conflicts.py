"""A conflict about numbers of one element's record is one of that file: all else of an export is written."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import urdfs
from support.commands import Execute
from support.networks import edit

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.conflicts import find_conflict, resolve
from urdfsync.state.record import Choice, UsersChoice

FORE, HAND, WRIST = (
    "modelica/Arm/Links/ForeParameters.mo",
    "modelica/Arm/Links/Hand.mo",
    "modelica/Arm/Joints/Wrist.mo",
)
ELBOW = urdfs.joint("elbow", "revolute", "base", "fore")


def export(mass: float, *names: tuple[str, str]) -> None:
    """Write the source: a forearm of this mass, and for each pair a joint with its link, in a chain."""
    links, joints, parent = [urdfs.link("base", 1.0), urdfs.link("fore", mass)], [ELBOW], "fore"
    for joint, link in names:
        links.append(urdfs.link(link, 1.0))
        joints.append(urdfs.joint(joint, "revolute", parent, link))
        parent = link
    Path("arm.urdf").write_text(urdfs.robot(*links, *joints))


@pytest.fixture
def conflict(folder: Path, execute: Execute) -> Path:
    """A forearm that was weighed, which the export has made heavier while it got a hand."""
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    export(2.5)
    execute("build")
    edit(FORE, "2.5", "2.6")
    export(2.75, ("wrist", "hand"))
    said = execute("build", code=3)
    assert "1 conflict" in said.out
    assert "wait" not in said.out
    return folder


def package() -> dict[str, str]:
    return {path.as_posix(): path.read_text() for path in sorted(Path("modelica").rglob("*.mo"))}


def test_structure_is_written(conflict: Path, execute: Execute) -> None:
    assert Path(HAND).exists()
    assert "wrist" in Path("modelica/Arm/Arm.mo").read_text()
    assert "2.6" in Path(FORE).read_text()
    before = package()
    for command, code in (("status", 3), ("build --check", 3), ("build", 3)):
        assert "1 conflict" in execute(*command.split(), code=code).out
    assert package() == before


@pytest.mark.parametrize(
    "then", [(), (("wrist", "hand"),), (("gelenk", "hand"),), (("wrist", "hand"), ("knuckle", "tip"))]
)
def test_what_is_exported_meanwhile_is_written_and_the_end_is_a_fresh_build(
    conflict: Path, execute: Execute, then: tuple[tuple[str, str], ...]
) -> None:
    if then:
        edit(HAND, "end Hand;", "  // mine\nend Hand;")
    export(2.875, *then)
    execute("build", code=3)
    execute("resolve", FORE, "--take")
    assert execute("status").lines[0].startswith("arm: in step")
    built = package()
    fresh = conflict / "fresh"
    fresh.mkdir()
    for name in ("arm.urdf", "urdfsync.toml"):
        (fresh / name).write_text(Path(name).read_text())
    execute("build", "--config", fresh / "urdfsync.toml")
    wanted = {path.relative_to(fresh).as_posix(): path.read_text() for path in sorted(fresh.rglob("*.mo"))}
    assert {path: text.replace("  // mine\n", "") for path, text in built.items()} == wanted
    assert sum("// mine" in text for text in built.values()) == bool(then)


def test_who_keeps_his_text_has_answered_the_export() -> None:
    action = Action("a.txt", Reason.CONFLICT, Role.MODEL, "", "base", "new", mine="mine")
    choices = {"a.txt": UsersChoice(Choice.KEEP, action.sides)}
    (kept,), _ = resolve([action], {"a.txt": find_conflict(action, ["1\n"], "2\n", "3\n")}, choices, merging=True)
    assert (kept.reason, kept.base, kept.choice) == (Reason.KEEP, "new", Choice.KEEP)


def test_bases_of_two_branches_that_give_different_merges_give_none() -> None:
    action = Action("a.txt", Reason.CONFLICT, Role.MODEL)
    both = find_conflict(action, ["1\n", "2\n"], "1\n", "2\n")
    assert both.merged(Choice.MERGE) is None
    assert both.rejected == "two branches recorded different bases, which give different merges"
