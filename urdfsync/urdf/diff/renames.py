"""Links and joints that have another name.

Elements of one name are the same element, whatever else changed. What is only in the old version is matched with what
is only in the new one, from the root down:

- The joints between the same two links are the same joint.
- A joint that leads to a link of another name is matched by its numbers and by all that this link has. It has to be the
  only such joint of its parent: of two legs of one kind that both have other names, none is matched.
- The link at the end of the same joint is the same link; a root is, if it has all that it had or one of its joints.
  Where more than the name changed, no other new link may have all that it had, and no other old link all that it has.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import Any

from urdfsync.domain import ElementKey, Snapshot

_NAMES = frozenset({"name", "parent", "child", "joint", "actuated", "drive", "transmission", "command"})
"""Entries of the snapshot, in any block, that are names, or follow from names elsewhere (a transmission that names the
joint): not part of what makes elements alike."""


def find_renames(old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
    """Return the new names of links and joints that were renamed."""
    links, joints = (old[part].keys() & new[part].keys() for part in ("links", "joints"))
    if not (old["links"].keys() - links and new["links"].keys() - links) and not (
        old["joints"].keys() - joints and new["joints"].keys() - joints
    ):
        return {}
    before, after = _joints_by_parent(old), _joints_by_parent(new)
    was = {name: _frozen(link) for name, link in old["links"].items() if name not in links}
    looks = {name: _frozen(link) for name, link in new["links"].items() if name not in links}
    all_were, all_look = set(was.values()), set(looks.values())
    renames: dict[ElementKey, str] = {}
    places = [(name, name) for name in old["links"] if name in links]  # links that are in the same place
    root, new_root = _root(old), _root(new)
    if was.get(root) == looks.get(new_root) or joints.intersection(before[root], after[new_root]):
        places.append((root, new_root))
    for one, other in places:  # grows while it is walked
        if one != other:
            if one in links or other in links:
                continue
            if was[one] != looks[other] and (was[one] in all_look or looks[other] in all_were):
                continue
            renames["link", one] = other
        matches = {name: name for name in joints.intersection(before[one], after[other])}
        gone = [name for name in before[one] if name not in joints]
        came = [name for name in after[other] if name not in joints]
        if gone and came:
            alike: defaultdict[Hashable, tuple[list[str], list[str]]] = defaultdict(lambda: ([], []))
            for name in gone:
                alike[_likeness(old, name, links)][0].append(name)
            for name in came:
                alike[_likeness(new, name, links)][1].append(name)
            for ones, others in alike.values():
                if len(ones) == len(others) == 1:
                    renames["joint", ones[0]] = others[0]
                    matches[ones[0]] = others[0]
        for name, match in matches.items():
            ends = old["joints"][name]["child"], new["joints"][match]["child"]
            places += [ends] if ends[0] != ends[1] else []
    return dict(sorted(renames.items(), key=lambda rename: (rename[0][0] != "link", rename[0][1])))


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
