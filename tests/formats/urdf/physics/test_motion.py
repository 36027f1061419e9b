"""The motion of a robot in a check: what it passes through, how it gets there, and what it leaves alone."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from urdfsync.formats.urdf.physics.motion import Course, Instant, axis_courses, base_courses, ways
from urdfsync.formats.urdf.robot import Joint, Limit

numbers = st.floats(-10, 10)
courses = st.lists(st.builds(Course, numbers, numbers, numbers), min_size=1, max_size=4)


def elbow(name: str = "elbow", **limits: float) -> Joint:
    return Joint(name, "revolute", "a", "b", limit=Limit(**{"effort": 1.0, "velocity": 2.0, **limits}))


@given(courses=courses)
def test_a_way_begins_and_ends_with_place_speed_and_acceleration(courses: list[Course]) -> None:
    found = [Polynomial(way) for way in ways(courses)]
    assert len(found) == len(courses)
    for way, here, there in zip(found, courses, [*courses[1:], courses[-1].ahead(1.0)], strict=True):
        for time, course in ((0.0, here), (1.0, there)):
            now = way(time), way.deriv()(time), way.deriv(2)(time)
            assert now == pytest.approx(course, abs=1e-9)


@pytest.mark.parametrize("end", [math.inf, 1.7e308])
def test_an_axis_without_limits_stays_near_its_start(end: float) -> None:
    for course in axis_courses(elbow(lower=-end, upper=end, velocity=end), 0.2):
        assert abs(course.position) < 2
        assert abs(course.speed) < 2


def test_the_motion_of_an_axis_follows_from_its_name_alone() -> None:
    first, same, other = (axis_courses(elbow(name, lower=-1.0, upper=1.0), 0.0) for name in ("a", "a", "b"))
    assert first == same
    assert all(one != another for one, another in zip(first[1:], other[1:], strict=True))
    assert all(abs(course.speed) > 2e-4 for course in first[Instant.SLOW :])


def test_an_axis_in_a_loop_makes_a_share_of_the_way() -> None:
    whole, half = (axis_courses(elbow(), 0.3, share) for share in (1.0, 0.5))
    for course, smaller in zip(whole, half, strict=True):
        assert smaller.position - 0.3 == pytest.approx((course.position - 0.3) / 2)
        assert smaller[1:] == pytest.approx([value / 2 for value in course[1:]])


def test_the_base_moves_and_turns() -> None:
    assert all(len(set(courses)) == len(Instant) == len(courses) for courses in base_courses())
