"""What the generic robot can't take, told where the URDF says it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.model.tables import has_tables, obstacles
from urdfsync.urdf.robot import Joint, Robot

_BY_PACKAGE = 'or use `approach = ["package"]`'
_PLANAR = f"write it as two prismatic joints and a continuous one, {_BY_PACKAGE}"
_FLOATING_BASE = f'leave it out with its parent link, and set `base = "floating"`, {_BY_PACKAGE}'
_FLOATING = f"write it as three prismatic joints and three continuous ones, {_BY_PACKAGE}"


def out_of_scope(robot: Robot, file: str, lines: Mapping[str, int]) -> Iterator[Diagnostic]:
    """A warning for each reason why the record has no tables; `file` and `lines` as in `RobotReading`."""
    for joint in obstacles(robot.joints):
        message = f"the generic robot has no {joint.type} joints, so there are no tables for it: joint '{joint.name}'"
        hint = _hint(joint, robot)
        yield Diagnostic(
            Severity.WARNING, f"{joint.type}-not-generic", message, file, lines.get(f"joint {joint.name}", 0), hint=hint
        )
    if not has_tables(robot.joints) and not any(obstacles(robot.joints)):
        message = "the generic robot needs a joint that moves, so there are no tables for it"
        hint = 'use `approach = ["package"]`, or take the record as it is'
        yield Diagnostic(Severity.WARNING, "nothing-moves", message, file, lines.get("robot", 0), hint=hint)


def _hint(joint: Joint, robot: Robot) -> str:
    if joint.type == "planar":
        return _PLANAR
    others = [other for other in robot.joints if other.parent == joint.parent or other.child == joint.parent]
    return _FLOATING_BASE if others == [joint] else _FLOATING
