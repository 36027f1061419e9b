"""Reads a URDF a second time, without code of the first reader, to check the first reading.

yourdfpy reads masses, sizes, places, axes, limits, losses and `mimic` elements; this module reads all else.

Each value has its path in the records of a package, such as `limits.effort`. The first reader reports faults, so this
reader does not: an unreadable value counts as missing.
"""

from __future__ import annotations

import contextlib
import copy
import io
import re
from collections import Counter, defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import msgspec
import numpy as np
import yourdfpy
from lxml import etree
from trimesh import transformations

from urdfsync.domain import Companion
from urdfsync.formats.urdf.options import LoopFrame, Options
from urdfsync.formats.urdf.second.companions import PATHS, Companions, read_companions
from urdfsync.formats.urdf.second.dynamics import OF_DYNAMICS
from urdfsync.formats.urdf.second.gears import Gear, read_gears
from urdfsync.formats.urdf.second.plain import SHAPES, decimal, plain_root

INF, ZERO = float("inf"), (0.0, 0.0, 0.0)
TURNS = ("revolute", "continuous")
MOVES = (*TURNS, "prismatic")
COMMANDS = ("position", "velocity", "effort")
TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_LOSSES = {
    **dict.fromkeys(MOVES, ("dynamics.damping", "dynamics.friction")),
    "planar": ("translation.damping", "translation.friction", "rotation.damping", "rotation.friction"),
    "ball": ("damping",),
}
"""Paths of damping and friction in the records, by type of joint."""
_SERVOS = {
    "position": "positionGain; velocityGain minPosition maxPosition minEffort maxEffort",
    "velocity": "positionGain velocityGain; minVelocity maxVelocity minPosition maxPosition minEffort maxEffort",
    "effort": "minEffort maxEffort;",
}
"""Numbers of a drive's law by its command; without any of those before the semicolon there is no law."""
_STATED = ("is_driven", "is_measured")
"""What an element may tell about a joint, beside its numbers."""
_SUBSTITUTES = {"capsule": "cylinder", "ellipsoid": "box"}
_WHEEL = re.compile("(left|right)((Front|Rear)?Joint|_joint)")
_SENSORS = {
    **dict.fromkeys("camera depth depth_camera rgbd rgbd_camera wideanglecamera".split(), "camera"),
    **dict.fromkeys("ray gpu_ray lidar gpu_lidar".split(), "lidar"),
    **{kind: kind for kind in ("imu", "force_torque", "accelerometer", "gyroscope")},
    **dict.fromkeys(("angular_velocity", "linear_acceleration"), "imu"),
    **dict.fromkeys(("force", "torque"), "force_torque"),
}
_FIELDS = {
    "camera": "width image/width image@width, height image/height image@height, near clip/near image@near, "
    "far clip/far image@far, horizontalAngle horizontal_fov image@hfov",
    "lidar": "samples scan/horizontal/samples horizontal@samples, verticalSamples scan/vertical/samples "
    "vertical@samples, minAngle scan/horizontal/min_angle horizontal@min_angle, maxAngle scan/horizontal/max_angle "
    "horizontal@max_angle, verticalMinAngle scan/vertical/min_angle vertical@min_angle, verticalMaxAngle "
    "scan/vertical/max_angle vertical@max_angle, minRange range/min, maxRange range/max",
}
_CONTACT = {
    "link": "mu contact/lateral_friction, kp contact/stiffness, kd contact/damping",
    "gazebo": "mu mu1 surface/friction/ode/mu collision/surface/friction/ode/mu, "
    "kp kp surface/contact/ode/kp collision/surface/contact/ode/kp, "
    "kd kd surface/contact/ode/kd collision/surface/contact/ode/kd, "
    "minDepth minDepth surface/contact/ode/min_depth collision/surface/contact/ode/min_depth",
}
"""Fields, each with the places of its number in the URDF. The first existing place counts."""


class Stated(NamedTuple):
    """A value of the source (numbers, a word or a rotation matrix), and the line of its element."""

    value: Any
    line: int
    file: str = ""
    """The companion that states the value; empty for the source itself."""


