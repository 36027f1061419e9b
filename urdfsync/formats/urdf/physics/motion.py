"""The motion in which `check` compares a package with Pinocchio.

The motion depends only on names and limits, so it is equal on all machines. One simulation goes through all instants,
since compiling is expensive. At each instant, base and axes have given positions, speeds and accelerations. Between
instants, all motion is smooth: joints in loops follow by integration, and a jump would stop the integration.
"""

from __future__ import annotations

import enum
import itertools
import math
import random
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from urdfsync.formats.urdf.kinematics.poses import own_range
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTIONS, Joint, Vector

GRAVITY = 9.81
"""In m/s², along -z of the world."""

_FARTHEST = 10.0  # m or rad; wider limits do not show where a joint works, and cost digits


class Course(NamedTuple):
    """Position, speed and acceleration of one coordinate at an instant."""

    position: float
    speed: float
    acceleration: float

    def ahead(self, time: float) -> Course:
        """Return the course `time` seconds after the instant, at constant acceleration."""
        position = self.position + self.speed * time + self.acceleration * time**2 / 2
        return Course(position, self.speed + self.acceleration * time, self.acceleration)

    def way_to(self, goal: Course) -> tuple[float, ...]:
        """Return the coefficients of a polynomial in the time since the instant; it reaches `goal` after 1 s."""
        d, v, a = (there - left for there, left in zip(goal, self.ahead(1.0), strict=True))
        parabola = self.position, self.speed, self.acceleration / 2
        return *parabola, 10 * d - 4 * v + a / 2, 7 * v - 15 * d - a, 6 * d - 3 * v + a / 2


class Instant(enum.IntEnum):
    """The instants of the comparison, in s."""

    START = 0
    """At rest under gravity, as at the beginning of Run and Test, but with accelerations."""
    SLOW = 1
    """So slow that dry friction is about to change its sign."""
    BACK = 2
    """Slow in the other direction."""
    FAST = 3
    TURNED = 4
    """Fast in the other direction."""


COMPARED = tuple(map(float, Instant))
_SWINGS = {
    Instant.START: (0.0, 0.0, 0.0),
    Instant.SLOW: (0.5, 2e-3, 0.7),
    Instant.BACK: (-0.3, -1e-3, -0.9),
    Instant.FAST: (0.8, 1.0, 1.5),
    Instant.TURNED: (-0.7, -1.0, -1.1),
}
"""Factors of the first amplitude, for position, speed and acceleration."""
_SHIFTS = {
    Instant.START: (0.0, 0.0, 1.0),
    Instant.SLOW: (1.0, 0.0, -1.2),
    Instant.BACK: (0.6, 0.0, 0.8),
    Instant.FAST: (-0.4, 0.0, 1.3),
    Instant.TURNED: (0.9, 0.0, -0.7),
}
"""Factors of the second amplitude, which makes speed and acceleration independent."""


def ways(courses: Sequence[Course]) -> list[tuple[float, ...]]:
    """Return the polynomials of a coordinate, one for the second after each instant."""
    return [course.way_to(goal) for course, goal in itertools.pairwise([*courses, courses[-1].ahead(1.0)])]


def _swinging(start: float, swing: float, shift: float) -> tuple[Course, ...]:
    """Return the courses of a coordinate at the instants."""
    rows = (zip(_SWINGS[instant], _SHIFTS[instant], strict=True) for instant in _SWINGS)
    courses = ([swing * a + shift * b for a, b in row] for row in rows)
    return tuple(Course(start + position, speed, gain) for position, speed, gain in courses)


PATH = (Course(0.4, -0.6, 1.1), Course(-0.3, 0.8, -0.7), Course(0.9, 0.5, 1.6))
"""x, y and z of the root link's frame in the world."""
TURN = Course(0.7, 0.9, -1.4)
"""Angle of the root link's frame about `TURN_AXIS`."""
TURN_AXIS: Vector = (2 / 7, 3 / 7, -6 / 7)  # in its frame, a ball joint turns about this axis, too
"""The axis is oblique, so that gravity and centrifugal forces act along all axes of the root link."""


FREE_START: Mapping[str, Vector] = {
    "r_start": (0.0, 0.0, 1.5),  # the height of the stance
    "rpy_start": (0.4, -0.3, 0.9),
    "v_start": (0.5, -0.3, 0.8),
    "w_start": (0.7, -1.1, 0.6),
}
"""The start of a free base, resolved in the world. All angles differ, so that a wrong order shows."""
BENCH_GRAVITY = 9.80665
"""Gravity of the standard library's world, as in Run and Test."""


def axis_course(joint: Joint) -> Course:
    """Return the course of a driven axis.

    The axis begins near the middle of a range that is not too large. The numbers are drawn from the joint's name, so
    that a new joint does not change the motion of others. No speed is close to zero, where faults would be invisible.
    """
    draw = random.Random(joint.name)  # noqa: S311 - not for cryptography

    def signed(least: float, most: float) -> float:
        return math.copysign(draw.uniform(least, most), draw.uniform(-1, 1))

    lower, upper = own_range(joint)
    middle, reach = 0.0, 0.5
    if -_FARTHEST <= lower < upper <= _FARTHEST:
        middle, reach = (lower + upper) / 2, min((upper - lower) / 4, 0.5)
    position = middle + draw.uniform(-reach, reach)
    return Course(position, signed(0.25, 0.5), signed(0.5, 1.0))


def axis_courses(joint: Joint, start: float, share: float = 1.0) -> tuple[Course, ...]:
    """Return the courses of a driven axis from its `start`, with a `share` of the usual motion."""
    course = axis_course(joint)
    return _swinging(start, share * course.speed, share * course.acceleration / 2)


def base_courses() -> tuple[tuple[Course, ...], ...]:
    """Return the courses of the base's x, y, z and angle."""
    return tuple(_swinging(*course) for course in (*PATH, TURN))


def driven_axes(tree: KinematicTree) -> tuple[Joint, ...]:
    """Return the joints with a drive, first turning ones, then sliding ones."""
    return tuple(joint for motion in MOTIONS for joint in tree.axes(motion))
