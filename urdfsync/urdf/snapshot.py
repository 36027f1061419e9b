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

from collections.abc import Mapping
from functools import partial
from typing import Any

import msgspec

from urdfsync.domain import Parts, Snapshot
from urdfsync.urdf.kept import Kept
from urdfsync.urdf.robot import Joint, Link, Robot

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


def from_snapshot(snapshot: Snapshot, parts: Parts | None = None) -> Robot:
    """The robot of a snapshot, its elements sorted by name: the inverse of `to_snapshot`.

    With `parts` of the last call, elements that are the same objects as then give the same links and joints. Raises
    ValueError (msgspec.ValidationError) or KeyError for data that is no snapshot of a robot.
    """
    extensions = [
        {"owner": owner, "tag": tag, "text": text}
        for owner, tags in snapshot["extensions"].items()
        for tag, texts in tags.items()
        for text in texts
    ]
    robot = msgspec.convert({"name": snapshot["name"], "extensions": extensions}, Robot)
    links, joints = Kept(parts, "links"), Kept(parts, "joints")
    return msgspec.structs.replace(
        robot,
        links=tuple([links.get(name, partial(_link, name), link) for name, link in snapshot["links"].items()]),
        joints=tuple([joints.get(name, partial(_joint, name), joint) for name, joint in snapshot["joints"].items()]),
    )


def _link(name: str, link: Mapping[str, Any]) -> Link:
    return msgspec.convert({"name": name, **link}, Link)


def _joint(name: str, joint: Mapping[str, Any]) -> Joint:
    return msgspec.convert({"name": name, **joint}, Joint)


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
