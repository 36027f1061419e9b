"""Exports that change the tree of a robot: another parent, an added or removed link, an exchange."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator, Mapping
from random import Random

from lxml import etree

from support import urdfs

Robot = etree._Element
Change = Callable[[Robot, Random], bool]
"""Changes a robot; false if the robot has no place for this change."""


def changed(content: bytes, kind: str, random: Random) -> bytes | None:
    """The robot after one change of this kind; None if the robot has no place for it."""
    robot = etree.fromstring(content, etree.XMLParser(recover=True, remove_comments=True))
    return etree.tostring(robot) if CHANGES[kind](robot, random) else None


def _move(robot: Robot, random: Random) -> bool:
    """Give a joint another parent."""
    joints = robot.findall("joint")
    pairs = [
        (joint, link.get("name"))
        for joint in joints
        for link in robot.findall("link")
        if link.get("name") not in {_parent(joint), *_below(robot, joint)}
    ]
    if not pairs:
        return False
    joint, name = random.choice(pairs)
    _end(joint, "parent").set("link", str(name))
    return True


def _insert(robot: Robot, random: Random) -> bool:
    """Insert a link and a joint between a link and its joint."""
    joints = robot.findall("joint")
    if not joints:
        return False
    joint = random.choice(joints)
    taken = {element.get("name") for element in robot}
    name = random.choice([name for name in map("between{}".format, range(1000)) if name not in taken])
    ends = f'<parent link="{_parent(joint)}"/><child link="{name}"/>'
    for element in (
        urdfs.link(name, 1),
        f'<joint name="{name}_joint" type="continuous">{ends}<axis xyz="0 1 0"/></joint>',
    ):
        robot.insert(random.randrange(len(robot)), etree.fromstring(element))
    _end(joint, "parent").set("link", name)
    return True


def _remove(robot: Robot, random: Random) -> bool:
    """Remove a joint and its child; the child's children move to its parent."""
    joints = [joint for joint in robot.findall("joint") if not _mentions(robot, joint)]
    if len(joints) < 2:
        return False
    joint = random.choice(joints)
    child = _child(joint)
    for other in robot.findall("joint"):
        if _parent(other) == child:
            _end(other, "parent").set("link", _parent(joint))
    for element in (joint, *(link for link in robot.findall("link") if link.get("name") == child)):
        robot.remove(element)
    return True


def _exchange(robot: Robot, random: Random) -> bool:
    """Exchange the children of two joints, with different masses: otherwise nobody could see the exchange."""
    joints = robot.findall("joint")
    masses = {link.get("name"): str(link.xpath("string(inertial/mass/@value)")) for link in robot.findall("link")}
    pairs = [
        (one, other)
        for one in joints
        for other in joints
        if "" not in (masses[_child(one)], masses[_child(other)]) and masses[_child(one)] != masses[_child(other)]
        if one is not other and _child(one) not in _below(robot, other) and _child(other) not in _below(robot, one)
    ]
    if not pairs:
        return False
    one, other = random.choice(pairs)
    first, second = _child(one), _child(other)
    _end(one, "child").set("link", second)
    _end(other, "child").set("link", first)
    return True


CHANGES: Mapping[str, Change] = {
    "another parent": _move,
    "a link in between": _insert,
    "a link less": _remove,
    "links exchanged": _exchange,
}


def _end(joint: Robot, tag: str) -> Robot:
    found = joint.find(tag)
    assert found is not None
    return found


def _parent(joint: Robot) -> str:
    return str(_end(joint, "parent").get("link"))


def _child(joint: Robot) -> str:
    return str(_end(joint, "child").get("link"))


def _below(robot: Robot, joint: Robot) -> Iterator[str]:
    """The links behind a joint."""
    child = _child(joint)
    yield child
    for other in robot.findall("joint"):
        if _parent(other) == child:
            yield from _below(robot, other)


def _mentions(robot: Robot, joint: Robot) -> bool:
    """Whether an element refers to a joint or its child, other than as the parent of a joint."""
    text = etree.tostring(copy.deepcopy(robot)).decode()
    behind = sum(_parent(other) == _child(joint) for other in robot.findall("joint"))
    return text.count(f'"{joint.get("name")}"') > 1 or text.count(f'"{_child(joint)}"') > 2 + behind
