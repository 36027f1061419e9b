"""Joints that a simulation of the package or of the generic robot can't move, told where the URDF says them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.drives import can_be_driven, driven_joints
from urdfsync.urdf.kinematics.massless import Massless, find_massless_joints, has_mass
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint, Robot

_BY_PACKAGE = "or use the package approach"
_PLANAR = f"write it as two prismatic joints and a continuous one, {_BY_PACKAGE}"
_FLOATING_BASE = (
    f'leave it out with its parent link and let the base float (`base = "floating"` in a project), {_BY_PACKAGE}'
)
_FLOATING = f"write it as three prismatic joints and three continuous ones, {_BY_PACKAGE}"
# What is wrong with a joint that moves no mass, and what to do about it.
_MASSLESS = {
    Massless.NOTHING_BEHIND: ("moves no mass", "give a link behind it an <inertial>, or make it a fixed joint"),
    Massless.ON_AXIS: (
        "turns nothing that has an inertia about its axis",
        "give a link behind it such an inertia, or make it a fixed joint",
    ),
    Massless.UNDONE: (
        "moves no mass where it starts if joints behind it undo its motion, as one about the same axis can",
        "give the link right behind it an <inertial>, or make it a fixed joint",
    ),
}


def massless_passive_joints(
    robot: Robot, options: Options, file: str, lines: Mapping[str, int]
) -> Iterator[Diagnostic]:
    """Yield a warning for each joint of the package that is not driven and moves nothing where the robot starts.

    Driven joints count as fixed: they move as prescribed, so a passive joint behind one or before one gets no motion
    from it that would undo its own. `file` and `lines` are those of `RobotReading`.
    """
    passive = {joint.name for joint in robot.joints if can_be_driven(joint)} - driven_joints(robot.joints, options)
    for name in find_massless_joints(KinematicTree.of(robot), passive) if passive else ():
        if name in passive:
            message = f"joint '{name}' is not driven and moves no mass where it starts, so nothing determines its "
            message += "motion in Run and Test"
            hint = "give a link behind it an <inertial>, drive it (`driven`), or make it a fixed joint"
            line = lines.get(f"joint {name}", 0)
            yield Diagnostic(Severity.WARNING, "passive-moves-no-mass", message, file, line, hint=hint)


def out_of_scope(robot: Robot, file: str, lines: Mapping[str, int]) -> Iterator[Diagnostic]:
    """Yield a warning for each joint that leaves the record without tables, or else for each that can't move freely.

    `file` and `lines` are those of `RobotReading`.
    """

    def warning(code: str, message: str, hint: str, element: str) -> Diagnostic:
        return Diagnostic(Severity.WARNING, code, message, file, lines.get(element, 0), hint=hint)

    unfit = obstacles(robot.joints)
    for joint in unfit:
        message = f"the generic robot has no {joint.type} joints, so there are no tables for it: joint '{joint.name}'"
        yield warning(f"{joint.type}-not-generic", message, _hint(joint, robot), f"joint {joint.name}")
    if unfit:
        return
    tree = KinematicTree.of(robot)
    found = find_massless_joints(tree)
    if found and not any(map(has_mass, tree.links)):
        message = "no link has a mass, so the joints of the generic robot can be moved by position only"
        yield warning("moves-no-mass", message, "give the links an <inertial>", "robot")
        return
    empty = set[str]()  # links with nothing behind them, in front of which a joint was named
    for joint in tree.joints:
        why = found.get(joint.name)
        if why and (joint.parent not in empty or why is Massless.UNDONE):
            problem, hint = _MASSLESS[why]
            message = f"joint '{joint.name}' {problem}, so the generic robot can move it by position only"
            yield warning("moves-no-mass", message, hint, f"joint {joint.name}")
        if joint.parent in empty or why is Massless.NOTHING_BEHIND:
            empty.add(joint.child)


def _hint(joint: Joint, robot: Robot) -> str:
    if joint.type == "planar":
        return _PLANAR
    others = [other for other in robot.joints if joint.parent in (other.parent, other.child)]
    return _FLOATING_BASE if others == [joint] else _FLOATING
