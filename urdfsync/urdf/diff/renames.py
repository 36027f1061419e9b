"""Links and joints that have another name and nothing else.

Elements of one name are the same element, whatever else changed. What is only in the old version is matched with what
is only in the new one from the root down: a link through the joint that leads to it, a joint through its parent link,
its numbers and its child link. A match has to be the only one among the joints of its parent; where several look the
same, what hangs on them decides, and if that is the same too, as with two legs of one kind, nothing is matched.
"""

from __future__ import annotations

import functools
from collections import Counter, defaultdict
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from urdfsync.domain import ElementKey, Snapshot

_NAMES = {"joint": ("parent", "child", "actuated"), "mimic": ("joint",), "material": ("name",), "shape": ("name",)}
"""Per block of the snapshot, the entries that are names, or follow from names elsewhere (a transmission that names the
joint): not part of what makes elements alike."""


def find_renames(old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
    """Return the new names of links and joints that were renamed, and are otherwise the same in the same place."""
    parts = ("links", "joints")
    if not any(old[part].keys() - new[part].keys() and new[part].keys() - old[part].keys() for part in parts):
        return {}
    links, joints = _Matching(old, new).run()
    return {("link", name): links[name] for name in sorted(links)} | {
        ("joint", name): joints[name] for name in sorted(joints)
    }


class _Tree:
    """One version's links and joints, and the joints that start at each link."""

    def __init__(self, snapshot: Snapshot) -> None:
        self.links: Mapping[str, Any] = snapshot["links"]
        self.joints: Mapping[str, Any] = snapshot["joints"]
        self.children: defaultdict[str, list[str]] = defaultdict(list)
        for name, joint in self.joints.items():
            self.children[joint["parent"]].append(name)

    def root(self) -> str:
        (root,) = self.links.keys() - {joint["child"] for joint in self.joints.values()}
        return root

    def depth_first(self) -> list[str]:
        """Return all joints, each after those above it."""
        order: list[str] = []
        stack = list(self.children[self.root()])
        while stack:
            order.append(stack.pop())
            stack += self.children[self.joints[order[-1]]["child"]]
        return order


class _Matching:
    """The search for one pair of versions; linear in their elements."""

    def __init__(self, old: Snapshot, new: Snapshot) -> None:
        self.old, self.new = _Tree(old), _Tree(new)
        self.common_links = self.old.links.keys() & self.new.links.keys()
        self.common_joints = self.old.joints.keys() & self.new.joints.keys()
        self.links: dict[str, str] = {}
        self.joints: dict[str, str] = {}

    def run(self) -> tuple[Mapping[str, str], Mapping[str, str]]:
        """Return the renamed links and joints."""
        pairs = [(name, name) for name in self.old.links if name in self.common_links]
        pairs += self._match_links(self.old.root(), self.new.root())
        for old, new in pairs:  # grows while it is walked
            for before, after in self._joints_between(old, new):
                pairs += self._match_links(self.old.joints[before]["child"], self.new.joints[after]["child"])
        self._drop_wrongly_led()
        return self.links, self.joints

    def _match_links(self, old: str, new: str) -> list[tuple[str, str]]:
        """Return the pair, if it is a renamed link."""
        if old in self.common_links or new in self.common_links:
            return []
        if _link(self.old.links[old]) != _link(self.new.links[new]):
            return []
        self.links[old] = new
        return [(old, new)]

    def _joints_between(self, old: str, new: str) -> list[tuple[str, str]]:
        """Return the joints that start at a link, in both versions; what was renamed is noted."""
        before, after = self.old.children[old], self.new.children[new]
        same = self.common_joints.intersection(before, after)
        gone = [name for name in before if name not in self.common_joints]
        came = [name for name in after if name not in self.common_joints]
        if gone and came:
            self.joints |= (found := self._siblings(gone, came))
            return [*((name, name) for name in same), *found.items()]
        return [(name, name) for name in same]

    def _siblings(self, gone: Sequence[str], came: Sequence[str]) -> dict[str, str]:
        found = _only_matches(
            {name: self._alike(self.old, name) for name in gone}, {name: self._alike(self.new, name) for name in came}
        )
        taken = set(found.values())
        gone = [name for name in gone if name not in found]
        came = [name for name in came if name not in taken]
        if gone and came:
            found |= _only_matches(
                {name: self._subtrees[id(self.old), name] for name in gone},
                {name: self._subtrees[id(self.new), name] for name in came},
            )
        return found

    def _alike(self, tree: _Tree, name: str) -> Hashable:
        """Return what a joint shares with its match: numbers, the joint that it follows, its child link."""
        joint = tree.joints[name]
        leader = joint.get("mimic", {}).get("joint")
        followed = leader if leader in self.common_joints else leader is not None
        child = joint["child"]
        return _joint(joint), followed, child if child in self.common_links else _link(tree.links[child])

    @functools.cached_property
    def _subtrees(self) -> Mapping[tuple[int, str], int]:
        """A number per joint of either version: the same for those that are alike with all that hangs on them."""
        numbers: dict[Hashable, int] = {}
        result: dict[tuple[int, str], int] = {}
        for tree in (self.old, self.new):
            for name in reversed(tree.depth_first()):
                below = sorted(result[id(tree), joint] for joint in tree.children[tree.joints[name]["child"]])
                key = name if name in self.common_joints else (self._alike(tree, name), tuple(below))
                result[id(tree), name] = numbers.setdefault(key, len(numbers))
        return result

    def _drop_wrongly_led(self) -> None:
        """Take back joints that follow another joint than before; and so on with those that follow them."""
        followers: defaultdict[str, list[str]] = defaultdict(list)
        wrong: list[str] = []
        for old, new in self.joints.items():
            if (mimic := self.old.joints[old].get("mimic")) and mimic["joint"] not in self.common_joints:
                followers[mimic["joint"]].append(old)
                if self.joints.get(mimic["joint"]) != self.new.joints[new]["mimic"]["joint"]:
                    wrong.append(old)
        for name in wrong:  # grows while it is walked
            if self.joints.pop(name, None) is not None:
                wrong += followers[name]


def _only_matches(before: Mapping[str, Hashable], after: Mapping[str, Hashable]) -> dict[str, str]:
    """Return pairs of names with equal keys, as far as each key occurs once on both sides."""
    counts = Counter(before.values()), Counter(after.values())
    names = {key: name for name, key in after.items()}
    return {name: names[key] for name, key in before.items() if counts[0][key] == counts[1][key] == 1}


def _joint(joint: Mapping[str, Any]) -> Hashable:
    """Return numbers and type of a joint."""
    plain = _without_names(joint, "joint")
    return _frozen({**plain, "mimic": _without_names(plain["mimic"], "mimic")} if "mimic" in plain else plain)


def _link(link: Mapping[str, Any]) -> Hashable:
    """Return numbers and shapes of a link."""
    shapes = {group: [_without_names(shape, "shape") for shape in link[group]] for group in ("visuals", "collisions")}
    for shape in shapes["visuals"]:
        if "material" in shape:
            shape["material"] = _without_names(shape["material"], "material")
    return _frozen({**link, **shapes})


def _without_names(block: Mapping[str, Any], kind: str) -> dict[str, Any]:
    return {key: value for key, value in block.items() if key not in _NAMES[kind]}


def _frozen(value: Any) -> Hashable:
    """Return plain data as a key, equal where the data is."""
    if isinstance(value, Mapping):
        return tuple((key, _frozen(item)) for key, item in sorted(value.items()))
    return tuple(map(_frozen, value)) if isinstance(value, list) else value
