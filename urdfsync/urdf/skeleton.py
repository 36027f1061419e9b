"""A robot's tree in canonical order: depth-first from the root, siblings in natural order of their names.

The order of elements in the URDF does not matter here; numbers of links, joints, axes and frames
follow from this order.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal

import msgspec

from urdfsync.urdf.naming import Identifier, Key, identify, natural_key
from urdfsync.urdf.robot import Joint, Limit, Link, Mimic, Robot

Motion = Literal["rotational", "translational"]

MOTIONS: Mapping[str, Motion] = {
    "continuous": "rotational",
    "revolute": "rotational",
    "prismatic": "translational",
}
"""Kind of motion of each joint type that has one axis."""


class Skeleton(msgspec.Struct, frozen=True):
    """Links and joints in canonical order; joint `k` leads to link `k + 1`, link 0 is the root."""

    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    names: Mapping[Key, Identifier]

    @classmethod
    def of(cls, robot: Robot, taken: Iterable[str] = ()) -> Skeleton:
        """The skeleton of a robot that passed all checks; `taken` names are not given to any element.

        Raises KeyError or ValueError for a robot that passes none.
        """
        links, joints = _depth_first(robot)
        keys = [("link", link.name) for link in links] + [("joint", joint.name) for joint in joints]
        return cls(links, joints, identify(keys, taken))

    def link(self, name: str) -> Identifier:
        """Identifier of a link."""
        return self.names["link", name]

    def joint(self, name: str) -> Identifier:
        """Identifier of a joint."""
        return self.names["joint", name]

    def children(self) -> Mapping[str, tuple[Joint, ...]]:
        """Joints that start at each link, in canonical order; links without any are left out."""
        children: defaultdict[str, list[Joint]] = defaultdict(list)
        for joint in self.joints:
            children[joint.parent].append(joint)
        return {link: tuple(joints) for link, joints in children.items()}

    def leaves(self) -> tuple[Link, ...]:
        """Links at which no joint starts."""
        parents = {joint.parent for joint in self.joints}
        return tuple(link for link in self.links if link.name not in parents)

    def axes(self, motion: Motion) -> tuple[Joint, ...]:
        """Joints with an axis of that kind that can be driven: all but those that follow another one."""
        return tuple(j for j in self.joints if MOTIONS.get(j.type) == motion and j.mimic is None)

    def followers(self) -> Iterator[tuple[Joint, Mimic]]:
        """Joints with an axis that follow another joint, and how."""
        return ((j, j.mimic) for j in self.joints if j.type in MOTIONS and j.mimic is not None)

    def followers_by_leader(self) -> Mapping[str, tuple[tuple[Joint, Mimic], ...]]:
        """The direct followers of each joint that has any."""
        followers: defaultdict[str, list[tuple[Joint, Mimic]]] = defaultdict(list)
        for joint, mimic in self.followers():
            followers[mimic.joint].append((joint, mimic))
        return {leader: tuple(joints) for leader, joints in followers.items()}

    def leaders_first(self) -> list[Joint]:
        """All joints, each after the joint that it follows."""
        followers = self.followers_by_leader()
        order = [joint for joint in self.joints if joint.mimic is None or joint.type not in MOTIONS]
        for joint in order:  # grows while it is walked
            order += (follower for follower, _ in followers.get(joint.name, ()))
        return order


def bare(joint: Joint) -> Joint:
    """What of a joint is no number: where it stands, how it moves, which joint it follows, and what drives it.

    A limit is there without its numbers: whether a joint has one decides with others whether it is driven.
    """
    limit = None if joint.limit is None else Limit()
    mimic = None if joint.mimic is None else Mimic(joint.mimic.joint)
    return Joint(joint.name, joint.type, joint.parent, joint.child, limit=limit, mimic=mimic, actuated=joint.actuated)


def _depth_first(robot: Robot) -> tuple[tuple[Link, ...], tuple[Joint, ...]]:
    links = {link.name: link for link in robot.links}
    children: defaultdict[str, list[Joint]] = defaultdict(list)
    for joint in robot.joints:
        children[joint.parent].append(joint)
    (root,) = links.keys() - {joint.child for joint in robot.joints}
    order: list[Joint] = []
    stack = _reversed_siblings(children[root])
    while stack:
        joint = stack.pop()
        order.append(joint)
        stack += _reversed_siblings(children[joint.child])
    return (links[root], *(links[joint.child] for joint in order)), tuple(order)


def _reversed_siblings(joints: Sequence[Joint]) -> list[Joint]:
    return sorted(joints, key=lambda joint: natural_key(joint.name), reverse=True) if len(joints) > 1 else [*joints]
