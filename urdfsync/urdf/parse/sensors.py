"""Read the `<sensor>` elements of URDF, of gazebo blocks and of ros2_control that the package models."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.urdf.parse.fields import Reader, quoted
from urdfsync.urdf.robot import Camera, Joint, Lidar, Origin, Sensor, SensorKind

_TYPES: Mapping[str, SensorKind] = {
    "imu": "imu",
    "force_torque": "force_torque",
    **dict.fromkeys(("camera", "depth", "depth_camera", "rgbd", "rgbd_camera", "wideanglecamera"), "camera"),
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar"), "lidar"),
}
"""Kinds by the attribute `type` of gazebo, and by the elements inside of URDF's own sensors."""
_STATES: Mapping[str, SensorKind] = {
    "angular_velocity": "imu",
    "linear_acceleration": "imu",
    "force": "force_torque",
    "torque": "force_torque",
}
"""Kinds by the beginning of the names of ros2_control's state interfaces."""
_CAMERA = {
    "width": ("image/width", "image@width"),
    "height": ("image/height", "image@height"),
    "horizontal_angle": ("horizontal_fov", "image@hfov"),
    "near": ("clip/near", "image@near"),
    "far": ("clip/far", "image@far"),
}
_LIDAR = {
    "samples": ("scan/horizontal/samples", "horizontal@samples"),
    "min_angle": ("scan/horizontal/min_angle", "horizontal@min_angle"),
    "max_angle": ("scan/horizontal/max_angle", "horizontal@max_angle"),
    "vertical_samples": ("scan/vertical/samples", "vertical@samples"),
    "vertical_min_angle": ("scan/vertical/min_angle", "vertical@min_angle"),
    "vertical_max_angle": ("scan/vertical/max_angle", "vertical@max_angle"),
    "min_range": ("range/min",),
    "max_range": ("range/max",),
}
"""Fields of `Camera` and `Lidar`, and where gazebo and URDF have them below the sensor's own element."""
_FRAMES = ("child", "parent", "sensor")
_DIRECTIONS = ("child_to_parent", "parent_to_child")
_COUNTS = frozenset({"width", "height", "samples", "vertical_samples"})
_LARGEST_INTEGER = 2**31 - 1
_PARTS = ("camera", "ray", "lidar")
"""Elements of a sensor that hold these fields, where they are not in its own."""

_Numbers = TypeVar("_Numbers", Camera, Lidar)


class _Found(NamedTuple):
    """A sensor with the name of the link or joint that it is at."""

    element: Element
    name: str
    kind: SensorKind
    at: str


def read_sensors(reader: Reader, root: Element, links: Collection[str], joints: Iterable[Joint]) -> tuple[Sensor, ...]:
    """Return the sensors that the package models.

    Those of a kind that it does not have, or of ros2_control without a frame, are left out. Sensors of one name are
    told apart by where they are.
    """
    above, known = {joint.child: joint.name for joint in joints}, {joint.name for joint in joints}
    placed = list[_Found]()
    for one in _found(root):
        place = above.get(one.at, one.at) if one.kind == "force_torque" and one.at not in known else one.at
        path = reader.place(one.element, f"sensor {one.name}")
        if place in (known if one.kind == "force_torque" else links):
            placed.append(one._replace(at=place))
            continue
        kind = "joint" if one.kind == "force_torque" else "link"
        message = f"{path} is at {kind} {one.at!r}, which does not exist: it is left out"
        reader.add(one.element, "unknown-sensor-place", message)
    counts = Counter(name for name, _ in {(one.name, one.at) for one in placed})
    sensors: dict[tuple[str, str], Sensor] = {}
    for one in placed:
        name = one.name if counts[one.name] == 1 else f"{one.at}/{one.name}"
        sensor = _read(reader, one, name)
        first = sensors.setdefault((one.name, one.at), sensor)
        # ros2_control says of a sensor where and of which kind it is, and no number
        if first.kind != sensor.kind or (first != sensor and one.element.find("state_interface") is None):
            message = f"{one.at!r} has another sensor {one.name}, and the first counts"
            reader.add(one.element, "duplicate-element", message, "give each sensor a name of its own")
    return tuple(sensors.values())


