"""What the generic robot can't take, told where the URDF says it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.resistance import resistances, yielding
from urdfsync.urdf.resisted import clearly_resisted
from urdfsync.urdf.robot import Joint, Link, Robot
from urdfsync.urdf.skeleton import MOTIONS, Skeleton

_BY_PACKAGE = "or use the package approach"
_PLANAR = f"write it as two prismatic joints and a continuous one, {_BY_PACKAGE}"
_FLOATING_BASE = (
    f'leave it out with its parent link and let the base float (`base = "floating"` in a project), {_BY_PACKAGE}'
)
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
    if clearly_resisted(skeleton):
        return
    resisted = resistances(skeleton)
    idle = {j.name for j in skeleton.joints if j.type in MOTIONS and j.mimic is None and not resisted[j.name]}
    heavy = _heavy(skeleton)
    if idle and not heavy:
        message = "no link has a mass, so the joints of the generic robot can be moved by position only"
        yield _warning("moves-no-mass", message, "give the links an <inertial>", file, lines, "robot")
        return
    giving = yielding(skeleton) - idle
    behind = set[str]()
    for joint in skeleton.joints:
        if joint.name in giving:
            yield _given_way(joint, file, lines)
        if joint.name in idle and joint.parent not in behind:
            yield _unresisted(joint, joint.child in heavy, file, lines)
        if joint.parent in behind or (joint.name in idle and joint.child not in heavy):
            behind.add(joint.child)  # there is nothing there either


def _unresisted(joint: Joint, carries: bool, file: str, lines: Mapping[str, int]) -> Diagnostic:
    """The warning of a joint with nothing to move, or with a mass that is all on its axis."""
    what, wanted = "moves no mass", "an <inertial>"
    if carries and MOTIONS[joint.type] == "rotational":
        what, wanted = "turns nothing that has an inertia about its axis", "such an inertia"
    message = f"joint '{joint.name}' {what}, so the generic robot can move it by position only"
    hint = f"give a link behind it {wanted}, or make it a fixed joint"
    return _warning("moves-no-mass", message, hint, file, lines, f"joint {joint.name}")


def _given_way(joint: Joint, file: str, lines: Mapping[str, int]) -> Diagnostic:
    """The warning of a joint that has a mass behind it, and other joints between."""
    message = (
        f"joint '{joint.name}' moves no mass where it starts if joints behind it undo its motion, as one about the "
        "same axis can, so the generic robot can move it by position only"
    )
    hint = "give the link right behind it an <inertial>, or make it a fixed joint"
    return _warning("moves-no-mass", message, hint, file, lines, f"joint {joint.name}")


def _heavy(skeleton: Skeleton) -> set[str]:
    """The links that have a mass or an inertia, or carry one that has."""
    heavy = {link.name for link in skeleton.links if _weighs(link)}
    for joint in reversed(skeleton.joints):
        if joint.child in heavy:
            heavy.add(joint.parent)
    return heavy


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
