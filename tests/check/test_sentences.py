"""Verdicts in words: how much differs, of what, and since when."""

from __future__ import annotations

import math

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.check import sentences
from urdfsync.check.results import CheckResult, CompiledModel, EditEffect
from urdfsync.domain import Deviation, Quantity


def effort(element: str, difference: float, value: float, unit: str = "N·m") -> Deviation:
    return Deviation(Quantity.EFFORT, element, difference, value, 60.0, unit)


ELBOW = effort("joint elbow", 0.4, 12.5)
SHOULDER = effort("joint shoulder", 0.3, 60.0)
WRIST = effort("joint wrist", 0.02, 1.0)
ROLL = effort("joint roll", 0.01, 0.5)
HAND = Deviation(Quantity.POSITION, "link hand", 0.0123, 0.9, 1.2, "m")
TURNED = Deviation(Quantity.ORIENTATION, "link hand", math.sin(math.radians(3)), 1.0, 1.0, "")
BENT = Deviation(Quantity.POSITION, "link finger", 0.02, 1.1, 1.2, "m")
REACTIONS = [
    Deviation(Quantity.REACTION, "link base", 7.5, 30.0, 30.0, "N"),
    Deviation(Quantity.REACTION, "link base", 0.168, 12.0, 12.0, "N·m"),
]
MASS = Deviation(Quantity.MASS, "robot", 0.5, 25.0, 25.0, "kg")
CENTRE = Deviation(Quantity.CENTRE, "robot", 0.0385, 0.3, 0.3, "m")
BLIND = Deviation(Quantity.ACCELERATION, "link wheel", math.inf, 1.0, 1.0, "rad/s²")


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (ELBOW, "3.2 %"),
        (effort("joint elbow", 6.0, 12.5), "48 %"),
        (effort("joint elbow", 1e-9, 12.5), "less than 0.001 %"),
        (effort("joint elbow", 0.4, 0.0), "0.4 N·m"),
        (effort("joint elbow", 0.4, 1e-14), "0.4 N·m"),
        (effort("joint slide", 20.0, 1e-14, "N"), "20 N"),
        (effort("joint elbow", math.nan, 12.5), "not finite"),
        (HAND, "12.3 mm"),
        (Deviation(Quantity.CENTRE, "robot", 1.2345, 2.0, 2.0, "m"), "1.23 m"),
        (TURNED, "3°"),
        (Deviation(Quantity.ORIENTATION, "link hand", 2.0, 1.0, 1.0, ""), "180°"),
        (MASS, "2 %"),
    ],
)
def test_amounts_are_in_percent_where_that_says_something(found: Deviation, said: str) -> None:
    assert sentences.amount(found) == said


@given(st.floats(min_value=0, allow_nan=False), st.floats(min_value=0, allow_nan=False, allow_infinity=False))
def test_no_percentage_is_absurd(difference: float, value: float) -> None:
    said = sentences.amount(effort("joint elbow", difference, value))
    number, _, unit = said.rpartition(" ")
    assert unit in ("%", "N·m", "finite")
    assert unit != "%" or number.startswith("less") or 0.001 <= float(number) < 1000


