"""Writes what is no plain URDF as one, for the programs that check our reading: SDFormat's spelling, Drake's joints.

It shares no code with `fields`, so that one fault can't be in both.
"""

from __future__ import annotations

import copy
from collections.abc import Collection
from xml.etree.ElementTree import Element, SubElement, tostring

from urdfsync.urdf.parse import xml

_ALONE = {"parent": "link", "child": "link", "mass": "value", "axis": "xyz"}
"""Attributes that SDFormat writes as text of an element."""
_NAMES = "xyz lower upper effort velocity damping friction multiplier offset ixx ixy ixz iyy iyz izz".split()


def with_attributes(content: bytes, joints: Collection[str] | None = None) -> bytes:
    """Return a URDF with the texts of its links and joints as attributes; the same bytes if there are none.

    Drake's joints become plain ones. A chain stands for a universal joint, and for a ball that is none of `joints`.
    """
    root, changed = xml.parse(content).root, False
    for joint in [part for part in root if part.tag in ("joint", "drake:joint")]:
        kind, axes = joint.get("type"), ""
        if joint.tag == "drake:joint" and kind in ("ball", "planar", "universal"):
            joint.tag, changed = "joint", True
            axes = "xy" * (kind == "universal")
        if kind in ("spherical", "ball"):
            joint.set("type", "ball")
            axes = "xyz" * (joints is not None and joint.get("name") not in joints)
            changed |= kind == "spherical"
        if axes:
            _make_chain(root, joint, axes)
            changed = True
    for element in (part for tag in ("link", "joint") for top in root.findall(tag) for part in list(top.iter())):
        for axis in element.findall("axis"):
            for part in [part for part in axis if part.tag in ("limit", "dynamics") and element.find(part.tag) is None]:
                axis.remove(part)
                element.append(part)
                changed = True
        pose = element.find("pose") if element.find("origin") is None else element.find("origin")
        if pose is not None and not pose.attrib and len(numbers := (pose.text or "").split()) == 6:
            pose.tag, changed = "origin", True
            pose.attrib.update(xyz=" ".join(numbers[:3]), rpy=" ".join(numbers[3:]))
        texts = {part.tag: part.text for part in element if part.tag in _NAMES}
        texts |= {_ALONE[element.tag]: element.text} if element.tag in _ALONE and not texts else {}
        for name, text in texts.items():
            if name not in element.attrib and (text or "").strip():
                element.set(name, (text or "").strip())
                changed = True
    return tostring(root) if changed else content


def _make_chain(root: Element, joint: Element, axes: str) -> None:
    """Replace a joint by hinges about some axes, with massless links between them; none is driven."""
    root.remove(joint)
    control = SubElement(root, "ros2_control", name=joint.get("name", ""))
    for part in [part for part in joint if part.tag in ("axis", "limit")]:
        joint.remove(part)
    for losses in joint.findall("dynamics"):
        losses.attrib.pop("friction", "")
    names = [f"{joint.get('name')}_{letter}" for letter in axes]
    for number, (name, letter) in enumerate(zip(names, axes, strict=True)):
        root.append(hinge := copy.deepcopy(joint))
        hinge.attrib.update(name=name, type="continuous")
        SubElement(SubElement(control, "joint", name=name), "state_interface", name="position")
        SubElement(hinge, "axis", xyz=" ".join(str(int(letter == other)) for other in "xyz"))
        for part in list(hinge) if number else ():
            if part.tag == "origin":
                hinge.remove(part)
            elif part.tag == "parent":
                part.set("link", names[number - 1])
        if name != names[-1]:
            SubElement(root, "link", name=name)
            for child in hinge.findall("child"):
                child.set("link", name)