def _found(root: Element) -> Iterator[_Found]:
    for at, element in _elements(root):
        parent = element.find("parent")
        inside = [child.tag for child in element]
        kind = next((_TYPES[word] for word in (element.get("type", ""), *inside) if word in _TYPES), None)
        place = at if parent is None else parent.get("link", at)
        if kind and place:
            yield _Found(element, element.get("name", "") or f"{place} {kind}", kind, place)
    for element in root.iterfind("ros2_control/sensor"):
        states = [state.get("name", "").partition(".")[0] for state in element.findall("state_interface")]
        kind = next((_STATES[state] for state in states if state in _STATES), None)
        frame = next((one.text for one in element.findall("param") if one.get("name") == "frame_id"), None)
        if kind and frame:
            yield _Found(element, element.get("name", ""), kind, frame.strip())


def _elements(root: Element) -> Iterator[tuple[str, Element]]:
    """Yield the sensors of robot, links, joints and gazebo blocks, with the name of what they stand in."""
    for child in root:
        if child.tag == "sensor":
            yield "", child
        elif child.tag in ("link", "joint", "gazebo"):
            at = child.get("reference" if child.tag == "gazebo" else "name", "")
            yield from ((at, sensor) for sensor in child.findall("sensor"))


def _read(reader: Reader, found: _Found, name: str) -> Sensor:
    element, path = found.element, f"sensor {found.name}"
    reader.used.add(element)
    for child in element:
        words = child.get("name", "")
        is_state = child.tag == "state_interface" and _STATES.get(words.partition(".")[0]) == found.kind
        if is_state or child.tag == "parent" or (child.tag == "param" and words == "frame_id"):
            reader.used.add(child)
    rate = reader.numbers(element, ("update_rate", "@update_rate"), path, "bad-sensor")
    sensor = Sensor(name, found.kind, found.at, _read_origin(reader, found, path), rate[0] if rate else 0.0)
    match found.kind:
        case "camera":
            return msgspec.structs.replace(sensor, camera=_read_fields(reader, element, path, Camera, _CAMERA))
        case "lidar":
            return msgspec.structs.replace(sensor, lidar=_read_fields(reader, element, path, Lidar, _LIDAR))
        case "force_torque":
            return _read_wrench(reader, element, path, sensor)
    return sensor


def _read_origin(reader: Reader, found: _Found, path: str) -> Origin:
    """Return the place of a sensor on its link: the `<pose>` of gazebo, or the `<origin>` of URDF."""
    pose, origin = reader.find(found.element, "pose"), reader.find(found.element, "origin")
    if origin is not None:
        return reader.read(origin, f"{path} / origin", Origin, path)
    numbers = reader.numbers(found.element, ("pose",), path, "bad-sensor", 6)
    if pose is None or numbers is None:
        return Origin()
    if (other := pose.get("relative_to")) and other != found.at:
        message = f"{path}: its pose counts from {found.at!r}, and not from {other!r}"
        reader.add(pose, "bad-sensor", message, f"give its pose in the frame of {found.at!r}")
    turn = math.radians(1) if pose.get("degrees", "").strip().lower() in ("true", "1") else 1.0
    x, y, z, roll, pitch, yaw = numbers
    return Origin((x, y, z), (roll * turn, pitch * turn, yaw * turn))


def _read_fields(
    reader: Reader, element: Element, path: str, struct: type[_Numbers], places: Mapping[str, Sequence[str]]
) -> _Numbers:
    """Return the numbers of a camera or laser scanner; those that the source does not say are 0."""
    part = next((child for child in element if child.tag in _PARTS), element)
    reader.used.add(part)
    values = {}
    for field, ways in places.items():
        (value,) = reader.numbers(part, ways, path, "bad-sensor") or (0.0,)
        if field in _COUNTS and not (value.is_integer() and 0 <= value <= _LARGEST_INTEGER):
            message = f"{path}: {field.replace('_', ' ')} {value:g} is no number of things"
            reader.add(part, "bad-sensor", message)
            continue
        values[field] = value
    return struct(**values)


def _read_wrench(reader: Reader, element: Element, path: str, sensor: Sensor) -> Sensor:
    """Return a sensor of force and torque with the axes and the direction of what it shows."""
    words = []
    for way, known in (("force_torque/frame", _FRAMES), ("force_torque/measure_direction", _DIRECTIONS)):
        part = reader.find(element, way)
        word = ((part.text if part is not None else "") or "").strip() or known[0]
        if word not in known:
            message = f"{path}: {quoted(word)} is none of {', '.join(known)}: the {known[0]} counts"
            reader.add(element, "bad-sensor", message)
        words.append(word)
    frame, way = words
    origin = sensor.origin if frame == "sensor" else Origin()
    return msgspec.structs.replace(
        sensor, origin=origin, in_parent=frame == "parent", on_child=way == "parent_to_child"
    )
