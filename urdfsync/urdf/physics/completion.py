"""Copies of URDF files that Pinocchio can read, and in which every moving joint carries mass.

Pinocchio's reader refuses, or leaves out, elements that urdfsync reads with a warning. And where a moving joint
carries no mass, only its kinematics could be compared. Package and reference are both made from the copy.
"""

from __future__ import annotations

import contextlib
import random
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.parse import xml
from urdfsync.urdf.robot import Inertia

_NEEDED = {
    "joint/limit": {"effort": "1000", "velocity": "1000"},
    "joint/safety_controller": {"k_velocity": "0"},
    "link/inertial/mass": {"value": "0"},
    "link/inertial/inertia": dict.fromkeys(Inertia.__struct_fields__, "0"),
}
"""Attributes that Pinocchio's reader insists on."""
_POINTS = 4  # made-up inertias are those of so many equal masses: not diagonal, and never impossible


class CompletedSource(NamedTuple):
    """A copy of a URDF, the same bytes if nothing is missing, and what was done: sentences without a full stop."""

    content: bytes
    notes: tuple[str, ...] = ()


def completed_for_pinocchio(content: bytes) -> CompletedSource:
    """Return the URDF in UTF-8, with the elements and attributes that Pinocchio's reader insists on."""
    root = xml.parse(content).root
    added = set() if root.get("name") else {"the robot's name"}
    root.set("name", root.get("name") or "robot")
    for joint in root.findall("joint"):
        if joint.get("type") in ("revolute", "prismatic") and joint.find("limit") is None:
            SubElement(joint, "limit", lower="-1000", upper="1000")
    for inertial in root.findall("link/inertial"):
        for tag in ("mass", "inertia"):
            if inertial.find(tag) is None:
                SubElement(inertial, tag)
    for dynamics in root.findall("joint/dynamics"):
        if not dynamics.get("friction") and not dynamics.get("damping"):
            dynamics.set("damping", "0")
            added.add("<dynamics>")
    for path, values in _NEEDED.items():
        for element in root.findall(path):
            if not values.keys() <= element.attrib.keys():
                added.add(f"<{element.tag}>")
                element.attrib.update(values | element.attrib)
    with contextlib.suppress(UnicodeDecodeError):
        if not added and "\0" not in content.decode():
            return CompletedSource(content)
    notes = (f"what Pinocchio's reader asks for was added: {', '.join(sorted(added))}",) if added else ()
    return CompletedSource(tostring(root, "UTF-8", xml_declaration=True), notes)


def with_inertias(content: bytes, tree: KinematicTree) -> CompletedSource:
    """Return the URDF with made-up inertias in all links that hang on a moving joint which carries no mass.

    The root link counts as moving: a robot without any mass gets inertias in all its links.
    """
    massless = _massless_links(tree)
    if not massless:
        return CompletedSource(content)
    root = xml.parse(content).root
    for link in root.findall("link"):
        if (name := link.get("name", "")) in massless:
            for old in link.findall("inertial"):
                link.remove(old)
            link.append(_made_up_inertial(name))
    links = f"{len(massless)} links" if len(massless) > 1 else f'link "{next(iter(massless))}"'
    note = f"inertias were made up for {links} of the generated package only, because they move without any mass"
    return CompletedSource(tostring(root, "UTF-8", xml_declaration=True), (note,))


def _massless_links(tree: KinematicTree) -> set[str]:
    """Return the links below moving joints that carry no mass, those joints' own links included."""
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
    """Return mass properties of equal masses at random places, in a frame that is turned and off-centre."""
    draw = random.Random(link)  # noqa: S311 - the link's name decides, so the numbers are the same everywhere
    mass = round(draw.uniform(0.5, 3), 3)
    points = [[draw.uniform(-0.15, 0.15) for _ in range(3)] for _ in range(_POINTS)]
    tensor = {}
    for name in Inertia.__struct_fields__:
        i, j = ("xyz".index(letter) for letter in name[1:])
        products = sum((i == j) * sum(x * x for x in point) - point[i] * point[j] for point in points)
        tensor[name] = repr(round(products * mass / _POINTS, 6))
    element = Element("inertial")
    xyz, rpy = (" ".join(repr(round(draw.uniform(-reach, reach), 3)) for _ in range(3)) for reach in (0.1, 1))
    SubElement(element, "origin", xyz=xyz, rpy=rpy)
    SubElement(element, "mass", value=repr(mass))
    SubElement(element, "inertia", tensor)
    return element
