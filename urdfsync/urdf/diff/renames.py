"""Links and joints that have another name and nothing else.

Elements of one name are the same element, whatever else changed. What is only in the old version is matched with what
is only in the new one from the root down: a link through the joint that leads to it, a joint through its parent link,
its numbers and its child link. A match has to be the only one among the joints of its parent: of two legs of one kind
that both have other names, none is matched.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import Any

from urdfsync.domain import ElementKey, Snapshot

_NAMES = frozenset({"name", "parent", "child", "joint", "actuated"})
"""Entries of the snapshot, in any block, that are names, or follow from names elsewhere (a transmission that names the
joint): not part of what makes elements alike."""


def find_renames(old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
    """Return the new names of links and joints that were renamed, and are otherwise the same in the same place."""
    links, joints = (old[part].keys() & new[part].keys() for part in ("links", "joints"))
    if not (old["links"].keys() - links and new["links"].keys() - links) and not (
        old["joints"].keys() - joints and new["joints"].keys() - joints
    ):
        return {}
    before, after = _joints_by_parent(old), _joints_by_parent(new)
    renames: dict[ElementKey, str] = {}
    places = [(name, name) for name in old["links"] if name in links]  # links that are in the same place
    places.append((_root(old), _root(new)))
    for one, other in places:  # grows while it is walked
        if one != other:
            if one in links or other in links or _frozen(old["links"][one]) != _frozen(new["links"][other]):
                continue
            renames["link", one] = other
        matches = {name: name for name in joints.intersection(before[one], after[other])}
        gone = [name for name in before[one] if name not in joints]
        came = [name for name in after[other] if name not in joints]
        if gone and came:
            alike: defaultdict[Hashable, tuple[list[str], list[str]]] = defaultdict(lambda: ([], []))
            for name in gone:
                alike[_likeness(old, name, links, joints)][0].append(name)
            for name in came:
                alike[_likeness(new, name, links, joints)][1].append(name)
            for ones, others in alike.values():
                if len(ones) == len(others) == 1:
                    renames["joint", ones[0]] = others[0]
                    matches[ones[0]] = others[0]
        for name, match in matches.items():
            ends = old["joints"][name]["child"], new["joints"][match]["child"]
            places += [ends] if ends[0] != ends[1] else []
    _drop_wrongly_led(renames, old, new)
    return dict(sorted(renames.items(), key=lambda rename: (rename[0][0] != "link", rename[0][1])))


def _joints_by_parent(snapshot: Snapshot) -> Mapping[str, Sequence[str]]:
    joints: defaultdict[str, list[str]] = defaultdict(list)
    for name, joint in snapshot["joints"].items():
        joints[joint["parent"]].append(name)
    return joints


def _root(snapshot: Snapshot) -> str:
    (root,) = snapshot["links"].keys() - {joint["child"] for joint in snapshot["joints"].values()}
    return str(root)


def _likeness(snapshot: Snapshot, name: str, links: AbstractSet[str], joints: AbstractSet[str]) -> Hashable:
    """Return what a joint shares with its match: numbers and type, the joint that it follows, its child link.

    `links` and `joints` are the names in both versions.
    """
    joint = snapshot["joints"][name]
    child, leader = joint["child"], None
    if "mimic" in joint:  # a leader that has another name may have been renamed as well: `_drop_wrongly_led` sees to it
        leader = joint["mimic"]["joint"] if joint["mimic"]["joint"] in joints else ""
    return _frozen(joint), leader, child if child in links else _frozen(snapshot["links"][child])


def _drop_wrongly_led(renames: dict[ElementKey, str], old: Snapshot, new: Snapshot) -> None:
    """Take back joints that follow another joint than before; and so on with those that follow them."""
    leaders = {
        name: (old["joints"][name]["mimic"]["joint"], new["joints"][match]["mimic"]["joint"])
        for (kind, name), match in renames.items()
        if kind == "joint" and "mimic" in old["joints"][name]
    }
    while wrong := [name for name, (one, other) in leaders.items() if renames.get(("joint", one), one) != other]:
        for name in wrong:
            del renames["joint", name], leaders[name]


def _frozen(value: Any) -> Hashable:
    """Return plain data as a key, equal where the data is, names aside."""
    if isinstance(value, Mapping):
        return tuple((key, _frozen(item)) for key, item in sorted(value.items()) if key not in _NAMES)
    return tuple(map(_frozen, value)) if isinstance(value, list) else value
