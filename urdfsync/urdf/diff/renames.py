"""Finds the features that identify renamed links, joints, loops and shapes, and renames elements of a robot."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from msgspec import to_builtins
from msgspec.structs import replace

from urdfsync.domain import ElementKey, Features, Numbered, Version, displaced, plain
from urdfsync.urdf.drives import can_be_driven, passive_joints
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.robot import SENSOR_KINDS, STATED_ELSEWHERE, Collision, Link, Mesh, Robot, Visual

_Said: TypeAlias = tuple[Any, Mapping[str, str]]
"""An element and further facts about the element."""
_KINDS = ("links", "joints", "sensors", "loops")
_NAMES = frozenset({"name", "parent", "child"})
_ENDS = {"parent": "link", "child": "link", "joint": "joint"}
"""Fields that name another element, with the kind of this element."""
_MENTIONING = ("mimic", "transmission")
_LEFT_OUT = frozenset({"name", "actuated", "measured"})
_PLACE = frozenset({"type", "kind", "origin", "child_origin", "axis", "child_axis"})


def find_features(snapshot: Robot) -> Mapping[ElementKey, Features]:
    """Return contents and neighbours of links, joints and loops.

    In a model that git has merged, a joint may name a missing link.
    """
    features = dict[ElementKey, Features]()
    leading = {joint.child: joint.name for joint in snapshot.joints}
    for link in snapshot.links:
        shapes: tuple[Visual | Collision, ...] = (*link.visuals, *link.collisions)
        contents = {"mass": to_builtins(link.inertial), "contact": to_builtins(link.contact)}
        contents["shape"] = [_without_names(to_builtins(shape)) for shape in shapes]
        contents = {aspect: content for aspect, content in contents.items() if content}
        files = tuple(shape.geometry.filename for shape in shapes if isinstance(shape.geometry, Mesh))
        neighbours = {"joint": ("joint", leading[link.name])} if link.name in leading else {}
        features["link", link.name] = Features(contents, neighbours, files)
    for kind, elements in (("joint", snapshot.joints), ("loop", snapshot.loops)):
        for element in elements:
            data = {key: value for key, value in to_builtins(element).items() if value is not None}
            contents = {"position": {key: value for key, value in data.items() if key in _PLACE}}
            more = {key: _without_names(data[key]) for key in data.keys() - _PLACE - _NAMES - STATED_ELSEWHERE}
            contents |= {"limits": more} if more else {}
            ends: dict[str, ElementKey] = {"child": ("link", element.child), "parent": ("link", element.parent)}
            existing = {relation: end for relation, end in ends.items() if end in features}
            features[kind, element.name] = Features(contents, existing)
    return features


def find_shapes(old: Version, new: Version) -> tuple[Numbered, Numbered]:
    """Return the shapes of the links of two versions.

    A mesh of both versions is known by its contents, since exporters number files, too. Other meshes have their names.
    """
    hashes = [{name: file.source_hash for name, file in (version.imports or {}).items()} for version in (old, new)]
    shared = set(hashes[0].values()) & set(hashes[1].values())
    found = list[Numbered]()
    for version, files in zip((old, new), hashes, strict=True):
        known = {name: sha256 for name, sha256 in files.items() if sha256 in shared}
        found.append({("link", link.name): dict(_shapes(link, known)) for link in version.snapshot.links})
    return found[0], found[1]


def _shapes(link: Link, meshes: Mapping[str, str]) -> Iterator[tuple[str, tuple[ElementKey, Features]]]:
    """Yield the shapes of a link; a contact with the ground goes with its collision. `meshes` has hashes of files."""
    kinds: Mapping[str, Sequence[Visual | Collision]] = {
        "visual": link.visuals,
        "collision": link.collisions,
        "contact": link.collisions,
    }
    for kind, shapes in kinds.items():
        names = Counter(shape.name for shape in shapes)
        for number, shape in enumerate(shapes, 1):
            contents = _without_names(to_builtins(shape))
            if isinstance(shape.geometry, Mesh):
                contents["file"] = meshes.get(lookup.key(shape.geometry), shape.geometry.filename)
            name = shape.name if names[shape.name] == 1 and shape.name else f"#{number}"
            yield f"{kind}{number}", ((kind, name), Features(contents, {}))


def _without_names(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_names(item) for key, item in value.items() if key not in ("name", "joint", "filename")}
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
