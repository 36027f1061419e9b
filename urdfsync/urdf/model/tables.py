"""Tables of the whole-robot record: the structure that the generic robot reads, and references to the numbers.

Links that fixed joints connect move as one *body*: body 1 is that of the root link, and moving joint `i` moves body
`i + 1`. A *moving joint* is revolute, continuous or prismatic; moving joints are counted in canonical order, so that
what carries a joint has a smaller number than what it moves. The tables say which link belongs to which body; adding
up the numbers is left to Modelica, so that none of them is written twice. Everything is counted from 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec

from urdfsync.modelica.literals import INFINITY
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree, Motion
from urdfsync.urdf.robot import Joint

_TURNS: Mapping[Motion, int] = {"rotational": 1, "translational": 2}
_PER_LINE = 10  # of numbers, so that the fourth line begins with number 31
_INDENT = "\n      "
_ENDS: Mapping[str, str] = {"lower": f"-{INFINITY}", "upper": INFINITY}


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
    moving = _moving(skeleton)
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
            (numbers[joint.name], numbers.get(joint.mimic.joint, 0)) for joint in _followers(skeleton) if joint.mimic
        ),
    )


def _followers(skeleton: KinematicTree) -> list[Joint]:
    """The moving joints that follow others, leaders first."""
    return [joint for joint in skeleton.leaders_first() if joint.type in MOTION_KINDS and joint.mimic is not None]


def record_tables(skeleton: KinematicTree) -> list[str]:
    """The tables that are not empty, as modifiers of `UrdfSync.Records.Robot`.

    Tables of references have one entry per line, which names the element that it is of: an element more is a line
    more. Integers have ten to a line; a new moving joint renumbers those behind it, however they are broken.
    """
    integers, moving = structure(skeleton), _moving(skeleton)
    joints = [skeleton.joint(joint.name).component for joint in skeleton.joints]
    tables = {
        "movingJoints": _count(moving),
        "turningJoints": _count(integers.moving["rotational"]),
        "slidingJoints": _count(integers.moving["translational"]),
        "rotationalAxes": _count(integers.axes["rotational"]),
        "translationalAxes": _count(integers.axes["translational"]),
        "jointTree": _pairs(integers.joint_tree),
        "firstJoints": _integers(integers.first_joints),
        "nextJoints": _integers(integers.next_joints),
        "linkBodies": _integers(integers.link_bodies),
        "turning": _integers(integers.moving["rotational"]),
        "sliding": _integers(integers.moving["translational"]),
        "rotationalJoints": _integers(integers.axes["rotational"]),
        "translationalJoints": _integers(integers.axes["translational"]),
        "followers": _pairs(integers.followers),
        "jointAxes": _column(f"{skeleton.joint(joint.name).component}.axis" for joint in moving),
        "jointPositions": _column(f"{joint}.origin.xyz" for joint in joints),
        "jointAngles": _column(f"{joint}.origin.rpy" for joint in joints),
        **_follower_tables(skeleton),
        **_link_tables([skeleton.link(link.name).component for link in skeleton.links]),
    }
    records = {
        "jointNames": _names(skeleton, moving),
        **_records(skeleton, "turning", [joint for joint in moving if MOTION_KINDS[joint.type] == "rotational"]),
        **_records(skeleton, "sliding", [joint for joint in moving if MOTION_KINDS[joint.type] == "translational"]),
    }
    return [
        *(f"{name} = {value}" for name, value in tables.items() if value),
        *(f"{name}({value})" for name, value in records.items() if value),
    ]


def _moving(skeleton: KinematicTree) -> list[Joint]:
    return [joint for joint in skeleton.joints if joint.type in MOTION_KINDS]


def _carried(carriers: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Per body its first joint, and per joint the next one of the same body; `carriers` has the body of each joint."""
    none = len(carriers) + 1
    first, following = [none] * none, [none] * len(carriers)
    for number in range(len(carriers), 0, -1):
        body = carriers[number - 1]
        following[number - 1], first[body - 1] = first[body - 1], number
    return tuple(first), tuple(following)


def _follower_tables(skeleton: KinematicTree) -> dict[str, str]:
    """Numbers of each follower to its own leader, so that the text grows with the number of followers only."""
    followers = _followers(skeleton)
    offsets = {
        motion: [
            f"{skeleton.joint(joint.name).component}.mimic.offset" if MOTION_KINDS[joint.type] == motion else "0"
            for joint in followers
        ]
        for motion in _TURNS
    }
    return {
        "followerMultipliers": _column(f"{skeleton.joint(j.name).component}.mimic.multiplier" for j in followers),
        "followerAngles": _column(offsets["rotational"]),
        "followerLengths": _column(offsets["translational"]),
    }


def _names(skeleton: KinematicTree, joints: Sequence[Joint]) -> str:
    """A modifier of an array of records: not every tool can pick a message out of an array of strings."""
    return _field("name", (f"{skeleton.joint(joint.name).component}.name" for joint in joints))


def _records(skeleton: KinematicTree, kind: str, joints: Sequence[Joint]) -> dict[str, str]:
    """Limits and losses of the joints of one kind, as modifiers of arrays of records."""
    names = [skeleton.joint(joint.name).component for joint in joints]
    limits = []
    for field in ("lower", "upper", "velocity", "effort"):
        entries = [
            _ENDS[field] if joint.type == "continuous" and field in _ENDS else f"{name}.limits.{field}"
            for joint, name in zip(joints, names, strict=True)
        ]  # a continuous joint has no ends, whatever its record says
        limits.append(_field(field, entries))
    losses = [
        _field(field, (f"{name}.dynamics.{field}" for name in names)) for field in ("damping", "friction", "steepness")
    ]
    return {f"{kind}Limits": ",".join(limits), f"{kind}Losses": ",".join(losses)} if joints else {}


def _field(name: str, entries: Iterable[str]) -> str:
    """One field of all elements of an array of records."""
    text = f",{_INDENT}  ".join(entries)
    return f"{_INDENT}{name} = {{{_INDENT}  {text}}}" if text else ""


def _link_tables(names: Sequence[str]) -> dict[str, str]:
    return {
        "linkMasses": _column(f"{name}.inertial.mass" for name in names),
        "linkCenters": _column(f"{name}.inertial.origin.xyz" for name in names),
        "inertialAngles": _column(f"{name}.inertial.origin.rpy" for name in names),
        "linkInertias": _column(_inertia(f"{name}.inertial.inertia") for name in names),
    }


def _inertia(tensor: str) -> str:
    """Six elements on two lines: they are long."""
    moments = ", ".join(f"{tensor}.i{element}" for element in ("xx", "yy", "zz"))
    products = ", ".join(f"{tensor}.i{element}" for element in ("xy", "xz", "yz"))
    return f"{{{moments},{_INDENT} {products}}}"


def _count(items: Sequence[object]) -> str:
    return str(len(items)) if items else ""


def _pairs(rows: Sequence[tuple[int, int]]) -> str:
    return _wrapped([f"{{{one}, {other}}}" for one, other in rows])


def _integers(numbers: Sequence[int]) -> str:
    return _wrapped([str(number) for number in numbers])


def _wrapped(entries: Sequence[str]) -> str:
    lines = [", ".join(entries[at : at + _PER_LINE]) for at in range(0, len(entries), _PER_LINE)]
    return _column(lines) if len(lines) != 1 else f"{{{lines[0]}}}"


def _column(entries: Iterable[str]) -> str:
    """An array with an entry or more per line; no text for an empty one, which has no literal in Modelica."""
    text = f",{_INDENT}".join(entries)
    return f"{{{_INDENT}{text}}}" if text else ""
