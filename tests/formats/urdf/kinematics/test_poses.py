"""Poses and start positions against independent answers."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Iterator

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from support.robots import SCALAR, robots, urdf

from urdfsync.formats.urdf.kinematics.poses import (
    Pose,
    across,
    link_poses,
    own_range,
    pose,
    roll_pitch_yaw,
    start_positions,
)
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import Joint, JointType, Limit, Link, Mimic, Origin, Robot

Array = NDArray[np.float64]
NUMBERS = st.floats(-3, 3)


def homogeneous(value: Pose) -> Array:
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = value
    return result


def configuration(model: pin.Model, robot: Robot, positions: dict[str, float]) -> Array:
    """Pinocchio's vector of positions, in which a continuous joint has a cosine and a sine."""
    q: Array = pin.neutral(model)
    for joint in robot.joints:
        if joint.type != "fixed":
            at = model.joints[model.getJointId(joint.name)].idx_q
            value = positions[joint.name]
            if joint.type == "prismatic":
                q[at] = value
            else:
                q[at : at + 2] = math.cos(value), math.sin(value)
    return q


@pytest.mark.slow
@settings(deadline=None)
@given(robots(("continuous", "prismatic", "fixed"), mimics=0.0), st.lists(NUMBERS, min_size=7, max_size=7))
def test_link_poses_are_those_of_pinocchio(robot: Robot, values: list[float]) -> None:
    positions = {joint.name: value for joint, value in zip(robot.joints, values, strict=False)}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = pin.buildModelFromXML(urdf(robot))
    data = model.createData()
    pin.framesForwardKinematics(model, data, configuration(model, robot, positions))
    poses = link_poses(KinematicTree.of(robot), positions)
    assert poses.keys() == {link.name for link in robot.links}
    for link, found in poses.items():
        expected = data.oMf[model.getFrameId(link, pin.FrameType.BODY)].homogeneous
        assert np.abs(homogeneous(found) - expected).max() < 1e-12 * max(1, np.abs(expected).max()), link


def followed(robot: Robot, leader: str) -> Iterator[tuple[Joint, float, float]]:
    """Every joint that moves with a leader, and factor and offset of its position."""
    waiting = [(leader, 1.0, 0.0)]
    while waiting:
        name, factor, offset = waiting.pop()
        yield next(joint for joint in robot.joints if joint.name == name), factor, offset
        for joint in robot.joints:
            if joint.mimic and joint.mimic.joint == name:
                m = joint.mimic
                waiting.append((joint.name, m.multiplier * factor, m.multiplier * offset + m.offset))


def allowed(joints: Iterable[tuple[Joint, float, float]]) -> tuple[float, float]:
    """The positions of a leader at which no joint that moves with it is outside of its own range."""
    lowest, highest = -math.inf, math.inf
    for joint, factor, offset in joints:
        if factor:
            ends = sorted((end - offset) / factor for end in own_range(joint))
            lowest, highest = max(lowest, ends[0]), min(highest, ends[1])
    return lowest, highest


@pytest.mark.slow
@given(robots(SCALAR))
def test_start_positions_respect_all_ranges_and_are_as_close_to_zero_as_these_allow(robot: Robot) -> None:
    positions = start_positions(KinematicTree.of(robot))
    assert positions.keys() == {joint.name for joint in robot.joints}
    for leader in robot.joints:
        if leader.mimic is None:
            joints = list(followed(robot, leader.name))
            lowest, highest = allowed(joints)
            if lowest <= highest:
                assert positions[leader.name] == pytest.approx(min(max(0, lowest), highest), abs=1e-9)
            for joint, factor, offset in joints:
                assert positions[joint.name] == pytest.approx(factor * positions[leader.name] + offset, abs=1e-9)


def chain(*joints: Joint) -> KinematicTree:
    return KinematicTree.of(Robot("r", (Link("l0"), *(Link(joint.child) for joint in joints)), joints))


def test_a_joint_starts_where_it_is_said_and_its_follower_with_it() -> None:
    leader = Joint("leader", "revolute", "l0", "l1", limit=Limit(-3, 3), start=0.5)
    follower = Joint("follower", "revolute", "l1", "l2", limit=Limit(-3, 3), mimic=Mimic("leader", -2, 0.25))
    assert start_positions(chain(leader, follower)) == {"leader": 0.5, "follower": -0.75}


def test_joints_that_follow_a_fixed_one_are_held_at_their_offsets() -> None:
    mount = Joint("mount", "fixed", "l0", "l1")
    held = Joint("held", "revolute", "l1", "l2", limit=Limit(-3, -2), mimic=Mimic("mount", 1, 0.25))
    assert start_positions(chain(mount, held)) == {"mount": 0, "held": 0.25}


FLOATS = st.floats(allow_nan=False, allow_infinity=False)


@given(st.sampled_from(["revolute", "continuous"]), FLOATS, FLOATS, NUMBERS)
@example("revolute", 1e-320, 0.0, 1.0)
@example("continuous", 1e10, 0.0, 0.0)
def test_absurd_numbers_still_give_finite_positions(
    kind: JointType, multiplier: float, offset: float, end: float
) -> None:
    leader = Joint("a", "revolute", "l0", "l1", limit=Limit(1e300, 1e305))
    follower = Joint("b", kind, "l1", "l2", limit=Limit(end, end + 1), mimic=Mimic("a", multiplier, offset))
    assert all(map(math.isfinite, start_positions(chain(leader, follower)).values()))


@given(
    st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda numbers: max(map(abs, numbers)) > 1e-3), st.floats(1e-200, 1e200)
)
@example((0.5, 0.5, -0.5, 0.5), 1.0)
@example((0.5, 0.5 + 1e-9, -0.5, 0.5), 1.0)
@example((0.5, -0.5, 0.5, 0.5 - 1e-12), 1.0)
def test_angles_of_a_quaternion(numbers: tuple[float, float, float, float], length: float) -> None:
    """The same orientation as Pinocchio's, also where roll and yaw turn about one axis."""
    expected = pin.Quaternion(np.array(numbers) / np.linalg.norm(numbers)).matrix()
    rotation, _ = pose(Origin(rpy=roll_pitch_yaw([length * number for number in numbers])))
    assert np.abs(np.array(rotation) - expected).max() < 1e-14


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (2 / 7, -3 / 7, 6 / 7), (-0.8, 0.0, 0.6)])
def test_two_vectors_across_an_axis_complete_a_frame(axis: tuple[float, float, float]) -> None:
    frame = np.array([axis, *across(axis)])
    assert frame @ frame.T == pytest.approx(np.eye(3))
    assert np.linalg.det(frame) == pytest.approx(1)
