"""The motion of a robot in a check: what it passes through, how it gets there, and what it leaves alone."""

from __future__ import annotations

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from urdfsync.urdf.physics.motion import GROUND_DEPTH, Course, Instant, axis_courses, base_courses, loop_courses, ways
from urdfsync.urdf.robot import Joint, Limit

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


def test_an_axis_is_just_within_and_just_beyond_its_limits() -> None:
    found = axis_courses(elbow(lower=-1.0, upper=3.0), 0.2)
    assert found[Instant.START][:2] == (0.2, 0.0)
    places = [found[instant].position for instant in (Instant.BELOW, Instant.LOW, Instant.HIGH, Instant.ABOVE)]
    assert places == pytest.approx([-1.002, -0.998, 2.998, 3.002])
    speeds = [abs(found[instant].speed) for instant in (Instant.BELOW, Instant.LOW, Instant.HIGH, Instant.ABOVE)]
    assert speeds == pytest.approx([2.002, 1.998, 1.998, 2.002])
    found = axis_courses(elbow(lower=-1.0, upper=3.0, acceleration=4.0, deceleration=5.0), 0.2)
    gains = [found[instant].acceleration for instant in (Instant.BELOW, Instant.LOW, Instant.HIGH, Instant.ABOVE)]
    assert gains == pytest.approx([-4.004, -3.996, -4.995, -5.005])
    strained = axis_courses(elbow(lower=-1.0, upper=3.0), 0.2, {Instant.LOADED: 7.0})
    assert strained[Instant.LOADED] == (1.0, 0.0, 7.0)
    assert strained[Instant.STANDING :] == (Course(0.2, 0.0, 0.0),) * 4


@pytest.mark.parametrize("end", [math.inf, 1.7e308])
def test_an_axis_without_limits_stays_near_its_start(end: float) -> None:
    for course in axis_courses(elbow(lower=-end, upper=end, velocity=end), 0.2):
        assert abs(course.position) < 2
        assert abs(course.speed) < 2


def test_the_motion_of_an_axis_follows_from_its_name_alone() -> None:
    first, same, other = (axis_courses(elbow(name, lower=-1.0, upper=1.0), 0.0) for name in ("a", "a", "b"))
    assert first == same
    assert all(one != another for one, another in zip(first[1:5], other[1:5], strict=True))
    assert all(abs(course.speed) > 2e-4 for course in first[Instant.SLOW : Instant.BELOW])


def test_an_axis_in_a_loop_makes_a_share_of_the_way_and_rests_where_limits_are_passed() -> None:
    whole, half = (loop_courses(elbow(), 0.3, share) for share in (1.0, 0.5))
    for course, smaller in zip(whole, half, strict=True):
        assert smaller.position - 0.3 == pytest.approx((course.position - 0.3) / 2)
        assert smaller[1:] == pytest.approx([value / 2 for value in course[1:]])
    assert set(whole[Instant.BELOW :]) == {Course(0.3, 0.0, 0.0)}


def test_the_base_moves_rests_and_stands() -> None:
    *place, turn = base_courses(depth=-2.0)
    assert all(len(courses) == len(Instant) for courses in (*place, turn))
    assert all(len(set(courses[: Instant.BELOW])) == 5 for courses in (*place, turn))
    for one, another in itertools.pairwise(turn[Instant.BELOW : Instant.STANDING]):
        assert one == another
        assert one[1:] == (0.0, 0.0)
    assert place[2][Instant.STANDING].position == 2.0 - GROUND_DEPTH
    assert place[2][Instant.SINKING].speed < 0 < place[2][Instant.RISING].speed
