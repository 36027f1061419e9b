"""Features by which links, joints and loops are found again, and snapshots under new names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from urdfsync.domain import ElementKey, Features, Snapshot, displaced
from urdfsync.urdf.drives import can_be_driven, passive_joints
from urdfsync.urdf.snapshot import joints_of

_NAMES = frozenset({"parent", "child", "joint", "actuated", "measured", "drive", "transmission", "command", "start"})
"""Entries of joints and loops that are names, or follow from names, such as in the configuration."""
_PLACE = frozenset({"type", "kind", "origin", "child_origin", "axis", "child_axis"})


def find_features(snapshot: Snapshot) -> Mapping[ElementKey, Features]:
    """Return contents and neighbours of links, joints and loops."""
    features = dict[ElementKey, Features]()
    leading = {joint["child"]: name for name, joint in snapshot["joints"].items()}
    for name, link in snapshot["links"].items():
        contents = {word: link[key] for key, word in (("inertial", "mass"), ("contact", "contact")) if key in link}
        shapes = [shape for kind in ("visuals", "collisions") for shape in link[kind]]
        if shapes:
            contents["shape"] = [_without_names(shape) for shape in shapes]
        files = tuple(shape["geometry"]["filename"] for shape in shapes if "filename" in shape["geometry"])
        neighbours = {"joint": ("joint", leading[name])} if name in leading else {}
        features["link", name] = Features(contents, neighbours, files)
    for kind in ("joint", "loop"):
        for name, joint in snapshot.get(f"{kind}s", {}).items():
            contents = {"position": {key: value for key, value in joint.items() if key in _PLACE}}
            more = {key: _without_names(joint[key]) for key in joint.keys() - _PLACE - _NAMES}
            contents |= {"limits": more} if more else {}
            features[kind, name] = Features(contents, {end: ("link", joint[end]) for end in ("child", "parent")})
    return features


def _without_names(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _without_names(item) for key, item in value.items() if key not in ("name", "joint", "filename")}
    return value


def comparable(snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
    """Return the snapshot with these links, joints and loops renamed everywhere, and extensions keyed.

    Each joint that can be driven has an entry `drive` in place of `actuated` and `measured`: `driven` or `passive`, by
    the source. A transmission can change it for joints that the transmission does not name.
    """
    displaced_elements = displaced(renames)

    def renamed(kind: str, name: str) -> str:
        return renames.get((kind, name), name)

    links = {
        renamed("link", name): link
        for name, link in snapshot["links"].items()
        if ("link", name) not in displaced_elements
    }
    joints = {}
    for name, joint in snapshot["joints"].items():
        if ("joint", name) in displaced_elements:
            continue
        joint = {key: value for key, value in joint.items() if key not in ("actuated", "measured")}
        if renames:
            joint |= {end: renamed("link", joint[end]) for end in ("parent", "child")}
            if mimic := joint.get("mimic"):
                joint["mimic"] = {**mimic, "joint": renamed("joint", mimic["joint"])}
        joints[renamed("joint", name)] = joint
    all_joints = joints_of(snapshot["joints"])
    passive = passive_joints(all_joints)
    for drivable in filter(can_be_driven, all_joints):
        name = drivable.name
        if ("joint", name) not in displaced_elements:
            joints[renamed("joint", name)]["drive"] = "passive" if name in passive else "driven"
    extensions = {}
    for owner, tags in snapshot["extensions"].items():
        kind, _, name = owner.partition(" ")
        if (kind, name) not in displaced_elements:
            extensions[f"{kind} {renamed(kind, name)}" if name else owner] = _keyed(tags)
    sensors = {
        name: {**sensor, "at": renamed("joint" if sensor["kind"] == "force_torque" else "link", sensor["at"])}
        for name, sensor in snapshot.get("sensors", {}).items()
    }
    loops = {
        renamed("loop", name): {**loop, **{end: renamed("link", loop[end]) for end in ("parent", "child")}}
        for name, loop in snapshot.get("loops", {}).items()
        if ("loop", name) not in displaced_elements
    }
    others = {"sensors": sensors, "loops": loops, "extensions": extensions}
    return {"name": snapshot["name"], "links": links, "joints": joints, **others}


def _keyed(tags: Mapping[str, Sequence[str]]) -> Mapping[str, Any]:
    """Return texts of extensions by `tag name`, with a number from 2 on for repeated keys."""
    result: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for tag, texts in tags.items():
        for text in texts:
            # the name in the first tag; in canonical XML the value of an attribute has no quotes
            subject = re.match(r'<[^>]*?\sname="([^"]*)"', text)
            label = f"{tag} {subject[1]}" if subject else tag
            counts[label] += 1
            result[label if counts[label] == 1 else f"{label} ({counts[label]})"] = text
    return result
