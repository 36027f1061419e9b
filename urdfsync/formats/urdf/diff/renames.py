"""Finds the features that identify renamed links, joints and loops, and renames elements of a robot."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from msgspec import to_builtins
from msgspec.structs import replace

from urdfsync.domain import ElementKey, Features, displaced, plain
from urdfsync.formats.urdf.drives import can_be_driven, passive_joints
from urdfsync.formats.urdf.robot import SENSOR_KINDS, STATED_ELSEWHERE, Collision, Link, Mesh, Robot, Visual, by_number

_Said: TypeAlias = tuple[Any, Mapping[str, str]]
"""An element and further facts about the element."""
_KINDS = ("links", "joints", "sensors", "loops")
_NAMES = frozenset({"name", "parent", "child"})
_NAMING = frozenset({"name", "joint", "filename", "number"})
_ENDS = {"parent": "link", "child": "link", "joint": "joint"}
"""Fields that name another element, with the kind of this element."""
_MENTIONING = ("mimic", "transmission")
_LEFT_OUT = frozenset({"name", "actuated", "measured"})
_PLACE = frozenset({"type", "kind", "origin", "child_origin", "axis", "child_axis"})


def find_features(snapshot: Robot) -> Mapping[ElementKey, Features]:
    """Return contents and neighbours of links, joints and loops.

    In a recorded model, which a stranger may have written, a joint may name a missing link.
    """
    features = dict[ElementKey, Features]()
    leading = {joint.child: joint.name for joint in snapshot.joints}
    for link in snapshot.links:
        shapes: tuple[Visual | Collision, ...] = (*link.visuals, *link.collisions)
        contents = {"mass": to_builtins(link.inertial), "contact": to_builtins(link.contact)}
        contents["shape"] = [without_names(to_builtins(shape)) for shape in shapes]
        contents = {aspect: content for aspect, content in contents.items() if content}
        files = tuple(shape.geometry.filename for shape in shapes if isinstance(shape.geometry, Mesh))
        neighbours = {"joint": ("joint", leading[link.name])} if link.name in leading else {}
        features["link", link.name] = Features(contents, neighbours, files)
    for kind, elements in (("joint", snapshot.joints), ("loop", snapshot.loops)):
        for element in elements:
            data = {key: value for key, value in to_builtins(element).items() if value is not None}
            contents = {"position": {key: value for key, value in data.items() if key in _PLACE}}
            more = {key: without_names(data[key]) for key in data.keys() - _PLACE - _NAMES - STATED_ELSEWHERE}
            contents |= {"limits": more} if more else {}
            ends: dict[str, ElementKey] = {"child": ("link", element.child), "parent": ("link", element.parent)}
            existing = {relation: end for relation, end in ends.items() if end in features}
            features[kind, element.name] = Features(contents, existing)
    return features


def without_names(value: Any) -> Any:
    """Return plain data without names, and without the numbers of shapes."""
    if isinstance(value, dict):
        return {key: without_names(item) for key, item in value.items() if key not in _NAMING}
    return value


def renamed(robot: Robot, renames: Mapping[ElementKey, str]) -> Robot:
    """Return the robot with renamed links, joints and loops, and without `displaced` elements."""
    gone = displaced(renames)

    def new(kind: str, name: str) -> str:
        return renames.get((kind, name), name)

    def mentioning(value: Any) -> Any:
        return replace(
            value, **{end: new(kind, getattr(value, end)) for end, kind in _ENDS.items() if hasattr(value, end)}
        )

    def under_new_names(kind: str, elements: Iterable[Any]) -> Iterator[Any]:
        for element in elements:
            if (kind, element.name) not in gone:
                yield replace(mentioning(element), name=new(kind, element.name))

    places = {place: place.partition(" ") for place in robot.extensions}
    kept = {place: (kind, name) for place, (kind, _, name) in places.items() if (kind, name) not in gone}
    return replace(
        robot,
        links=tuple(under_new_names("link", robot.links)),
        joints=tuple(
            replace(joint, **{part: mentioning(getattr(joint, part)) for part in _MENTIONING if getattr(joint, part)})
            for joint in under_new_names("joint", robot.joints)
        ),
        sensors=tuple(replace(one, at=new(SENSOR_KINDS[one.kind].at, one.at)) for one in robot.sensors),
        loops=tuple(under_new_names("loop", robot.loops)),
        extensions={
            f"{key[0]} {new(*key)}" if key[1] else place: robot.extensions[place] for place, key in kept.items()
        },
    )


def comparable(
    old: Robot, new: Robot, renames: Mapping[ElementKey, str]
) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Return the elements that differ between two robots, as plain data by kind and name; extensions have keys.

    Each joint that can be driven has an entry `drive` instead of `actuated` and `measured`: `driven` or `passive`, as
    the source says. A transmission can change this entry even of joints that it does not name.
    """
    before, after = _elements(old, renames), _elements(new, {})
    return {"name": old.name, **_differing(before, after)}, {"name": new.name, **_differing(after, before)}


def _elements(robot: Robot, renames: Mapping[ElementKey, str]) -> dict[tuple[str, str], _Said]:
    """Return the elements of a robot with further facts, by kind and new name."""
    passive, new = passive_joints(robot.joints), renamed(robot, renames) if renames else robot
    drives = {
        renames.get(("joint", joint.name), joint.name): {"drive": "passive" if joint.name in passive else "driven"}
        for joint in filter(can_be_driven, robot.joints)
    }
    elements: dict[tuple[str, str], _Said] = {
        (kind, element.name): (element, {}) for kind in _KINDS for element in getattr(new, kind)
    }
    elements |= {("joints", joint.name): (joint, drives.get(joint.name, {})) for joint in new.joints}
    return elements | {("extensions", owner): (None, _keyed(tags)) for owner, tags in new.extensions.items()}


def _differing(elements: Mapping[tuple[str, str], Any], others: Mapping[tuple[str, str], Any]) -> dict[str, Any]:
    parts: dict[str, dict[str, Any]] = {kind: {} for kind in (*_KINDS, "extensions")}
    for key, value in elements.items():
        if others.get(key) != value:
            data = {word: item for word, item in (plain(value[0]) or {}).items() if word not in _LEFT_OUT}
            for kind in ("visuals", "collisions") if isinstance(value[0], Link) else ():
                shapes = by_number(getattr(value[0], kind))
                data[kind] = {number: plain(replace(shape, number=None)) for number, shape in shapes.items()}
            parts[key[0]][key[1]] = data | value[1]
    return parts


def _keyed(tags: Mapping[str, Sequence[str]]) -> Mapping[str, Any]:
    """Return texts of extensions by `tag name`. Repeated keys are numbered from 2."""
    result: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for tag, texts in tags.items():
        for text in texts:
            # the name in the first tag; in canonical XML no attribute contains a quote
            subject = re.match(r'<[^>]*?\sname="([^"]*)"', text)
            label = f"{tag} {subject[1]}" if subject else tag
            counts[label] += 1
            result[label if counts[label] == 1 else f"{label} ({counts[label]})"] = text
    return result
