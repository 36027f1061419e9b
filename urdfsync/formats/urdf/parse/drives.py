"""Reads the drives of joints, as `<ros2_control>`, `<transmission>` and plugins of Gazebo state them.

A source may state the drive of a joint several times. The first of these counts: configuration, `<ros2_control>`,
transmission, plugin. A contradiction is a warning, unless the configuration decides. For couplings, the `<mimic>` of
the joint comes first.
"""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias, get_args
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.formats.urdf.kinematics.poses import own_range
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.parse.closures import Closures
from urdfsync.formats.urdf.parse.fields import Reader, quoted
from urdfsync.formats.urdf.robot import MOTION_KINDS, Command, Joint, Mimic, Servo, Transmission
from urdfsync.formats.urdf.validate import Finding, perhaps

_REDUCTIONS = (
    "actuator/drake:gear_ratio",
    "joint/mechanical_reduction",
    "actuator/mechanical_reduction",
    "actuator/mechanicalReduction",
    "joint/mechanicalReduction",
    "mechanicalReduction",
)
"""Places of the reduction in a transmission; the first existing place counts."""
_JOINT = re.compile(r"\w*joint\d*", re.IGNORECASE)
"""Elements of a transmission that name joints: `joint`, `joint1`, and `flexJoint` and `gap_joint` of the PR2."""
_ROLES = {"flexJoint": "joint1", "rollJoint": "joint2", "rightActuator": "actuator1", "leftActuator": "actuator2"}
"""Elements of the PR2's wrist transmission with their roles."""
_REDUCTIONS_OF_PARTS = ("drake:gear_ratio", "mechanical_reduction", "mechanicalReduction", "@mechanicalReduction")
"""Places of the reduction in a joint or an actuator, if the transmission couples joints."""
_Law: TypeAlias = Callable[[float, float], tuple[tuple[float, float], tuple[float, float]]]
_COUPLINGS: Mapping[str, _Law] = {
    "DifferentialTransmission": lambda first, second: ((first, second), (first, -second)),
    "FourBarLinkageTransmission": lambda first, second: ((first, 0.0), (1.0, second)),
    "WristTransmission": lambda first, second: ((first, -second), (-first, -second)),
}
"""Laws of coupled joints: the reductions of two joints give a row for each motor.

The row has the motor's turns per turn of each joint, without the motor's own gear. The packages
`transmission_interface` (of ros_control) and `pr2_mechanism_model` document these laws.
"""
_COMMANDS: tuple[Command, ...] = get_args(Command)
"""Command interfaces of a joint in order: the first existing interface counts."""
_INTERFACES: Mapping[str, Command | None] = {
    "PositionJointInterface": "position",
    "VelocityJointInterface": "velocity",
    "EffortJointInterface": "effort",
    "PosVelJointInterface": "position",
    "PosVelAccJointInterface": "position",
    "JointStateInterface": None,
}
"""The command of each interface of ROS 1; None for the interface that only measures."""
_SERVOS: Mapping[Command, tuple[Sequence[str], Sequence[str]]] = {
    "position": (("position_gain",), ("velocity_gain", "min_position", "max_position", "min_effort", "max_effort")),
    "velocity": (
        ("position_gain", "velocity_gain"),
        ("min_velocity", "max_velocity", "min_position", "max_position", "min_effort", "max_effort"),
    ),
    "effort": (("min_effort", "max_effort"), ()),
}
"""Params of a command interface that state the law of the drive: any of the first make a law, others add to it."""
_STATES = ("position", "velocity", "acceleration", "effort")
"""State interfaces that the model of a joint has."""
_KINDS = {"transmission": "gears", "command": "commands", "mimic": "couplings", "start": "start positions"}
"""Words for the fields of `DriveStatement` that may contradict each other."""
_BAD = "bad-transmission"
_SAME = 1e-6
"""The greatest rounding error of a position, in rad or m."""
_WHEELS = re.compile(r"(?:left|right)(?:Front|Rear)?Joint|(?:left|right)_joint")
"""Elements that name the joints of wheels in plugins for differential and skid-steer drives."""


class DriveStatement(NamedTuple):
    """A statement about the drive of one joint."""

    path: str
    """For example `transmission wheel_trans / joint wheel`; empty for the configuration."""
    joint: str
    element: Element | None = None
    """The source's element; None if urdfsync does not model it, or there is none."""
    transmission: Transmission | None = None
    command: Command | None = None
    mimic: Mimic | None = None
    start: float | None = None
    servo: Servo | None = None
    is_driven: bool = True
    """Whether the element drives the joint."""
    is_measured: bool = False
    """Whether the element only measures the joint."""


