"""Reads the `<sensor>` elements of robots, links, joints, `<gazebo>` and `<ros2_control>`."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.formats.urdf.parse.fields import Reader, quoted
from urdfsync.formats.urdf.robot import SENSOR_KINDS, Camera, Joint, Lidar, Origin, Sensor, SensorKind

_TYPES = {word: kind for kind, model in SENSOR_KINDS.items() for word in (kind, *model.types)}
_STATES = {state: kind for kind, model in SENSOR_KINDS.items() for state in model.states}
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
"""Fields of `Camera` and `Lidar`, with their paths in Gazebo and in URDF below the element of the sensor."""
_FRAMES = ("child", "parent", "sensor")
_DIRECTIONS = ("child_to_parent", "parent_to_child")
_COUNTS = frozenset({"width", "height", "samples", "vertical_samples"})
_LARGEST_INTEGER = 2**31 - 1  # of Modelica
_PARTS = ("camera", "ray", "lidar")
"""Elements of a sensor that may contain these fields."""


class _SensorElement(NamedTuple):
    """An element of a sensor, with the name of its link or joint."""

    element: Element
    name: str
    kind: SensorKind
    at: str


def read_sensors(reader: Reader, root: Element, links: Collection[str], joints: Iterable[Joint]) -> tuple[Sensor, ...]:
    """Return the sensors that the package models.

    Sensors of other kinds, and sensors of ros2_control without a frame, are left out. If several sensors have one name,
    the name of the link or joint goes before the name of the sensor.
    """
    joints_above, joint_names = {joint.child: joint.name for joint in joints}, {joint.name for joint in joints}
    placed = list[_SensorElement]()
    for source in _find_sensors(root):
        place, kind = source.at, SENSOR_KINDS[source.kind].at
        if kind == "joint" and place not in joint_names:  # Gazebo names the joint's child link
            place = joints_above.get(place, place)
        path = reader.place(source.element, f"sensor {source.name}")
        if place in (joint_names if kind == "joint" else links):
            placed.append(source._replace(at=place))
            continue
        message = f"{path} is at {kind} {source.at!r}, which does not exist: the sensor is left out"
        reader.add(source.element, "unknown-sensor-place", message)
    counts = Counter(name for name, _ in {(source.name, source.at) for source in placed})
    sensors: dict[tuple[str, str], Sensor] = {}
    for source in placed:
        name = source.name if counts[source.name] == 1 else f"{source.at}/{source.name}"
        sensor = _read(reader, source, name)
        first = sensors.setdefault((source.name, source.at), sensor)
        # ros2_control gives a sensor only a place and a kind, no numbers
        if first.kind != sensor.kind or (first != sensor and source.element.find("state_interface") is None):
            message = f"{source.at!r} has another sensor {source.name}, and the first counts"
            reader.add(source.element, "duplicate-element", message, "give each sensor a name of its own")
    return tuple(sensors.values())


def _find_sensors(root: Element) -> Iterator[_SensorElement]:
    """Yield the sensors of known kinds. Their links and joints may not exist."""
    for child in root:
        at = child.get("reference" if child.tag == "gazebo" else "name", "") if child.tag != "sensor" else ""
        inner = child.findall("sensor") if child.tag in ("link", "joint", "gazebo") else []
        for element in [child] if child.tag == "sensor" else inner:
            parent, words = element.find("parent"), (element.get("type", ""), *(part.tag for part in element))
            kind = next((_TYPES[word] for word in words if word in _TYPES), None)
            place = at if parent is None else parent.get("link") or parent.get("joint", at)
            if kind and place:
                yield _SensorElement(element, element.get("name", "") or f"{place} {kind}", kind, place)
    for element in root.iterfind("ros2_control/sensor"):
        states = [state.get("name", "").partition(".")[0] for state in element.findall("state_interface")]
        kind = next((_STATES[state] for state in states if state in _STATES), None)
        frame = element.findtext("param[@name='frame_id']")
        if kind and frame:
            yield _SensorElement(element, element.get("name", ""), kind, frame.strip())


def _read(reader: Reader, source: _SensorElement, name: str) -> Sensor:
    element, path = source.element, f"sensor {source.name}"
    reader.used.add(element)
    reader.expect(element, path, ("name", "type", "update_rate"), moves=False)
    for child in element:
        words = child.get("name", "")
        is_state = child.tag == "state_interface" and _STATES.get(words.partition(".")[0]) == source.kind
        if is_state or child.tag == "parent" or (child.tag == "param" and words == "frame_id"):
            reader.used.add(child)
    rate = reader.number(element, ("update_rate", "@update_rate"), path, "bad-sensor")
    sensor = Sensor(name, source.kind, source.at, _read_origin(reader, source, path), rate or 0.0)
    if source.kind == "camera":
        return msgspec.structs.replace(sensor, camera=Camera(**_read_fields(reader, element, path, _CAMERA)))
    if source.kind == "lidar":
        return msgspec.structs.replace(sensor, lidar=Lidar(**_read_fields(reader, element, path, _LIDAR)))
    return _read_wrench(reader, element, path, sensor) if source.kind == "force_torque" else sensor


def _read_origin(reader: Reader, source: _SensorElement, path: str) -> Origin:
    """Return the frame of a sensor in its link: the `<origin>` of URDF, or the `<pose>` of Gazebo."""
    pose, origin = reader.find(source.element, "pose"), reader.find(source.element, "origin")
    if origin is not None:
        return reader.read(origin, f"{path} / origin", Origin, path)
    numbers = reader.numbers(source.element, ("pose",), path, "bad-sensor", 6)
    if pose is None or numbers is None:
        return Origin()
    if (other := pose.get("relative_to")) and other != source.at:
        message = f"{path}: its pose is read in the frame of {source.at!r}, not of {other!r}"
        reader.add(pose, "bad-sensor", message, f"give the pose in the frame of {source.at!r}")
    turn = math.radians(1) if pose.get("degrees", "").strip().lower() in ("true", "1") else 1.0
    x, y, z, roll, pitch, yaw = numbers
    return Origin((x, y, z), (roll * turn, pitch * turn, yaw * turn))


def _read_fields(reader: Reader, element: Element, path: str, places: Mapping[str, Sequence[str]]) -> dict[str, float]:
    """Return the numbers of a camera or laser scanner; missing numbers are 0."""
    part = next((child for child in element if child.tag in _PARTS), element)
    reader.used.add(part)
    values = dict[str, float]()
    for field, ways in places.items():
        value = reader.number(part, ways, path, "bad-sensor") or 0.0
        if field in _COUNTS and not (value.is_integer() and 0 <= value <= _LARGEST_INTEGER):
            message = f"{path}: {field.replace('_', ' ')} {value:g} is no whole number, or too large"
            reader.add(part, "bad-sensor", message)
            continue
        values[field] = value
    return values


def _read_wrench(reader: Reader, element: Element, path: str, sensor: Sensor) -> Sensor:
    """Return a force-torque sensor with the axes and the direction of its values."""
    words = []
    for tags, choices in (("force_torque/frame", _FRAMES), ("force_torque/measure_direction", _DIRECTIONS)):
        part = reader.find(element, tags)
        word = ((part.text if part is not None else "") or "").strip() or choices[0]
        if word not in choices:
            message = f"{path}: {quoted(word)} is none of {', '.join(choices)}: the {choices[0]} counts"
            reader.add(element, "bad-sensor", message)
        words.append(word)
    frame, direction = words
    origin = sensor.origin if frame == "sensor" else Origin()
    return msgspec.structs.replace(
        sensor, origin=origin, in_parent=frame == "parent", on_child=direction == "parent_to_child"
    )
