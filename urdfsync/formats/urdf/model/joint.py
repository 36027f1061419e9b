"""Template data of a joint's model: no number of the URDF."""

from __future__ import annotations

from typing import Any

from urdfsync.formats.urdf.drives import by_effort, friction_law, has_motor, is_chosen, sharing_joint
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import MECHANISMS, MOTION_KINDS, Joint, limits_acceleration, reflected_inertia


def joint_title(joint: Joint) -> str:
    """Return a description of a joint: its type, its name and its links."""
    return f'{joint.type} joint "{joint.name}" from link "{joint.parent}" to link "{joint.child}"'


def joint_model(joint: Joint, options: Options, is_driven: bool) -> dict[str, Any]:
    """Return the parts of a joint's model.

    If the motor has a flange, the rotor is a separate part. The spring of an elastic drive limits effort and velocity.
    If the drive gives an effort, Run limits both.
    """
    # if a motor also moves another joint, the robot model has its gear and its rotor
    armature, sharing = joint.dynamics and joint.dynamics.armature, sharing_joint(joint, options.drives)
    with_motor = has_motor(joint, options) and not sharing
    inertia = armature if with_motor or sharing else reflected_inertia(joint)
    return {
        "motion": MOTION_KINDS.get(joint.type),
        "is_endless": joint.type == "continuous",
        "dynamics": joint.dynamics is not None,
        "accelerations": limits_acceleration(joint),
        "inertia": inertia is not None,
        **{part: getattr(joint.dynamics, number, None) is not None for part, number in MECHANISMS.items()},
        "motor": with_motor,
        "sharing": sharing,
        "friction": friction_law(joint, options),
        "elastic": is_driven and is_chosen(joint, options.elastic),
        "saturated": is_driven and is_chosen(joint, options.saturated) and not by_effort(joint),
    }
