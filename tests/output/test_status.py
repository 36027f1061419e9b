"""How files stand, for each action that a build may have for them, and a robot in one line."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.domain import ChangeClass, ChangeKind, Role
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import Action, Actions, FileStatus, Kind, Reason
from urdfsync.engine.result import Result
from urdfsync.output.status import status_section, summary
from urdfsync.output.terminal import text


def action(reason: Reason, waits: bool = False, path: str = "") -> Action:
    return Action(path or f"Arm/{reason}.mo", reason, Role.MODEL, "link tip", base="b", mine="m", is_waiting=waits)


def result_of(*actions: Action, changes: Changes | None = None) -> Result:
    writes = any(one.writes for one in actions)
    return Result(
        robot="arm",
        package="Arm",
        folder=Path("/project/Arm"),
        root=Path("/project"),
        actions=Actions(actions),
        changes=changes,
        dry=True,
        writes=writes,
    )


def said(result: Result, *, verbose: bool = False) -> list[str]:
    return list(map(str, text(status_section(result, verbose=verbose), verbose=verbose)))


def changed(*classes: ChangeClass, noise: bool = False) -> Changes:
    new = 1 + 1e-9 if noise else 2.0
    return Changes(tuple(Change(("link tip", "mass"), ChangeKind.CHANGED, one, 1.0, new) for one in classes))


@pytest.mark.parametrize("reason", [reason for reason in Reason if reason is not Reason.FORGET])
def test_every_action_says_how_its_file_stands(reason: Reason) -> None:
    status = reason.status
    assert (status is FileStatus.CONFLICT) == (reason.kind is Kind.CONFLICT)
    assert (status in (FileStatus.STALE, FileStatus.MISSING)) == Action("A.mo", reason, Role.MODEL).writes
    shown, *_ = (line for line in said(result_of(action(reason)), verbose=True) if f"Arm/{reason}.mo" in line)
    assert shown.startswith(f"  {status}")
    assert not shown.endswith(".mo") or reason in (Reason.UNCHANGED, Reason.KEEP)


def test_a_conflict_of_a_renamed_element_is_where_the_file_is() -> None:
    conflict = Action("Arm/New.mo", Reason.CONFLICT, Role.MODEL, base="b", origin="Arm/Old.mo", mine="m")
    move = Action("Arm/Other.mo", Reason.MOVE, Role.MODEL, base="b", origin="Arm/Same.mo")
    shown = "\n".join(said(result_of(conflict, move)))
    assert "conflict   /project/Arm/Old.mo" in shown
    assert "stale      /project/Arm/Other.mo" in shown


@pytest.mark.parametrize(
    ("kinds", "words"),
    [
        ([Reason.UNCHANGED], "in step, 1 file"),
        (
            [Reason.UNCHANGED, Reason.KEEP, Reason.ORPHAN, Reason.FORGET],
            "in step, 2 files, 1 kept because you edited it, 1 orphan kept because you edited it",
        ),
        (
            [Reason.UPDATE, Reason.RESTORE, Reason.KEEP, Reason.CREATE],
            "out of step: 2 files to write, 1 to restore, 1 kept because you edited it",
        ),
        ([Reason.CONFLICT, Reason.UNOWNED, Reason.UNCHANGED], "out of step: 2 conflicts"),
    ],
)
def test_a_robot_in_one_line(kinds: list[Reason], words: str) -> None:
    found = result_of(*map(action, kinds))
    assert summary(found) == words
    assert found.in_step == words.startswith("in step")


def test_a_conflict_in_a_package_that_was_never_built() -> None:
    new = [Action(f"Arm/{name}.mo", Reason.CREATE, Role.MODEL) for name in "ab"]
    assert (
        summary(result_of(*new, Action("Arm/c.mo", Reason.UNOWNED, Role.MODEL)))
        == "not built yet: 2 files to write, 1 conflict"
    )


@pytest.mark.parametrize(
    ("kinds", "changes", "words"),
    [
        ([Reason.UNCHANGED, Reason.KEEP], None, []),
        ([Reason.DELETE, Reason.DELETE], None, []),
        (
            [Reason.UPDATE, Reason.CREATE, Reason.DELETE],
            changed(ChangeClass.PARAMETER, ChangeClass.STRUCTURAL, ChangeClass.PARAMETER),
            ["1 structural and 2 parameter changes", *["link tip: mass 1 → 2 (+100 %)"] * 3],
        ),
        ([Reason.UNCHANGED], changed(ChangeClass.UNMODELLED), []),
        (
            [Reason.UPDATE],
            changed(ChangeClass.PARAMETER, noise=True),
            ["link tip: rounding 1 change"],
        ),
        (
            [Reason.UPDATE],
            Changes(generator=True),
            ["a template, an option or urdfsync itself changed"],
        ),
    ],
)
def test_what_the_next_build_does(kinds: list[Reason], changes: Changes | None, words: list[str]) -> None:
    shown = said(result_of(*map(action, kinds), changes=changes))
    assert [line.strip() for line in shown[1:] if ".mo" not in line] == words


def test_what_waits_for_a_conflict_is_counted_and_says_so() -> None:
    waiting = [action(Reason.UPDATE, waits=True, path=path) for path in ("a.mo", "b.mo")]
    found = result_of(action(Reason.CONFLICT), *waiting, action(Reason.CREATE), changes=changed(ChangeClass.STRUCTURAL))
    shown = said(found)
    assert shown[0].endswith("out of step: 1 file to write, 1 conflict (2 files wait for it)")
    assert sum("waits for the conflicts" in line for line in shown) == 2
