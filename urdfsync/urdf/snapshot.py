"""Robot to snapshot and back: the model as plain data that JSON keeps, and that reads well as a diff.

    {"name": …,
     "links": {name: {"inertial": {…}, "visuals": [{…}], "collisions": [{…}]}},
     "joints": {name: {"type": …, "parent": …, "child": …, "origin": {"xyz": […], "rpy": […]}, …}},
     "extensions": {owner: {tag: [text, …]}}}

Elements are sorted by name, so their order in the file makes no difference; visuals and collisions keep theirs.
What the model does not have (no inertial, no limit, no colour, no drive) is left out, so that its coming and going is
one block of a diff; every number is there, defaults too, so that a change of a number is one changed line.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from urdfsync.domain import Snapshot
from urdfsync.urdf.robot import Extension, Joint, Link, Robot

_ENCODER = msgspec.json.Encoder(order="sorted")


def to_snapshot(robot: Robot) -> Snapshot:
    """Return the robot as plain data, as it would come back from JSON; names of links, and of joints, are unique."""
    return {
        "extensions": _extensions(robot.extensions),
        "joints": _by_name(robot.joints),
        "links": _by_name(robot.links),
        "name": robot.name,
    }


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
    robot = msgspec.convert({"name": snapshot["name"], "extensions": extensions}, Robot)
    links = msgspec.convert([{"name": name, **link} for name, link in snapshot["links"].items()], tuple[Link, ...])
    return msgspec.structs.replace(robot, links=links, joints=joints_of(snapshot["joints"]))


def joints_of(joints: Mapping[str, Any]) -> tuple[Joint, ...]:
    """Return the joints of a snapshot, in its order, given its entry `joints`. Raises ValueError for other data."""
    return msgspec.convert([{"name": name, **joint} for name, joint in joints.items()], tuple[Joint, ...])


def _extensions(extensions: Iterable[Extension]) -> dict[str, dict[str, list[str]]]:
    """Return the texts of extensions by owner and tag, all sorted."""
    found: dict[str, dict[str, list[str]]] = {}
    for extension in sorted(extensions, key=msgspec.structs.astuple):
        found.setdefault(extension.owner, {}).setdefault(extension.tag, []).append(extension.text)
    return found


def _by_name(elements: Iterable[Link | Joint]) -> dict[str, Any]:
    """Return the data of the elements by their names, sorted."""
    found = {}
    for element in sorted(elements, key=lambda element: element.name):
        plain = msgspec.json.decode(_ENCODER.encode(element))
        del plain["name"]
        if plain.get("actuated") is False:
            del plain["actuated"]
        found[element.name] = _without_absent(plain)
    return found


def _without_absent(value: Any) -> Any:
    """Return plain data without None, at every level."""
    if isinstance(value, dict):
        return {key: _without_absent(item) for key, item in value.items() if item is not None}
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [_without_absent(item) for item in value]
    return value
