"""Diagnostics about the loops of a robot that need its poses: whether they close, and by what they are moved."""

from __future__ import annotations

import math
from collections.abc import Iterator

from urdfsync.urdf.drives import assemble_loops
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.validate import Finding

_NOTABLE = 1e-5
"""Gap in m and rad from which on the start of the source is told not to close a loop: above rounding in exports."""


def find_loop_findings(tree: KinematicTree, options: Options) -> Iterator[Finding]:
    """Yield why loops have no model, or else what their model has that the source does not say."""
    assembly = assemble_loops(tree, options)
    if assembly is None or isinstance(assembly, tuple):
        yield from assembly or ()
        return
    for name, gap in assembly.gaps.items():
        if max(gap.distance, gap.angle) > _NOTABLE:
            apart = f"{1000 * gap.distance:.3g} mm and {math.degrees(gap.angle):.3g}°"
            yield Finding("loop-closed", f"loop {name}", f"loop {name!r} is {apart} open at the start of the source")
    for name, closure in assembly.closures.items():
        if closure.weaker:
            yield Finding("loop-weaker", f"loop {name}", f"loop {name!r} is {closure.weaker}")
    if assembly.excess:
        names = ", ".join(map(repr, assembly.excess))
        message = f"joints {names} are not driven: the loops leave {assembly.freedoms} freedoms, which others move"
        yield Finding("loop-excess", f"loop {tree.loops[0].name}", message)