class SecondElement(msgspec.Struct):
    """A link, joint, loop or sensor with its values; `type` is also the kind of a loop or sensor."""

    name: str
    line: int
    type: str = ""
    parent: str = ""
    """The parent link of a joint or loop; the link or joint of a sensor."""
    child: str = ""
    values: dict[str, Stated] = {}
    leader: str = ""
    command: str = ""
    """The quantity that Run commands; empty for a joint that Run does not drive."""
    is_named: bool = False
    """Whether the source or the configuration names the joint as driven."""
    in_loop: bool = False
    shares: str = ""
    """Another joint that the joint's motor turns."""
    file: str = ""
    """The companion that states a loop; empty for an element of the source itself."""
    axes: tuple[Any, ...] = ()
    """The axes of a loop, or two flags of a force-torque sensor: axes of the parent, measures parent to child."""

    def put(self, path: str, value: Any, at: Any) -> None:
        """Store a value with the line of an XML element or of a companion. A single number becomes a tuple."""
        place = getattr(at, "sourceline", 0), getattr(at, "file", "")
        self.values[path] = Stated((value,) if isinstance(value, float) else value, *place)

    def state(self, value: Any) -> Stated:
        """Return a value with the place of the element."""
        return Stated(value, self.line, self.file)

    def number(self, path: str) -> float:
        """Return the first number of a value."""
        return float(self.values[path].value[0])


class SecondReading(msgspec.Struct):
    """A whole robot."""

    name: str
    links: dict[str, SecondElement] = {}
    joints: dict[str, SecondElement] = {}
    loops: dict[str, SecondElement] = {}
    sensors: dict[str, SecondElement] = {}


def read_again(content: bytes, options: Options, *companions: Companion) -> SecondReading:
    """Return the second reading of a source. Raises ValueError or LookupError for an unreadable source."""
    stated = read_companions(companions, options)
    reading = _read(content, options, stated, None)
    held = {name for name, joint in reading.joints.items() if joint.in_loop and joint.type == "ball"}
    return _read(content, options, stated, reading.joints.keys() - held) if held else reading


def _read(content: bytes, options: Options, stated: Companions, names: Collection[str] | None) -> SecondReading:
    """Read a source; a ball joint whose name is not in `names` becomes a chain of hinges."""
    root = plain_root(content, names, stated)
    gears = read_gears(root, stated.rows)
    for part in root.iter():  # yourdfpy refuses prefixes
        part.tag = part.tag.replace(":", "_")
        for name in [name for name in part.attrib if ":" in name]:
            part.set(name.replace(":", "_"), part.attrib.pop(name))
    robot = _read_with_yourdfpy(root)
    links = {each.name: each for each in _links(root, robot.links)}
    motors = ({"joint": joint, "at": at, "is_driven": True} for joint, at in stated.motors)
    joints = {each.name: each for each in _joints(root, robot.joints, gears, [*_drives(root), *motors], options)}
    reading = SecondReading(robot.name, links, joints)
    for name, (row, place) in stated.rows.items():
        for path in (PATHS[number] for number in row if name in joints):
            joints[name].values[path] = Stated(joints[name].values[path].value, place.sourceline, place.file)
    reading.sensors = {each.name: each for each in _sensors(root, reading)}
    reading.loops = {each.name: each for each in _loops(root, reading, options, stated)}
    above = {joint.child: joint for joint in joints.values()}
    for loop in reading.loops.values():
        ways = {end: set[str]() for end in (loop.parent, loop.child)}
        for end, way in ways.items():
            while end in above:
                way.add(above[end].name)
                end = above[end].parent
        for name in set.symmetric_difference(*ways.values()):
            while name in joints:
                joints[name].in_loop, name = True, joints[name].leader
    return reading


def rotation(rpy: Sequence[float]) -> Any:
    """Return the matrix of fixed-axis roll, pitch and yaw angles. A matrix is returned unchanged."""
    return rpy if len(np.shape(rpy)) == 2 else transformations.euler_matrix(*rpy)[:3, :3]


