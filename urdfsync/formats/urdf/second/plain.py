"""Writes a source as plain URDF: SDFormat's elements become attributes, and joints with several axes become chains.

Couplings of ros2_control and of Gazebo's plugins become `<mimic>`. Numbers of the catalogue become attributes of
joints, except the numbers of gears; `read_gears` has these.

The second reader and Pinocchio read the result. The first reader shares only the decoding of bytes.
"""

from __future__ import annotations

import contextlib
import copy
import re
from collections.abc import Collection, Mapping
from typing import Any

from lxml import etree

from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.second.companions import PATHS, CatalogueNumbers, Companions

_ALONE = {"parent": "link", "child": "link", "mass": "value", "axis": "xyz"}
"""Elements whose text SDFormat uses instead of an attribute."""
SHAPES = {
    "box": "size",
    "cylinder": "radius length",
    "capsule": "radius length",
    "sphere": "radius",
    "ellipsoid": "radii",
    "mesh": "",
}
"""Shapes, each with its attributes of numbers; those of a mesh are read apart."""
_HOLDERS = frozenset(("axis", "dynamics", "inertia", "limit", "mimic", "origin", *SHAPES))
"""Elements in which SDFormat uses elements with texts instead of attributes."""


_NOTHING = Companions()


def plain_urdf(content: bytes, joints: Collection[str] | None = None, companions: Companions = _NOTHING) -> bytes:
    """Return a source as plain URDF, with loops and motors of the YAML. A plain URDF is returned unchanged.

    See `plain_root`.
    """
    root = plain_root(content, joints, companions)
    for name, kind, first, second, _ in companions.loops:
        loop = etree.SubElement(root, "loop_joint", name=name, type=kind)
        etree.SubElement(loop, "link1", link=first)
        etree.SubElement(loop, "link2", link=second)
    for joint, _ in companions.motors:
        etree.SubElement(etree.SubElement(root, "transmission", name=joint), "joint", name=joint)
    plain = etree.tostring(root)
    return content if plain == etree.tostring(_parse(content)) else bytes(plain)


def plain_root(content: bytes, joints: Collection[str] | None = None, companions: Companions = _NOTHING) -> Any:
    """Return the root of a source as plain URDF. Loops and motors of the YAML are not in it.

    `joints` are the names of joints in the first reading. A ball joint without such a name becomes a chain of hinges.
    """
    root = _parse(content)
    _replace_joints_of_several_axes(root, joints, companions.axes)
    elements = [element for top in root if top.tag in ("link", "joint") for element in top.iter()]
    for element in elements:
        _write_pose_as_origin(element)
        _write_texts_as_attributes(element)
    _remove_newer(root)
    _write_springs_of_gazebo(root)
    _write_couplings(root)
    _write_rows(root, companions.rows)
    return root


def _replace_joints_of_several_axes(root: Any, names: Collection[str] | None, axes: Mapping[str, str]) -> None:
    """Replace universal joints, joints with several `axes` by the YAML, and ball joints without a name in `names`."""
    for joint in [part for part in root if part.tag in ("joint", "drake:joint")]:
        name, kind = joint.get("name", ""), joint.get("type")
        if joint.tag == "drake:joint" and kind in ("ball", "planar", "universal"):
            joint.tag = "joint"
            if kind == "universal":
                _make_chain(root, joint, "xy", has_damping=True)
        if kind in ("spherical", "ball"):
            joint.set("type", "ball")
            if names is not None and name not in names:
                _make_chain(root, joint, "xyz", has_damping=True)
        if name in axes:
            _make_chain(root, joint, axes[name], has_damping=False)


def _write_pose_as_origin(element: Any) -> None:
    """Write a pose of six numbers as the attributes of an origin."""
    place = next((part for part in element if part.tag in ("origin", "pose")), None)
    numbers = "" if place is None or place.attrib else (place.text or "").split()
    if place is not None and len(numbers) == 6:
        place.tag = "origin"
        place.attrib.update({"xyz": " ".join(numbers[:3]), "rpy": " ".join(numbers[3:])})


def _write_texts_as_attributes(element: Any) -> None:
    """Write the text of an element, or of the elements in it, as attributes. Existing attributes stay.

    SDFormat has limits and losses in `<axis>`; they move to the joint.
    """
    for part in element.xpath("axis/limit | axis/dynamics"):
        if element.find(part.tag) is None:
            element.append(part)
    parts = element if element.tag in _HOLDERS else ()
    texts = {part.tag: part.text for part in parts if not part.attrib and not len(part)}
    if element.tag in _ALONE and not element.attrib:
        texts = texts or {_ALONE[element.tag]: element.text}
    for name, text in texts.items():
        if name not in element.attrib and (text or "").strip():
            element.set(name, text.strip())


def _remove_newer(root: Any) -> None:
    """Remove attributes that the version of the URDF does not have. Drake's spelling counts in any version."""
    version = tuple(map(int, re.findall(r"\d+", root.get("version", "1.0"))[:2]))
    for element in root.xpath("//origin[@quat_xyzw]") if version < (1, 1) else ():
        del element.attrib["quat_xyzw"]
    for limit in root.findall("joint/limit"):
        for name in ("acceleration", "deceleration", "jerk") if version < (1, 2) else ():
            limit.attrib.pop(name, None)
        if acceleration := limit.attrib.pop("drake:acceleration", ""):
            limit.set("acceleration", limit.get("acceleration", acceleration))


