"""The verdict on a robot: one word and one line for all that was found, and the exit code of several."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest

from urdfsync.analysis.checks.results import (
    CheckResult,
    CheckStatus,
    CompiledModel,
    EditEffect,
    exit_code,
    listed,
    worst,
)
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain.experiment import Aspect, Deviation, Quantity
from urdfsync.engine.result import Exit

ELBOW = Deviation(Quantity.EFFORT, "joint elbow", 0.4, 12.5, 60.0, "N·m", Aspect.LOSSES)
MASS = Deviation(Quantity.MASS, "robot", 0.0, 25.0, 25.0, "kg")
CHANGED = {"effects": (EditEffect(("a.mo",), (ELBOW,)),)}
OFF, SAME_MASS = {"deviations": (ELBOW,)}, {"deviations": (MASS,)}
GAP = "the effect of your edits was not measured: the robot can't be simulated"
ERROR, WARNING = (Diagnostic(severity, "code", "words") for severity in (Severity.ERROR, Severity.WARNING))
USERS = CompiledModel("Arm", 9), CompiledModel("Cell", 7, is_users=True)
PLAIN = "syntax and layout; "


@pytest.mark.parametrize(("facts", "strict", "summary"), [
    ({}, True, f"right: {PLAIN}"),
    ({"gaps": (GAP,)}, True, f"incomplete: {PLAIN}"),
    ({"gaps": (GAP,), "in_step": False}, False, f"out of step: {PLAIN}"),
    ({"in_step": False, "built": False}, False, f"not built: {PLAIN}"),
    (CHANGED, False, f"right: {PLAIN}"),
    ({**CHANGED, "gaps": (GAP,)}, True, f"differs: {PLAIN}"),
    ({**OFF, "in_step": False}, False, f"differs: {PLAIN}friction and gears differ (joint elbow); "),
    ({"between": (ELBOW,)}, False, f"differs: {PLAIN}"),
    ({"between_edited": (ELBOW,)}, False, f"differs: {PLAIN}"),
    (SAME_MASS, False, f"right: {PLAIN}rigid bodies right; "),
    ({**OFF, "diagnostics": (ERROR, WARNING, ERROR)}, False, "failed: 2 errors; friction and gears differ"),
    ({"compiled": USERS, "failing": ("Part", "Other"), "freedoms": 1}, False,
        "right: 1 model compiles, and 1 of yours; 2 of yours do not; 1 degree of freedom; "),
    ({"compiled": USERS[:1] * 3, "failing": ("Part",)}, False,
        "right: 3 models compile; 1 of yours does not; 0.0 s"),
])  # fmt: skip
def test_one_word_for_all(facts: dict[str, Any], strict: bool, summary: str) -> None:
    result = CheckResult("arm", "Arm", strict=strict, **facts)
    assert result.summary.startswith(summary)
    assert result.summary.endswith("; 0.0 s")


@pytest.mark.parametrize(("facts", "code", "strict"), [
    ({}, Exit.IN_STEP, Exit.IN_STEP),
    ({"gaps": (GAP,)}, Exit.IN_STEP, Exit.OUT_OF_STEP),
    ({"in_step": False}, Exit.OUT_OF_STEP, Exit.OUT_OF_STEP),
    (CHANGED, Exit.IN_STEP, Exit.OUT_OF_STEP),
    ({"diagnostics": (ERROR,), "in_step": False}, Exit.ERROR, Exit.ERROR),
])  # fmt: skip
def test_the_exit_code_is_that_of_the_worst(facts: dict[str, Any], code: Exit, strict: Exit) -> None:
    right, result = CheckResult("a", "A"), CheckResult("arm", "Arm", **facts)
    assert exit_code([right, result, right]) == code
    assert exit_code([right, msgspec.structs.replace(result, strict=True)]) == strict
    assert exit_code([CheckResult("b", "B", in_step=False), result]) == max(code, Exit.OUT_OF_STEP)


def test_the_worst_of_a_part_is_that_furthest_beyond_its_tolerance() -> None:
    less = msgspec.structs.replace(ELBOW, element="joint wrist", difference=0.3)
    assert worst([MASS, less, ELBOW, less]) == {Aspect.BODIES: MASS, Aspect.LOSSES: ELBOW}
    coarse = msgspec.structs.replace(ELBOW, difference=0.5, least_tolerance=1.0)
    assert worst([coarse, ELBOW]) == {Aspect.LOSSES: ELBOW}
    assert [CheckResult("a", "A", deviations=each).agrees for each in (None, (ELBOW,), (MASS,))] == [None, False, True]


def test_a_finding_is_there_once() -> None:
    result = CheckResult("arm", "Arm", diagnostics=(WARNING,))
    result.add([ERROR, WARNING, ERROR])
    assert (result.diagnostics, result.status) == ((WARNING, ERROR), CheckStatus.FAILED)


@pytest.mark.parametrize(
    ("count", "words"), [(0, ""), (1, "a"), (2, "a and b"), (3, "a, b and c"), (5, "a, b and 3 more")]
)
def test_names_in_words(count: int, words: str) -> None:
    assert listed("abcde"[:count]) == words