def pose(xyz: Any, rpy: Any) -> Any:
    """Return the 4×4 matrix of a place and angles."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation(rpy), xyz
    return matrix


def origin(element: SecondElement, path: str = "origin") -> Any:
    """Return the 4×4 matrix of one of the origins of an element."""
    return pose(element.values[f"{path}.xyz"].value, element.values[f"{path}.rpy"].value)


def poses(reading: SecondReading) -> dict[str, Any]:
    """Return the poses of all links in the root frame, with all joints at zero."""
    placed = {name: np.eye(4) for name in reading.links.keys() - {joint.child for joint in reading.joints.values()}}
    for link in (waiting := list(placed)):  # the list grows in this loop
        for joint in (joint for joint in reading.joints.values() if joint.parent == link):
            placed[joint.child] = placed[link] @ origin(joint)
            waiting.append(joint.child)
    return placed


def same(ours: Any, theirs: Any) -> bool:
    """Return whether two values agree: numbers to nine digits, rotations by their matrices."""
    if isinstance(ours, str) or isinstance(theirs, str) or ours is None:
        return bool(ours == theirs)
    if {np.size(ours), np.size(theirs)} == {3, 9}:
        return bool(np.abs(rotation(ours) - rotation(theirs)).max() < 1e-9)
    return np.shape(ours) == np.shape(theirs) and bool(np.isclose(ours, theirs, rtol=1e-9, atol=1e-14).all())


# XML


def _numbers(text: str | None, count: int = 1) -> tuple[float, ...] | None:
    with contextlib.suppress(ValueError):
        numbers = tuple(decimal(word) + 0.0 for word in (text or "").split())
        return numbers if len(numbers) == count else None
    return None


def _at(element: Any, places: str, count: int = 1, default: Any = None) -> Any:
    """Return the numbers at the first existing place; if `count` is 1, the number itself.

    A place is a path, `@` with an attribute, or both.
    """
    for place in places.split():
        path, _, attribute = place.partition("@")
        holder = element.find(path or ".")
        if holder is not None and (not attribute or attribute in holder.attrib):
            numbers = _numbers(holder.get(attribute or "value") or (None if attribute else holder.text), count)
            return default if numbers is None else numbers[0] if count == 1 else numbers
    return default


def _text(element: Any, path: str) -> str:
    return (element.findtext(path) or "").strip()


def _put_origin(element: SecondElement, around: Any, path: str = "origin", theirs: Any = None) -> None:
    """State the origin in an XML element; `theirs` is yourdfpy's matrix, which knows no quaternions."""
    place = around.find("origin")
    xyz, rpy = _at(around, "origin@xyz", 3, ZERO), _at(around, "origin@rpy", 3, ZERO)
    if quaternion := _at(around, "origin@quat_xyzw", 4):
        *axis, w = np.array(quaternion) / max(map(abs, quaternion))  # squares of large numbers would overflow
        rpy = transformations.quaternion_matrix([w, *axis])[:3, :3]
    elif theirs is not None:
        xyz, turned = tuple(map(float, theirs[:3, 3])), theirs[:3, :3]
        rpy = rpy if same(rpy, turned) else turned  # messages show angles as the source has them
    element.put(f"{path}.xyz", xyz, around if place is None else place)
    element.put(f"{path}.rpy", rpy, around if place is None else place)


# yourdfpy


def _read_with_yourdfpy(root: Any) -> Any:
    """Return the links and joints of a plain URDF with their numbers, as yourdfpy reads them.

    It requires a name and known shapes, and an absent moment of inertia is 1 for it. Capsules and ellipsoids become
    cylinders and boxes with the same numbers. Materials are left out: yourdfpy looks up no names.
    """
    plain = etree.Element("robot", name=root.get("name", ""))
    plain.extend(copy.deepcopy(part) for part in root if part.tag in ("link", "joint"))
    for inertia in plain.findall("link/inertial/inertia"):
        inertia.attrib.update(dict.fromkeys(TENSOR, "0") | dict(inertia.attrib))
    for shape in plain.xpath("link/visual | link/collision"):
        if (geometry := _geometry(shape)) is None:
            shape.getparent().remove(shape)
            continue
        sizes = {"size" if name == "radii" else name: text for name, text in geometry.items()}
        shape.find("geometry")[:] = [etree.Element(_SUBSTITUTES.get(geometry.tag, geometry.tag), sizes)]
        for material in shape.findall("material"):
            shape.remove(material)
    return yourdfpy.URDF.load(io.BytesIO(etree.tostring(plain)), load_meshes=False, build_scene_graph=False).robot


