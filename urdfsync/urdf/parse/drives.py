"""Read the drives of joints: `<transmission>` and `<ros2_control>`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple, get_args
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.robot import MOTION_KINDS, Command, Joint, Transmission
from urdfsync.urdf.validate import Finding

_REDUCTIONS = (
    "actuator/drake:gear_ratio",
    "joint/mechanical_reduction",
    "actuator/mechanical_reduction",
    "actuator/mechanicalReduction",
    "joint/mechanicalReduction",
    "mechanicalReduction",
)
"""Elements of a transmission that hold its reduction; the first that is there counts."""
_COMMANDS: tuple[Command, ...] = get_args(Command)
_STATES = ("position", "velocity", "acceleration", "effort")
"""State interfaces of a joint that a model has."""


class Drive(NamedTuple):
    """The drive of one joint, as one element describes it."""

    path: str
    """For example `transmission wheel_trans / joint wheel`."""
    joint: str
    element: Element
    """The `<transmission>`, or the `<joint>` of a `<ros2_control>`."""
    transmission: Transmission | None = None
    command: Command | None = None
    is_coupled: bool = False
    """Whether the transmission has other joints, too."""


def read_drives(reader: Reader, element: Element, path: str) -> Iterator[Drive]:
    """Yield a drive for each joint of a `<transmission>` or `<ros2_control>`.

    A `<ros2_control>` drives the joints of its own transmissions, and those with a `<command_interface>`. It only
    measures its other joints.
    """
    transmissions = [element]
    if element.tag == "ros2_control":
        transmissions = element.findall("transmission")
        for joint in element.findall("joint"):
            interfaces = {interface.get("name", ""): interface for interface in joint.findall("command_interface")}
            states = joint.findall("state_interface")
            reader.used.update(state for state in states if state.get("name") in _STATES)
            if interfaces and (name := joint.get("name", "")):
                command = next((command for command in _COMMANDS if command in interfaces), None)
                if command:
                    reader.used.add(interfaces[command])
                yield Drive(reader.place(joint, f"{path} / joint {name}"), name, joint, None, command)
    for transmission in transmissions:
        joints = transmission.findall("joint")
        gear = _read_gear(reader, transmission, path) if len(joints) == 1 else None
        for joint in joints:
            if name := joint.get("name", ""):
                place = reader.place(joint, f"{path} / joint {name}")
                yield Drive(place, name, transmission, gear, None, len(joints) > 1)
        if len(joints) > 1:
            message = f"{path} couples {len(joints)} joints: they move independently of one another, without gears"
            reader.add(transmission, "coupled-transmission", message)


def _read_gear(reader: Reader, element: Element, path: str) -> Transmission | None:
    """Return reduction, offset and rotor of a transmission; None if it names none of them."""

    def number(*places: str) -> float | None:
        numbers = reader.numbers(element, places, path, "bad-transmission")
        return numbers[0] if numbers else None

    reduction = number(*_REDUCTIONS)
    if reduction == 0:
        reader.add(element, "bad-transmission", f"{path}: the reduction is 0")
    gear = Transmission(reduction or 1.0, number("joint/offset") or 0.0, number("actuator/drake:rotor_inertia"))
    reader.used.update(part for part in element if part.tag in ("joint", "actuator"))
    # the <type> of the transmission: that of one joint, which is modelled
    reader.used.update(part for part in element if "SimpleTransmission" in (part.text or ""))
    return None if gear == Transmission() else gear


def with_drives(reader: Reader, joints: Iterable[Joint], drives: Iterable[Drive]) -> list[Joint]:
    """Return the joints with their drives; of several transmissions of a joint the first counts.

    An element that drives a joint without an axis counts as not modelled.
    """
    joints = list(joints)
    gears, commands, actuated = dict[str, Drive](), dict[str, Command](), set[str]()
    by_name = {joint.name: joint for joint in joints if joint.type in MOTION_KINDS}
    for drive in drives:
        actuated.add(drive.joint)
        joint = by_name.get(drive.joint)
        if joint and not drive.is_coupled:
            reader.used.add(drive.element)
        if joint and drive.command and not joint.mimic:
            commands.setdefault(drive.joint, drive.command)
        if drive.transmission and gears.setdefault(drive.joint, drive).transmission != drive.transmission:
            message = f"joint {drive.joint!r} has another gear, and the first counts"
            reader.extend([Finding("duplicate-element", drive.path, message)])
    return [
        msgspec.structs.replace(
            joint,
            actuated=True,
            transmission=gears[joint.name].transmission if joint.name in gears else None,
            command=commands.get(joint.name, "position"),
        )
        if joint.name in actuated
        else joint
        for joint in joints
    ]
