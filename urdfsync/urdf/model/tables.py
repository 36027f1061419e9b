"""The integer tables of the whole-robot record: the structure that the generic robot reads.

Links that fixed joints connect move as one *body*: body 1 is that of the root link, and moving joint `i` moves body
`i + 1`. A *moving joint* is revolute, continuous or prismatic; moving joints are counted in canonical order, so that
what carries a joint has a smaller number than what it moves. The tables say which link belongs to which body; adding
up the numbers is left to Modelica, so that none of them is written twice. Everything is counted from 1. The tables
that refer to the numbers of links and joints are written out in the template.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec

from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree, Motion
from urdfsync.urdf.robot import Joint

_TURNS: Mapping[Motion, int] = {"rotational": 1, "translational": 2}


class Structure(msgspec.Struct, frozen=True):
    """The integer tables, as `UrdfSync.Records.Robot` describes them."""

    link_bodies: tuple[int, ...]
    """Per link: its body."""
    joint_tree: tuple[tuple[int, int], ...]
    """Per moving joint: the body that carries it, and 1 if it turns or 2 if it slides."""
    first_joints: tuple[int, ...]
    """Per body: the first joint that it carries; the number of joints + 1 if there is none."""
    next_joints: tuple[int, ...]
    """Per moving joint: the next one on the same body; the number of joints + 1 if there is none."""
    moving: Mapping[Motion, tuple[int, ...]]
    """The moving joints of each kind."""
    axes: Mapping[Motion, tuple[int, ...]]
    """Per driven axis of each kind: its moving joint."""
    followers: tuple[tuple[int, int], ...]
    """Per joint that follows another one, leaders first: its number and that of its leader, 0 if that does not move."""


def obstacles(joints: Iterable[Joint]) -> Iterator[Joint]:
    """The joints for which the generic robot has no place: planar and floating ones."""
    return (joint for joint in joints if joint.type not in MOTION_KINDS and joint.type != "fixed")


def has_tables(joints: Iterable[Joint]) -> bool:
    """Whether the generic robot can take a robot with these joints: none is planar or floating."""
    return not any(obstacles(joints))


def structure(skeleton: KinematicTree) -> Structure:
    """The integer tables of a robot that has some (see `has_tables`)."""
    moving = moving_joints(skeleton)
    numbers = {joint.name: number for number, joint in enumerate(moving, 1)}
    bodies = {skeleton.links[0].name: 1}
    for joint in skeleton.joints:
        bodies[joint.child] = numbers[joint.name] + 1 if joint.name in numbers else bodies[joint.parent]
    carriers = [bodies[joint.parent] for joint in moving]
    first, following = _carried(carriers)
    return Structure(
        link_bodies=tuple(bodies[link.name] for link in skeleton.links),
        joint_tree=tuple(
            (body, _TURNS[MOTION_KINDS[joint.type]]) for body, joint in zip(carriers, moving, strict=True)
        ),
        first_joints=first,
        next_joints=following,
        moving={
            motion: tuple(numbers[joint.name] for joint in moving if MOTION_KINDS[joint.type] == motion)
            for motion in _TURNS
        },
        axes={motion: tuple(numbers[joint.name] for joint in skeleton.axes(motion)) for motion in _TURNS},
        followers=tuple(
            (numbers[joint.name], numbers.get(joint.mimic.joint, 0))
            for joint in following_joints(skeleton)
            if joint.mimic
        ),
    )


def following_joints(skeleton: KinematicTree) -> list[Joint]:
    """The moving joints that follow others, leaders first."""
    return [joint for joint in skeleton.leaders_first() if joint.type in MOTION_KINDS and joint.mimic is not None]


def moving_joints(skeleton: KinematicTree) -> list[Joint]:
    """The joints that turn or slide, in canonical order."""
    return [joint for joint in skeleton.joints if joint.type in MOTION_KINDS]


def _carried(carriers: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Per body its first joint, and per joint the next one of the same body; `carriers` has the body of each joint."""
    none = len(carriers) + 1
    first, following = [none] * none, [none] * len(carriers)
    for number in range(len(carriers), 0, -1):
        body = carriers[number - 1]
        following[number - 1], first[body - 1] = first[body - 1], number
    return tuple(first), tuple(following)