def _geometry(shape: Any) -> Any:
    """Return the first known geometry of a visual or collision; None without one."""
    return next((part for part in shape.xpath("geometry[1]/*") if part.tag in SHAPES), None)


def _number(theirs: Any, field: str, default: float) -> float:
    """Return a number that yourdfpy has read; `theirs` may be None."""
    number = getattr(theirs, field, None)
    return default if number is None else float(number)


# Links


def _links(root: Any, robot: Any) -> Iterator[SecondElement]:
    colors = dict[str, tuple[float, ...]]()
    for material in (*root.iterchildren("material"), *root.findall("link/visual/material")):
        if rgba := _at(material, "color@rgba", 4):
            colors.setdefault(material.get("name", ""), rgba)
    blocks = [("gazebo", block.get("reference"), block) for block in root.iterchildren("gazebo")]
    for element, theirs in zip(root.iterchildren("link"), robot, strict=True):
        link = SecondElement(theirs.name, element.sourceline)
        link.put("name", link.name, element)
        inertial = element.find("inertial")
        if theirs.inertial is None:
            link.put("hasInertial", "false", element)
        else:
            _put_origin(link, inertial, "inertial.origin", theirs.inertial.origin)
            link.put("inertial.mass", _number(theirs.inertial, "mass", 0.0), inertial)
            tensor = np.zeros((3, 3)) if theirs.inertial.inertia is None else theirs.inertial.inertia
            for name, number in zip(TENSOR, tensor[np.triu_indices(3)], strict=True):
                link.put(f"inertial.inertia.{name}", float(number), inertial)
        for kind, name, block in (("link", link.name, element), *blocks):
            for field, *places in (words.split() for words in _CONTACT[kind].split(", ") if name == link.name):
                number = _at(block, " ".join(places), 1, -1.0)
                if f"contact.{field}" not in link.values and (0 < number < INF or (number == 0 and field != "kp")):
                    link.put(f"contact.{field}", number, block)
        for tag, sizes in (("visual", theirs.visuals), ("collision", theirs.collisions)):
            drawn = [shape for shape in element.iterchildren(tag) if _geometry(shape) is not None]
            for number, (shape, each) in enumerate(zip(drawn, sizes, strict=True), 1):
                _put_shape(link, f"{tag}{number}", shape, each, colors)
        yield link


def _put_shape(link: SecondElement, path: str, shape: Any, drawn: Any, colors: Mapping[str, Any]) -> None:
    geometry = _geometry(shape)
    _put_origin(link, shape, f"{path}.origin", drawn.origin)
    link.put(f"{path}.shape", geometry.tag, geometry)
    theirs = getattr(drawn.geometry, _SUBSTITUTES.get(geometry.tag, geometry.tag))
    for field in SHAPES[geometry.tag].split():
        numbers = np.ravel(getattr(theirs, "size" if field == "radii" else field))
        link.put(f"{path}.{field}", tuple(map(float, numbers)), geometry)
    if geometry.tag == "mesh":
        scale = (1.0, 1.0, 1.0) if theirs.scale is None else theirs.scale
        link.put(f"{path}.uri", (theirs.filename, tuple(map(float, scale))), geometry)
    rgba: Any = (1.0, 105 / 255, 180 / 255, 0.5) if shape.tag == "collision" else None
    material = shape.find("material")
    if shape.tag == "visual" and material is not None:
        rgba = (material.get("name") and colors.get(material.get("name"))) or _at(material, "color@rgba", 4)
    if rgba or geometry.tag != "mesh":
        *color, opacity = (min(max(part, 0.0), 1.0) for part in rgba or (*3 * (180 / 255,), 1.0))
        link.put(f"{path}.color", tuple(float(round(255 * part)) for part in color), shape)
        link.put(f"{path}.opacity", opacity, shape)


