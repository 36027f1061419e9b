"""Units of the numbers of a robot, by their place in the snapshot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from urdfsync.urdf.kinematics.tree import MOTION_KINDS, Motion

_EVERYWHERE = {
    "xyz": "m",
    "rpy": "rad",
    "size": "m",
    "radius": "m",
    "length": "m",
    "mass": "kg",
    **dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), "kg·m²"),
}

_POSITIONS = ("lower", "upper", "offset", "rising", "falling", "soft_lower_limit", "soft_upper_limit")

_ALONG: Mapping[Motion, Mapping[str, str]] = {
    "rotational": {
        **dict.fromkeys(_POSITIONS, "rad"),
        "velocity": "rad/s",
        "effort": "N·m",
        "damping": "N·m·s/rad",
        "friction": "N·m",
        "k_velocity": "N·m·s/rad",
        "k_position": "1/s",
    },
    "translational": {
        **dict.fromkeys(_POSITIONS, "m"),
        "velocity": "m/s",
        "effort": "N",
        "damping": "N·s/m",
        "friction": "N",
        "k_velocity": "N·s/m",
        "k_position": "1/s",
    },
}


def link_unit(field: str) -> str:
    """Unit of a number of a link, by the name of its field; empty if it has none."""
    return _EVERYWHERE.get(field, "")


def joint_unit(joint: Mapping[str, Any], joints: Mapping[str, Any], field: str) -> str:
    """Unit of a number of a joint; `joints` are all of the version, since a multiplier depends on its leader.

    Losses of a planar joint have none: one number stands for sliding and turning.
    """
    motion = MOTION_KINDS.get(joint["type"])
    if field != "multiplier":
        return _EVERYWHERE.get(field, "") or (_ALONG[motion].get(field, "") if motion else "")
    leader = MOTION_KINDS.get(joints[joint["mimic"]["joint"]]["type"])
    if motion is None or leader is None or motion == leader:
        return ""
    return f"{_ALONG[motion]['lower']}/{_ALONG[leader]['lower']}"
