"""The exit code of a comparison: what counts as in step, and which of several results wins."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.diff.changes import Change, Changes
from urdfsync.diff.comparison import Comparison, exit_code
from urdfsync.domain import ChangeClass, ChangeKind, Role
from urdfsync.engine.actions import Action, Actions
from urdfsync.engine.actions import Kind as Does
from urdfsync.outcome import Result


def comparison(
    reach: ChangeClass | None = None, does: Does = Does.UNCHANGED, *, failed: bool = False, locked: bool = False
) -> Comparison:
    change = Change(("joint a", "limit"), ChangeKind.CHANGED, reach, 1, 2) if reach else None
    result = Result(
        "arm",
        "Arm",
        Path("Arm"),
        Path(),
        actions=Actions([Action("Arm/Arm.mo", does, Role.MODEL)]),
        failed=failed,
        locked=locked,
        changes=Changes((change,)) if change else None,
    )
    return Comparison(result, "arm.urdf")


@pytest.mark.parametrize(
    ("found", "code"),
    [
        (comparison(), 0),
        (comparison(does=Does.KEEP), 0),
        (comparison(ChangeClass.UNMODELLED), 0),
        (comparison(ChangeClass.PARAMETER), 1),
        (comparison(ChangeClass.STRUCTURAL), 1),
        (comparison(does=Does.RESTORE), 1),
        (comparison(does=Does.CONFLICT), 1),
        (comparison(failed=True), 2),
        (comparison(failed=True, locked=True), 4),
    ],
)
def test_exit_code_of_one(found: Comparison, code: int) -> None:
    assert exit_code([found]) == code


def test_a_generator_that_is_another_is_out_of_step_and_the_worst_of_several_wins() -> None:
    other = Comparison(Result("arm", "Arm", Path("Arm"), Path(), changes=Changes(generator=True)), "arm.urdf")
    broken, locked = comparison(failed=True), comparison(failed=True, locked=True)
    assert exit_code([comparison(), other]) == 1
    assert exit_code([other, locked]) == 4
    assert exit_code([locked, broken, comparison()]) == 2
