"""Turns a robot into a snapshot and back: plain data that JSON keeps, and that gives readable diffs.

    {"name": …,
     "links": {name: {"inertial": {…}, "visuals": [{…}], "collisions": [{…}]}},
     "joints": {name: {"type": …, "parent": …, "child": …, "origin": {"xyz": […], "rpy": […]}, …}},
     "extensions": {owner: {tag: [text, …]}},
     "sensors": {name: {"kind": …, "at": …, "origin": {…}, …}},   if there are any
     "loops": {name: {"kind": …, "parent": …, "child": …, "origin": {…}, "child_origin": {…}, …}}}   if there are any

Elements are sorted by name, so their order in the file makes no difference; visuals and collisions keep theirs. A
missing part is left out: inertial, limit, colour, drive. So a diff shows an added or removed part as one block. Every
number is written, even a default, so that its change is one changed line.
"""

from __future__ import annotations

import operator
from collections.abc import Mapping
from typing import Any

import msgspec

from urdfsync.domain import Snapshot
from urdfsync.urdf.robot import Joint, Link, Loop, Robot, Sensor


def to_snapshot(robot: Robot) -> Snapshot:
    """Return the robot as plain data of JSON's types; names of links, and of joints, are unique."""
    extensions: dict[str, dict[str, list[str]]] = {}
    for extension in sorted(robot.extensions, key=msgspec.structs.astuple):
        extensions.setdefault(extension.owner, {}).setdefault(extension.tag, []).append(extension.text)
    by_name = operator.attrgetter("name")
    joints = {joint.name: _plain(joint) for joint in sorted(robot.joints, key=by_name)}
    links = {link.name: _plain(link) for link in sorted(robot.links, key=by_name)}
    snapshot = {"extensions": extensions, "joints": joints, "links": links, "name": robot.name}
    if robot.sensors:
        snapshot["sensors"] = {sensor.name: _plain(sensor) for sensor in sorted(robot.sensors, key=by_name)}
    if robot.loops:
        snapshot["loops"] = {loop.name: _plain(loop) for loop in sorted(robot.loops, key=by_name)}
    return snapshot


def _plain(element: Link | Joint | Sensor | Loop) -> Mapping[str, Any]:
    """Return an element as plain data, without its name."""
    data = _without_none(msgspec.json.decode(msgspec.json.encode(element, order="sorted")))
    del data["name"]
    for key, default in (("actuated", False), ("measured", False), ("command", "position")):
        if data.get(key) == default:
            del data[key]
    return data


def _without_none(data: dict[str, Any]) -> dict[str, Any]:
    """Return a struct's data without fields that are None; lists are of numbers, or of structs."""
    fields: dict[str, Any] = {}
    for key, item in data.items():
        if isinstance(item, dict):
            fields[key] = _without_none(item)
        elif item and isinstance(item, list) and isinstance(item[0], dict):
            fields[key] = [_without_none(struct) for struct in item]
        elif item is not None:
            fields[key] = item
    return fields


def from_snapshot(snapshot: Snapshot) -> Robot:
    """Return the robot of a snapshot, its elements sorted by name: the inverse of `to_snapshot`.

    Raises ValueError (msgspec.ValidationError) or KeyError for data that is no snapshot of a robot.
    """
    extensions = [
        {"owner": owner, "tag": tag, "text": text}
        for owner, tags in snapshot["extensions"].items()
        for tag, texts in tags.items()
        for text in texts
    ]
    elements = {
        kind: [{"name": name, **element} for name, element in snapshot.get(kind, {}).items()]
        for kind in ("links", "joints", "sensors", "loops")
    }
    return msgspec.convert({"name": snapshot["name"], "extensions": extensions, **elements}, Robot)


def joints_of(joints: Mapping[str, Any]) -> tuple[Joint, ...]:
    """Return the joints of a snapshot, in its order, given its entry `joints`. Raises ValueError for other data."""
    return msgspec.convert([{"name": name, **joint} for name, joint in joints.items()], tuple[Joint, ...])