# Joints


def _joints(
    root: Any, robot: Any, gears: Mapping[str, Gear], found: Sequence[dict[str, Any]], options: Options
) -> Iterator[SecondElement]:
    drives, chosen = defaultdict[str, list[dict[str, Any]]](list), options.driven
    for drive in found:
        drives[drive["joint"]].append(drive)
    has_drives = any(drive.get("is_driven") for theirs in robot for drive in drives[theirs.name])
    for element, theirs in zip(root.iterchildren("joint"), robot, strict=True):
        joint = SecondElement(theirs.name, element.sourceline, theirs.type, theirs.parent, theirs.child)
        joint.put("name", joint.name, element)
        _put_origin(joint, element, theirs=theirs.origin)
        if joint.type in (*MOVES, "planar"):
            axis = theirs.axis / np.abs(theirs.axis).max()
            joint.put("axis", tuple(map(float, axis / np.linalg.norm(axis))), element)
        for place in _LOSSES.get(joint.type, ()) if theirs.dynamics else ():
            joint.put(place, _number(theirs.dynamics, place.rpartition(".")[2], 0.0), element.find("dynamics"))
        if joint.type in MOVES:
            _put_axis(joint, element, theirs)
            _put_drive(joint, element, theirs.mimic, drives[joint.name], gears.get(joint.name), options)
        is_driven, is_measured = (any(drive.get(key) for drive in drives[joint.name]) for key in _STATED)
        # joints without a drive in the source may be driven, too
        is_free = has_drives and joint.type == "continuous" and element.find("limit") is None
        is_passive = not is_driven and (is_measured or is_free)
        is_wanted = joint.name in options.commands or not is_passive
        joint.is_named = is_driven or joint.name in options.commands
        if chosen is not None:
            joint.is_named = is_wanted = joint.name in chosen
        if not is_wanted:
            joint.command = ""
        yield joint


def _put_axis(joint: SecondElement, element: Any, theirs: Any) -> None:
    """State limits, inertia, calibration and safety controller of a joint that turns or slides."""
    limit = element.find("limit")
    at = element if limit is None else limit
    for field, infinite in (("lower", -INF), ("upper", INF)):
        is_open = limit is None or joint.type == "continuous"
        joint.put(f"limits.{field}", infinite if is_open else _number(theirs.limit, field, 0.0), at)
    for field in ("velocity", "effort"):
        joint.put(f"limits.{field}", _number(theirs.limit, field, INF), at)
    for field in ("acceleration", "deceleration", "jerk"):
        if (number := _at(element, f"limit@{field}")) is not None:
            joint.put(f"limits.{field}", number, at)
    for field, attribute in OF_DYNAMICS.items():
        if (number := _at(element, f"dynamics@{attribute}")) is not None:
            joint.put(f"dynamics.{field}", number, element.find("dynamics"))
    for tag, group, fields, default in (
        ("calibration", "calibration", "rising falling", INF),
        ("safety_controller", "safetyController", "k_velocity k_position soft_lower_limit soft_upper_limit", 0.0),
    ):
        for field in fields.split() if getattr(theirs, tag) else ():
            joint.put(f"{group}.{field}", _number(getattr(theirs, tag), field, default), element.find(tag))


