"""Finds joints that a simulation of the package or of the generic robot can't move."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.drives import can_be_driven, sharing_joint
from urdfsync.formats.urdf.kinematics.massless import find_massless_joints
from urdfsync.formats.urdf.kinematics.poses import AXES
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.model.record import obstacles
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint
from urdfsync.formats.urdf.validate import Finding, unit_vector


def find_unsimulated(assembly: Assembly) -> Iterator[Finding]:
    """Yield a finding for each part that the chosen approaches can't simulate."""
    tree, closed, options = assembly.tree, assembly.closed, assembly.options
    if "record" in options.approach:
        yield from out_of_scope(tree)
    if "package" not in options.approach:
        names = ", ".join(sensor.name for sensor in tree.sensors)
        parts = [f"sensors ({names})"] * bool(names) + ["flanges of motors"] * (options.drives == "motor")
        servos = ", ".join(joint.name for joint in tree.joints if joint.servo)
        parts += [f"laws of drives ({servos})"] * bool(servos)
        if parts:
            yield Finding("not-in-record", "", f"the record approach has no {' and no '.join(parts)}")
        return
    # Driven joints count as fixed: they move as prescribed, and can't undo the motion of a passive joint.
    passive = {joint.name for joint in tree.joints if can_be_driven(joint)} - closed.driven - closed.dependent
    for name in find_massless_joints(tree, passive) if passive else ():
        if name in passive:
            message = f"joint '{name}' is not driven and moves no mass at its start, so nothing determines its "
            yield Finding("passive-moves-no-mass", f"joint {name}", f"{message}motion in Run and Test")
    for joint in tree.joints:
        if joint.type == "ball" and _has_massless_axis(tree, joint):
            message = f"joint '{joint.name}' is a ball and turns no inertia about an axis, so nothing determines its "
            hint = "give a link behind the ball an <inertial> with an inertia about each axis"
            yield Finding("passive-moves-no-mass", f"joint {joint.name}", f"{message}motion in Run and Test", hint)


def _has_massless_axis(tree: KinematicTree, ball: Joint) -> bool:
    """Return whether a ball turns no inertia about an axis of its frame or the line to its child's centre of mass."""
    inertial = next(link.inertial for link in tree.links if link.name == ball.child)
    for axis in (*AXES, unit_vector(inertial.origin.xyz if inertial else AXES[0])):
        hinge = replace(ball, type="continuous", axis=axis)
        joints = tuple(hinge if joint is ball else joint for joint in tree.joints)
        if ball.name in find_massless_joints(replace(tree, joints=joints), {ball.name}):
            return True
    return False


def out_of_scope(tree: KinematicTree) -> Iterator[Finding]:
    """Yield findings about parts that the generic robot lacks; if it has all joints, about joints that move no mass."""
    if tree.loops:
        message = "the generic robot has no loops: the record leaves them open"
        yield Finding("loops-not-in-record", f"loop {tree.loops[0].name}", message)
    for name in (joint.name for joint in tree.joints if sharing_joint(joint, "joint")):
        message = f"the motor of joint '{name}' also moves another joint, but in the record the motor's rotor does not"
        yield Finding("shared-rotor-not-in-record", f"joint {name}", message)
    unfit = obstacles(tree.joints)
    for joint in unfit:
        message = (
            f"joint '{joint.name}' is {joint.type}; the generic robot has no such joints, so the record has no tables"
        )
        yield Finding(f"{joint.type}-not-generic", f"joint {joint.name}", message)
    if unfit:
        return
    inertials = [link.inertial for link in tree.links if link.inertial is not None]
    has_mass = any(part.mass or part.inertia.ixx or part.inertia.iyy or part.inertia.izz for part in inertials)
    if not has_mass and any(joint.type in MOTION_KINDS for joint in tree.joints):
        message = "no link has a mass, so the joints of the generic robot can be moved by position only"
        yield Finding("moves-no-mass", "robot", message, "give the links an <inertial>")
        return
    massless = set(find_massless_joints(tree))
    behind = set[str]()  # links behind a joint with a warning: further joints there get no warning
    for joint in tree.joints:
        if joint.name in massless and joint.parent not in behind:
            message = f"joint '{joint.name}' moves no inertia about its axis, or only inertia behind "
            message += "another joint on the same axis, so the generic robot can move it by position only"
            yield Finding("moves-no-mass", f"joint {joint.name}", message)
        if joint.name in massless or joint.parent in behind:
            behind.add(joint.child)
