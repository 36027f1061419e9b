"""Read joints, and which of them are actuated. A fault becomes a diagnostic, and a default takes the value's place."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

from urdfsync.urdf.parse.fields import Reader, Values
from urdfsync.urdf.parse.link import read_origin
from urdfsync.urdf.robot import JOINT_KINDS, Calibration, Dynamics, Joint, JointType, Limit, Mimic, SafetyController
from urdfsync.urdf.validate import nearest

_PARTS = [name for name in Joint.__struct_fields__ if name not in ("name", "type", "actuated")]


def read_joint(reader: Reader, element: Element, path: str) -> Joint | None:
    """Read a joint with its axis as written; return None, after an error, if it connects nothing.

    A joint of unknown type is read as a plain fixed one.
    """
    name, kind = reader.text(element, path, "name"), _read_type(reader, element, path)
    reader.expect(element, path, ("name", "type"))
    parts = reader.children(element, path, _PARTS, f"joint {name}")
    ends = []
    for tag in ("parent", "child"):
        if tag in parts:
            reader.expect(parts[tag], f"{path} / {tag}", ("link",))
            ends.append(reader.text(parts[tag], f"{path} / {tag}", "link"))
        else:
            reader.error(element, "missing-element", f"{path} has no <{tag}>", f'add <{tag} link="…"/>')
            ends.append("")
    parent, child = ends
    if not parent or not child:
        return None
    if kind is None:
        return Joint(name, "fixed", parent, child)

    def part(tag: str, struct: type[Values]) -> Values | None:
        return reader.read(parts[tag], f"{path} / {tag}", struct) if tag in parts else None

    if "safety_controller" in parts and "k_velocity" not in parts["safety_controller"].attrib:
        message = f"{path} / safety_controller has no 'k_velocity', taken as 0"
        reader.warn(parts["safety_controller"], "missing-gain", message, "add k_velocity=…")
    _check_limit(reader, element, path, kind, parts.get("limit"))
    axis, mimic = parts.get("axis", Element("")), part("mimic", Mimic)
    reader.expect(axis, f"{path} / axis", ("xyz",))
    x, y, z = reader.numbers(axis, f"{path} / axis", "xyz", 3) or (1.0, 0.0, 0.0)
    return Joint(
        name,
        kind,
        parent,
        child,
        origin=read_origin(reader, parts, path),
        axis=(x, y, z),
        limit=part("limit", Limit),
        dynamics=part("dynamics", Dynamics),
        mimic=mimic if mimic and mimic.joint else None,
        calibration=part("calibration", Calibration),
        safety_controller=part("safety_controller", SafetyController),
    )


def _read_type(reader: Reader, element: Element, path: str) -> JointType | None:
    """Read one of URDF's joint types; return None after an error."""
    text = reader.text(element, path, "type")
    kind = next((known for known in JOINT_KINDS if known == text), None)
    if kind is None and text:
        meant = nearest(text.lower(), JOINT_KINDS)
        hint = f"perhaps {meant!r} is meant" if meant else f"use one of {', '.join(JOINT_KINDS)}"
        reader.error(element, "unknown-joint-type", f"{path} has the unknown type {text!r}", hint)
    return kind


def _check_limit(reader: Reader, joint: Element, path: str, kind: JointType, limit: Element | None) -> None:
    """Warn about limits that are absent: they are 0 for a position, and there is none for effort and velocity."""
    if limit is None:
        if JOINT_KINDS[kind].has_limits:
            message = f"{path} is {kind} but has no <limit>: it moves without limits"
            reader.warn(joint, "missing-limit", message, "add <limit>, or make a revolute joint continuous")
        return
    zero = [name for name in ("lower", "upper") if name not in limit.attrib and JOINT_KINDS[kind].has_limits]
    unlimited = [name for name in ("effort", "velocity") if name not in limit.attrib and JOINT_KINDS[kind].motion]
    absent = [f"{' and '.join(zero)}, taken as 0"] if zero else []
    absent += [f"{' and '.join(unlimited)}, taken as unlimited"] if unlimited else []
    if absent:
        hint = "add what is missing, or make a joint that turns freely continuous"
        reader.warn(limit, "missing-limit-value", f"{path} / limit has no {'; no '.join(absent)}", hint)


def read_actuated(reader: Reader, element: Element, path: str) -> Iterator[tuple[str, str]]:
    """Yield path and name of each joint that a `<transmission>` or `<ros2_control>` drives.

    The latter drives by its own transmissions, and joints that have a `<command_interface>`: others are only measured.
    An example of a path: `transmission wheel_trans / joint wheel`.
    """
    joints = element.findall("joint")
    if element.tag == "ros2_control":
        joints = [joint for joint in joints if joint.find("command_interface") is not None]
        joints += element.findall("transmission/joint")
    for joint in joints:
        if name := joint.get("name", ""):
            yield reader.place(joint, f"{path} / joint {name}"), name