def _put_drive(
    joint: SecondElement,
    element: Any,
    mimic: Any,
    drives: Sequence[Mapping[str, Any]],
    gear: Gear | None,
    options: Options,
) -> None:
    """State gear, coupling, command and start of a joint. The first statement of each counts."""
    first = dict[str, Any]()
    for drive in drives:
        for key in ("command", "start"):
            if drive.get(key) is not None:
                first.setdefault(key, (drive[key], drive["at"]))
    if gear:
        joint.shares = gear.joint
        at = next((drive["at"] for drive in drives if getattr(drive["at"], "tag", "") == "transmission"), element)
        gears = gear.reduction, gear.offset, gear.rotor, gear.joint_reduction if gear.joint else None
        for field, number in zip(("reduction", "offset", "rotorInertia", "otherReduction"), gears, strict=True):
            if number is not None:
                joint.put(f"transmission.{field}", float(number), at)
    if mimic:
        joint.leader = mimic.joint
        for field in ("multiplier", "offset"):
            joint.put(f"mimic.{field}", getattr(mimic, field), element.find("mimic"))
        return
    joint.command = options.commands.get(joint.name) or first.get("command", ("position",))[0]
    if "command" in first and joint.name not in options.commands:
        for field, (number, at) in next(drive for drive in drives if drive.get("command")).get("servo", {}).items():
            joint.put(f"servo.{field}", number, at)
    start, at = first.get("start", (None, element))
    if start is not None and not joint.number("limits.lower") - 1e-6 <= start <= joint.number("limits.upper") + 1e-6:
        start = None
    if (start := options.start.get(joint.name, start)) is not None:
        joint.put("start", float(start), at)


def _drives(root: Any) -> Iterator[dict[str, Any]]:
    """Yield each statement of ros2_control, transmissions and plugins about a joint. Earlier statements come first."""
    for control in root.iterchildren("ros2_control"):
        for joint in control.iterchildren("joint"):
            names = [part.get("name", "").removesuffix("_pid") for part in joint.iterchildren("command_interface")]
            drive = {"joint": joint.get("name"), "at": joint, "is_driven": bool(names)}
            drive["is_measured"] = not names and joint.find("state_interface") is not None
            drive["command"] = next((command for command in COMMANDS if command in names), None)
            drive["servo"] = _servo(joint, drive["command"])
            for param in joint.xpath("state_interface[@name='position']/param[@name='initial_value']"):
                drive["start"], drive["at"] = _at(param, "."), param
            yield drive
        yield from (drive for part in control.iterchildren("transmission") for drive in _transmission(part))
    yield from (drive for part in root.iterchildren("transmission") for drive in _transmission(part))
    for plugin in root.findall("gazebo/plugin"):
        for part in (part for part in plugin if _WHEEL.fullmatch(part.tag)):
            yield {"joint": (part.text or "").strip(), "at": part, "is_driven": True, "command": "velocity"}


def _servo(joint: Any, command: str | None) -> dict[str, tuple[float, Any]]:
    """Return the numbers of a drive's law with their elements; none without a law."""
    places = [part for part in joint.iterchildren("command_interface") if command]
    place = next((part for part in reversed(places) if part.get("name", "").removesuffix("_pid") == command), None)
    needed, others = (words.split() for words in _SERVOS.get(command or "", ";").split(";"))
    numbers = dict[str, tuple[float, Any]]()
    for param in () if place is None else place.iterchildren("param"):
        first, *rest = param.get("name", "").split("_")
        field, number = first + "".join(map(str.capitalize, rest)), _at(param, ".")
        if field in (*needed, *others) and number is not None:
            numbers.setdefault(field, (number, param))
    if command == "velocity" and "positionGain" not in numbers:  # nothing has a position to limit
        numbers = {field: each for field, each in numbers.items() if "Position" not in field}
    return {} if numbers.keys().isdisjoint(needed) else numbers


def _transmission(element: Any) -> Iterator[dict[str, Any]]:
    joints = [part for part in element if part.tag.rstrip("12").lower().endswith("joint") and part.get("name")]
    for joint in joints:
        drive = {"joint": joint.get("name"), "at": element}
        for place in (joint, *(element.findall("actuator") if len(element.findall("joint")) == 1 else ())):
            names = [(part.text or "").strip() for part in place.iterchildren("hardwareInterface")]
            words = [re.match(r"(?:hardware_interface/)?(Pos|Vel|Eff)\w*JointInterface$", name) for name in names]
            commands = [command for command in COMMANDS if command[:3].title() in {word[1] for word in words if word}]
            is_measured = not commands and any(name.endswith("JointStateInterface") for name in names)
            is_driven = not is_measured and not joint.tag.startswith("passive")
            drive |= {"is_measured": is_measured, "is_driven": is_driven, "command": next(iter(commands), None)}
            if commands or is_measured:
                break
        yield drive


