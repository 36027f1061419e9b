"""How files stand, for each action that a build may plan: those that a small project does not come to, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.changes import Change, Changes
from urdfsync.commands.status import FileStatus, file_status, is_in_step, lines, summary
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Happening
from urdfsync.engine.actions import CONFLICTS, WRITES, Action, Actions, Kind
from urdfsync.engine.result import Result


def action(kind: Kind, held: bool = False, path: str = "") -> Action:
    return Action(path or f"Arm/{kind}.mo", kind, Role.MODEL, "link tip", base="b", held=held)


def result_of(*actions: Action, changes: Changes | None = None) -> Result:
    return Result("arm", "Arm", Path("/project/Arm"), Path("/project"), Actions(actions), changes=changes, dry=True)


def said(result: Result, *, verbose: bool = False) -> list[str]:
    return list(map(str, lines(result, verbose)))


def changed(*classes: ChangeClass, noise: bool = False) -> Changes:
    new = 1 + 1e-9 if noise else 2.0
    return Changes(tuple(Change(("link tip", "mass"), Happening.CHANGED, one, 1.0, new) for one in classes))


@pytest.mark.parametrize("kind", [kind for kind in Kind if kind is not Kind.FORGET])
def test_every_action_says_how_its_file_stands(kind: Kind) -> None:
    status = file_status(action(kind))
    assert (status is FileStatus.CONFLICT) == (kind in CONFLICTS)
    assert (status in (FileStatus.STALE, FileStatus.MISSING)) == (kind in WRITES)
    (shown,) = (line for line in said(result_of(action(kind)), verbose=True) if f"Arm/{kind}.mo" in line)
    assert shown.startswith(f"  {status}")
    assert not shown.endswith(".mo") or kind in (Kind.UNCHANGED, Kind.KEEP)
    assert file_status(action(Kind.FORGET)) is None


def test_a_conflict_of_a_renamed_element_is_where_the_file_is() -> None:
    conflict = Action("Arm/New.mo", Kind.CONFLICT, Role.MODEL, base="b", origin="Arm/Old.mo")
    move = Action("Arm/Other.mo", Kind.MOVE, Role.MODEL, base="b", origin="Arm/Same.mo")
    shown = "\n".join(said(result_of(conflict, move)))
    assert "conflict   /project/Arm/Old.mo" in shown
    assert "stale      /project/Arm/Other.mo" in shown


@pytest.mark.parametrize(
    ("kinds", "words"),
    [
        ([Kind.UNCHANGED], "in step, 1 file"),
        ([Kind.UNCHANGED, Kind.ADOPT, Kind.KEEP, Kind.ORPHAN, Kind.FORGET], "in step, 4 files: 1 edited, 1 orphan"),
        ([Kind.UPDATE, Kind.RESTORE, Kind.KEEP, Kind.CREATE], "out of step, 4 files: 1 missing, 2 stale, 1 edited"),
        ([Kind.CONFLICT, Kind.UNOWNED, Kind.UNCHANGED], "out of step, 3 files: 2 conflicts"),
    ],
)
def test_a_robot_in_one_line(kinds: list[Kind], words: str) -> None:
    found = result_of(*map(action, kinds))
    assert summary(found) == words
    assert is_in_step(found) == words.startswith("in step")


def test_a_robot_that_was_never_built_says_so() -> None:
    new = [Action(f"Arm/{name}.mo", Kind.CREATE, Role.MODEL) for name in "ab"]
    assert summary(result_of(*new, Action("Arm/c.mo", Kind.UNOWNED, Role.MODEL))) == "not built yet: 1 conflict"


@pytest.mark.parametrize(
    ("kinds", "changes", "words"),
    [
        ([Kind.UNCHANGED, Kind.KEEP], None, []),
        ([Kind.DELETE, Kind.DELETE], None, ["a build: 2 to delete"]),
        (
            [Kind.UPDATE, Kind.CREATE, Kind.DELETE],
            changed(ChangeClass.PARAMETER, ChangeClass.STRUCTURAL, ChangeClass.PARAMETER),
            ["1 structural and 2 parameter changes in the source", "a build: 2 files to write, 1 to delete"],
        ),
        ([Kind.UNCHANGED], changed(ChangeClass.UNMODELLED), ["1 unmodelled change in the source"]),
        ([Kind.UNCHANGED], changed(ChangeClass.PARAMETER, noise=True), ["1 parameter change in the source (rounding)"]),
        (
            [Kind.UPDATE],
            Changes(generator=True),
            ["a template, an option or urdfsync itself changed", "a build: 1 file to write"],
        ),
    ],
)
def test_what_the_next_build_does(kinds: list[Kind], changes: Changes | None, words: list[str]) -> None:
    shown = said(result_of(*map(action, kinds), changes=changes))
    assert [line.strip() for line in shown[1:] if ".mo" not in line] == words


def test_what_waits_for_a_conflict_is_counted_and_says_so() -> None:
    held = [action(Kind.UPDATE, held=True, path=path) for path in ("a.mo", "b.mo")]
    found = result_of(action(Kind.CONFLICT), *held, action(Kind.CREATE), changes=changed(ChangeClass.STRUCTURAL))
    shown = said(found)
    assert shown[2] == "  a build: 1 file to write, 1 conflict, 2 changes waiting for that"
    assert sum("waits until the conflict is settled" in line for line in shown) == 2