_NOTHING = DriveStatement("", "")


def read_drives(reader: Reader, element: Element, path: str) -> Iterator[DriveStatement]:
    """Yield a drive for each joint of a `<ros2_control>`, a `<transmission>` or a `<gazebo>`."""
    if element.tag == "gazebo":
        yield from _read_mimic_plugins(reader, element, path)
        for wheel in element.iterfind("plugin/*"):
            if _WHEELS.fullmatch(wheel.tag) and (name := (wheel.text or "").strip()):
                yield DriveStatement(reader.place(wheel, f"{path} / joint {name}"), name, None, None, "velocity")
        return
    transmissions = [element]
    if element.tag == "ros2_control":
        transmissions = element.findall("transmission")
        for joint in element.findall("joint"):
            if name := joint.get("name", ""):
                yield _read_control(reader, joint, reader.place(joint, f"{path} / joint {name}"), name)
    for transmission in transmissions:
        joints = [part for part in transmission if _JOINT.fullmatch(part.tag) and part.get("name")]
        gears = _read_gears(reader, transmission, path, joints)
        modelled = None if gears is None else transmission
        for joint, gear in zip(joints, gears or [None] * len(joints), strict=True):
            name = joint.get("name", "")
            place = reader.place(joint, f"{path} / joint {name}")
            commands = _read_interfaces(reader, transmission, joint, place)
            command, is_measured = next(filter(commands.__contains__, _COMMANDS), None), commands == {None}
            # the passive_joints of the PR2's gripper have no motor
            is_driven = not is_measured and not joint.tag.startswith("passive")
            yield DriveStatement(place, name, modelled, gear, command, is_driven=is_driven, is_measured=is_measured)


def _read_gears(
    reader: Reader, element: Element, path: str, joints: Sequence[Element]
) -> Sequence[Transmission | None] | None:
    """Return the gear of each joint of a transmission; None if urdfsync does not model their coupling."""
    kind = (element.findtext("type") or element.findtext("plugin") or element.get("type") or "").strip()
    law = _COUPLINGS.get(kind.rpartition("/")[2])
    actuators = [part for part in element if part.tag.lower().endswith("actuator")]
    for part in (element, *joints, *actuators):
        if law or part.tag in ("transmission", "joint", "actuator"):
            reader.expect(part, path, ("name", "type", "role", *(("mechanicalReduction", "offset") if law else ())))
    if not joints or (not law and [joint.tag for joint in joints] == ["joint"]):
        return [_read_gear(reader, element, path) for _ in joints]
    if law and (gears := _read_coupled_gears(reader, path, law, joints, actuators)):
        reader.used.update(part for part in element if part.tag in ("type", "plugin"))
        return gears
    # Franka's simulator has such transmissions for handles of the whole arm; no joints are coupled
    if not kind.endswith("Interface"):
        names = ", ".join(dict.fromkeys(joint.get("name", "") for joint in joints))
        message = f"{path} ({kind or 'without a type'}) moves {names} in a way that is not modelled: "
        hint = (
            f"a {kind} needs two joints and two actuators, with the roles {', '.join(_ROLES.values())}" if law else ""
        )
        reader.add(element, "coupled-transmission", f"{message}each moves by itself, without gears", hint)
    return None


def _read_coupled_gears(
    reader: Reader, path: str, law: _Law, joints: Sequence[Element], actuators: Sequence[Element]
) -> Sequence[Transmission | None] | None:
    """Return the gears of two joints in the order of `joints`; None if elements or numbers do not fit the law."""
    parts = dict[str, Element]()
    for kind, elements in (("joint", joints), ("actuator", actuators)):
        for number, part in enumerate(elements, 1):
            role = part.get("role") or (part.findtext("role") or "").strip() or _ROLES.get(part.tag, f"{kind}{number}")
            parts[role if role.startswith(kind) else ""] = part
    names = {joint.get("name") for joint in joints}
    if parts.keys() != {*_ROLES.values()} or not len(joints) == len(names) == len(actuators) == 2:
        return None
    reader.used.update(part for holder in parts.values() for part in (holder, *holder.findall("role")))
    holders = [parts[role] for role in _ROLES.values()]
    first, second, *motors = (_read_reduction(reader, part, _REDUCTIONS_OF_PARTS, path) for part in holders)
    offsets = [reader.number(joint, ("offset", "@offset"), path, _BAD) or 0.0 for joint in holders[:2]]
    gears = list[Transmission | None]()
    for k, row in enumerate(law(first, second)):
        own, shared = motors[k] * row[k], motors[k] * row[1 - k]
        offset = offsets[k] + offsets[1 - k] * (row[1 - k] / row[k])
        if not own or not all(map(math.isfinite, (own, shared, offset))):
            return None
        rotor = reader.number(holders[2 + k], ("drake:rotor_inertia",), path, _BAD)
        gear = Transmission(own, offset, rotor, holders[1 - k].get("name") if shared else None, shared or None)
        gears.append(None if gear == Transmission() else gear)
    return gears if holders[0] is joints[0] else gears[::-1]