# Sensors


def _sensors(root: Any, reading: SecondReading) -> Iterator[SecondElement]:
    """Yield the sensors of existing links and joints.

    If several sensors have the same name on the same link or joint, only the first counts.
    """
    above, placed = {joint.child: name for name, joint in reading.joints.items()}, dict[tuple[str, str], Any]()
    for element, name, kind, place in _find_sensors(root):
        is_wrench = kind == "force_torque"
        at = above.get(place, place) if is_wrench and place not in reading.joints else place
        if at in (reading.joints if is_wrench else reading.links):
            placed.setdefault((name, at), (element, kind))
    counts = Counter(name for name, _ in placed)
    for (name, at), (element, kind) in placed.items():
        sensor = SecondElement(name if counts[name] == 1 else f"{at}/{name}", element.sourceline, kind, at)
        sensor.put("name", sensor.name, element)
        sensor.put("updateRate", _at(element, "update_rate @update_rate", 1, 0.0), element)
        frame, direction = (_text(element, f"force_torque/{tag}") for tag in ("frame", "measure_direction"))
        sensor.axes = frame == "parent", direction == "parent_to_child"
        _put_origin(sensor, element)
        if element.find("origin") is None and (six := _at(element, "pose", 6)):
            is_degrees = element.find("pose").get("degrees", "").strip().lower() in ("true", "1")
            sensor.put("origin.xyz", six[:3], element)
            sensor.put("origin.rpy", tuple(np.radians(six[3:])) if is_degrees else six[3:], element)
        if kind == "force_torque" and frame != "sensor":
            sensor.put("origin.xyz", ZERO, element)
            sensor.put("origin.rpy", ZERO, element)
        part = next((child for child in element if child.tag in ("camera", "ray", "lidar")), element)
        for field, *places in (words.split() for words in _FIELDS.get(kind, "").split(", ") if words):
            number = _at(part, " ".join(places), 1, 0.0)
            is_count = field in ("width", "height", "samples", "verticalSamples")
            sensor.put(field, 0.0 if is_count and (number % 1 or not 0 <= number < 2**31) else number, element)
        yield sensor


def _find_sensors(root: Any) -> Iterator[tuple[Any, str, str, str]]:
    """Yield each sensor of a known kind, with its name, its kind, and the name of its link or joint."""
    for around in root.xpath("sensor | link | joint | gazebo"):
        place = "" if around.tag == "sensor" else around.get("reference" if around.tag == "gazebo" else "name", "")
        for element in [around] if around.tag == "sensor" else around.findall("sensor"):
            words = (element.get("type", ""), *(child.tag for child in element))
            kind, parent = next((_SENSORS[word] for word in words if word in _SENSORS), ""), element.find("parent")
            at = place if parent is None else parent.get("link") or parent.get("joint", place)
            if kind and at:
                yield element, element.get("name") or f"{at} {kind}", kind, at
    for element in root.findall("ros2_control/sensor"):
        states = [state.get("name", "").partition(".")[0] for state in element.iterchildren("state_interface")]
        kind = next((_SENSORS[state] for state in states if state in _SENSORS), "")
        frames = [(param.text or "").strip() for param in element.xpath("param[@name='frame_id']")]
        if kind and frames and frames[0]:
            yield element, element.get("name", ""), kind, frames[0]


# Loops


def _loops(root: Any, reading: SecondReading, options: Options, stated: Companions) -> Iterator[SecondElement]:
    """Yield the loops of the configuration, then other loops of the source."""
    ends, known = {name: joint.child for name, joint in reading.joints.items()}, set[Any]()
    for option in options.loops:
        frames = [LoopFrame(frame) if isinstance(frame, str) else frame for frame in option.frames]
        places = [(frame.link, frame.xyz, frame.rpy) for frame in frames]
        yield _loop(option.name, option.kind, None, places, option.axis, option.child_axis)
        known |= {option.name, str(sorted(map(str, places)))}
    beside = [
        (name, kind, at, [(end, ZERO, ZERO) for end in ends], (1.0, 0.0, 0.0), None)
        for name, kind, *ends, at in stated.loops
    ]
    for name, kind, element, places, axis, second in (*_loops_in(root, reading), *beside, *_loops_by_name(reading)):
        places = [(link if link in reading.links else ends.get(link, link), *rest) for link, *rest in places]
        if known.isdisjoint({name, str(sorted(map(str, places)))}):
            yield _loop(name, kind, element, places, axis, second)


