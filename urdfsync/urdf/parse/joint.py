"""Read joints, and which of them are actuated. A fault becomes a diagnostic, and a default takes the value's place.

Two children of the robot name actuated joints: `<transmission>` by its joints, and `<ros2_control>` by its own
transmissions and by its joints that have a `<command_interface>`; those without one are only measured.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args

from urdfsync.urdf.parse.fields import Element
from urdfsync.urdf.parse.link import read_origin
from urdfsync.urdf.robot import (
    Calibration,
    Dynamics,
    Extension,
    Joint,
    JointType,
    Limit,
    Mimic,
    SafetyController,
)
from urdfsync.urdf.validate import LIMITED, SCALAR, nearest

_TYPES: tuple[JointType, ...] = get_args(JointType)
_PARTS = [name for name in Joint.__struct_fields__ if name not in ("name", "type", "actuated")]
_X = (1.0, 0.0, 0.0)


def read_joint(element: Element, extensions: list[Extension]) -> Joint | None:
    """Read a joint with its axis as written; return None, after an error, if it connects nothing.

    Add what is not modelled to `extensions`. A joint of unknown type is read as a plain fixed one.
    """
    name = element.text("name")
    element.expect(("name", "type"))
    extensions += element.extensions(f"joint {name}", _PARTS)
    kind, parent, child = _read_type(element), _read_end(element, "parent"), _read_end(element, "child")
    if not parent or not child:
        return None
    if kind is None:
        return Joint(name, "fixed", parent, child)
    axis, dynamics = element.child("axis", "xyz"), element.child("dynamics", *Dynamics.__struct_fields__)
    calibration = element.child("calibration", *Calibration.__struct_fields__)
    safety = element.child("safety_controller", *SafetyController.__struct_fields__)
    if safety and "k_velocity" not in safety.node.attributes:
        safety.warn("missing-gain", f"{safety.path} has no 'k_velocity', taken as 0", "add k_velocity=…")
    return Joint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        origin=read_origin(element),
        axis=axis.vector("xyz", _X) if axis else _X,
        limit=_read_limit(element, kind),
        dynamics=dynamics.numbers(Dynamics) if dynamics else None,
        mimic=_read_mimic(element),
        calibration=calibration.numbers(Calibration) if calibration else None,
        safety_controller=safety.numbers(SafetyController) if safety else None,
    )


def _read_type(element: Element) -> JointType | None:
    """Read one of URDF's joint types; return None after an error."""
    text = element.text("type")
    kind = next((known for known in _TYPES if known == text), None)
    if kind is None and text:
        meant = nearest(text.lower(), _TYPES)
        hint = f"perhaps {meant!r} is meant" if meant else f"use one of {', '.join(_TYPES)}"
        element.error("unknown-joint-type", f"{element.path} has the unknown type {text!r}", hint)
    return kind


def _read_end(element: Element, tag: str) -> str:
    """Read the name of the parent or child link; return an empty one after an error."""
    end = element.child(tag, "link")
    if end is None:
        element.error("missing-element", f"{element.path} has no <{tag}>", f'add <{tag} link="…"/>')
        return ""
    return end.text("link")


def _read_limit(joint: Element, kind: JointType) -> Limit | None:
    """Read the limits; what is absent is 0 for a position, and no limit for effort and velocity."""
    element = joint.child("limit", *Limit.__struct_fields__)
    if element is None:
        if kind in LIMITED:
            message = f"{joint.path} is {kind} but has no <limit>: it moves without limits"
            joint.warn("missing-limit", message, "add <limit>, or make a revolute joint continuous")
        return None
    given = element.node.attributes
    zero = [name for name in ("lower", "upper") if name not in given and kind in LIMITED]
    unlimited = [name for name in ("effort", "velocity") if name not in given and kind in SCALAR]
    if zero or unlimited:
        absent = [f"{' and '.join(zero)}, taken as 0"] if zero else []
        absent += [f"{' and '.join(unlimited)}, taken as unlimited"] if unlimited else []
        hint = "add what is missing, or make a joint that turns freely continuous"
        element.warn("missing-limit-value", f"{element.path} has no {'; no '.join(absent)}", hint)
    return element.numbers(Limit)


def _read_mimic(joint: Element) -> Mimic | None:
    """Read the mimic relation; return None, after an error, if it names no joint."""
    element = joint.child("mimic", "joint", "multiplier", "offset")
    if element is None:
        return None
    leader, multiplier, offset = element.text("joint"), element.number("multiplier", 1.0), element.number("offset", 0.0)
    return Mimic(leader, multiplier, offset) if leader else None


def read_actuated(element: Element) -> Iterator[tuple[str, str]]:
    """Yield path and name of each joint that a `<transmission>` or `<ros2_control>` drives.

    An example of a path: `transmission wheel_trans / joint wheel`.
    """
    is_control = element.node.tag == "ros2_control"
    for node in element.node.children:
        if node.tag == "transmission" and is_control:
            driven = [child for child in node.children if child.tag == "joint"]
        elif node.tag == "joint" and (not is_control or any(part.tag == "command_interface" for part in node.children)):
            driven = [node]
        else:
            continue
        for joint in driven:
            if name := joint.attributes.get("name", ""):
                yield Element(joint, f"{element.path} / joint {name}", element.findings).path, name