def _read_control(reader: Reader, joint: Element, path: str, name: str) -> DriveStatement:
    """Return the drive of a joint of `<ros2_control>`; without a command, the element only measures the joint."""
    # gazebo_ros2_control has `velocity_pid` for a velocity with its own controller
    interfaces = {part.get("name", "").removesuffix("_pid"): part for part in joint.findall("command_interface")}
    states = joint.findall("state_interface")
    reader.used.update(state for state in states if state.get("name") in _STATES)
    reader.used.update(interfaces[command] for command in _COMMANDS if command in interfaces)
    command = next(filter(interfaces.__contains__, _COMMANDS), None)
    if interfaces and not command:
        unknown = next(iter(interfaces))
        _add_unknown(reader, interfaces[unknown], path, unknown, _COMMANDS)
    params = {param.get("name", ""): param for param in joint.findall("param")}
    mimic = _read_mimic(reader, params, "mimic", path)
    start = _read_start(reader, states, path, name)
    servo = _read_servo(reader, interfaces[command], command, path, name) if command else None
    is_measured = bool(states) and not interfaces
    return DriveStatement(path, name, joint, None, command, mimic, start, servo, bool(interfaces), is_measured)


def _read_servo(reader: Reader, interface: Element, command: Command, path: str, name: str) -> Servo | None:
    """Return the law of a drive; None if the command interface states none."""
    needed, others = _SERVOS[command]
    params = {param.get("name", ""): param for param in reversed(interface.findall("param"))}  # the first counts
    if params.keys().isdisjoint(needed):
        return None
    if command == "velocity" and "position_gain" not in params:  # the command is not integrated
        others = [field for field in others if not field.endswith("position")]
    numbers = dict[str, float]()
    for field in (field for field in (*needed, *others) if field in params):
        reader.used.add(params[field])
        reader.place(params[field], f"joint {name} / servo / {field}")
        number = reader.number(params[field], ("",), f"{path} / {field}", "bad-servo")
        if number is not None:
            numbers[field] = number
            if field.endswith("gain") and number < 0:
                message = f"{path}: {field} is {number:g}, but a gain is never negative"
                reader.add(params[field], "bad-servo", message, "correct its sign")
    for lower, upper in ((f"min_{quantity}", f"max_{quantity}") for quantity in _COMMANDS):
        if lower in numbers and upper in numbers and numbers[lower] > numbers[upper]:
            message = f"{path}: {lower} is {numbers[lower]:g}, and {upper} is {numbers[upper]:g}"
            reader.add(params[lower], "bad-servo", message, "exchange or correct the limits")
    return Servo(**numbers)


def _read_start(reader: Reader, states: Iterable[Element], path: str, name: str) -> float | None:
    """Return the initial position of a joint of `<ros2_control>`. Warn of an initial velocity and ignore the value."""
    starts = dict[str, float]()
    for state in states:
        kind, param = state.get("name", ""), state.find("param[@name='initial_value']")
        if param is not None and kind in ("position", "velocity"):
            reader.used.add(param)
            if (number := reader.number(param, ("",), path, "bad-start")) is not None:
                starts[kind] = number
            if kind == "position":
                reader.place(param, f"joint {name} / start")
            elif starts.get(kind):
                message = f"{path} begins with velocity {starts[kind]:g}; in Run and Test the joint begins at rest"
                reader.add(param, "bad-start", message, "take it out")
    return starts.get("position")


def _read_mimic_plugins(reader: Reader, element: Element, path: str) -> Iterator[DriveStatement]:
    """Yield the coupling of each plugin that has a `<mimicJoint>`."""
    for plugin in element.iterfind("plugin"):
        parts = {part.tag: part for part in plugin}
        name = (parts["mimicJoint"].text or "").strip() if "mimicJoint" in parts else ""
        if name:
            place = reader.place(plugin, f"{path} / joint {name}")
            reader.used.add(parts["mimicJoint"])
            mimic = _read_mimic(reader, parts, "joint" if "joint" in parts else "jointName", place)
            yield DriveStatement(place, name, plugin, mimic=mimic, is_driven=False)


