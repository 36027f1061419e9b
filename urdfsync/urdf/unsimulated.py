"""Diagnostics about joints that a simulation of the package or of the generic robot can't move."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.drives import can_be_driven, dependent_joints, driven_joints
from urdfsync.urdf.kinematics.massless import find_massless_joints
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS

_HINTS = {
    "planar": "write it as two prismatic joints and a continuous one, or use the package approach",
    "floating": "write it as three prismatic joints and three continuous ones, or use the package approach; if the "
    'root link has no other joint, remove both and set `base = "floating"` in a project',
}


def find_unsimulated(
    tree: KinematicTree, options: Options, file: str, lines: Mapping[str, int]
) -> Iterator[Diagnostic]:
    """Yield diagnostics about parts that the chosen approaches can't simulate.

    `file` and `lines` are those of `RobotReading`.
    """
    if "record" in options.approach:
        yield from out_of_scope(tree, file, lines)
    if "package" not in options.approach:
        names = ", ".join(sensor.name for sensor in tree.sensors)
        parts = [f"sensors ({names})"] * bool(names) + ["flanges of motors"] * (options.drives == "motor")
        if parts:
            message = f"the record approach has no {' and no '.join(parts)}"
            hint = 'add "package" to `approach` for them'
            yield Diagnostic(Severity.NOTE, "not-in-record", message, file, hint=hint)
        return
    # Driven joints count as fixed. They move as prescribed, so that none can undo the motion of a passive joint.
    passive = {joint.name for joint in tree.joints if can_be_driven(joint)} - driven_joints(tree, options)
    passive -= dependent_joints(tree, options)
    for name in find_massless_joints(tree, passive) if passive else ():
        if name in passive:
            message = f"joint '{name}' is not driven and moves no mass where it starts, so nothing determines its "
            message += "motion in Run and Test"
            hint = "give a link behind it an <inertial>, drive it (`driven`), or make it a fixed joint"
            line = lines.get(f"joint {name}", 0)
            yield Diagnostic(Severity.WARNING, "passive-moves-no-mass", message, file, line, hint=hint)


def out_of_scope(tree: KinematicTree, file: str, lines: Mapping[str, int]) -> Iterator[Diagnostic]:
    """Yield a warning for each joint that leaves the record without tables, or else for each that can't move freely.

    `file` and `lines` are those of `RobotReading`.
    """

    def warning(code: str, message: str, hint: str, element: str) -> Diagnostic:
        return Diagnostic(Severity.WARNING, code, message, file, lines.get(element, 0), hint=hint)

    if tree.loops:
        message = "the generic robot has no loops, and is open in the record"
        hint = "generate a package for it"
        yield warning("loops-not-in-record", message, hint, f"loop {tree.loops[0].name}")
    unfit = obstacles(tree.joints)
    for joint in unfit:
        message = (
            f"joint '{joint.name}' is {joint.type}; the generic robot has no such joints, so the record has no tables"
        )
        yield warning(f"{joint.type}-not-generic", message, _HINTS[joint.type], f"joint {joint.name}")
    if unfit:
        return
    inertials = [link.inertial for link in tree.links if link.inertial is not None]
    has_mass = any(part.mass or part.inertia.ixx or part.inertia.iyy or part.inertia.izz for part in inertials)
    if not has_mass and any(joint.type in MOTION_KINDS for joint in tree.joints):
        message = "no link has a mass, so the joints of the generic robot can be moved by position only"
        yield warning("moves-no-mass", message, "give the links an <inertial>", "robot")
        return
    massless = set(find_massless_joints(tree))
    behind = set[str]()  # links behind a joint with a warning: no further joint there gets one
    for joint in tree.joints:
        if joint.name in massless and joint.parent not in behind:
            message = f"joint '{joint.name}' moves no inertia about its axis, or only one that is behind "
            message += "another joint on the same axis, so the generic robot can move it by position only"
            hint = "give the link right behind it an <inertial>, or make it a fixed joint"
            yield warning("moves-no-mass", message, hint, f"joint {joint.name}")
        if joint.name in massless or joint.parent in behind:
            behind.add(joint.child)
