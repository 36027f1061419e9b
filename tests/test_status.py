"""How files stand, as it follows from the plan of a build."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync import status, wording
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.diff.changes import Change, Changes
from urdfsync.domain import ChangeClass, Role
from urdfsync.domain import ChangeKind as Happening
from urdfsync.engine.actions import CONFLICTS, WRITES, Action, Actions, Kind
from urdfsync.engine.conflicts import Conflict
from urdfsync.merge import merge
from urdfsync.outcome import Result
from urdfsync.status import FileStatus, RobotState


def action(kind: Kind, held: bool = False, path: str = "") -> Action:
    return Action(path or f"Arm/{kind}.mo", kind, Role.MODEL, "link tip", base="b", held=held)


def state(*actions: Action, changes: Changes | None = None, standoffs: tuple[Conflict, ...] = ()) -> RobotState:
    folder = Path("/project/Arm")
    return status.of(
        Result("arm", "Arm", folder, folder.parent, Actions(actions), changes=changes, standoffs=standoffs)
    )


def changed(*classes: ChangeClass, noise: bool = False) -> Changes:
    new = 1 + 1e-9 if noise else 2.0
    return Changes(tuple(Change(("link tip", "mass"), Happening.CHANGED, one, 1.0, new) for one in classes))


@pytest.mark.parametrize("kind", Kind)
def test_every_action_says_how_its_file_stands(kind: Kind) -> None:
    files = state(action(kind)).files
    if kind is Kind.FORGET:
        assert files == ()
        return
    (file,) = files
    assert (file.status is FileStatus.CONFLICT) == (kind in CONFLICTS)
    assert (file.status in (FileStatus.STALE, FileStatus.MISSING)) == (kind in WRITES)
    assert file.reason or kind in (Kind.UNCHANGED, Kind.KEEP)


@pytest.mark.parametrize(
    ("kind", "expected", "reason"),
    [
        (Kind.UNCHANGED, "in step", ""),
        (Kind.CREATE, "stale", "to be created"),
        (Kind.UPDATE, "stale", "to be updated"),
        (Kind.DELETE, "stale", "to be deleted"),
        (Kind.RESTORE, "missing", "deleted, to be written again"),
        (Kind.KEEP, "edited", ""),
        (Kind.INCLUDED, "edited", "already has what is new"),
        (Kind.UNOWNED, "conflict", "not written by urdfsync"),
        (Kind.ORPHAN, "orphan", "edited, no longer generated"),
    ],
)
def test_status_and_reason(kind: Kind, expected: str, reason: str) -> None:
    (file,) = state(action(kind)).files
    assert (file.status, file.reason) == (expected, reason)


def test_a_file_that_is_held_says_that_it_waits() -> None:
    (file,) = state(action(Kind.UPDATE, held=True)).files
    assert (file.status, file.reason) == (FileStatus.STALE, "to be updated, waits")


@pytest.mark.parametrize(
    ("generated", "reason"),
    [("1\n2\n3\n", "edited and stale; can be merged"), ("8\n", "edited and stale")],
)
def test_a_conflict_that_can_be_merged_says_so(generated: str, reason: str) -> None:
    texts = "1\n2\n", "9\n2\n", generated
    standoff = Conflict("Arm/conflict.mo", "link tip", *texts, merge=merge(*texts))
    (file,) = state(action(Kind.CONFLICT), standoffs=(standoff,)).files
    assert file.reason == reason


def test_a_conflict_of_a_renamed_element_is_where_the_file_is() -> None:
    conflict = Action("Arm/New.mo", Kind.CONFLICT, Role.MODEL, base="b", origin="Arm/Old.mo")
    move = Action("Arm/Other.mo", Kind.MOVE, Role.MODEL, base="b", origin="Arm/Same.mo")
    assert [file.path for file in state(conflict, move).files] == ["Arm/Old.mo", "Arm/Other.mo"]


@pytest.mark.parametrize(
    ("kinds", "words"),
    [
        ([Kind.UNCHANGED, Kind.UNCHANGED], "in step, 2 files"),
        ([Kind.UNCHANGED], "in step, 1 file"),
        ([Kind.UNCHANGED, Kind.ADOPT, Kind.KEEP, Kind.ORPHAN, Kind.FORGET], "in step, 4 files: 1 edited, 1 orphan"),
        ([Kind.UPDATE, Kind.RESTORE, Kind.KEEP, Kind.CREATE], "out of step, 4 files: 1 missing, 2 stale, 1 edited"),
        ([Kind.CONFLICT, Kind.UNOWNED, Kind.UNCHANGED], "out of step, 3 files: 2 conflicts"),
    ],
)
def test_a_robot_in_one_line(kinds: list[Kind], words: str) -> None:
    found = state(*map(action, kinds))
    assert wording.state(found) == words
    assert found.in_step == words.startswith("in step")


def test_a_robot_that_was_never_built_says_so() -> None:
    new = [Action(f"Arm/{name}.mo", Kind.CREATE, Role.MODEL) for name in "ab"]
    assert wording.state(state(*new)) == "not built yet"
    assert wording.state(state(*new, Action("Arm/c.mo", Kind.UNOWNED, Role.MODEL))) == "not built yet: 1 conflict"
    assert not state(*new).built


@pytest.mark.parametrize(
    ("kinds", "changes", "lines"),
    [
        ([Kind.UNCHANGED, Kind.KEEP], None, []),
        ([Kind.UPDATE], None, ["`urdfsync build` writes 1 file"]),
        ([Kind.DELETE, Kind.DELETE], None, ["`urdfsync build` deletes 2 files"]),
        (
            [Kind.UPDATE, Kind.CREATE, Kind.DELETE],
            changed(ChangeClass.PARAMETER, ChangeClass.STRUCTURAL, ChangeClass.PARAMETER),
            ["1 structural and 2 parameter changes in the source; `urdfsync build` writes 2 files and deletes 1"],
        ),
        ([Kind.UNCHANGED], changed(ChangeClass.UNMODELLED), ["1 unmodelled change in the source"]),
        (
            [Kind.UPDATE],
            Changes(generator=True),
            ["a template, an option or urdfsync itself changed; `urdfsync build` writes 1 file"],
        ),
    ],
)
def test_what_a_robot_waits_for(kinds: list[Kind], changes: Changes | None, lines: list[str]) -> None:
    assert wording.outlook(state(*map(action, kinds), changes=changes)) == lines


def test_rounding_is_called_rounding() -> None:
    found = state(action(Kind.UPDATE), changes=changed(ChangeClass.PARAMETER, noise=True))
    assert wording.outlook(found)[0].startswith("1 parameter change in the source (rounding);")


def test_what_waits_for_a_conflict_is_counted() -> None:
    held = [action(Kind.UPDATE, held=True, path=path) for path in ("a.mo", "b.mo")]
    found = state(action(Kind.CONFLICT), *held, action(Kind.CREATE), changes=changed(ChangeClass.STRUCTURAL))
    assert wording.outlook(found) == [
        "1 structural change in the source",
        "`urdfsync build` writes 1 file; 2 files wait for the conflict",
    ]
    assert wording.outlook(state(action(Kind.CONFLICT), held[0])) == ["1 file waits for the conflict"]


def test_warnings_about_the_source_are_left_to_builds() -> None:
    def said(severity: Severity, file: str) -> Diagnostic:
        return Diagnostic(severity, "code", "message", file)

    diagnostics = said(Severity.WARNING, "arm.urdf"), said(Severity.ERROR, "arm.urdf"), said(Severity.WARNING, "Arm.mo")
    result = Result("arm", "Arm", Path("/Arm"), Path("/"), diagnostics=diagnostics)
    assert status.of(result, "arm.urdf").findings == [*diagnostics[1:]]