def _read_mimic(reader: Reader, parts: Mapping[str, Element], leader: str, path: str) -> Mimic | None:
    """Return the coupling that the elements `parts` state; None without the element named `leader`."""
    name = (parts[leader].text or "").strip() if leader in parts else ""
    if not name:
        return None
    reader.used.update(parts[part] for part in (leader, "multiplier", "offset") if part in parts)
    stated = {part: parts[part] for part in ("multiplier", "offset") if part in parts}
    numbers = {part: reader.number(element, ("",), path, "bad-mimic") for part, element in stated.items()}
    return Mimic(name, **{part: number for part, number in numbers.items() if number is not None})


def _read_interfaces(reader: Reader, element: Element, joint: Element, path: str) -> set[Command | None]:
    """Return the commands of a transmission's joint; None stands for an interface that only measures.

    The actuator's interfaces count if the joint names no interface, and the transmission has no other joint.
    """
    is_alone = len(element.findall("joint")) == 1
    stated = list[set[Command | None]]()
    for place in (joint, *(element.findall("actuator") if is_alone else ())):
        commands = set[Command | None]()
        for interface in place.findall("hardwareInterface"):
            name = (interface.text or "").strip()
            if (known := name.removeprefix("hardware_interface/")) in _INTERFACES:
                reader.used.add(interface)
                commands.add(_INTERFACES[known])
            else:
                _add_unknown(reader, interface, path, name, _INTERFACES)
        stated += [commands] if commands else []
    if any(commands != stated[0] for commands in stated):
        message = f"{path}: the interfaces of joint and actuator differ; those of the joint count"
        reader.add(element, "drive-contradiction", message)
    return stated[0] if stated else set()


def _add_unknown(reader: Reader, element: Element, path: str, name: str, names: Iterable[str]) -> None:
    message = f"{path} has the unknown interface {quoted(name)}, which has no effect"
    reader.add(element, "unknown-interface", message, perhaps(name, list(names)))


def _read_gear(reader: Reader, element: Element, path: str) -> Transmission | None:
    """Return reduction, offset and rotor of a transmission; None if the transmission has none of these numbers."""
    reduction = _read_reduction(reader, element, _REDUCTIONS, path)
    offset = reader.number(element, ("joint/offset",), path, _BAD) or 0.0
    gear = Transmission(reduction, offset, reader.number(element, ("actuator/drake:rotor_inertia",), path, _BAD))
    reader.used.update(part for part in element if part.tag in ("joint", "actuator"))
    # the type SimpleTransmission needs no report: the model has it
    reader.used.update(part for part in element if "SimpleTransmission" in (part.text or ""))
    return None if gear == Transmission() else gear


def _read_reduction(reader: Reader, element: Element, places: Iterable[str], path: str) -> float:
    """Return a reduction; 1 if the reduction is missing or, after a warning, zero."""
    reduction = reader.number(element, places, path, _BAD)
    if reduction == 0:
        reader.add(element, _BAD, f"{path}: the reduction is 0")
    return reduction or 1.0


def configured_drives(options: Options) -> Iterator[DriveStatement]:
    """Yield the commands and start positions of the configuration. Neither makes a joint driven."""
    for name in dict.fromkeys((*options.commands, *options.start)):
        yield DriveStatement(
            "", name, command=options.commands.get(name), start=options.start.get(name), is_driven=False
        )


def read_motors(reader: Reader, closures: Closures) -> Iterator[DriveStatement]:
    """Yield the drives of the joints that have a motor in a YAML."""
    for name, line in closures.motors:
        reader.put(f"motor {name}", line, closures.file)
        yield DriveStatement(f"motor {name}", name)


def with_drives(reader: Reader, joints: Iterable[Joint], drives: Iterable[DriveStatement]) -> list[Joint]:
    """Return the joints with their drives; of contradictory drives the first counts.

    A drive of a joint without an axis is not modelled.
    """
    by_joint = defaultdict[str, list[DriveStatement]](list)
    for drive in drives:
        by_joint[drive.joint].append(drive)
    driven = [
        _with_drives(reader, joint, by_joint[joint.name]) if joint.name in by_joint else joint for joint in joints
    ]
    _tell_held_starts(reader, driven)
    return _without_loose_gears(reader, driven, by_joint)


