"""Template data of a joint's model, which depends on no number of the URDF, and of its record."""

from __future__ import annotations

from typing import Any

from urdfsync.urdf.drives import friction_law, has_motor, is_chosen, sharing_joint
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Joint, Limit, limits_acceleration, reflected_inertia


def joint_title(joint: Joint) -> str:
    """Return a description of a joint: its type, its name and its links."""
    return f'{joint.type} joint "{joint.name}" from link "{joint.parent}" to link "{joint.child}"'


def joint_model(joint: Joint, options: Options, is_driven: bool) -> dict[str, Any]:
    """Return which parts a joint's model has; the rotor is a separate part if the motor has a flange.

    The spring of an elastic drive keeps the limits of effort and velocity. If Run commands an effort, Run keeps them.
    """
    # if a motor also moves another joint, its gear and its rotor are in the robot model
    armature, sharing = joint.dynamics and joint.dynamics.armature, sharing_joint(joint, options.drives)
    with_motor = has_motor(joint, options) and not sharing
    inertia = armature if with_motor or sharing else reflected_inertia(joint)
    return {
        "dynamics": joint.dynamics is not None,
        "accelerations": limits_acceleration(joint),
        "inertia": inertia is not None,
        "motor": with_motor,
        "sharing": sharing,
        "friction": friction_law(joint, options),
        "elastic": is_driven and is_chosen(joint, options.elastic),
        "saturated": is_driven and is_chosen(joint, options.saturated) and joint.command != "effort",
    }


def joint_record(joint: Joint) -> dict[str, Any]:
    """Return the numbers of a joint; missing limits are None."""
    return {"joint": joint, "limits": joint.limit or dict.fromkeys(Limit.__struct_fields__)}
