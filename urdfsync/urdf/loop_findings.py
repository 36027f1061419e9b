"""Diagnostics about the loops of a robot that need its poses: whether they close, and by what they are moved."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from urdfsync.diagnostics import Severity
from urdfsync.urdf.drives import assemble_loops
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.validate import ADVICE, Finding

_NOTABLE = 1e-5
"""Gap in m and rad from which on the start of the source is told not to close a loop: above rounding in exports."""


class LoopFinding(NamedTuple):
    """A finding about a loop."""

    loop: str
    code: str
    message: str
    hint: str = ""

    @property
    def is_fault(self) -> bool:
        """Whether the robot has no model because of it."""
        return ADVICE[self.code][0] is Severity.ERROR

    def at_source(self) -> Finding:
        """Return it as a finding about the source."""
        return Finding(self.code, f"loop {self.loop}", self.message, self.hint)


def find_loop_findings(tree: KinematicTree, options: Options) -> Iterator[LoopFinding]:
    """Yield why loops have no model, or else what their model has that the source does not say."""
    assembly = assemble_loops(tree, options)
    if assembly is None:
        return
    if isinstance(assembly, tuple):
        yield from (LoopFinding(fault.loop, fault.code, fault.message, fault.hint) for fault in assembly)
        return
    for name, gap in assembly.gaps.items():
        if max(gap.distance, gap.angle) > _NOTABLE:
            apart = f"{1000 * gap.distance:.3g} mm and {math.degrees(gap.angle):.3g}°"
            yield LoopFinding(name, "loop-closed", f"loop {name!r} is {apart} open at the start of the source")
    for name, closure in assembly.closures.items():
        if closure.weaker:
            yield LoopFinding(name, "loop-weaker", f"loop {name!r} is {closure.weaker}")
    if assembly.excess:
        names, first = ", ".join(map(repr, assembly.excess)), tree.loops[0].name
        message = f"joints {names} are not driven: the loops leave {assembly.freedoms} freedoms, which others move"
        yield LoopFinding(first, "loop-excess", message)
