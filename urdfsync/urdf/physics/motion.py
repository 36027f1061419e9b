"""The motion of a robot in the comparison: a function of names and limits, the same on every machine.

One simulation goes through all instants, since compiling is expensive. At each instant base and axes have given
positions, speeds and accelerations. In between they move smoothly: joints in loops follow by integration, which jumps
would stop.
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
"""Along -z of the world, in m/s²."""

ENDLESS = 1e300
"""A larger limit is none: numbers that follow from it would be infinite."""
_FARTHEST = 10.0  # limits beyond it (m or rad) do not show where a joint works, and cost digits


class Course(NamedTuple):
    """One coordinate at an instant."""

    position: float
    speed: float
    acceleration: float

    def ahead(self, time: float) -> Course:
        """Return the course at a time after the instant."""
        position = self.position + self.speed * time + self.acceleration * time**2 / 2
        return Course(position, self.speed + self.acceleration * time, self.acceleration)

    def way_to(self, goal: Course) -> tuple[float, ...]:
        """Return coefficients of the time since the instant: they lead to the goal one second later."""
        d, v, a = (there - left for there, left in zip(goal, self.ahead(1.0), strict=True))
        parabola = self.position, self.speed, self.acceleration / 2
        return *parabola, 10 * d - 4 * v + a / 2, 7 * v - 15 * d - a, 6 * d - 3 * v + a / 2


class Instant(enum.IntEnum):
    """The instants, in s.

    All up to `TURNED` are compared with the reference; at the others only limits are checked, and at the last four the
    ground's force.
    """

    START = 0
    """At rest under gravity, where Run and Test begin; only accelerations differ."""
    SLOW = 1
    """So slow that dry friction changes its sign."""
    BACK = 2
    """The same in the other direction."""
    FAST = 3
    TURNED = 4
    """Fast in the other direction."""
    BELOW = 5
    """Just below the lower end of the range, and just too fast."""
    LOW = 6
    """Just inside, and just slow enough."""
    HIGH = 7
    ABOVE = 8
    STRAINED = 9
    """The effort is just above its limit, backward, so that a lost sign shows."""
    LOADED = 10
    """The effort is just below, in the other direction."""
    STANDING = 11
    """The robot stands where the ground carries it, if it can."""
    SLIDING = 12
    SINKING = 13
    RISING = 14


COMPARED = tuple(map(float, list(Instant)[: Instant.TURNED + 1]))
"""The instants at which all quantities are compared."""
JUST = 1e-3
"""Part of a limit by which it is passed or kept."""
LOADS = {Instant.STRAINED: -1 - JUST, Instant.LOADED: 1 - JUST}
"""The part of its effort limit that drives each axis."""
PERIOD = 10.0
"""Of the way there and back in Test, in s."""
GROUND_DEPTH = 1e3
"""Depth of the ground in m: farther than any robot reaches, and near enough for digits."""
ON_GROUND: Mapping[Instant, Vector] = {
    Instant.STANDING: (0.0, 0.0, 0.0),
    Instant.SLIDING: (0.3, -0.2, 0.0),
    Instant.SINKING: (0.0, 0.0, -0.005),
    Instant.RISING: (0.0, 0.0, 1.0),
}
"""Speeds of a robot that stands."""
_SWINGS = {
    Instant.START: (0.0, 0.0, 0.0),
    Instant.SLOW: (0.5, 2e-3, 0.7),
    Instant.BACK: (-0.3, -1e-3, -0.9),
    Instant.FAST: (0.8, 1.0, 1.5),
    Instant.TURNED: (-0.7, -1.0, -1.1),
}
"""Parts of one amplitude in position, speed and acceleration."""
_SHIFTS = {
    Instant.START: (0.0, 0.0, 1.0),
    Instant.SLOW: (1.0, 0.0, -1.2),
    Instant.BACK: (0.6, 0.0, 0.8),
    Instant.FAST: (-0.4, 0.0, 1.3),
    Instant.TURNED: (0.9, 0.0, -0.7),
}
"""Those of another amplitude, so that speed and acceleration are independent."""


def ways(courses: Sequence[Course]) -> list[tuple[float, ...]]:
    """Return the way of a coordinate from each instant on."""
    return [course.way_to(goal) for course, goal in itertools.pairwise([*courses, courses[-1].ahead(1.0)])]


def _swinging(start: float, swing: float, shift: float) -> list[Course]:
    """Return a coordinate at the instants up to `TURNED`."""
    rows = (zip(_SWINGS[instant], _SHIFTS[instant], strict=True) for instant in _SWINGS)
    courses = ([swing * a + shift * b for a, b in row] for row in rows)
    return [Course(start + position, speed, gain) for position, speed, gain in courses]


PATH = (Course(0.4, -0.6, 1.1), Course(-0.3, 0.8, -0.7), Course(0.9, 0.5, 1.6))
"""x, y and z of the root link's frame in the world."""
TURN = Course(0.7, 0.9, -1.4)
"""Angle of the root link's frame about `TURN_AXIS`."""
TURN_AXIS: Vector = (2 / 7, 3 / 7, -6 / 7)  # also that of prescribed balls, in the joint frame
"""At an angle to all axes of the world, so that gravity and centrifugal forces act along all axes of the root link."""


