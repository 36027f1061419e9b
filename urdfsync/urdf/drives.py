"""Which joints Run and Test drive.

A joint can be driven if it has one axis and follows no other joint. Of these, some are passive, such as casters: where
a source says of any joint that a transmission or ros2_control drives it, a continuous joint counts as passive if it
has neither, and no limit. Other joints without a drive stay driven, since transmissions are often left out: a joint
with a limit was meant to be moved by something. A source that says nothing of drives has no passive joints.
"""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Joint


def driven_joints(joints: Iterable[Joint], options: Options) -> frozenset[str]:
    """The names of the joints that are driven: those of the option `driven` if it is set, else all but passive ones.

    No number of the joints counts, so those of a structure without numbers do. Names in the option that are no joint
    that can be driven are left out: `check_options` reports them.
    """
    joints = list(joints)
    can = frozenset(joint.name for joint in joints if can_be_driven(joint))
    return can.intersection(options.driven) if options.driven is not None else can - passive_joints(joints)


def passive_joints(joints: Iterable[Joint]) -> frozenset[str]:
    """The names of the joints that could be driven and, going by the source alone, are not."""
    joints = list(joints)
    if not any(joint.actuated for joint in joints):
        return frozenset()
    free = (joint for joint in joints if joint.type == "continuous" and joint.limit is None and not joint.actuated)
    return frozenset(joint.name for joint in free if can_be_driven(joint))


def has_motor(joint: Joint, options: Options) -> bool:
    """Whether the motor's side of the joint's gear has a flange."""
    return options.drives == "motor" and joint.transmission is not None and can_be_driven(joint)


def can_be_driven(joint: Joint) -> bool:
    """Whether a joint has one axis and follows no other joint."""
    return joint.type in MOTION_KINDS and joint.mimic is None
