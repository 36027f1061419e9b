"""The closed loops of a robot: start pose, degrees of freedom, and the equations and states of the model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import msgspec

from urdfsync.common.spelling import counted
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import Vector
from urdfsync.formats.urdf.validate import Finding

NOTABLE = 1e-5
"""In m and rad: smaller gaps at the source's start, and smaller motions of joints, are rounding errors of exporters."""


class Gap(msgspec.Struct, frozen=True):
    """The gap of a loop in a pose."""

    distance: float
    """The distance between the origins of both frames, in m."""
    angle: float
    """The angle between the axes of both frames that a closed loop aligns, in rad."""

    def __str__(self) -> str:
        """Return the gap in words."""
        return f"{1000 * self.distance:.3g} mm and {round(math.degrees(self.angle), 6):.3g}°"


class Closure(msgspec.Struct, frozen=True):
    """The equations that close a loop in a model. They are independent of each other and of other loops' equations."""

    translations: tuple[Vector, ...]
    """Unit vectors in the frame of the parent: along each, the distance of both origins is zero."""
    rotations: tuple[tuple[Vector, Vector], ...]
    """Pairs of unit vectors, u in the frame of the parent and v in the frame of the child: u·R·v = 0."""
    planar: Vector | None = None
    """Normal of the loop's plane, in the frame of the parent, if two translations in the plane close the loop."""
    weaker: str | None = None
    """The reason why the loop has fewer equations than its kind; also None for a planar loop."""


class ClosedLoops(msgspec.Struct, frozen=True, kw_only=True):
    """The closed loops of a robot, or the faults of its loops. Without loops, only `tree` and `driven` are set."""

    tree: KinematicTree
    """The robot. Joints of loops begin in a closed pose: the start pose of the source, if that pose is closed."""
    driven: frozenset[str]
    """All driven joints of the robot."""
    joints: tuple[str, ...] = ()
    """Joints that loops restrict, and the leaders of such joints, in canonical order."""
    states: tuple[str, ...] = ()
    """One of `joints` for each degree of freedom: driven joints, then others.

    The states determine all other joints. The number of states is the number of independent joints minus the rank of
    the constraints at generic poses.
    """
    excess: tuple[str, ...] = ()
    """Joints that are named as drives but not driven, since other drives already move the loops."""
    reach: Mapping[str, float] = {}
    """The greatest motion of each driven joint in Test: the loops stay closed if all move at once."""
    closures: Mapping[str, Closure] = {}
    gaps: Mapping[str, Gap] = {}
    """The gap of each loop at the start of the source."""
    moved: Mapping[str, str] = {}
    """Joints that do not begin at their given start, with the distance in words."""
    choices: Mapping[str, str] = {}
    """Driven joints of loops with the reason for each choice, if neither source nor options name such joints."""
    faults: tuple[Finding, ...] = ()
    """The reasons why loops stay open: then only `tree` (unchanged) and `driven` are set."""

    @property
    def dependent(self) -> frozenset[str]:
        """Joints whose positions loops determine from the positions of other joints."""
        return frozenset(self.joints).difference(self.states)


def find_loop_findings(closed: ClosedLoops) -> Iterator[Finding]:
    """Yield the faults of loops, or the differences between their models and the source."""
    yield from closed.faults
    for name, gap in closed.gaps.items():
        if max(gap.distance, gap.angle) > NOTABLE:
            yield Finding("loop-closed", f"loop {name}", f"loop {name!r} is {gap} open at the start of the source")
    if closed.moved:
        moves = ", ".join(f"{name!r} {way}" for name, way in closed.moved.items())
        yield Finding("start-moved", f"joint {next(iter(closed.moved))}", f"to close the loops, joints move: {moves}")
    if closed.choices:
        choices = ", ".join(f"{name!r} ({reason})" for name, reason in closed.choices.items())
        yield Finding("loop-drives", f"loop {closed.tree.loops[0].name}", f"Run and Test drive {choices}")
    for name, closure in closed.closures.items():
        if closure.weaker:
            yield Finding("loop-weaker", f"loop {name}", f"loop {name!r} is {closure.weaker}")
    if closed.excess:
        names, freedoms = ", ".join(map(repr, closed.excess)), counted(len(closed.states), "freedom")
        message = f"the drives of {names} are left out: other joints already drive the {freedoms}"
        yield Finding("loop-excess", f"loop {closed.tree.loops[0].name}", message)
