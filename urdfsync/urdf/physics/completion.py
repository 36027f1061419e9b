"""Copies of URDF files that Pinocchio can read, and in which every moving joint carries mass.

Pinocchio's reader refuses, or leaves out, elements that urdfsync reads with a warning. And where a moving joint
carries no mass, only its kinematics could be compared. Package and reference are both made from the copy.
"""

from __future__ import annotations

import contextlib
import random
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from lxml import etree

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.parse import xml

Element = etree._Element

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_POINTS = 4  # made-up inertias are those of so many equal masses: not diagonal, and never impossible


class CompletedSource(NamedTuple):
    """A copy of a URDF, the same bytes if nothing is missing, and what was done: sentences without a full stop."""

    content: bytes
    notes: tuple[str, ...] = ()


def children(element: Element, tag: str) -> Iterator[Element]:
    """The children of that name, those with a prefix left out."""
    return (child for child in element.iterchildren("{*}" + tag) if child.prefix is None)


def attribute(element: Element, tag: str, name: str, default: str = "") -> str:
    """An attribute of the first child of that name; the default if there is no such child or attribute."""
    found = next(children(element, tag), None)
    return default if found is None else found.get(name, default)


def completed_for_pinocchio(content: bytes) -> CompletedSource:
    """The URDF in UTF-8, with the elements and attributes that Pinocchio's reader insists on."""
    root = xml.parse_tree(content)
    added = [] if root.get("name") else ["the robot's name"]
    root.set("name", root.get("name") or "robot")
    filled = Counter[str]()
    for joint in children(root, "joint"):
        if joint.get("type") in ("revolute", "prismatic") and next(children(joint, "limit"), None) is None:
            etree.SubElement(joint, "limit", lower="-1000", upper="1000")
        _fill(joint, "limit", {"effort": "1000", "velocity": "1000"}, filled)
        _fill(joint, "safety_controller", {"k_velocity": "0"}, filled)
        if not attribute(joint, "dynamics", "friction"):
            _fill(joint, "dynamics", {"damping": "0"}, filled)
    for inertial in (part for link in children(root, "link") for part in children(link, "inertial")):
        for tag, values in (("mass", {"value": "0"}), ("inertia", dict.fromkeys(_TENSOR, "0"))):
            if next(children(inertial, tag), None) is None:
                etree.SubElement(inertial, tag)
            _fill(inertial, tag, values, filled)
    added += [f"{count} <{tag}>" for tag, count in sorted(filled.items())]
    with contextlib.suppress(UnicodeDecodeError):
        if not added and "\0" not in content.decode():
            return CompletedSource(content)
    notes = (f"what Pinocchio's reader asks for was added: {', '.join(added)}",) if added else ()
    return CompletedSource(_bytes(root), notes)


def with_inertias(content: bytes, tree: KinematicTree) -> CompletedSource:
    """The URDF with made-up inertias in all links that hang on a moving joint which carries no mass.

    The root link counts as moving: a robot without any mass gets inertias in all its links.
    """
    massless = _massless_links(tree)
    if not massless:
        return CompletedSource(content)
    root = xml.parse_tree(content)
    for link in children(root, "link"):
        if link.get("name") in massless:
            for old in list(children(link, "inertial")):
                link.remove(old)
            link.append(_made_up_inertial(link.get("name") or ""))
    links = f"{len(massless)} links" if len(massless) > 1 else f'link "{next(iter(massless))}"'
    everywhere = len(massless) == len(tree.links)
    reason = "the file gives no mass at all" if everywhere else "joints move them without any mass"
    note = f"inertias were made up for {links} of the generated package only, because {reason}"
    return CompletedSource(_bytes(root), (note,))


def _fill(parent: Element, tag: str, values: Mapping[str, str], filled: Counter[str]) -> None:
    """Give the children of that name the attributes that they lack, and count those that lacked any."""
    for element in children(parent, tag):
        missing = [name for name in values if element.get(name) is None]
        for name in missing:
            element.set(name, values[name])
        if missing:
            filled[tag] += 1


def _massless_links(tree: KinematicTree) -> set[str]:
    """Links below moving joints that carry no mass, those joints' own links included."""
    massive = {link.name for link in tree.links if link.inertial and link.inertial.mass > 0}
    for joint in reversed(tree.joints):  # from the leaves to the root
        if joint.child in massive:
            massive.add(joint.parent)
    massless = {tree.links[0].name} - massive
    for joint in tree.joints:
        if joint.child not in massive and (joint.type != "fixed" or joint.parent in massless):
            massless.add(joint.child)
    return massless


def _made_up_inertial(link: str) -> Element:
    """Mass properties of equal masses at random places, in a frame that is turned and off-centre."""
    draw = random.Random(link)  # noqa: S311 - the link's name decides, so the numbers are the same everywhere
    mass = round(draw.uniform(0.5, 3), 3)
    points = [[draw.uniform(-0.15, 0.15) for _ in range(3)] for _ in range(_POINTS)]
    tensor = {}
    for name in _TENSOR:
        i, j = ("xyz".index(letter) for letter in name[1:])
        products = sum((i == j) * sum(x * x for x in point) - point[i] * point[j] for point in points)
        tensor[name] = repr(round(products * mass / _POINTS, 6))
    element = etree.Element("inertial")
    xyz, rpy = (" ".join(repr(round(draw.uniform(-reach, reach), 3)) for _ in range(3)) for reach in (0.1, 1))
    etree.SubElement(element, "origin", xyz=xyz, rpy=rpy)
    etree.SubElement(element, "mass", value=repr(mass))
    etree.SubElement(element, "inertia", tensor)
    return element


def _bytes(root: Element) -> bytes:
    return etree.tostring(root, encoding="UTF-8", xml_declaration=True)
