"""Passive joints that move no mass: Run and Test of the package approach have no acceleration for them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.drives import can_be_driven, driven_joints
from urdfsync.urdf.kinematics.massless import find_massless_joints
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Robot


def massless_passive_joints(
    robot: Robot, options: Options, file: str, lines: Mapping[str, int]
) -> Iterator[Diagnostic]:
    """A warning for each joint that is not driven and moves nothing where the robot starts.

    Driven joints count as fixed: they move as prescribed, so a passive joint behind one or before one gets no motion
    from it that would undo its own. `file` and `lines` are those of `RobotReading`.
    """
    passive = {joint.name for joint in robot.joints if can_be_driven(joint)} - driven_joints(robot.joints, options)
    if not passive:
        return
    for name in find_massless_joints(KinematicTree.of(robot), passive):
        if name in passive:
            message = (
                f"joint '{name}' is not driven and moves no mass where it starts, so nothing determines its "
                "motion in Run and Test"
            )
            hint = "give a link behind it an <inertial>, drive it (`driven`), or make it a fixed joint"
            line = lines.get(f"joint {name}", 0)
            yield Diagnostic(Severity.WARNING, "passive-moves-no-mass", message, file, line, hint=hint)
