"""Snapshots as they are compared: under the new names, with drives, and with extensions keyed by their subjects."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from urdfsync.domain import ElementKey, Snapshot, displaced
from urdfsync.urdf.drives import can_be_driven, passive_joints
from urdfsync.urdf.snapshot import joints_of


def comparable(snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
    """Return the snapshot with those links, joints and loops renamed wherever it mentions them, and extensions keyed.

    Each joint that can be driven has an entry `drive` in place of `actuated` and `measured`: `driven` or `passive`, as
    the source has it. One transmission more or less can change it for joints that the transmission does not name.
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
    """Return texts of extensions by `tag name`, with a number from 2 on where that is not enough."""
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
