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

from urdfsync.urdf.kinematics.poses import own_range
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTIONS, Joint, Vector

GRAVITY = 9.81
"""In m/s², along -z of the world."""

ENDLESS = 1e300
"""A larger limit counts as no limit: results would be infinite."""
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
    """The instants, in s.

    Instants up to `TURNED` are compared with Pinocchio. The next six instants check limits, the last four the force of
    the ground.
    """

    START = 0
    """At rest under gravity, as at the beginning of Run and Test, but with accelerations."""
    SLOW = 1
    """So slow that dry friction is about to change its sign."""
    BACK = 2
    """Slow in the other direction."""
    FAST = 3
    TURNED = 4
    """Fast in the other direction."""
    BELOW = 5
    """Just below the lower end of the range, just too fast, and speeding up just too much."""
    LOW = 6
    """Just within the range, and just slow enough."""
    HIGH = 7
    ABOVE = 8
    """Just above the upper end of the range, and slowing down just too much."""
    STRAINED = 9
    """The effort is just above its limit, in the negative direction: this shows a lost sign."""
    LOADED = 10
    """The effort is just below its limit, in the positive direction."""
    STANDING = 11
    """The robot stands on the ground, if one of its shapes can touch the ground."""
    SLIDING = 12
    SINKING = 13
    RISING = 14


COMPARED = tuple(map(float, list(Instant)[: Instant.TURNED + 1]))
"""At these instants, all quantities are compared."""
JUST = 1e-3
"""Distance of a value from its limit, as a fraction of the limit."""
LOADS = {Instant.STRAINED: -1 - JUST, Instant.LOADED: 1 - JUST}
"""The effort on each axis at these instants, as a fraction of its limit."""
PERIOD = 10.0
"""In s: duration of the motion of Test, there and back."""
GROUND_DEPTH = 1e3
"""In m: depth of the ground, beyond the reach of any robot, but small enough to keep digits."""
ON_GROUND: Mapping[Instant, Vector] = {
    Instant.STANDING: (0.0, 0.0, 0.0),
    Instant.SLIDING: (0.003, -0.002, 0.0),
    Instant.SINKING: (0.0, 0.0, -0.005),
    Instant.RISING: (0.0, 0.0, 1.0),
}
"""Velocity of a standing robot's base at each instant. It slides so slowly that the slip speed has an effect."""
TILT = 1e-3
"""In rad: angle of the base while the robot sinks. With an angle, the forms of shapes have an effect."""
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


def _swinging(start: float, swing: float, shift: float) -> list[Course]:
    """Return the courses of a coordinate at the instants up to `TURNED`."""
    rows = (zip(_SWINGS[instant], _SHIFTS[instant], strict=True) for instant in _SWINGS)
    courses = ([swing * a + shift * b for a, b in row] for row in rows)
    return [Course(start + position, speed, gain) for position, speed, gain in courses]


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
BENCH_LOAD = 500.0
"""In N: weight for which the ground of a bench is designed."""
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


def axis_courses(joint: Joint, start: float, strains: Mapping[Instant, float] = {}) -> tuple[Course, ...]:
    """Return the courses of a driven axis from its `start`; `strains` are its accelerations under load."""
    course, (lower, upper) = axis_course(joint), own_range(joint)
    middle, reach = (lower + upper) / 2, (upper - lower) / 2
    if not reach < ENDLESS:
        middle, reach = start, 0.5
    speed = joint.limit.velocity if joint.limit and joint.limit.velocity is not None else math.inf
    speed = speed if speed < ENDLESS else abs(course.speed)
    courses = _swinging(start, course.speed, course.acceleration / 2)
    up, down = (gain if gain < ENDLESS else 0.0 for gain in greatest_gains(joint))
    for side, just, gain in ((-1, JUST, up), (-1, -JUST, up), (1, -JUST, down), (1, JUST, down)):
        courses.append(Course(middle + side * reach * (1 + just), side * speed * (1 + just), -gain * (1 + just)))
    courses += [Course(middle, 0.0, strains.get(instant, 0.0)) for instant in LOADS]
    return (*courses, *(Course(start, 0.0, 0.0) for _ in ON_GROUND))


def greatest_gains(joint: Joint) -> tuple[float, float]:
    """Return the limits of a joint's acceleration and deceleration."""
    up = joint.limit.acceleration if joint.limit and joint.limit.acceleration is not None else math.inf
    return up, joint.limit.deceleration if joint.limit and joint.limit.deceleration is not None else up


def loop_courses(joint: Joint, start: float, share: float) -> tuple[Course, ...]:
    """Return the courses of an axis in a loop: a `share` of the usual motion, within all limits."""
    course = axis_course(joint)
    moving = _swinging(start, share * course.speed, share * course.acceleration / 2)
    return (*moving, *(Course(start, 0.0, 0.0) for _ in range(len(Instant) - len(moving))))


def base_courses(depth: float = -GROUND_DEPTH) -> tuple[tuple[Course, ...], ...]:
    """Return the courses of the base's x, y, z and angle.

    The base rests while joints are at their limits. `depth` is the depth of the standing robot in the ground.
    """
    every = list[tuple[Course, ...]]()
    for k, course in enumerate((*PATH, TURN)):
        moving, place = _swinging(*course), -GROUND_DEPTH - depth if k == 2 else 0.0
        resting = [Course(course.position, 0.0, 0.0) for _ in range(len(Instant) - len(moving) - len(ON_GROUND))]
        places = [TILT * (k == 3 and at is Instant.SINKING) + place for at in ON_GROUND]
        standing = [Course(p, (*v, 0.0)[k], 0.0) for p, v in zip(places, ON_GROUND.values(), strict=True)]
        every.append((*moving, *resting, *standing))
    return tuple(every)


def driven_axes(tree: KinematicTree) -> tuple[Joint, ...]:
    """Return the joints with a drive, first turning ones, then sliding ones."""
    return tuple(joint for motion in MOTIONS for joint in tree.axes(motion))
