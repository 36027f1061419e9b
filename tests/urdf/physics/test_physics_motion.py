"""The prescribed motion: inside limits, the same everywhere, and nowhere so slow that a fault hides."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.physics.motion import (
    DURATION,
    INSTANT,
    TURN_AXIS,
    Course,
    Floating,
    Planar,
    axis_course,
    duration,
    free_start,
)
from urdfsync.urdf.robot import Joint, JointType, Limit, Link, Robot

NAMES = st.text(min_size=1, max_size=20)


def joint(kind: JointType, name: str = "elbow", limits: Limit | None = None) -> Joint:
    return Joint(name, kind, "upper", "fore", limit=limits)


def test_a_course_is_a_parabola() -> None:
    assert Course(1.0, 2.0, 3.0).at(2.0) == (1 + 2 * 2 + 3 * 4 / 2, 2 + 3 * 2, 3)


@given(NAMES, st.floats(-10, 10), st.floats(1e-6, 20))
def test_axes_begin_in_the_middle_half_of_their_range(name: str, lower: float, width: float) -> None:
    upper = min(lower + width, 10.0)
    if lower < upper:
        start = axis_course(joint("revolute", name, Limit(lower, upper))).position
        quarter = (upper - lower) / 4
        assert lower + quarter - 1e-9 <= start <= upper - quarter + 1e-9
        assert abs(start - (lower + upper) / 2) <= 0.5 + 1e-9


@pytest.mark.parametrize(
    "limits", [None, Limit(0.0, 0.0), Limit(-1e9, 1e9), Limit(100.0, 200.0)], ids=["none", "point", "wide", "far"]
)
def test_other_ranges_do_not_count(limits: Limit | None) -> None:
    assert axis_course(joint("prismatic", limits=limits)) == axis_course(joint("continuous"))
    assert abs(axis_course(joint("prismatic", limits=limits)).position) <= 0.5


@given(NAMES)
def test_no_axis_moves_so_slowly_that_its_losses_hide(name: str) -> None:
    course = axis_course(joint("continuous", name))
    assert 0.25 <= abs(course.speed) <= 0.5
    assert 0.5 <= abs(course.acceleration) <= 1.0


def test_the_motion_is_the_same_on_every_machine() -> None:
    assert axis_course(joint("continuous")) == (0.3658443950165243, 0.3519522504876569, -0.5698369843751905)
    start = free_start(joint("planar"))
    assert isinstance(start, Planar)
    assert (start.s[0], start.w) == (-0.5329221975082622, 0.40647037601981817)


def test_every_joint_moves_in_its_own_way() -> None:
    names = [f"joint_{number}" for number in range(50)]
    assert len({axis_course(joint("continuous", name)) for name in names}) == 50
    assert len({free_start(joint("floating", name)) for name in names}) == 50


def test_no_free_joint_begins_where_conventions_do_not_matter() -> None:
    start = free_start(joint("floating"))
    assert isinstance(start, Floating)
    assert len({abs(value) for vector in start for value in vector}) == 12
    assert all(abs(value) >= 0.1 for vector in start for value in vector)


def test_the_base_turns_about_a_unit_vector_that_is_no_axis() -> None:
    assert math.hypot(*TURN_AXIS) == pytest.approx(1.0, abs=1e-15)
    assert min(map(abs, TURN_AXIS)) > 0.2


@pytest.mark.parametrize(("kind", "end"), [("revolute", DURATION), ("planar", DURATION), ("floating", INSTANT)])
def test_floating_joints_are_looked_at_for_an_instant_only(kind: JointType, end: float) -> None:
    robot = Robot("", (Link("upper"), Link("fore")), (joint(kind),))
    assert duration(KinematicTree.of(robot)) == end
