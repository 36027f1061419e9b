"""Robots from two sources, in the frames of the first: without differences that are none of their motion."""

from __future__ import annotations

import random

import pytest

from urdfsync.urdf.diff.common_frames import in_common_frames
from urdfsync.urdf.robot import Inertia, Inertial, Joint, Link, Origin, Robot


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