@pytest.mark.parametrize(
    ("files", "deviations", "said"),
    [
        (["Joints/Elbow.mo"], [ELBOW], "joint elbow: torque differs by 3.2 % since Joints/Elbow.mo was edited"),
        (
            ["Joints/Slide.mo"],
            [effort("joint slide", 2.0, 20.0, "N")],
            "joint slide: force differs by 10 % since Joints/Slide.mo was edited",
        ),
        (["Links/Hand.mo"], [], "Links/Hand.mo was edited; nothing that is compared changed"),
        (
            ["Links/Hand.mo", "Links/Palm.mo"],
            [SHOULDER, ELBOW, WRIST],
            "joint wrist: torque differs by 2 % (joint elbow by 3.2 %, joint shoulder by 0.5 %) "
            "since Links/Hand.mo and Links/Palm.mo were edited",
        ),
        (
            ["a.mo", "b.mo", "c.mo", "d.mo", "e.mo"],
            [SHOULDER, ELBOW, WRIST, ROLL],
            "joint roll: torque differs by 2 % (joint wrist by 2 %, joint elbow by 3.2 %, and 1 more) "
            "since a.mo, b.mo and 3 more were edited",
        ),
        (
            ["Joints/Elbow.mo"],
            [HAND, TURNED, ELBOW, MASS],
            "link hand: position differs by 12.3 mm and orientation by 3°; joint elbow: torque differs by 3.2 %; "
            "robot: mass differs by 2 %, all since Joints/Elbow.mo was edited",
        ),
        (
            ["Joints/Elbow.mo"],
            [BLIND, ELBOW],
            "joint elbow: torque differs by 3.2 % (angular acceleration of link wheel not finite) "
            "since Joints/Elbow.mo was edited",
        ),
        (
            [f"Links/L{number}.mo" for number in range(12)],
            [HAND, ELBOW],
            "link hand: position differs by 12.3 mm; joint elbow: torque differs by 3.2 %, all because of 12 edited "
            "files (Links/L0.mo, Links/L1.mo, …)",
        ),
        (
            [f"Links/L{number}.mo" for number in range(7)],
            [],
            "7 edited files (Links/L0.mo, Links/L1.mo, …) change nothing that is compared",
        ),
    ],
)
def test_what_an_edit_does_is_one_sentence(files: list[str], deviations: list[Deviation], said: str) -> None:
    assert sentences.effect(EditEffect(tuple(files), tuple(deviations))) == said


@pytest.mark.parametrize(
    ("owners", "deviations", "said"),
    [
        # the link that was edited, not the first that is displaced
        ((), [HAND, BENT], "link hand: position differs by 12.3 mm (link finger by 20 mm)"),
        (("link finger",), [HAND, BENT], "link finger: position differs by 20 mm (link hand by 12.3 mm)"),
        # the joint that was edited, not the last one; all joints before what holds the root
        (
            (),
            [*REACTIONS, SHOULDER, ELBOW],
            "joint elbow: torque differs by 3.2 % (joint shoulder by 0.5 %, "
            "reaction force of link base by 25 % and reaction torque by 1.4 %)",
        ),
        (
            ("joint shoulder",),
            [*REACTIONS, SHOULDER, ELBOW],
            "joint shoulder: torque differs by 0.5 % (joint elbow by 3.2 %, "
            "reaction force of link base by 25 % and reaction torque by 1.4 %)",
        ),
        (("link base",), REACTIONS, "link base: reaction force differs by 25 % and reaction torque by 1.4 %"),
        # what differs is labelled where it is not the same as that of the first element
        (
            (),
            [TURNED, BENT, msgspec.structs.replace(TURNED, element="link finger")],
            "link hand: orientation differs by 3° (position of link finger by 20 mm and orientation by 3°)",
        ),
        (
            (),
            [HAND, TURNED, BENT, msgspec.structs.replace(TURNED, element="link finger")],
            "link hand: position differs by 12.3 mm and orientation by 3° (link finger by 20 mm and 3°)",
        ),
        (
            (),
            [BLIND, *REACTIONS],
            "link wheel: angular acceleration is not finite (reaction force of link base by 25 % "
            "and reaction torque by 1.4 %)",
        ),
    ],
)
def test_the_element_nearest_to_the_cause_comes_first(
    owners: tuple[str, ...], deviations: list[Deviation], said: str
) -> None:
    assert sentences.effect(EditEffect(("a.mo",), tuple(deviations), owners)) == f"{said} since a.mo was edited"


