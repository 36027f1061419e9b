"""Read what `<transmission>` and `<ros2_control>` say of the drives of joints."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, get_args
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.urdf.parse.fields import Reader, parse_numbers, quoted
from urdfsync.urdf.robot import MOTION_KINDS, Command, Joint, Transmission
from urdfsync.urdf.validate import Finding

_REDUCTIONS = (
    "actuator/drake:gear_ratio",
    "joint/mechanical_reduction",
    "actuator/mechanical_reduction",
    "actuator/mechanicalReduction",
    "joint/mechanicalReduction",
    "mechanicalReduction",  # of the PR2
)
"""Elements of a transmission that hold its reduction; the first that is there counts."""
_COMMANDS: tuple[Command, ...] = get_args(Command)


class Drive(NamedTuple):
    """What one element says of the drive of a joint."""

    path: str
    """For example `transmission wheel_trans / joint wheel`."""
    joint: str
    element: Element
    """The `<transmission>`, or the `<joint>` of a `<ros2_control>`."""
    transmission: Transmission | None = None
    command: Command | None = None
    read: Sequence[Element] = ()
    """What holds the gear's numbers, or the command."""
    is_coupled: bool = False
    """Whether the transmission has other joints, too."""


def read_drives(reader: Reader, element: Element, path: str) -> Iterator[Drive]:
    """Yield what a `<transmission>` or `<ros2_control>` says of each joint that it drives.

    The latter drives by its own transmissions, and joints that have a `<command_interface>`: others are only measured.
    """
    transmissions = [element]
    if element.tag == "ros2_control":
        transmissions = element.findall("transmission")
        for joint in element.findall("joint"):
            names = {interface.get("name", "") for interface in joint.findall("command_interface")}
            if names and (target := joint.get("name", "")):
                command = next((name for name in _COMMANDS if name in names), None)
                read = [one for one in joint.findall("command_interface") if one.get("name") == command]
                yield Drive(reader.place(joint, f"{path} / joint {target}"), target, joint, None, command, read)
    for one in transmissions:
        joints = one.findall("joint")
        is_coupled = len(joints) > 1
        gear, read = (None, []) if is_coupled else _read_gear(reader, one, path)
        for joint in joints:
            if target := joint.get("name", ""):
                place = reader.place(joint, f"{path} / joint {target}")
                yield Drive(place, target, one, gear, None, read, is_coupled)
        if is_coupled:
            message = f"{path} couples {len(joints)} joints: they move independently of one another, without gears"
            reader.add(one, "coupled-transmission", message)


def _read_gear(reader: Reader, element: Element, path: str) -> tuple[Transmission | None, list[Element]]:
    """Return reduction, offset and rotor of a transmission, None if they say nothing, and what they were read from."""
    parts: dict[str, Element] = {}  # ElementTree's own paths know no prefix without a namespace
    for child in element:
        parts.setdefault(child.tag, child)
        for one in child:
            parts.setdefault(f"{child.tag}/{one.tag}", one)
    read: list[Element] = []

    def number(place: str, nothing: float | None = None) -> float | None:
        if (found := parts.get(place)) is None:
            return None
        text = found.get("value") or found.text or ""
        try:
            (value,) = parse_numbers(text, 1)
        except ValueError as error:
            reader.add(found, "bad-transmission", f"{path}: <{found.tag}> {quoted(text.strip())} {error}")
            return None
        if value == nothing:
            reader.add(element, "bad-transmission", f"{path}: the reduction is 0")
            return None
        read.append(found)
        return value

    reduction = number(next(filter(parts.__contains__, _REDUCTIONS), ""), nothing=0)
    gear = Transmission(reduction or 1.0, number("joint/offset") or 0.0, number("actuator/drake:rotor_inertia"))
    return None if gear == Transmission() else gear, read


def with_drives(reader: Reader, joints: Iterable[Joint], drives: Iterable[Drive]) -> list[Joint]:
    """Return the joints with what drives them; of several transmissions of a joint the first counts.

    What is said of joints without an axis is left as it is.
    """
    joints = list(joints)
    gears, commands, actuated = dict[str, Drive](), dict[str, Command](), set[str]()
    by_name = {joint.name: joint for joint in joints if joint.type in MOTION_KINDS}
    for drive in drives:
        actuated.add(drive.joint)
        joint = by_name.get(drive.joint)
        if drive.element.tag == "joint":
            if not drive.command or not joint or joint.mimic:
                continue
            if commands.setdefault(drive.joint, drive.command) == drive.command:
                for interface in drive.read:
                    del interface.attrib["name"]
        elif drive.read and gears.setdefault(drive.joint, drive).transmission != drive.transmission:
            message = f"joint {drive.joint!r} has another gear, and the first counts"
            reader.extend([Finding("duplicate-element", drive.path, message)])
        elif joint and not drive.is_coupled:
            reader.modelled.add(drive.element)
            for number in drive.read:
                reader.show(number, "value")
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
