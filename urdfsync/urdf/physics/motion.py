"""The motion of a robot in the comparison: a function of names and limits alone, the same on every machine.

The base and all driven axes follow polynomials of time.
"""

from __future__ import annotations

import math
import random
from typing import NamedTuple

from urdfsync.urdf.kinematics.poses import own_range
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTIONS, Joint, Vector

DURATION = 0.01
"""End of the motion, in s: prescribed motion is exact all the time."""
GRAVITY = 9.81
"""Along -z of the world, in m/s²."""

_FARTHEST = 10.0  # limits beyond it (m or rad) say nothing about where a joint is at home, and cost digits


class Course(NamedTuple):
    """One coordinate over time, q = position + speed·t + acceleration·t²/2."""

    position: float
    speed: float
    acceleration: float

    def at(self, time: float) -> Course:
        """Return the course as it is at a later time."""
        position = self.position + self.speed * time + self.acceleration * time**2 / 2
        return Course(position, self.speed + self.acceleration * time, self.acceleration)


PATH = (Course(0.4, -0.6, 1.1), Course(-0.3, 0.8, -0.7), Course(0.9, 0.5, 1.6))
"""x, y and z of the root link's frame in the world."""
TURN = Course(0.7, 0.9, -1.4)
"""Angle of the root link's frame about `TURN_AXIS`."""
TURN_AXIS: Vector = (2 / 7, 3 / 7, -6 / 7)
"""At an angle to all axes of the world, so that gravity and centrifugal forces act along all axes of the root link."""


def axis_course(joint: Joint) -> Course:
    """Return the course of a driven axis. It begins near the middle of its range, if that is finite and sensible.

    The joint's name decides, so that a new joint leaves the motion of the others alone. No speed is close to zero,
    where faults do not show.
    """
    draw = random.Random(joint.name)  # noqa: S311 - nothing is kept secret

    def signed(least: float, most: float) -> float:
        return math.copysign(draw.uniform(least, most), draw.uniform(-1, 1))

    lower, upper = own_range(joint)
    middle, reach = 0.0, 0.5
    if -_FARTHEST <= lower < upper <= _FARTHEST:
        middle, reach = (lower + upper) / 2, min((upper - lower) / 4, 0.5)
    position = middle + draw.uniform(-reach, reach)
    return Course(position, signed(0.25, 0.5), signed(0.5, 1.0))


def driven_axes(tree: KinematicTree) -> tuple[Joint, ...]:
    """Return the joints with a drive, first those that turn, then those that slide."""
    return tuple(joint for motion in MOTIONS for joint in tree.axes(motion))
