"""Verdicts in words: how much differs, of what, and since when."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.checking import words
from urdfsync.checking.verdict import Comparison, Compiled, Effect, Verdict
from urdfsync.domain import Deviation, Quantity


def effort(element: str, difference: float, value: float, unit: str = "N·m") -> Deviation:
    return Deviation(Quantity.EFFORT, element, difference, value, 60.0, unit)


ELBOW = effort("joint elbow", 0.4, 12.5)
SHOULDER = effort("joint shoulder", 0.3, 60.0)
WRIST = effort("joint wrist", 0.02, 1.0)
ROLL = effort("joint roll", 0.01, 0.5)
HAND = Deviation(Quantity.POSITION, "link hand", 0.0123, 0.9, 1.2, "m")
TURNED = Deviation(Quantity.ORIENTATION, "link hand", math.sin(math.radians(3)), 1.0, 1.0, "")
MASS = Deviation(Quantity.MASS, "robot", 0.5, 25.0, 25.0, "kg")


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
    assert words.amount(found) == said


@given(st.floats(min_value=0, allow_nan=False), st.floats(min_value=0, allow_nan=False, allow_infinity=False))
def test_no_percentage_is_absurd(difference: float, value: float) -> None:
    said = words.amount(effort("joint elbow", difference, value))
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
            [ELBOW, SHOULDER, WRIST],
            "joint elbow: torque differs by 3.2 % (joint shoulder by 0.5 %, joint wrist by 2 %) "
            "since Links/Hand.mo and Links/Palm.mo were edited",
        ),
        (
            ["a.mo", "b.mo", "c.mo", "d.mo", "e.mo"],
            [ELBOW, SHOULDER, WRIST, ROLL],
            "joint elbow: torque differs by 3.2 % (joint shoulder by 0.5 %, joint wrist by 2 %, and 1 more) "
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
            [ELBOW, Deviation(Quantity.ACCELERATION, "joint wheel", math.nan, 1.0, 1.0, "rad/s²")],
            "joint elbow: torque differs by 3.2 % (angular acceleration of joint wheel not finite) "
            "since Joints/Elbow.mo was edited",
        ),
    ],
)
def test_what_an_edit_does_is_one_sentence(files: list[str], deviations: list[Deviation], said: str) -> None:
    assert words.effect(Effect(tuple(files), tuple(deviations))) == said


def test_a_failure_says_by_how_much_and_against_what() -> None:
    exact = effort("joint roll", 1e-15, 0.5)
    broken = Deviation(Quantity.ACCELERATION, "joint wheel", math.nan, 1.0, 1.0, "rad/s²")
    found = Verdict("arm", "Arm", generated=Comparison((exact, SHOULDER, ELBOW, HAND)), reference="Pinocchio 3.4")
    assert words.failures(found) == [
        "link hand: position differs from Pinocchio 3.4 by 12.3 mm",
        "joint elbow: torque differs from Pinocchio 3.4 by 3.2 %, 0.4 N·m of up to 12.5 N·m (joint shoulder by 0.5 %)",
    ]
    assert words.failures(Verdict("arm", "Arm", generated=Comparison((exact, broken)))) == [
        "joint wheel: angular acceleration is not finite"
    ]
    assert words.failures(Verdict("arm", "Arm")) == []
    assert words.advice([found, Verdict("cart", "Cart")]).startswith("arm as generated, whatever you edited; look at")
    assert words.advice([Verdict("cart", "Cart")]) == ""


def test_nothing_compared_and_nothing_compiled_is_said_to_be_no_more() -> None:
    assert words.summary(Verdict("arm", "Arm", seconds=0.31), strict=False) == "right: syntax and layout; 0.3 s"


def test_a_tool_that_does_not_count_is_not_quoted() -> None:
    found = Verdict("arm", "Arm", compiled=(Compiled("Arm", 0, 0), Compiled("ArmRun", 0, 0)), seconds=2)
    assert words.parts(found) == ["2 models compile"]


@pytest.mark.parametrize(
    ("seconds", "said"),
    [(0.04, "0.0 s"), (12.41, "12.4 s"), (99.96, "100 s"), (599.0, "599 s"), (725.0, "12 min")],
)
def test_durations(seconds: float, said: str) -> None:
    assert words.duration(seconds) == said


def test_sentences_that_hold_for_several_robots_are_said_once() -> None:
    verdicts = [Verdict(name, name) for name in ("a", "b", "c", "d")]
    assert words.shared(verdicts, [["x", "y"], ["x"], ["x", "z"], ["x", "z"]]) == [
        "x (all robots)",
        "y (a)",
        "z (c and d)",
    ]
    assert words.shared(verdicts[:1], [["x", "y"]]) == ["x", "y"]
