"""A robot's tree in canonical order: depth-first from the root, siblings in natural order of their names.

The canonical order, not the order in the URDF, gives links, joints, axes and frames their numbers.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import msgspec
from msgspec.structs import replace

from urdfsync.domain import ElementKey
from urdfsync.formats.urdf.names import Identifier, identify, natural_key
from urdfsync.formats.urdf.robot import (
    MOTION_KINDS,
    Joint,
    Link,
    Loop,
    Mimic,
    Motion,
    Origin,
    Robot,
    Sensor,
    effective,
    structure,
)


class KinematicTree(msgspec.Struct, frozen=True):
    """Links and joints in canonical order; joint `k` leads to link `k + 1`, link 0 is the root.

    Joints are `effective`: only a joint that follows another has a `mimic`.
    """

    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    names: Mapping[ElementKey, Identifier]
    sensors: tuple[Sensor, ...] = ()
    """In natural order of their names."""
    loops: tuple[Loop, ...] = ()

    def __hash__(self) -> int:
        """Return a hash of the elements without `names`: mappings have no hash."""
        return hash((self.links, self.joints, self.sensors, self.loops))

    @classmethod
    def of(cls, robot: Robot, taken: Iterable[str] = ()) -> KinematicTree:
        """Return the tree of a valid robot.

        No element gets a name in `taken`. Raises KeyError or ValueError for an invalid robot.
        """
        links = {link.name: link for link in robot.links}
        if len({joint.child for joint in robot.joints}) < len(robot.joints):
            raise ValueError("two joints lead to one link")  # without this check, the loop below might not end
        children: defaultdict[str, list[Joint]] = defaultdict(list)
        for joint in robot.joints:
            children[joint.parent].append(joint)
        for siblings in children.values():
            siblings.sort(key=lambda joint: natural_key(joint.name), reverse=True)  # the pop takes the last first
        (root,) = links.keys() - {joint.child for joint in robot.joints}
        joints: list[Joint] = []
        waiting = list(children[root])
        while waiting:
            joints.append(effective(waiting.pop()))
            waiting += children[joints[-1].child]
        keys = [("link", link.name) for link in robot.links] + [("joint", joint.name) for joint in joints]
        order = (links[root], *(links[joint.child] for joint in joints))
        sensors = tuple(sorted(robot.sensors, key=lambda sensor: natural_key(sensor.name)))
        loops = tuple(sorted(robot.loops, key=lambda loop: natural_key(loop.name)))
        keys += [("loop", loop.name) for loop in loops]
        return cls(order, tuple(joints), identify(keys, taken), sensors, loops)

    def structure(self) -> KinematicTree:
        """Return the tree without numbers."""
        links = tuple(Link(link.name) for link in self.links)
        sensors = [
            replace(sensor, origin=Origin(), update_rate=0.0, camera=None, lidar=None) for sensor in self.sensors
        ]
        loops = [Loop(loop.name, loop.kind, loop.parent, loop.child) for loop in self.loops]
        return KinematicTree(links, tuple(map(structure, self.joints)), self.names, tuple(sensors), tuple(loops))

    def link(self, name: str) -> Identifier:
        """Return the identifier of a link."""
        return self.names["link", name]

    def joint(self, name: str) -> Identifier:
        """Return the identifier of a joint."""
        return self.names["joint", name]

    def loop(self, name: str) -> Identifier:
        """Return the identifier of a loop."""
        return self.names["loop", name]

    def children(self) -> Mapping[str, tuple[Joint, ...]]:
        """Return the joints that start at each link, in canonical order. Links without such joints are left out."""
        children: defaultdict[str, list[Joint]] = defaultdict(list)
        for joint in self.joints:
            children[joint.parent].append(joint)
        return {link: tuple(joints) for link, joints in children.items()}

    def leaves(self) -> tuple[Link, ...]:
        """Return the links at which no joint starts."""
        parents = {joint.parent for joint in self.joints}
        return tuple(link for link in self.links if link.name not in parents)

    def axes(self, motion: Motion) -> tuple[Joint, ...]:
        """Return the joints with this kind of motion that follow no other joint."""
        return tuple(j for j in self.joints if MOTION_KINDS.get(j.type) == motion and j.mimic is None)

    def starts(self) -> tuple[Joint, ...]:
        """Return the joints whose start positions the source or the configuration states."""
        return tuple(joint for joint in self.joints if joint.start is not None)

    def followers(self) -> Iterator[tuple[Joint, Mimic]]:
        """Yield the joints that follow another joint, each with its `mimic`."""
        return ((joint, joint.mimic) for joint in self.joints if joint.mimic is not None)

    def followers_by_leader(self) -> Mapping[str, tuple[tuple[Joint, Mimic], ...]]:
        """Return the direct followers of each leader."""
        followers: defaultdict[str, list[tuple[Joint, Mimic]]] = defaultdict(list)
        for joint, mimic in self.followers():
            followers[mimic.joint].append((joint, mimic))
        return {leader: tuple(joints) for leader, joints in followers.items()}

    def leaders_first(self) -> list[Joint]:
        """Return all joints, each one after its leader."""
        followers = self.followers_by_leader()
        order = [joint for joint in self.joints if joint.mimic is None]
        for joint in order:  # the list grows in this loop
            order += (follower for follower, _ in followers.get(joint.name, ()))
        return order
