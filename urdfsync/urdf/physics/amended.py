"""Copies of URDF files that Pinocchio can read, and in which every moving joint carries mass.

Pinocchio's reader refuses, or leaves out, elements that urdfsync reads with a warning. And where a moving joint
carries no mass, only its kinematics could be compared. The copy has what is missing, for both sides.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Collection, Iterator
from typing import NamedTuple

from lxml import etree

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.physics.elements import Element, child, children, parse
from urdfsync.urdf.robot import Link

_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_POINTS = 4
"""Made-up inertias are those of so many equal masses: not diagonal, and never impossible."""
_NAME = "the robot's name"


class Amended(NamedTuple):
    """A copy of a URDF, the same bytes if nothing is missing, and what was done: sentences without a full stop."""

    content: bytes
    notes: tuple[str, ...] = ()


def readable(content: bytes) -> Amended:
    """The URDF with the elements and attributes that Pinocchio's reader does not do without."""
    root = parse(content)
    counts = Counter(_completed(root))
    if not counts and _is_utf8(content):
        return Amended(content)
    added = [_NAME] * counts.pop("robot", 0) + [f"{count} <{tag}>" for tag, count in sorted(counts.items())]
    notes = [f"what Pinocchio's reader asks for was added: {', '.join(added)}"] if added else []
    return Amended(_bytes(root), tuple(notes))


def with_inertias(content: bytes, skeleton: KinematicTree) -> Amended:
    """The URDF with made-up inertias in all links that hang on a moving joint which carries no mass.

    The root link counts as moving: a robot without any mass gets it in all its links.
    """
    bare = _bare_links(skeleton)
    if not bare:
        return Amended(content)
    root = parse(content)
    for link in children(root, "link"):
        if link.get("name") in bare:
            for old in list(children(link, "inertial")):
                link.remove(old)
            link.append(_inertial(random.Random(link.get("name"))))  # noqa: S311 - nothing is kept secret
    links = f"{len(bare)} links" if len(bare) > 1 else f'link "{next(iter(bare))}"'
    reason = (
        "the file gives no mass at all" if len(bare) == len(skeleton.links) else "joints move them without any mass"
    )
    return Amended(
        _bytes(root), (f"inertias were made up for {links} of the generated package only, because {reason}",)
    )


def _completed(root: Element) -> Iterator[str]:
    """Complete the elements below `root`; gives the tag of each that was not complete."""
    if not root.get("name"):
        root.set("name", "robot")
        yield "robot"
    for joint in children(root, "joint"):
        if joint.get("type") in ("revolute", "prismatic") and child(joint, "limit") is None:
            etree.SubElement(joint, "limit", lower="-1000", upper="1000")
        yield from _filled(joint, "limit", ("effort", "velocity"), "1000")
        yield from _filled(joint, "safety_controller", ("k_velocity",), "0")
        losses = child(joint, "dynamics")
        if losses is not None and losses.get("friction") is None:
            yield from _filled(joint, "dynamics", ("damping",), "0")
    for inertial in (part for link in children(root, "link") for part in children(link, "inertial")):
        for tag, names in (("mass", ("value",)), ("inertia", _COMPONENTS)):
            if child(inertial, tag) is None:
                etree.SubElement(inertial, tag)
            yield from _filled(inertial, tag, names, "0")


def _filled(parent: Element, tag: str, names: Collection[str], value: str) -> Iterator[str]:
    for element in children(parent, tag):
        absent = [name for name in names if element.get(name) is None]
        for name in absent:
            element.set(name, value)
        if absent:
            yield tag


def _bare_links(skeleton: KinematicTree) -> frozenset[str]:
    """Links below moving joints that carry no mass, those joints' own links included."""
    massive: set[str] = {link.name for link in skeleton.links if _mass(link) > 0}
    for joint in reversed(skeleton.joints):  # from the leaves to the root
        if joint.child in massive:
            massive.add(joint.parent)
    bare = set() if skeleton.links[0].name in massive else {skeleton.links[0].name}
    for joint in skeleton.joints:
        if joint.child not in massive and (joint.type != "fixed" or joint.parent in bare):
            bare.add(joint.child)
    return frozenset(bare)


def _mass(link: Link) -> float:
    return link.inertial.mass if link.inertial else 0.0


def _inertial(draw: random.Random) -> Element:
    """Mass properties of equal masses at random places, in a frame that is turned and off-centre."""
    mass = round(draw.uniform(0.5, 3), 3)
    points = [[draw.uniform(-0.15, 0.15) for _ in range(3)] for _ in range(_POINTS)]
    tensor = {}
    for name in _COMPONENTS:
        i, j = ("xyz".index(letter) for letter in name[1:])
        products = sum((i == j) * sum(x * x for x in point) - point[i] * point[j] for point in points)
        tensor[name] = repr(round(products * mass / _POINTS, 6))
    element = etree.Element("inertial")
    etree.SubElement(element, "origin", xyz=_vector(draw, 0.1), rpy=_vector(draw, 1))
    etree.SubElement(element, "mass", value=repr(mass))
    etree.SubElement(element, "inertia", tensor)
    return element


def _vector(draw: random.Random, reach: float) -> str:
    return " ".join(repr(round(draw.uniform(-reach, reach), 3)) for _ in range(3))


def _is_utf8(content: bytes) -> bool:
    try:
        return "\0" not in content.decode()
    except UnicodeDecodeError:
        return False


def _bytes(root: Element) -> bytes:
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True)
