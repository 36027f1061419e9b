"""The integer tables of the whole-robot record: the structure that the generic robot reads.

Links that fixed joints connect move as one *body*: body 1 is that of the root link, and moving joint `i` moves body `i
+ 1`. A *moving joint* is revolute, continuous or prismatic; moving joints are counted in canonical order, so that the
body that carries a joint has a smaller number than the one that it moves. The tables say which link belongs to which
body; adding up the numbers is left to Modelica, so that none of them is written twice. Everything is counted from 1.
The tables that refer to the numbers of links and joints are written out in the template.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Motion

_TURNS: Mapping[Motion, int] = {"rotational": 1, "translational": 2}


class Tables(msgspec.Struct, frozen=True):
    """The integer tables, as `UrdfSync.Records.Robot` describes them."""

    link_bodies: list[int]
    """Per link: its body."""
    joint_tree: list[tuple[int, int]]
    """Per moving joint: the body that carries it, and 1 if it turns or 2 if it slides."""
    first_joints: list[int]
    """Per body: the first joint that it carries; the number of joints + 1 if there is none."""
    next_joints: list[int]
    """Per moving joint: the next one on the same body; the number of joints + 1 if there is none."""
    moving: Mapping[Motion, list[int]]
    """The moving joints of each kind."""
    axes: Mapping[Motion, list[int]]
    """Per driven axis of each kind: its moving joint."""
    followers: list[tuple[int, int]]
    """Per joint that follows another one, leaders first: its number and that of its leader, 0 if that does not move."""


def obstacles(joints: Iterable[Joint]) -> list[Joint]:
    """Return the planar and floating joints, which the generic robot has no place for: with one there are no tables."""
    return [joint for joint in joints if joint.type not in MOTION_KINDS and joint.type != "fixed"]


def tables(tree: KinematicTree) -> Tables:
    """Return the integer tables of a robot without `obstacles`."""
    moving = [joint for joint in tree.joints if joint.type in MOTION_KINDS]
    numbers = {joint.name: number for number, joint in enumerate(moving, 1)}
    bodies = {tree.links[0].name: 1}
    for joint in tree.joints:
        bodies[joint.child] = numbers[joint.name] + 1 if joint.name in numbers else bodies[joint.parent]
    none = len(moving) + 1
    first, following = [none] * none, [none] * len(moving)
    for joint in reversed(moving):
        number, body = numbers[joint.name], bodies[joint.parent]
        following[number - 1], first[body - 1] = first[body - 1], number
    return Tables(
        link_bodies=[bodies[link.name] for link in tree.links],
        joint_tree=[(bodies[joint.parent], _TURNS[MOTION_KINDS[joint.type]]) for joint in moving],
        first_joints=first,
        next_joints=following,
        moving={kind: [numbers[j.name] for j in moving if MOTION_KINDS[j.type] == kind] for kind in _TURNS},
        axes={kind: [numbers[joint.name] for joint in tree.axes(kind)] for kind in _TURNS},
        followers=[
            (numbers[joint.name], numbers.get(joint.mimic.joint, 0))
            for joint in tree.leaders_first()
            if joint.mimic is not None
        ],
    )
