"""The numbers of a joint in groups, as its record holds them."""

from __future__ import annotations

import msgspec

from urdfsync.modelica.literals import INFINITY, real
from urdfsync.urdf.kinematics.tree import MOTION_KINDS
from urdfsync.urdf.robot import Joint, Origin, Vector


class Group(msgspec.Struct, frozen=True):
    """Numbers of a joint that come and go together."""

    name: str
    modifiers: list[str]
    """For example `damping = 0.5`."""


class JointNumbers(msgspec.Struct, frozen=True):
    """What a record says of a joint."""

    name: str
    kind: str
    origin: Origin
    axis: Vector | None
    groups: list[Group]


def joint_numbers(joint: Joint) -> JointNumbers:
    """Name, origin, axis and the groups that the joint has."""
    return JointNumbers(joint.name, joint.type.capitalize(), joint.origin, axis(joint), _groups(joint))


def axis(joint: Joint) -> Vector | None:
    """The axis of a joint that has one."""
    return joint.axis if joint.type in MOTION_KINDS or joint.type == "planar" else None


def _groups(joint: Joint) -> list[Group]:
    if joint.type == "planar":
        return _planar_groups(joint)
    if joint.type not in MOTION_KINDS:
        return []
    groups = [_limits(joint)]
    if joint.dynamics is not None:
        groups.append(_group("dynamics", damping=joint.dynamics.damping, friction=joint.dynamics.friction))
    if joint.mimic is not None:
        groups.append(_group("mimic", multiplier=joint.mimic.multiplier, offset=joint.mimic.offset))
    if joint.calibration is not None:
        groups.append(_group("calibration", rising=joint.calibration.rising, falling=joint.calibration.falling))
    if (safety := joint.safety_controller) is not None:
        groups.append(
            _group(
                "safetyController",
                k_velocity=safety.k_velocity,
                k_position=safety.k_position,
                soft_lower_limit=safety.soft_lower_limit,
                soft_upper_limit=safety.soft_upper_limit,
            )
        )
    return groups


def _planar_groups(joint: Joint) -> list[Group]:
    if joint.dynamics is None:
        return []
    numbers = {"damping": joint.dynamics.damping, "friction": joint.dynamics.friction}
    return [_group("translation", **numbers), _group("rotation", **numbers)]


def _limits(joint: Joint) -> Group:
    limit = joint.limit
    limited = joint.type != "continuous"
    return Group(
        "limits",
        [
            f"lower = {real(limit.lower if limit and limited else None, absent=f'-{INFINITY}')}",
            f"upper = {real(limit.upper if limit and limited else None)}",
            f"velocity = {real(limit.velocity if limit else None)}",
            f"effort = {real(limit.effort if limit else None)}",
        ],
    )


def _group(name: str, **numbers: float | None) -> Group:
    return Group(name, [f"{field} = {real(value)}" for field, value in numbers.items()])