def _write_springs_of_gazebo(root: Any) -> None:
    """Write the springs of joints in `<gazebo>` as attributes of `<dynamics>`."""
    for number in root.xpath("gazebo/springStiffness | gazebo/springReference"):
        field = f"spring_{number.tag.removeprefix('spring').lower()}"
        for joint in root.xpath("joint[@name=$name]", name=number.getparent().get("reference", "")):
            if (part := joint.find("dynamics")) is None:
                part = etree.SubElement(joint, "dynamics")
                part.sourceline = joint.sourceline
            if field not in part.attrib:
                part.set(field, (number.get("value") or number.text or "").strip())


def _write_couplings(root: Any) -> None:
    """Write the couplings of ros2_control, then those of Gazebo's plugins, as `<mimic>` of joints that have none."""
    stated = list[tuple[str, Any, Mapping[str, Any], str]]()
    for control in root.findall("ros2_control/joint"):
        params = {param.get("name", ""): param for param in control.iterchildren("param")}
        stated.append((control.get("name", ""), control, params, "mimic"))
    for plugin in root.findall("gazebo/plugin"):
        parts = {part.tag: part for part in plugin}
        leader = "joint" if "joint" in parts else "jointName"
        stated.append(((plugin.findtext("mimicJoint") or "").strip(), plugin, parts, leader))
    for name, place, given, leader in stated:
        texts = {part: (element.get("value") or element.text or "").strip() for part, element in given.items()}
        for joint in root.xpath("joint[@name=$name][not(mimic)]", name=name):
            if texts.get(leader) and joint.get("type") in ("revolute", "continuous", "prismatic"):
                mimic = etree.SubElement(joint, "mimic", joint=texts[leader])
                mimic.sourceline = place.sourceline
                for part in ("multiplier", "offset"):
                    with contextlib.suppress(ValueError):  # an unreadable number is left out
                        mimic.set(part, repr(decimal(texts.get(part, ""))))


def _write_rows(root: Any, rows: Mapping[str, CatalogueNumbers]) -> None:
    """Write the numbers of the catalogue as attributes of joints, except the numbers of gears."""
    for name, row in rows.items():
        for number, size in row.numbers.items():
            tag = PATHS[number].partition(".")[0].replace("limits", "limit")
            for joint in root.xpath("joint[@name=$name]", name=name) if tag != "transmission" else ():
                part = joint.find(tag)
                (etree.SubElement(joint, tag) if part is None else part).set(number, repr(size))


def decimal(text: str) -> float:
    """Return a number. Raises ValueError, even for texts that Python accepts but URDF does not, such as `1_000`."""
    if "_" in text or not text.isascii():
        raise ValueError(text)
    return float(text)


def _parse(content: bytes) -> Any:
    """Return the root, without comments and namespaces. Tags and attributes keep their prefixes."""
    text = re.sub(r"""\sxmlns(:\w+)?\s*=\s*("[^"]*"|'[^']*')""", "", xml.parse(content).text)
    parser = etree.XMLParser(recover=True, resolve_entities=False, remove_comments=True, remove_pis=True)
    return etree.fromstring(text.encode(), parser)


def _make_chain(root: Any, joint: Any, axes: str, *, has_damping: bool) -> None:
    """Replace a joint by hinges about the given axes, with massless links between the hinges. No hinge is driven."""
    root.remove(joint)
    losses = joint.find("dynamics") if has_damping else None
    for part in joint.xpath("axis | limit | dynamics"):
        joint.remove(part)
    damping = "0" if losses is None else losses.get("damping") or losses.findtext("damping", "0")
    if re.search("[1-9]", damping):  # no hinge has friction
        etree.SubElement(joint, "dynamics", damping=damping)
    for end in root.xpath("loop_joint/*[@link=$name]", name=joint.get("name", "")):  # the joint stands for its child
        end.set("link", joint.find("child").get("link"))
    names = [f"{joint.get('name', '')}_{axis}" for axis in axes]
    if not axes:
        joint.set("type", "fixed")
        root.append(joint)
    for number, (name, axis) in enumerate(zip(names, axes, strict=True)):
        root.append(hinge := copy.deepcopy(joint))
        hinge.attrib.update({"name": name, "type": "continuous"})
        for part in hinge.xpath("*[not(self::child or self::dynamics)]") if number else ():
            hinge.remove(part)
        etree.SubElement(hinge, "axis", xyz=" ".join(str(int(axis == other)) for other in "xyz"))
        if number:
            etree.SubElement(hinge, "parent", link=names[number - 1])
        if name != names[-1]:
            for part in hinge.findall("child"):
                hinge.remove(part)
            etree.SubElement(hinge, "child", link=name)
            etree.SubElement(root, "link", name=name).sourceline = joint.sourceline
        control = etree.SubElement(root, "ros2_control", name=name)
        etree.SubElement(etree.SubElement(control, "joint", name=name), "state_interface", name="position")
