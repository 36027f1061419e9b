"""Links, joints and loops that have another name, and snapshots under the new names.

Elements of one name are the same element, whatever else changed. Those of the old version alone are matched with those
of the new one alone, from the root down:

- The joints between the same two links are the same joint.
- A joint that leads to a link of another name is matched by its numbers and by the data of this link. It has to be the
  only such joint of its parent: of two legs of one kind that both have other names, none is matched.
- The link at the end of the same joint is the same link; a root is, if it has all that it had or one of its joints.
  Where more than the name changed, no other new link may equal the old one, and no other old link the new one.
- The only loop between two links is the same loop.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Hashable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import Any

from urdfsync.domain import ElementKey, Snapshot, displaced
from urdfsync.urdf.drives import can_be_driven, passive_joints
from urdfsync.urdf.snapshot import joints_of

_NAMES = frozenset({"name", "parent", "child", "joint", "actuated", "measured", "drive", "transmission", "command"})
"""Entries of the snapshot, in any block, that do not make elements alike.

They are names, or follow from names elsewhere, such as that of the joint in a transmission.
"""


def find_renames(old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
    """Return the new names of links, joints and loops that were renamed."""
    links, joints = (old[part].keys() & new[part].keys() for part in ("links", "joints"))
    if not (old["links"].keys() - links and new["links"].keys() - links) and not (
        old["joints"].keys() - joints and new["joints"].keys() - joints
    ):
        return _renamed_loops(old, new, {})
    before, after = _joints_by_parent(old), _joints_by_parent(new)
    removed = {name: _frozen(link) for name, link in old["links"].items() if name not in links}
    added = {name: _frozen(link) for name, link in new["links"].items() if name not in links}
    all_removed, all_added = set(removed.values()), set(added.values())
    renames: dict[ElementKey, str] = {}
    places = [(name, name) for name in old["links"] if name in links]  # links that are in the same place
    root, new_root = _root(old), _root(new)
    if removed.get(root) == added.get(new_root) or joints.intersection(before[root], after[new_root]):
        places.append((root, new_root))
    for link, new_link in places:  # grows while it is walked
        if link != new_link:
            if link in links or new_link in links:
                continue
            is_alike = removed[link] == added[new_link]
            if not is_alike and (removed[link] in all_added or added[new_link] in all_removed):
                continue
            renames["link", link] = new_link
        matches = {name: name for name in joints.intersection(before[link], after[new_link])}
        alike: defaultdict[Hashable, tuple[list[str], list[str]]] = defaultdict(lambda: ([], []))
        for name in before[link]:
            if name not in joints:
                alike[_likeness(old, name, links)][0].append(name)
        for name in after[new_link]:
            if name not in joints:
                alike[_likeness(new, name, links)][1].append(name)
        for old_names, new_names in alike.values():
            if len(old_names) == len(new_names) == 1:
                renames["joint", old_names[0]] = matches[old_names[0]] = new_names[0]
        for name, match in matches.items():
            ends = old["joints"][name]["child"], new["joints"][match]["child"]
            places += [ends] if ends[0] != ends[1] else []
    renames |= _renamed_loops(old, new, renames)
    return dict(sorted(renames.items(), key=lambda rename: (rename[0][0] != "link", rename[0][1])))


def _renamed_loops(old: Snapshot, new: Snapshot, renames: Mapping[ElementKey, str]) -> Mapping[ElementKey, str]:
    """Return the new names of loops: of the only one of each version alone between the same two links."""
    before, after = old.get("loops", {}), new.get("loops", {})
    alike: defaultdict[Hashable, tuple[list[str], list[str]]] = defaultdict(lambda: ([], []))
    for name in before.keys() - after.keys():
        ends = [renames.get(("link", before[name][end]), before[name][end]) for end in ("parent", "child")]
        alike[frozenset(ends)][0].append(name)
    for name in after.keys() - before.keys():
        alike[frozenset(after[name][end] for end in ("parent", "child"))][1].append(name)
    pairs = [names for names in alike.values() if len(names[0]) == len(names[1]) == 1]
    return {("loop", olds[0]): news[0] for olds, news in sorted(pairs)}


def _joints_by_parent(snapshot: Snapshot) -> Mapping[str, Sequence[str]]:
    joints: defaultdict[str, list[str]] = defaultdict(list)
    for name, joint in snapshot["joints"].items():
        joints[joint["parent"]].append(name)
    return joints


def _root(snapshot: Snapshot) -> str:
    (root,) = snapshot["links"].keys() - {joint["child"] for joint in snapshot["joints"].values()}
    return str(root)


def _likeness(snapshot: Snapshot, name: str, links: AbstractSet[str]) -> Hashable:
    """Return what a joint shares with its match; `links` are those in both versions."""
    joint = snapshot["joints"][name]
    child = joint["child"]
    return child if child in links else (_frozen(joint), _frozen(snapshot["links"][child]))


def _frozen(value: Any) -> Hashable:
    """Return plain data as a key, equal where the data is, names aside."""
    if isinstance(value, Mapping):
        return tuple((key, _frozen(item)) for key, item in sorted(value.items()) if key not in _NAMES)
    return tuple(map(_frozen, value)) if isinstance(value, list) else value


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
