"""Copies a URDF for Pinocchio, with a mass behind every moving joint.

Pinocchio's reader refuses or leaves out some elements that urdfsync reads with a warning. Of a joint without a mass
behind it, only the kinematics could be compared. The copy is the source of both package and reference.
"""

from __future__ import annotations

import contextlib
import random
from collections.abc import Collection
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.robot import Inertia
from urdfsync.formats.urdf.second.companions import Companions
from urdfsync.formats.urdf.second.plain import plain_urdf

_NEEDED = {
    "joint/axis": {"xyz": "1 0 0"},
    "joint/limit": {"effort": "1000", "velocity": "1000"},
    "joint/safety_controller": {"k_velocity": "0"},
    "link/inertial/mass": {"value": "0"},
    "link/inertial/inertia": dict.fromkeys(Inertia.__struct_fields__, "0"),
}
"""Attributes that Pinocchio's reader requires."""
_NOTHING = Companions()
_PER_MASS = (0.013, 0.002, -0.003, 0.016, 0.001, 0.012)
"""Made-up inertia tensor of 1 kg, in the order of `Inertia`'s fields: not diagonal, and physically possible."""


class CompletedSource(NamedTuple):
    """A copy of a URDF, and notes on its changes, without full stops. A complete URDF is copied unchanged."""

    content: bytes
    notes: tuple[str, ...] = ()


def completed_for_reference(
    content: bytes, joints: Collection[str] | None = None, companions: Companions = _NOTHING
) -> CompletedSource:
    """Return the URDF in UTF-8, with the elements and attributes that Pinocchio's reader requires.

    `joints` are the names of the joints in the first reading, see `plain_root`. The copy has the statements of a YAML,
    but not the gears of a catalogue.
    """
    root = xml.parse(content := plain_urdf(content, joints, companions)).root
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
    notes = (f"additions for the reference's reader: {', '.join(sorted(added))}",) if added else ()
    return CompletedSource(tostring(root, "UTF-8", xml_declaration=True), notes)


def with_inertias(content: bytes, tree: KinematicTree) -> CompletedSource:
    """Return the URDF with made-up inertias in all links behind a moving joint without a mass.

    The root link counts as moving: a robot without a mass gets inertias in all links.
    """
    massless, root = _massless_links(tree), xml.parse(content).root
    if not massless:
        return CompletedSource(content)
    for link in root.findall("link"):
        if (name := link.get("name", "")) in massless:
            for old in link.findall("inertial"):
                link.remove(old)
            link.append(_made_up_inertial(name))
    links = f"{len(massless)} links" if len(massless) > 1 else f'link "{next(iter(massless))}"'
    note = f"inertias were made up for {links} of the generated package only, since moving links need a mass"
    return CompletedSource(tostring(root, "UTF-8", xml_declaration=True), (note,))


def _massless_links(tree: KinematicTree) -> set[str]:
    """Return the child of each moving joint without a mass behind it, and all links below the child."""
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
    """Return made-up mass and inertia in a turned frame off the centre. No two links get equal numbers."""
    mass = random.Random(link).uniform(0.5, 3)  # noqa: S311 - the link's name is the seed: equal on all machines
    element = Element("inertial")
    SubElement(element, "origin", xyz="0.04 -0.07 0.06", rpy="0.3 -0.8 0.6")
    SubElement(element, "mass", value=repr(round(mass, 3)))
    tensor = zip(Inertia.__struct_fields__, _PER_MASS, strict=True)
    SubElement(element, "inertia", {name: repr(round(value * mass, 6)) for name, value in tensor})
    return element