FREE_START: Mapping[str, Vector] = {
    "r_start": (0.3, -0.2, 1.5),
    "rpy_start": (0.4, -0.3, 0.9),
    "v_start": (0.5, -0.3, 0.8),
    "w_start": (0.7, -1.1, 0.6),
}
"""The start of a free base, resolved in the world; no two angles are equal, so that their order shows."""
BENCH_GRAVITY = 9.80665
"""Gravity of the standard library's world, as in Run and Test."""


def axis_course(joint: Joint) -> Course:
    """Return the course of a driven axis.

    It begins near the middle of its range, if that is finite and sensible. The joint's name decides, so that a new
    joint does not change the motion of the others. No speed is close to zero, where faults are invisible.
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
    """Return the courses of a driven axis that starts at `start`; `strains` are its accelerations under load."""
    course, (lower, upper) = axis_course(joint), own_range(joint)
    middle, reach = (lower + upper) / 2, (upper - lower) / 2
    if not reach < ENDLESS:
        middle, reach = start, 0.5
    speed = joint.limit.velocity if joint.limit and joint.limit.velocity is not None else math.inf
    speed = speed if speed < ENDLESS else abs(course.speed)
    courses = _swinging(start, course.speed, course.acceleration / 2)
    for side, just in ((-1, JUST), (-1, -JUST), (1, -JUST), (1, JUST)):
        courses.append(Course(middle + side * reach * (1 + just), side * speed * (1 + just), 0.0))
    courses += [Course(middle, 0.0, strains.get(instant, 0.0)) for instant in LOADS]
    return (*courses, *(Course(start, 0.0, 0.0) for _ in ON_GROUND))


def loop_courses(joint: Joint, start: float, share: float) -> tuple[Course, ...]:
    """Return the courses of an axis in a loop: a share of the motion of others, without passed limits."""
    course = axis_course(joint)
    moving = _swinging(start, share * course.speed, share * course.acceleration / 2)
    return (*moving, *(Course(start, 0.0, 0.0) for _ in range(len(Instant) - len(moving))))


def base_courses(depth: float = -GROUND_DEPTH) -> tuple[tuple[Course, ...], ...]:
    """Return the courses of the base's x, y, z and angle; it rests while limits are passed.

    `depth` is the robot's depth in the ground.
    """
    every = list[tuple[Course, ...]]()
    for k, course in enumerate((*PATH, TURN)):
        moving, place = _swinging(*course), -GROUND_DEPTH - depth if k == 2 else 0.0
        resting = [Course(course.position, 0.0, 0.0) for _ in range(len(Instant) - len(moving) - len(ON_GROUND))]
        standing = [Course(place, (*speeds, 0.0)[k], 0.0) for speeds in ON_GROUND.values()]
        every.append((*moving, *resting, *standing))
    return tuple(every)


def driven_axes(tree: KinematicTree) -> tuple[Joint, ...]:
    """Return the joints with a drive, first turning ones, then sliding ones."""
    return tuple(joint for motion in MOTIONS for joint in tree.axes(motion))
