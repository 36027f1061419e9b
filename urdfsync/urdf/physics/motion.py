"""How a robot moves in the comparison: a function of names and limits alone, the same on every machine.

The base and all driven axes follow polynomials of time. Planar and floating joints have no drives in generated
packages: they begin with the positions and speeds of `Planar` and `Floating`, and move as the forces want.
"""

from __future__ import annotations

import math
import random
from typing import NamedTuple, TypeAlias

from urdfsync.urdf.kinematics.poses import own_range
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.robot import Joint, Vector

DURATION = 0.01
"""End of the motion, in s: prescribed motion is exact all the time."""
INSTANT = 1e-6
"""End of the motion with floating joints, in s: errors of a solver in their quaternions are no errors of the robot."""
GRAVITY = 9.81
"""Along -z of the world, in m/s²."""

_FARTHEST = 10.0  # limits beyond it (m or rad) say nothing about where a joint is at home, and cost digits


class Course(NamedTuple):
    """One coordinate over time, q = position + speed·t + acceleration·t²/2."""

    position: float
    speed: float
    acceleration: float

    def at(self, time: float) -> Course:
        """The course as it is later."""
        position = self.position + self.speed * time + self.acceleration * time**2 / 2
        return Course(position, self.speed + self.acceleration * time, self.acceleration)


PATH = (Course(0.4, -0.6, 1.1), Course(-0.3, 0.8, -0.7), Course(0.9, 0.5, 1.6))
"""x, y and z of the root link's frame in the world."""
TURN = Course(0.7, 0.9, -1.4)
"""Angle of the root link's frame about `TURN_AXIS`."""
TURN_AXIS: Vector = (2 / 7, 3 / 7, -6 / 7)
"""At an angle to all axes of the world, so that gravity and centrifugal forces act along all axes of the root link."""


class Planar(NamedTuple):
    """Start of a planar joint: along its two directions (m, m/s), and about the normal (rad, rad/s)."""

    s: tuple[float, float]
    v: tuple[float, float]
    phi: float
    w: float


class Floating(NamedTuple):
    """Start of a floating joint, resolved in the joint frame: m, rad (roll, pitch, yaw), m/s and rad/s."""

    r: Vector
    rpy: Vector
    v: Vector
    w: Vector


Start: TypeAlias = Planar | Floating
"""Its fields are the parameters `s_start`, … of the joint's model."""


def axis_course(joint: Joint) -> Course:
    """The course of a driven axis: it begins near the middle of its range, if that is finite and sensible."""
    draw = random_numbers(joint)
    lower, upper = own_range(joint)
    middle, reach = 0.0, 0.5
    if -_FARTHEST <= lower < upper <= _FARTHEST:
        middle, reach = (lower + upper) / 2, min((upper - lower) / 4, 0.5)
    position = middle + draw.uniform(-reach, reach)
    return Course(position, signed(draw, 0.25, 0.5), signed(draw, 0.5, 1.0))


def driven_axes(tree: KinematicTree) -> tuple[Joint, ...]:
    """Joints with a drive, first those that turn, then those that slide."""
    return (*tree.axes("rotational"), *tree.axes("translational"))


def free_joints(tree: KinematicTree) -> tuple[Joint, ...]:
    """Joints without a drive, each after those that carry it."""
    return tuple(obstacles(tree.joints))


def free_start(joint: Joint) -> Start:
    """Where a planar or floating joint begins, and how fast."""
    draw = random_numbers(joint)

    def vector() -> Vector:
        return signed(draw, 0.1, 0.6), signed(draw, 0.1, 0.6), signed(draw, 0.1, 0.6)

    if joint.type == "planar":
        (x, y, v_x), (v_y, phi, w) = vector(), vector()
        return Planar((x, y), (v_x, v_y), phi, w)
    return Floating(vector(), vector(), vector(), vector())


def duration(tree: KinematicTree) -> float:
    """End of the motion, in s."""
    return INSTANT if any(joint.type == "floating" for joint in tree.joints) else DURATION


def random_numbers(joint: Joint) -> random.Random:
    """Random numbers of one joint: its name decides, so that a new joint leaves the motion of the others alone."""
    return random.Random(joint.name)  # noqa: S311 - nothing is kept secret


def signed(draw: random.Random, least: float, most: float) -> float:
    """A number of either sign, and not close to zero, where faults do not show."""
    return math.copysign(draw.uniform(least, most), draw.uniform(-1, 1))
