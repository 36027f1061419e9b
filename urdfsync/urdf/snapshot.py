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

import operator
from collections.abc import Iterable, Mapping
from itertools import compress
from typing import Any, TypeAlias

import msgspec

from urdfsync.domain import Parts, Snapshot
from urdfsync.urdf.kept import Kept
from urdfsync.urdf.robot import Extension, Joint, Link, Robot

_ENCODER = msgspec.json.Encoder(order="sorted")
_NULL = b"null"
_Element: TypeAlias = Link | Joint


def to_snapshot(robot: Robot, before: tuple[Robot, Snapshot] | None = None) -> Snapshot:
    """The robot as plain data, as it would come back from JSON; names of links, and of joints, must be unique.

    `before` is another robot with its snapshot: of links and joints that are the same objects, the data are so, too.
    """
    old, known = before or (Robot(""), {"extensions": {}, "joints": {}, "links": {}})
    return {
        "extensions": known["extensions"] if robot.extensions == old.extensions else _extensions(robot.extensions),
        "joints": _by_name(robot.joints, old.joints, known["joints"]),
        "links": _by_name(robot.links, old.links, known["links"]),
        "name": robot.name,
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
    kept = Kept(parts, "elements")
    links, joints = kept.each("links", _link, snapshot["links"]), kept.each("joints", _joint, snapshot["joints"])
    return msgspec.structs.replace(robot, links=tuple(links.values()), joints=tuple(joints.values()))


def joints_of(joints: Mapping[str, Any]) -> tuple[Joint, ...]:
    """The joints of a snapshot, in its order, given its entry `joints`. Raises ValueError for other data."""
    return tuple([_joint(name, joint) for name, joint in joints.items()])


def _link(name: str, link: Mapping[str, Any]) -> Link:
    return msgspec.convert({"name": name, **link}, Link)


def _joint(name: str, joint: Mapping[str, Any]) -> Joint:
    return msgspec.convert({"name": name, **joint}, Joint)


def _extensions(extensions: Iterable[Extension]) -> dict[str, dict[str, list[str]]]:
    """The texts of extensions by owner and tag, all sorted."""
    found: dict[str, dict[str, list[str]]] = {}
    for extension in sorted(extensions, key=msgspec.structs.astuple):
        found.setdefault(extension.owner, {}).setdefault(extension.tag, []).append(extension.text)
    return found


def _by_name(elements: tuple[_Element, ...], old: tuple[_Element, ...], known: Mapping[str, Any]) -> Mapping[str, Any]:
    """The data of the elements by their names, sorted; `known` are those of the old ones."""
    others = list(map(operator.is_not, elements, old))
    new, gone = list(compress(elements, others)), compress(old, others)
    if len(elements) == len(old) and [element.name for element in new] == [element.name for element in gone]:
        return {**known, **{element.name: _plain(element) for element in new}} if new else known
    objects = {element.name: element for element in old}
    return {
        element.name: known[element.name] if objects.get(element.name) is element else _plain(element)
        for element in sorted(elements, key=lambda element: element.name)
    }


def _plain(element: _Element) -> dict[str, Any]:
    """The data of one element, without its name and without what it does not have."""
    text = _ENCODER.encode(element)
    plain: dict[str, Any] = msgspec.json.decode(text)
    del plain["name"]
    if plain.get("actuated") is False:
        del plain["actuated"]
    if _NULL in text:
        _drop_absent(plain)
    return plain


def _drop_absent(plain: dict[str, Any]) -> None:
    """Take out what is None, at every level."""
    for key in [key for key, value in plain.items() if value is None]:
        del plain[key]
    for value in plain.values():
        if type(value) is dict:
            _drop_absent(value)
        elif type(value) is list and value and type(value[0]) is dict:
            for below in value:
                _drop_absent(below)
