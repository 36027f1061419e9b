"""Conflicts of meshes and of plain texts; `tests/scenarios/numbers.txt` has those about numbers of one element."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.meshes import stl
from support.networks import edit
from support.urdfs import robot_of

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide.conflicts import find_conflict, resolve

FORE = "modelica/Arm/Links/ForeParameters.mo"
SHAPE = '<visual><geometry><mesh filename="tip.stl"/></geometry></visual>'


def export(mass: float, size: float) -> None:
    """Write a forearm of this mass with a mesh of this size; 0 for a file that is missing."""
    Path("arm.urdf").write_text(
        robot_of(f"elbow fore {mass}").replace("</inertial></link>", f"</inertial>{SHAPE}</link>")
    )
    Path("tip.stl").write_text(stl(size))
    if not size:
        Path("tip.stl").unlink()


@pytest.mark.parametrize(
    ("sizes", "told"),
    [
        ([1, 2], ["mesh tip.stl: content"]),
        ([1, 2, 3], ["mesh tip.stl: content"]),
        ([1, 2, 1], []),
        ([1, 2, 0], ["mesh tip.stl: content"]),  # the copy stays
        ([0, 1], ["mesh tip.stl: content"]),
        ([0, 1, 2], ["mesh tip.stl: content"]),
    ],
)
def test_a_changed_mesh_is_told_by_each_command_as_long_as_a_file_conflicts(
    folder: Path, execute: Execute, sizes: list[float], told: list[str]
) -> None:
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    export(2.5, sizes[0])
    execute("build")
    edit(FORE, "2.5", "2.6")
    for size in sizes[1:]:
        export(2.75, size)
        execute("build", code=3)
    for command in ("diff", "status", "build", "build --dry-run"):
        rows = (line.split() for line in execute(*command.split(), code=None).lines if line.startswith("  mesh"))
        assert [" ".join(row[:3]) for row in rows] == told, command


def test_a_conflict_names_the_mesh_that_alone_has_changed(folder: Path, execute: Execute) -> None:
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    export(2.5, 1)
    execute("build")
    edit(FORE, "2.5", "2.6")
    Path("tip.stl").write_text(stl(2))
    for command in ("build", "build", "diff"):
        assert "its generated text changed too: mesh tip.stl" in execute(*command.split(), code=None).words


MINE, BOTH, GENERATED = "2\n\na\n", "2\n\nb\n", "1\n\nb\n"
FITTING, DISPUTED, SAME = (("1\n\na\n", MINE, GENERATED), ("1\n", "2\n", "3\n"), ("1\n\na\n", BOTH, GENERATED))


@pytest.mark.parametrize(
    ("before", "texts", "merging", "after", "text"),
    [
        (Reason.CONFLICT, FITTING, False, Reason.CONFLICT, None),
        (Reason.CONFLICT, FITTING, True, Reason.MERGE, BOTH),
        (Reason.CONFLICT, DISPUTED, True, Reason.CONFLICT, None),
        (Reason.CONFLICT, SAME, False, Reason.KEEP, None),
        (Reason.CONFLICT, SAME, True, Reason.KEEP, None),
        (Reason.MOVE, FITTING, False, Reason.MOVE, BOTH),
        (Reason.MOVE, DISPUTED, True, Reason.CONFLICT, None),
        (Reason.ORPHAN, None, True, Reason.ORPHAN, None),
        (Reason.UPDATE, None, True, Reason.UPDATE, None),
    ],
)
def test_merges_are_taken_if_the_configuration_allows_them_or_a_file_moves(
    before: Reason, texts: tuple[str, str, str] | None, merging: bool, after: Reason, text: str | None
) -> None:
    action = Action("a.txt", before, Role.MODEL, "", "base", "new", mine="mine")
    conflicts = {"a.txt": find_conflict(action, *texts)} if texts else {}
    (resolved,), merged = resolve([action], conflicts, merging=merging)
    assert (resolved.reason, merged.get("a.txt")) == (after, text)
