"""Robot to snapshot and back: the model as plain data that JSON keeps, and that reads well as a diff.

    {"name": …,
     "links": {name: {"inertial": {…}, "visuals": [{…}], "collisions": [{…}]}},
     "joints": {name: {"type": …, "parent": …, "child": …, "origin": {"xyz": […], "rpy": […]}, …}},
     "extensions": {owner: {tag: [text, …]}}}

Elements are sorted by name, so their order in the file makes no difference; visuals and collisions keep theirs.
What the model does not have (no inertial, no limit, no colour) is left out, so that its coming and going is one
block of a diff; every number is there, defaults too, so that a change of a number is one changed line.
"""

from __future__ import annotations

from typing import Any

import msgspec

from urdfsync.domain import Snapshot
from urdfsync.urdf.robot import Robot

_NESTED = (dict, list, tuple)


def to_snapshot(robot: Robot) -> Snapshot:
    """The robot as plain data; the names of its links, and of its joints, must be unique."""
    plain = _without_absent(msgspec.to_builtins(robot, builtin_types=(), str_keys=True))
    extensions: dict[str, dict[str, list[str]]] = {}
    for extension in sorted(robot.extensions, key=msgspec.structs.astuple):
        extensions.setdefault(extension.owner, {}).setdefault(extension.tag, []).append(extension.text)
    return {
        "name": robot.name,
        "links": _by_name(plain["links"]),
        "joints": _by_name(plain["joints"]),
        "extensions": extensions,
    }


def from_snapshot(snapshot: Snapshot) -> Robot:
    """The robot of a snapshot, its elements sorted by name: the inverse of `to_snapshot`.

    Raises ValueError (msgspec.ValidationError) or KeyError for data that is no snapshot of a robot.
    """
    extensions = [
        {"owner": owner, "tag": tag, "text": text}
        for owner, tags in snapshot["extensions"].items()
        for tag, texts in tags.items()
        for text in texts
    ]
    plain = {
        "name": snapshot["name"],
        "links": [{"name": name, **link} for name, link in snapshot["links"].items()],
        "joints": [{"name": name, **joint} for name, joint in snapshot["joints"].items()],
        "extensions": extensions,
    }
    return msgspec.convert(plain, Robot)


def _without_absent(value: Any) -> Any:
    """The value without mapping entries that are None, and with lists instead of tuples."""
    if isinstance(value, dict):
        return {
            key: _without_absent(item) if isinstance(item, _NESTED) else item
            for key, item in value.items()
            if item is not None
        }
    if isinstance(value, _NESTED):
        return [_without_absent(item) if isinstance(item, _NESTED) else item for item in value]
    return value


def _by_name(elements: list[dict[str, Any]]) -> dict[str, Any]:
    """The elements keyed by their names, sorted."""
    return {element.pop("name"): element for element in sorted(elements, key=lambda element: str(element["name"]))}
