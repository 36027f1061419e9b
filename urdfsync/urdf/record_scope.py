"""What the generic robot can't take, told where the URDF says it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.robot import Joint, Link, Robot
from urdfsync.urdf.skeleton import MOTIONS, Skeleton

_BY_PACKAGE = 'or use `approach = ["package"]`'
_PLANAR = f"write it as two prismatic joints and a continuous one, {_BY_PACKAGE}"
_FLOATING_BASE = f'leave it out with its parent link, and set `base = "floating"`, {_BY_PACKAGE}'
_FLOATING = f"write it as three prismatic joints and three continuous ones, {_BY_PACKAGE}"


def out_of_scope(robot: Robot, file: str, lines: Mapping[str, int]) -> Iterator[Diagnostic]:
    """A warning for each joint that leaves the record without tables, or else for each that can't move freely.

    `file` and `lines` are those of `RobotReading`.
    """
    unfit = list(obstacles(robot.joints))
    for joint in unfit:
        message = f"the generic robot has no {joint.type} joints, so there are no tables for it: joint '{joint.name}'"
        yield _warning(f"{joint.type}-not-generic", message, _hint(joint, robot), file, lines, f"joint {joint.name}")
    if not unfit:
        yield from _massless(Skeleton.of(robot), file, lines)


def _massless(skeleton: Skeleton, file: str, lines: Mapping[str, int]) -> Iterator[Diagnostic]:
    idle, behind = _idle(skeleton), set[str]()
    if idle and not any(map(_weighs, skeleton.links)):
        message = "no link has a mass, so the joints of the generic robot can be moved by position only"
        yield _warning("moves-no-mass", message, "give the links an <inertial>", file, lines, "robot")
        return
    for joint in skeleton.joints:
        if joint.parent not in behind and joint.name not in idle:
            continue
        if joint.parent not in behind:
            message = f"joint '{joint.name}' moves no mass, so the generic robot can move it by position only"
            hint = "give a link behind it an <inertial>, or make it a fixed joint"
            yield _warning("moves-no-mass", message, hint, file, lines, f"joint {joint.name}")
        behind.add(joint.child)


def _idle(skeleton: Skeleton) -> set[str]:
    """Driven joints that have no mass behind them, and lead no joint that has."""
    heavy = {link.name for link in skeleton.links if _weighs(link)}
    for joint in reversed(skeleton.joints):
        if joint.child in heavy:
            heavy.add(joint.parent)
    followers, moves = skeleton.followers_by_leader(), set[str]()
    for joint in reversed(skeleton.leaders_first()):
        led = followers.get(joint.name, ())
        if joint.child in heavy or any(one.name in moves and mimic.multiplier for one, mimic in led):
            moves.add(joint.name)
    return {j.name for j in skeleton.joints if j.type in MOTIONS and j.mimic is None and j.name not in moves}


def _weighs(link: Link) -> bool:
    inertial = link.inertial
    return inertial is not None and any(
        (inertial.mass, inertial.inertia.ixx, inertial.inertia.iyy, inertial.inertia.izz)
    )


def _warning(code: str, message: str, hint: str, file: str, lines: Mapping[str, int], element: str) -> Diagnostic:
    return Diagnostic(Severity.WARNING, code, message, file, lines.get(element, 0), hint=hint)


def _hint(joint: Joint, robot: Robot) -> str:
    if joint.type == "planar":
        return _PLANAR
    others = [other for other in robot.joints if other.parent == joint.parent or other.child == joint.parent]
    return _FLOATING_BASE if others == [joint] else _FLOATING
