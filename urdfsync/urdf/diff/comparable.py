"""Snapshots as they are compared: under the new names, with drives, extensions keyed by what they are about."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from urdfsync.domain import ElementKey, Snapshot, displaced
from urdfsync.urdf.drives import can_be_driven, passive_joints
from urdfsync.urdf.snapshot import joints_of


def comparable(snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
    """Return the snapshot with those links and joints renamed wherever it mentions them, and extensions keyed.

    Each joint that can be driven has an entry `drive` in the place of `actuated`: `driven` or `passive`, as the source
    has it. One transmission more or less can change it for joints that it does not name.
    """
    links, joints, extensions = snapshot["links"], snapshot["joints"], snapshot["extensions"]
    if renames:
        gone = displaced(renames)
        links = {renames.get(("link", name), name): link for name, link in links.items() if ("link", name) not in gone}
        joints = {
            renames.get(("joint", name), name): _joint(joint, renames)
            for name, joint in joints.items()
            if ("joint", name) not in gone
        }
        extensions = {}
        for owner, tags in snapshot["extensions"].items():
            kind, _, name = owner.partition(" ")
            if (kind, name) not in gone:
                extensions[f"{kind} {renames[kind, name]}" if (kind, name) in renames else owner] = tags
    sensors = snapshot.get("sensors", {})
    if renames:
        sensors = {
            name: {
                **sensor,
                "at": renames.get(
                    ("joint" if sensor["kind"] == "force_torque" else "link", sensor["at"]), sensor["at"]
                ),
            }
            for name, sensor in sensors.items()
        }
    robot = joints_of(joints)
    passive = passive_joints(robot)
    drives = {
        joint.name: {"drive": "passive" if joint.name in passive else "driven"}
        for joint in robot
        if can_be_driven(joint)
    }
    return {
        "name": snapshot["name"],
        "links": links,
        "joints": {
            name: {key: value for key, value in joint.items() if key != "actuated"} | drives.get(name, {})
            for name, joint in joints.items()
        },
        "sensors": sensors,
        "extensions": {owner: _keyed(tags) for owner, tags in extensions.items()},
    }


def _joint(joint: Mapping[str, Any], renames: Mapping[ElementKey, str]) -> Mapping[str, Any]:
    ends = {end: renames.get(("link", joint[end]), joint[end]) for end in ("parent", "child")}
    if mimic := joint.get("mimic"):
        ends["mimic"] = {**mimic, "joint": renames.get(("joint", mimic["joint"]), mimic["joint"])}
    return {**joint, **ends}


def _keyed(tags: Mapping[str, Sequence[str]]) -> Mapping[str, str]:
    """Texts of extensions by `tag name`, with a number from 2 on where that is not enough."""
    result: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for tag, texts in tags.items():
        for text in texts:
            # the name in the first tag; in canonical XML the value of an attribute has no quotes
            subject = re.match(r'<[^>]*?\s(?:name|reference)="([^"]*)"', text)
            label = f"{tag} {subject[1]}" if subject else tag
            counts[label] += 1
            result[label if counts[label] == 1 else f"{label} ({counts[label]})"] = text
    return result