def test_a_failure_says_by_how_much_and_against_what() -> None:
    exact = effort("joint roll", 1e-15, 0.5)
    found = CheckResult("arm", "Arm", deviations=(SHOULDER, ELBOW, exact, HAND), reference="Pinocchio 4.1.0")
    assert sentences.reference_differences(found) == [
        "link hand: position differs from Pinocchio 4.1.0 by 12.3 mm",
        "joint elbow: torque differs from Pinocchio 4.1.0 by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected "
        "(joint shoulder by 0.5 %)",
    ]
    assert sentences.reference_differences(CheckResult("arm", "Arm", deviations=(exact, BLIND))) == [
        "link wheel: angular acceleration is not finite"
    ]
    assert sentences.reference_differences(CheckResult("arm", "Arm")) == []
    assert sentences.advice([found, CheckResult("cart", "Cart")]).startswith(
        "arm as generated, whatever you edited; look at"
    )
    assert sentences.advice([CheckResult("cart", "Cart")]) == ""


def test_two_quantities_of_one_element_are_told_apart() -> None:
    mobile = (*REACTIONS, MASS, CENTRE)
    assert sentences.reference_differences(
        CheckResult("arm", "Arm", deviations=mobile, reference="Pinocchio 4.1.0")
    ) == [
        "link base: reaction force differs from Pinocchio 4.1.0 by 25 %, 7.5 N where up to 30 N are expected, and "
        "reaction torque by 1.4 %, 0.168 N·m where up to 12 N·m are expected",
        "robot: mass differs from Pinocchio 4.1.0 by 2 %, 0.5 kg where 25 kg are expected, and "
        "centre of mass by 38.5 mm",
    ]


@pytest.mark.parametrize(
    ("deviations", "said"),
    [
        ([HAND, ELBOW], ["poses differ by 12.3 mm (link hand)", "torques differ by 3.2 % (joint elbow)"]),
        ([*REACTIONS, ELBOW], ["torques differ by 25 % (reaction force of link base)"]),
        ([BLIND], ["torques are not finite (link wheel)"]),
        ([CENTRE], ["centre of mass differs by 38.5 mm"]),
        ([MASS, CENTRE], ["mass differs by 2 % and centre of mass by 38.5 mm"]),
        ([MASS, msgspec.structs.replace(CENTRE, difference=1e-17)], ["mass differs by 2 %"]),
        (
            [msgspec.structs.replace(MASS, difference=math.inf), CENTRE],
            ["mass is not finite and centre of mass differs by 38.5 mm"],
        ),
        (
            [msgspec.structs.replace(MASS, difference=0), msgspec.structs.replace(CENTRE, difference=0)],
            ["masses agree exactly"],
        ),
    ],
)
def test_a_summary_names_what_differs_most(deviations: list[Deviation], said: list[str]) -> None:
    found = CheckResult("arm", "Arm", compiled=(CompiledModel("Arm", 0, 0),), deviations=tuple(deviations))
    assert sentences.findings(found) == ["1 model compiles", *said]


GAP = "what edits do was not measured: the robot can't be simulated"


@pytest.mark.parametrize(
    ("found", "strict", "head"),
    [
        (CheckResult("arm", "Arm"), False, "right"),
        (CheckResult("arm", "Arm", gaps=(GAP,)), False, "incomplete"),
        (CheckResult("arm", "Arm", gaps=(GAP,)), True, "incomplete"),
        (CheckResult("arm", "Arm", gaps=(GAP,), in_step=False), False, "out of step"),
        (CheckResult("arm", "Arm", in_step=False, conflicting=True), False, "out of step"),
        (CheckResult("arm", "Arm", in_step=False, built=False), False, "not built"),
        (CheckResult("arm", "Arm", effects=(EditEffect(("a.mo",), (ELBOW,)),)), False, "right"),
        (CheckResult("arm", "Arm", effects=(EditEffect(("a.mo",), (ELBOW,)),), gaps=(GAP,)), True, "differs"),
        (CheckResult("arm", "Arm", deviations=(ELBOW,), in_step=False), False, "differs"),
    ],
)
def test_one_word_for_all(found: CheckResult, strict: bool, head: str) -> None:
    assert sentences.verdict(found, strict) == head
