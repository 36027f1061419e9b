"""How files stand and what the next build does, for actions that a small project does not come to, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.commands.status import PackageStatus, next_build, package_status, summary
from urdfsync.diff.changes import Change, Changes
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Happening
from urdfsync.engine.actions import Action, Actions, Kind
from urdfsync.outcome import Result


def action(kind: Kind, held: bool = False, path: str = "") -> Action:
    return Action(path or f"Arm/{kind}.mo", kind, Role.MODEL, "link tip", base="b", held=held)


def status_of(*actions: Action, changes: Changes | None = None) -> PackageStatus:
    return package_status(
        Result("arm", "Arm", Path("/project/Arm"), Path("/project"), Actions(actions), changes=changes)
    )


def changed(*classes: ChangeClass, noise: bool = False) -> Changes:
    new = 1 + 1e-9 if noise else 2.0
    return Changes(tuple(Change(("link tip", "mass"), Happening.CHANGED, one, 1.0, new) for one in classes))


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
    found = status_of(*map(action, kinds))
    assert summary(found) == words
    assert found.in_step == words.startswith("in step")


def test_a_robot_that_was_never_built_says_so() -> None:
    new = [Action(f"Arm/{name}.mo", Kind.CREATE, Role.MODEL) for name in "ab"]
    assert summary(status_of(*new, Action("Arm/c.mo", Kind.UNOWNED, Role.MODEL))) == "not built yet: 1 conflict"


@pytest.mark.parametrize(
    ("kinds", "changes", "lines"),
    [
        ([Kind.UNCHANGED, Kind.KEEP], None, []),
        ([Kind.DELETE, Kind.DELETE], None, ["`urdfsync build` deletes 2 files"]),
        (
            [Kind.UPDATE, Kind.CREATE, Kind.DELETE],
            changed(ChangeClass.PARAMETER, ChangeClass.STRUCTURAL, ChangeClass.PARAMETER),
            ["1 structural and 2 parameter changes in the source; `urdfsync build` writes 2 files and deletes 1"],
        ),
        ([Kind.UNCHANGED], changed(ChangeClass.UNMODELLED), ["1 unmodelled change in the source"]),
        ([Kind.UNCHANGED], changed(ChangeClass.PARAMETER, noise=True), ["1 parameter change in the source (rounding)"]),
        (
            [Kind.UPDATE],
            Changes(generator=True),
            ["a template, an option or urdfsync itself changed; `urdfsync build` writes 1 file"],
        ),
    ],
)
def test_what_the_next_build_does(kinds: list[Kind], changes: Changes | None, lines: list[str]) -> None:
    assert next_build(status_of(*map(action, kinds), changes=changes)) == lines


def test_what_waits_for_a_conflict_is_counted_and_says_so() -> None:
    held = [action(Kind.UPDATE, held=True, path=path) for path in ("a.mo", "b.mo")]
    found = status_of(action(Kind.CONFLICT), *held, action(Kind.CREATE), changes=changed(ChangeClass.STRUCTURAL))
    assert next_build(found) == [
        "1 structural change in the source",
        "`urdfsync build` writes 1 file; 2 files wait for the conflict",
    ]
    assert found.files[-1].reason == "to be updated, waits"
