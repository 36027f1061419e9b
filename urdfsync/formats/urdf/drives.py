"""The joints that Run and Test drive.

A joint can be driven if it has one axis and follows no other joint. Joints that the source only measures are passive.
If the source drives any joint, a continuous joint with neither drive nor limit, such as a caster, is also passive. All
other joints are driven, since sources often leave transmissions out.

In loops, at most one joint per degree of freedom is driven: see `kinematics.loops.ClosedLoops`.
"""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.formats.urdf.options import FrictionLaw, Options
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint


def wanted_joints(joints: Iterable[Joint], options: Options) -> frozenset[str]:
    """Return the names of the joints to drive: those of the option `driven` if it is set, else all but passive joints.

    A passive joint with a command in the options is also driven. `check_options` reports names in the option that no
    drivable joint has; this function skips them.
    """
    joints = list(joints)
    can = frozenset(joint.name for joint in joints if can_be_driven(joint))
    if options.driven is not None:
        return can.intersection(options.driven)
    return can - (passive_joints(joints) - options.commands.keys())


def passive_joints(joints: Iterable[Joint]) -> frozenset[str]:
    """Return the names of passive joints: joints that could be driven, but are not."""
    joints = list(joints)
    has_drives = any(joint.actuated for joint in joints)

    def is_passive(joint: Joint) -> bool:
        is_free = has_drives and joint.type == "continuous" and joint.limit is None and not joint.actuated
        return can_be_driven(joint) and (joint.measured or is_free)

    return frozenset(joint.name for joint in joints if is_passive(joint))


def by_effort(joint: Joint) -> bool:
    """Return whether the drive of a joint gives an effort; any other drive moves the joint exactly as commanded."""
    return joint.command == "effort" or joint.servo is not None


def has_motor(joint: Joint, options: Options) -> bool:
    """Return whether the motor's side of the joint's gear has a flange."""
    return options.drives == "motor" and joint.transmission is not None and can_be_driven(joint)


def sharing_joint(joint: Joint, drives: str) -> str | None:
    """Return the other joint that a joint's motor moves; None without such a joint, or without flange and rotor."""
    gear = joint.transmission
    return gear.joint if gear and (drives == "motor" or gear.rotor_inertia is not None) else None


def friction_law(joint: Joint, options: Options) -> FrictionLaw | None:
    """Return the friction law of a joint with one axis; None without losses.

    A joint that follows another joint has the smooth law: if both stuck, they would hold one motion twice.
    """
    if joint.dynamics is None:
        return None
    return chosen_law(joint, options) if can_be_driven(joint) else "smooth"


def chosen_law(joint: Joint, options: Options) -> FrictionLaw:
    """Return the friction law that the options choose for a joint."""
    return options.friction if isinstance(options.friction, str) else options.friction.get(joint.name, "smooth")


def is_chosen(joint: Joint, names: str | tuple[str, ...]) -> bool:
    """Return whether the names in the option `elastic` or `saturated` include a joint."""
    return names == "all" or (not isinstance(names, str) and joint.name in names)


def can_be_driven(joint: Joint) -> bool:
    """Return whether a joint has one axis and follows no other joint."""
    return joint.type in MOTION_KINDS and joint.mimic is None
