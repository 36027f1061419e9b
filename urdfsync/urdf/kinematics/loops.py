"""The closed loops of a robot: its start pose, its freedoms, and the equations and states of its model."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping

import msgspec

from urdfsync.spelling import counted
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import Vector
from urdfsync.urdf.validate import Finding

NOTABLE = 1e-5
"""Smaller gaps at the source's start and smaller motions of joints are not reported, in m and rad: exports round."""


class Gap(msgspec.Struct, frozen=True):
    """The gap of a loop in a pose."""

    distance: float
    """Between the origins of both frames, in m."""
    angle: float
    """Between the axes that the loop's kind holds together, in rad."""

    def __str__(self) -> str:
        """Return the gap in words."""
        return f"{1000 * self.distance:.3g} mm and {round(math.degrees(self.angle), 6):.3g}°"


class Closure(msgspec.Struct, frozen=True):
    """The equations by which a model closes a loop: independent of each other, and of all other loops' equations."""

    translations: tuple[Vector, ...]
    """Unit vectors in the frame of the parent, along which the origins of both frames coincide."""
    rotations: tuple[tuple[Vector, Vector], ...]
    """Pairs of unit vectors u in the frame of the parent and v in that of the child: u·R·v = 0."""
    planar: Vector | None = None
    """Normal of the plane in the frame of the parent, if there are two translations in a plane and no rotations."""
    weaker: str | None = None
    """The reason for fewer equations than the kind has; None also for a planar loop."""


class ClosedLoops(msgspec.Struct, frozen=True, kw_only=True):
    """The closed loops of a robot, or their faults, and its driven joints; a robot without loops has only drives."""

    tree: KinematicTree
    """The robot; joints that move a loop begin in a closed pose: at the start of the source, if that is closed."""
    driven: frozenset[str]
    """All joints of the robot that are driven."""
    joints: tuple[str, ...] = ()
    """Joints whose motion the loops restrict, with the leaders of followers, in canonical order."""
    states: tuple[str, ...] = ()
    """Of `joints`, one for each freedom: driven ones, then others. All other joints follow from these.

    They are as many as the joints that follow no other joint, less the rank of the constraints at generic poses.
    """
    excess: tuple[str, ...] = ()
    """Joints that are named as drives but not driven, since others move the loops already."""
    reach: Mapping[str, float] = {}
    """How far Test moves each driven one of `joints` at most: the loops stay closed when all move at once."""
    closures: Mapping[str, Closure] = {}
    gaps: Mapping[str, Gap] = {}
    """The gap of each loop at the start of the source."""
    moved: Mapping[str, str] = {}
    """Joints that do not begin at their given start, each with the distance in words."""
    choices: Mapping[str, str] = {}
    """The driven ones of `joints` with the reason for each, if neither source nor options name any."""
    faults: tuple[Finding, ...] = ()
    """Why the loops can't be closed. If they can't, the tree is unchanged, and only `driven` and `proposed` are set."""
    proposed: Mapping[str, float] = {}
    """If loops are singular at the start: nearby positions of joints at which no loop is; empty if none are found."""

    @property
    def dependent(self) -> frozenset[str]:
        """Joints whose positions follow from those of other joints through loops."""
        return frozenset(self.joints).difference(self.states)


def find_loop_findings(closed: ClosedLoops) -> Iterator[Finding]:
    """Yield why loops have no model, or else how their model differs from the source."""
    start = ", ".join(f"{json.dumps(name)} = {value:g}" for name, value in closed.proposed.items())
    hint = f"let its joints start elsewhere, as in `start = {{ {start} }}`" if 0 < len(closed.proposed) < 10 else ""
    yield from (fault._replace(hint=fault.hint or hint) for fault in closed.faults)
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
