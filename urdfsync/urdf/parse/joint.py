"""Read joints, and which of them are actuated."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.parse.link import check_origin
from urdfsync.urdf.robot import JOINT_KINDS, Joint
from urdfsync.urdf.validate import nearest, perhaps


def read_joint(reader: Reader, element: Element, path: str) -> Joint | None:
    """Read a joint with its axis as written; return None, after an error, if it connects nothing.

    A joint of unknown type becomes a plain fixed one.
    """
    joint = reader.read(element, path, Joint, f"joint {element.get('name', '')}")
    if joint.type not in JOINT_KINDS:
        if joint.type:
            hint = perhaps(nearest(joint.type.lower(), JOINT_KINDS))
            reader.add(element, "unknown-joint-type", f"{path} has the unknown type {joint.type!r}", hint)
        joint = Joint(joint.name, "fixed", joint.parent, joint.child)
    if not joint.parent or not joint.child:
        return None
    check_origin(reader, element, path)
    safety = element.find("safety_controller")
    if safety is not None and "k_velocity" not in safety.attrib:
        reader.add(safety, "missing-gain", f"{path} / safety_controller has no 'k_velocity', taken as 0")
    _check_limit(reader, element, path, joint)
    return joint


def _check_limit(reader: Reader, element: Element, path: str, joint: Joint) -> None:
    """Warn about limits that are absent: they are 0 for a position, and there is none for effort and velocity."""
    kind, limit = JOINT_KINDS[joint.type], element.find("limit")
    if limit is None:
        if kind.has_limits:
            message = f"{path} is {joint.type} but has no <limit>: it moves without limits"
            reader.add(element, "missing-limit", message)
        return
    zero = [name for name in ("lower", "upper") if name not in limit.attrib and kind.has_limits]
    unlimited = [name for name in ("effort", "velocity") if name not in limit.attrib and kind.motion]
    absent = [f"{' and '.join(zero)}, taken as 0"] if zero else []
    absent += [f"{' and '.join(unlimited)}, taken as unlimited"] if unlimited else []
    if absent:
        reader.add(limit, "missing-limit-value", f"{path} / limit has no {'; no '.join(absent)}")


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
