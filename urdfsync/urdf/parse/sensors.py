"""Read the `<sensor>` elements of URDF, of gazebo blocks and of ros2_control that the package models."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element

import msgspec

from urdfsync.urdf.parse.fields import Reader, parse_numbers, quoted
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
    reader.modelled.add(element)
    if element.get("type") == found.kind:
        del element.attrib["type"]
    for child in element:
        words = child.get("name", "")
        is_frame = child.tag == "param" and words == "frame_id"
        is_state = child.tag == "state_interface" and _STATES.get(words.partition(".")[0]) == found.kind
        if child.tag == "parent" or is_frame or is_state:
            reader.show(child, "link" if child.tag == "parent" else "name")

    def numbers(part: Element, places: Sequence[str], count: int = 1) -> tuple[float, ...] | None:
        for place in places:
            where, _, attribute = place.partition("@")
            holder = part.find(where) if where else part
            text = None if holder is None else holder.get(attribute) if attribute else holder.text
            if holder is None or text is None:
                continue
            try:
                values = parse_numbers(text, count)
            except ValueError as error:
                reader.add(holder, "bad-sensor", f"{path}: <{holder.tag}> {quoted(text.strip())} {error}")
                continue
            while where:
                reader.modelled.update(part.findall(where))
                where = where.rpartition("/")[0]
            holder.attrib.pop(attribute, None)
            return values
        return None

    def fields(places: Mapping[str, Sequence[str]], tags: Sequence[str]) -> dict[str, float]:
        part = next((child for child in element if child.tag in tags), element)
        reader.modelled.add(part)
        values = {field: value[0] for field, ways in places.items() if (value := numbers(part, ways))}
        for field in values.keys() & _COUNTS:
            if not (values[field].is_integer() and 0 <= values[field] <= _LARGEST_INTEGER):
                message = f"{path}: {field.replace('_', ' ')} {values.pop(field):g} is no number of things"
                reader.add(part, "bad-sensor", message)
        return values

    pose, place, force = element.find("pose"), element.find("origin"), element.find("force_torque")
    origin = Origin()
    if pose is not None and (values := numbers(element, ("pose",), 6)):
        turn = math.radians(1) if pose.get("degrees", "").strip().lower() in ("true", "1") else 1.0
        origin = Origin((values[0], values[1], values[2]), (values[3] * turn, values[4] * turn, values[5] * turn))
        if (other := pose.get("relative_to")) and other != found.at:
            message = f"{path}: its pose counts from {found.at!r}, and not from {other!r}"
            reader.add(pose, "bad-sensor", message, f"give its pose in the frame of {found.at!r}")
        reader.show(pose, "degrees", "relative_to")
    if place is not None:
        origin = reader.read(place, f"{path} / origin", Origin)
        reader.show(place, *place.keys())  # the others are told already
    rate = numbers(element, ("update_rate", "@update_rate"))
    sensor = Sensor(name, found.kind, found.at, origin, rate[0] if rate else 0.0)
    match found.kind:
        case "camera":
            return msgspec.structs.replace(sensor, camera=Camera(**fields(_CAMERA, ("camera",))))
        case "lidar":
            return msgspec.structs.replace(sensor, lidar=Lidar(**fields(_LIDAR, ("ray", "lidar"))))
        case "force_torque":
            parts = [] if force is None else [force, *force.findall("frame"), *force.findall("measure_direction")]
            reader.modelled.update(parts)
            said = {part.tag: (part.text or "").strip() for part in reversed(parts)}
            frame, way = said.get("frame") or _FRAMES[0], said.get("measure_direction") or _DIRECTIONS[0]
            for text, known in ((frame, _FRAMES), (way, _DIRECTIONS)):
                if text not in known:
                    message = f"{path}: {quoted(text)} is none of {', '.join(known)}: the {known[0]} counts"
                    reader.add(element, "bad-sensor", message)
            if frame != "sensor":
                sensor = msgspec.structs.replace(sensor, origin=Origin())
            return msgspec.structs.replace(sensor, in_parent=frame == "parent", on_child=way == "parent_to_child")
    return sensor
