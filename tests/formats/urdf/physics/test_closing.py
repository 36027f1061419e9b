"""Closed poses by Pinocchio: against geometry, differences in time, and the forces that hold the loops."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace
from support.loops import FOUR_BAR, ROBOTS, joint, to_urdf

from urdfsync.domain import Target
from urdfsync.domain.experiment import Sample
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.physics.closing import OpenLoopError
from urdfsync.formats.urdf.physics.completion import completed_for_reference
from urdfsync.formats.urdf.physics.motion import Course, Instant
from urdfsync.formats.urdf.physics.subject import Subject
from urdfsync.formats.urdf.robot import Inertia, Inertial, Link, Origin, Robot


def subject(robot: Robot) -> Subject:
    content = completed_for_reference(to_urdf(robot).encode()).content
    return Subject(Sample(content, "robot.urdf", Target("Bot", "Bot"), Options(), {}), robot)


def test_a_four_bar_closes_as_its_triangles_do() -> None:
    """The rocker's end is where circles about its pivot and about the crank's end meet."""
    four = subject(FOUR_BAR)
    for angle in (0.8, 1.2, 1.6):
        state = four.reference.state([Course(angle, 0.0, 0.0)])
        x, y = 0.2 * math.cos(angle) - 0.5, 0.2 * math.sin(angle)
        distance = math.hypot(x, y)
        rocker = math.atan2(y, x) - math.acos((distance**2 + 0.4**2 - 0.6**2) / (2 * 0.4 * distance))
        row = four.reference.multibody.coordinates["rocker_pivot"].start
        assert state.positions[row] == pytest.approx(rocker, abs=1e-12)


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
def test_velocities_and_accelerations_are_those_of_positions_over_time(robot: Robot) -> None:
    moving, step = subject(robot), 1e-4
    courses = [course[Instant.FAST] for course in moving.courses]
    before, now, after = (
        moving.reference.state([course.ahead(time) for course in courses]) for time in (-step, 0, step)
    )
    speeds = (after.positions - before.positions) / (2 * step)
    gains = (after.positions - 2 * now.positions + before.positions) / step**2
    assert now.v[6:] == pytest.approx(speeds[6:], abs=1e-6)
    assert now.a[6:] == pytest.approx(gains[6:], abs=1e-5)
    assert np.abs(now.v[6:]).min() > 1e-3


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
def test_forces_that_act_from_outside_in_place_of_the_loops_leave_dependent_joints_nothing_to_do(robot: Robot) -> None:
    moving = subject(robot)
    reference, state, solved = moving.reference, moving.states[3.0], moving.solved[3.0]
    multibody = reference.multibody
    assert reference.closing
    load = multibody.efforts(state.q, state.v, state.a)
    data, open_load = multibody.move(state.q), load.copy()
    for each in reference.closing.loads(state.q, load):
        place = multibody.pose(data, each.link)[0]
        open_load -= multibody.jacobian(data, each.link).T @ np.concatenate([each.force, each.torque_at(place)])
    own = [multibody.coordinates[name].start for name in reference.axes]
    others = [row for row in range(6, multibody.nv) if row not in own]
    assert open_load[own] == pytest.approx(solved.efforts, abs=1e-10)
    assert open_load[others] == pytest.approx(0, abs=1e-10)
    assert np.abs(load[others]).min() > 1e-6
    assert open_load[:6] == pytest.approx([*solved.force, *solved.torque], abs=1e-10)


def test_a_loop_that_opens_on_the_way_is_moved_less() -> None:
    """With a coupler of 0.25 m, the crank locks at 2.3 rad."""
    (loop,), (pivot, *others) = FOUR_BAR.loops, FOUR_BAR.joints
    coupler = replace(loop, origin=Origin((0.25, 0.0, 0.0)))
    short = subject(replace(FOUR_BAR, joints=(replace(pivot, start=2.0), *others), loops=(coupler,)))
    with pytest.raises(OpenLoopError):
        short.reference.state([Course(2.4, 0.0, 0.0)])
    assert short.share < subject(FOUR_BAR).share == 1
    assert {float(instant) for instant in Instant} == short.states.keys()


def test_a_start_whose_rounding_opens_long_bars_is_closed_before_it_is_judged() -> None:
    """Twelve decimals of an angle are a picometre at the end of a bar of some metres."""
    (loop,), (pivot, pin, rocker) = FOUR_BAR.loops, FOUR_BAR.joints
    pins = replace(pin, origin=Origin((2.0, 0.0, 0.0))), replace(rocker, origin=replace(rocker.origin, xyz=(5.0, 0, 0)))
    long_bars = replace(loop, origin=Origin((6.0, 0.0, 0.0)), child_origin=Origin((4.0, 0.0, 0.0)))
    moving = subject(replace(FOUR_BAR, joints=(pivot, *pins), loops=(long_bars,)))
    assert moving.share == 1
    assert max(abs(moving.solved[0.0].reactions[0].gap)) < 1e-14


def test_what_a_loop_leaves_open_is_told_in_the_world() -> None:
    """A planar loop leaves its bars apart along the axes; the base of a check turns."""
    (loop,) = FOUR_BAR.loops
    apart = replace(loop, child_origin=replace(loop.child_origin, xyz=(*loop.child_origin.xyz[:2], 5e-5)))
    moving = subject(replace(FOUR_BAR, loops=(apart,)))
    ends = (apart.parent, apart.origin), (apart.child, apart.child_origin)
    for solved in moving.solved.values():
        frames = [(*solved.poses[link], np.array(origin.xyz)) for link, origin in ends]
        parent, child = (place + axes @ xyz for place, axes, xyz in frames)
        assert solved.reactions[0].gap == pytest.approx(child - parent, abs=1e-12)
        assert np.linalg.norm(child - parent) == pytest.approx(5e-5)


def test_light_parts_on_heavy_ones_are_left_what_closed_poses_leave_open() -> None:
    """A ball at the coupler's end turns freely."""
    (loop,), light = FOUR_BAR.loops, Inertial(1e-6, inertia=Inertia(ixx=3e-11, iyy=3e-11, izz=3e-11))
    turning = joint("ball_turn", "continuous", "coupler", "ball", 0.6)
    ends = replace(loop, kind="ball", parent="ball", origin=Origin())
    doubts = list[float]()
    for inertial in (light, Inertial(0.1, inertia=Inertia(ixx=1e-4, iyy=1e-4, izz=1e-4))):
        links = *FOUR_BAR.links, Link("ball", inertial)
        moving = subject(replace(FOUR_BAR, links=links, joints=(*FOUR_BAR.joints, turning), loops=(ends,)))
        response = moving.reference.free_gains(moving.states[0.0], np.zeros(2), is_free=False)
        assert response
        doubts.append(response[1])
    assert 1e-7 < doubts[0] < 1e-2
    assert doubts[1] < 1e-7