def _with_drives(reader: Reader, joint: Joint, drives: Sequence[DriveStatement]) -> Joint:
    is_driven = any(drive.is_driven for drive in drives)
    if joint.type not in MOTION_KINDS:
        if is_driven and joint.type == "ball":
            message = f"joint {joint.name!r} is a ball: its drive has no effect"
            reader.tell("ball-not-driven", f"joint {joint.name}", message)
        return msgspec.structs.replace(joint, actuated=is_driven or None)
    reader.used.update(drive.element for drive in drives if drive.element is not None)
    place = f"joint {joint.name} / mimic"
    own = [DriveStatement(place, joint.name, mimic=joint.mimic)] if joint.mimic else []
    mimic = _first(reader, "mimic", [*own, *drives])
    if mimic.mimic and not own:
        reader.lines[place] = reader.lines[mimic.path]  # later findings about the coupling need the line
    _check_flags(reader, drives, follows=mimic.mimic is not None)
    command = _NOTHING if mimic.mimic else _first(reader, "command", drives)
    return msgspec.structs.replace(
        joint,
        actuated=is_driven or None,
        measured=(not is_driven and (joint.measured or any(drive.is_measured for drive in drives))) or None,
        transmission=_first(reader, "transmission", drives).transmission,
        mimic=mimic.mimic,
        start=_start_within_limits(reader, joint, _first(reader, "start", drives)),
        command=command.command if command.command != "position" else None,
        servo=command.servo,
    )


def _first(reader: Reader, field: str, drives: Iterable[DriveStatement]) -> DriveStatement:
    """Return the first statement of a field about a joint; report later statements that contradict it."""
    first, *others = [drive for drive in drives if getattr(drive, field) is not None] or [_NOTHING]
    for other in others if first.path else ():
        if getattr(other, field) != getattr(first, field):
            message = f"joint {first.joint!r} has two {_KINDS[field]} that differ: "
            message += f"that of {first.path} counts, that of {other.path} does not"
            hint = "correct one, or choose by `commands` in the configuration" if field == "command" else ""
            reader.tell("drive-contradiction", other.path, message, hint)
    return first


def _check_flags(reader: Reader, drives: Iterable[DriveStatement], *, follows: bool) -> None:
    """Add a warning for each `mimic="…"` that contradicts whether the joint follows another one."""
    for drive in drives:
        stated = drive.element.get("mimic", "").lower() if drive.element is not None else ""
        if stated == ("false" if follows else "true"):
            fact = "follows another joint all the same" if follows else "has no <mimic>, and moves by itself"
            message = f"{drive.path} has mimic={quoted(stated)}, but joint {drive.joint!r} {fact}"
            reader.tell("drive-contradiction", drive.path, message)


def _start_within_limits(reader: Reader, joint: Joint, drive: DriveStatement) -> float | None:
    """Return the start of a joint; None, after a warning, if the source states one outside of the joint's limits."""
    (lower, upper), start = own_range(joint), drive.start
    if start is not None and drive.path and not lower - _SAME <= start <= upper + _SAME:
        message = f"joint {joint.name!r} begins at {start:g}, outside of its limits {lower:g} to {upper:g}"
        reader.tell("bad-start", f"joint {joint.name} / start", f"{message}: the start is ignored")
        return None
    return start


def _tell_held_starts(reader: Reader, joints: Iterable[Joint]) -> None:
    """Add a warning for each follower that its leader holds elsewhere than it is to begin."""
    starts = {joint.name: joint.start or 0.0 for joint in joints}
    for joint in joints:
        if joint.mimic and joint.start is not None and joint.mimic.joint in starts:
            position = joint.mimic.multiplier * starts[joint.mimic.joint] + joint.mimic.offset
            if abs(position - joint.start) > _SAME:
                message = f"joint {joint.name!r} can't begin at {joint.start:g}: the joint that it follows holds it at "
                reader.tell("bad-start", f"joint {joint.name} / start", f"{message}{position:g}")


def _without_loose_gears(
    reader: Reader, joints: Sequence[Joint], drives: Mapping[str, Sequence[DriveStatement]]
) -> list[Joint]:
    """Return the joints without the gears that couple two joints of which not both turn by themselves."""
    names, loose, found = {joint.name for joint in joints}, dict[str, Finding](), list[Joint]()
    turning = {joint.name for joint in joints if MOTION_KINDS.get(joint.type) == "rotational" and joint.mimic is None}
    for joint in joints:
        gear = joint.transmission
        if gear is None or gear.joint is None or turning.issuperset((joint.name, gear.joint)):
            found.append(joint)
            continue
        found.append(msgspec.structs.replace(joint, transmission=None))
        path = next(drive.path for drive in drives[joint.name] if drive.transmission == gear)
        name, pair = path.partition(" / ")[0], f"{joint.name} and {gear.joint}"
        message = f"{name} couples {pair}, but not both joints turn by themselves: neither has a gear"
        if gear.joint in names:  # other code reports a missing joint
            loose.setdefault(name, Finding("coupled-transmission", path, message))
    reader.extend(loose.values())
    return found
