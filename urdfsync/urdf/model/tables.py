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
from urdfsync.urdf.robot import Joint
from urdfsync.urdf.skeleton import MOTIONS, Motion, Skeleton

_TURNS: Mapping[Motion, int] = {"rotational": 1, "translational": 2}
_PER_LINE = 10  # of numbers, so that the fourth line begins with number 31
_INDENT = "\n      "
_RECORDS = "jointNames"  # an array of records, not of strings


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
    axes: Mapping[Motion, tuple[int, ...]]
    """Per driven axis of each kind: its moving joint."""
    followers: tuple[tuple[int, int], ...]
    """Per joint that follows another one, leaders first: its number and that of the driven one at the head, or 0."""


class Ratio(msgspec.Struct, frozen=True):
    """What a follower is to the joint at the head of its chain: Modelica expressions of multiplier and offset."""

    head: str
    multiplier: str
    offset: str


def obstacles(joints: Iterable[Joint]) -> Iterator[Joint]:
    """The joints for which the generic robot has no place: planar and floating ones."""
    return (joint for joint in joints if joint.type not in MOTIONS and joint.type != "fixed")


def has_tables(joints: Iterable[Joint]) -> bool:
    """Whether the generic robot can take a robot with these joints: none is planar or floating."""
    return not any(obstacles(joints))


def structure(skeleton: Skeleton) -> Structure:
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
        joint_tree=tuple((body, _TURNS[MOTIONS[joint.type]]) for body, joint in zip(carriers, moving, strict=True)),
        first_joints=first,
        next_joints=following,
        axes={motion: tuple(numbers[joint.name] for joint in skeleton.axes(motion)) for motion in _TURNS},
        followers=tuple((numbers[name], numbers.get(ratio.head, 0)) for name, ratio in ratios(skeleton).items()),
    )


def ratios(skeleton: Skeleton) -> Mapping[str, Ratio]:
    """Per follower, leaders first, its ratio to the joint at the head of the chain, in terms of the record."""
    found: dict[str, Ratio] = {}
    for joint in skeleton.leaders_first():
        if joint.type not in MOTIONS or joint.mimic is None:
            continue
        own = f"{skeleton.joint(joint.name).component}.mimic"
        multiplier, offset = f"{own}.multiplier", f"{own}.offset"
        leader = found.get(joint.mimic.joint)
        if leader is None:
            found[joint.name] = Ratio(joint.mimic.joint, multiplier, offset)
        else:
            inner = f"({leader.offset})" if "+" in leader.offset else leader.offset
            offset = f"{multiplier}*{inner} + {offset}"
            found[joint.name] = Ratio(leader.head, f"{multiplier}*{leader.multiplier}", offset)
    return found


def record_tables(skeleton: Skeleton) -> list[str]:
    """The tables that are not empty, as modifiers of `UrdfSync.Records.Robot`.

    Tables of references have one entry per line, which names the element that it is of: an element more is a line
    more. Integers have ten to a line; a new moving joint renumbers those behind it, however they are broken.
    """
    integers, moving = structure(skeleton), _moving(skeleton)
    joints = [skeleton.joint(joint.name).component for joint in skeleton.joints]
    tables = {
        "movingJoints": _count(moving),
        "rotationalAxes": _count(integers.axes["rotational"]),
        "translationalAxes": _count(integers.axes["translational"]),
        "jointTree": _pairs(integers.joint_tree),
        "firstJoints": _integers(integers.first_joints),
        "nextJoints": _integers(integers.next_joints),
        "linkBodies": _integers(integers.link_bodies),
        "rotationalJoints": _integers(integers.axes["rotational"]),
        "translationalJoints": _integers(integers.axes["translational"]),
        "followers": _pairs(integers.followers),
        **_moving_tables(skeleton, moving),
        "jointPositions": _column(f"{joint}.origin.xyz" for joint in joints),
        "jointAngles": _column(f"{joint}.origin.rpy" for joint in joints),
        "followerRatios": _column(f"{{{ratio.multiplier}, {ratio.offset}}}" for ratio in ratios(skeleton).values()),
        **_link_tables([skeleton.link(link.name).component for link in skeleton.links]),
    }
    return [_modifier(name, value) for name, value in tables.items() if value]


def _modifier(name: str, value: str) -> str:
    return f"{name}(name = {value})" if name == _RECORDS else f"{name} = {value}"


def _moving(skeleton: Skeleton) -> list[Joint]:
    return [joint for joint in skeleton.joints if joint.type in MOTIONS]


def _carried(carriers: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Per body its first joint, and per joint the next one of the same body; `carriers` has the body of each joint."""
    none = len(carriers) + 1
    first, following = [none] * none, [none] * len(carriers)
    for number in range(len(carriers), 0, -1):
        body = carriers[number - 1]
        following[number - 1], first[body - 1] = first[body - 1], number
    return tuple(first), tuple(following)


def _moving_tables(skeleton: Skeleton, moving: Sequence[Joint]) -> dict[str, str]:
    names = [skeleton.joint(joint.name).component for joint in moving]
    return {
        "jointNames": _column(f"{name}.name" for name in names),
        "jointAxes": _column(f"{name}.axis" for name in names),
        "jointLimits": _column(_limits(joint, name) for joint, name in zip(moving, names, strict=True)),
        "jointLosses": _column(f"{{{name}.dynamics.damping, {name}.dynamics.friction}}" for name in names),
    }


def _limits(joint: Joint, name: str) -> str:
    ends = f"{name}.limits.lower, {name}.limits.upper"
    if joint.type == "continuous":  # whatever its record says
        ends = f"-{INFINITY}, {INFINITY}"
    return f"{{{ends}, {name}.limits.velocity, {name}.limits.effort}}"


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