def _loop(name: str, kind: str, element: Any, places: Sequence[Any], axis: Any, second: Any) -> SecondElement:
    """Return a loop between two frames; `places` has link, position and angles of each frame."""
    loop = SecondElement(name, getattr(element, "sourceline", 0), kind, places[0][0], places[1][0])
    loop.file = getattr(element, "file", "")
    loop.put("name", name, element)
    for path, (_, xyz, rpy) in zip(("origin", "childOrigin"), places, strict=True):
        loop.put(f"{path}.xyz", xyz, element)
        loop.put(f"{path}.rpy", rpy, element)
    loop.axes = tuple(None if part is None else np.array(part) / np.linalg.norm(part) for part in (axis, second))
    return loop


def _loops_in(root: Any, reading: SecondReading) -> Iterator[tuple[Any, ...]]:
    within = {"loop_joint": "self::*", "drake_ball_constraint": "self::*", "gazebo": "joint"}
    elements = [part for top in root if top.tag in within for part in top.xpath(within[top.tag])]
    placed = poses(reading)
    for number, element in enumerate(elements, 1):
        name, kind = element.get("name") or f"loop_{number}", element.get("type", "")
        kind, axis, second = {"spherical": "ball", "continuous": "revolute"}.get(kind, kind), (0.0, 0.0, 1.0), None
        places = list[Any]()
        if element.tag == "loop_joint":
            axis = _at(element, "axis@xyz", 3, (1.0, 0.0, 0.0))
            for end in element.xpath("link1 | link2") or [element.find("parent"), element.find("child")]:
                own = element.find("origin") if end.tag == "parent" else None
                own = element.find(f"{end.tag}_origin") if own is None else own
                place = end if own is None else own
                places.append((end.get("link"), _at(place, "@xyz", 3, ZERO), _at(place, "@rpy", 3, ZERO)))
            (first, _, rpy), (last, xyz, _) = places
            if element.xpath("child_origin[not(@rpy)]") and {first, last} <= placed.keys():  # both frames are parallel
                places[1] = last, xyz, placed[last][:3, :3].T @ placed[first][:3, :3] @ rotation(rpy)
        elif element.tag == "drake_ball_constraint":
            kind = "ball"
            for body, point in (("body_A", "p_AP"), ("body_B", "p_BQ")):
                link = element.find(f"drake_ball_constraint_{body}").get("name")
                places.append((link, _at(element, f"drake_ball_constraint_{point}@value", 3, ZERO), ZERO))
        else:
            parent, child = (_text(element, tag) for tag in ("parent", "child"))
            axis, second = _at(element, "axis/xyz", 3, axis), _at(element, "axis2/xyz", 3)
            six = _at(element, "pose", 6, (*ZERO, *ZERO))
            if parent in placed and child in placed:
                there = np.linalg.inv(placed[parent]) @ placed[child] @ pose(six[:3], six[3:])
                xyz = tuple(round(float(value), 12) + 0.0 for value in there[:3, 3])
                places = [(parent, xyz, there[:3, :3]), (child, six[:3], six[3:])]
        if len(places) == 2 and kind in ("ball", "revolute", "universal", "fixed"):
            yield name, kind, element, places, axis, second


def _loops_by_name(reading: SecondReading) -> Iterator[tuple[Any, ...]]:
    """Yield a ball joint for each pair of links with onshape-to-robot's names for a loop."""
    for name in reading.links:
        other = f"{name[:-1]}2"
        if re.fullmatch("closing_.+_1", name) and other in reading.links:
            yield name[:-2], "ball", None, [(name, ZERO, ZERO), (other, ZERO, ZERO)], (0.0, 0.0, 1.0), None
