"""Robots from two sources, in the frames of the first: without differences that are none of their motion."""

from __future__ import annotations

import random
from math import pi

import pytest
from msgspec.structs import replace

from urdfsync.formats.urdf.diff.common_frames import in_common_frames
from urdfsync.formats.urdf.robot import Inertia, Inertial, Joint, Link, Origin, Robot


def random_robot(seed: int) -> Robot:
    """A tree of six links with random masses, inertias and frames."""
    rng = random.Random(seed)

    def origin() -> Origin:
        x, y, z, *turn = (rng.uniform(-1, 1) for _ in range(6))
        return Origin((x, y, z), (3 * turn[0], 1.5 * turn[1], 3 * turn[2]))

    links, joints = list[Link](), list[Joint]()
    for number in range(6):
        size = 10 ** rng.uniform(-6, 1)
        numbers = {name: size * rng.uniform(1, 1.9) for name in ("ixx", "iyy", "izz")}
        numbers |= {name: size * rng.uniform(-0.2, 0.2) for name in ("ixy", "ixz", "iyz")}
        tensor = Inertia(**numbers)
        links.append(Link(f"link{number}", Inertial(rng.choice((1.0, 60.0, rng.uniform(0.01, 50))), origin(), tensor)))
        if number:
            kind = rng.choice(("fixed", "revolute", "continuous", "prismatic"))
            axis = rng.choice(((1.0, 0.0, 0.0), (0.0, 0.6, 0.8)))
            parent = f"link{rng.randrange(number)}"
            joints.append(Joint(f"joint{number}", kind, parent, f"link{number}", origin(), axis))  # type: ignore[arg-type]
    return Robot("robot", tuple(links), tuple(joints))


@pytest.mark.parametrize("seed", range(40))
def test_a_robot_does_not_differ_from_itself(seed: int) -> None:
    """Also where the rounding of a rounded number changes its last digit, as for some moments of inertia."""
    old, new = in_common_frames(random_robot(seed), random_robot(seed), {})
    assert new == old


MOMENTS = Inertia(ixx=0.1, iyy=0.2, izz=0.25)


def standing(rpy: tuple[float, float, float]) -> Robot:
    """A pendulum on a block that stands in this orientation in the world."""
    block = Link("block", Inertial(6.0, Origin((0.1, 0.2, 0.0)), MOMENTS))
    arm = Link("arm", Inertial(1.0, Origin((0.3, 0.0, 0.0)), MOMENTS))
    hinge = Joint("hinge", "continuous", "block", "arm", Origin((0.0, 0.0, 0.5)), (0.0, 1.0, 0.0))
    mount = Joint("mount", "fixed", "world", "block", Origin((0.0, 0.0, 1.0), rpy))
    return Robot("robot", (Link("world"), block, arm), (mount, hinge))


def without_world(robot: Robot) -> Robot:
    """The same robot with the block as its root."""
    return replace(robot, links=robot.links[1:], joints=robot.joints[1:])


def mounts(old: Robot, new: Robot) -> list[tuple[float, ...]]:
    """Return the orientations of both robots in the world, if they differ."""
    pair = in_common_frames(old, new, {})
    return [joint.origin.rpy for robot in pair for joint in robot.joints if joint.name == "world_fixed"]


@pytest.mark.parametrize("turn", [(0.0, pi / 2, 0.0), (0.4, 0.0, 0.0), (pi, 0.0, 0.0), (0.3, -0.2, 0.0)])
def test_a_robot_that_stands_otherwise_moves_otherwise(turn: tuple[float, float, float]) -> None:
    """Gravity pulls in another direction of its block, whether or not a source names the world."""
    upright, tilted = standing((0.0, 0.0, 0.0)), standing(turn)
    for first in (upright, without_world(upright)):
        before, after = mounts(first, tilted)
        assert before == (0.0, 0.0, 0.0)
        assert after[0] ** 2 + after[1] ** 2 > 0.1
        before, after = mounts(tilted, first)
        assert before != after


@pytest.mark.parametrize("tilt", [(0.0, 0.0, 0.0), (0.3, -0.2, 0.0), (0.0, 1.2, 0.0)])
def test_a_turn_about_the_vertical_and_another_place_make_no_difference(tilt: tuple[float, float, float]) -> None:
    old, new = standing(tilt), standing((tilt[0], tilt[1], 0.7))
    moved = replace(new.joints[0], origin=replace(new.joints[0].origin, xyz=(1.0, 2.0, 3.0)))
    new = replace(new, joints=(moved, *new.joints[1:]))
    first, second = in_common_frames(old, new, {})
    assert first == second
    assert len(first.links) == 2


def test_frames_that_are_turned_in_a_robot_that_stands_alike_make_no_difference() -> None:
    """The y-axis of the second block's frame points upwards. Without the world, this frame counts as upright."""
    old, turn = standing((0.0, 0.0, 0.0)), (pi / 2, 0.0, 0.0)
    block = Link("block", Inertial(6.0, Origin((0.1, 0.0, -0.2), (-pi / 2, 0.0, 0.0)), MOMENTS))
    hinge = replace(old.joints[1], origin=Origin((0.0, 0.5, 0.0), (-pi / 2, 0.0, 0.0)))
    new = replace(standing(turn), links=(old.links[0], block, old.links[2]))
    new = replace(new, joints=(new.joints[0], hinge))
    assert mounts(old, new) == []
    first, second = in_common_frames(old, new, {})
    assert first == second
    assert len(mounts(old, without_world(new))) == 2


def test_a_rounded_angle_is_no_tilt() -> None:
    """Exporters write 1.5708 for a right angle, which other formats have with all digits."""
    assert mounts(standing((pi / 2, 0.0, 0.0)), standing((1.5708, 0.0, 0.0))) == []
