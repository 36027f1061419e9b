"""What a child of the root says: a link, a joint, a material, or something that is kept as it is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from urdfsync.urdf.reader.actuated import TAGS, Actuated, read_actuated
from urdfsync.urdf.reader.checks import Finding, check_joint, check_link
from urdfsync.urdf.reader.fields import Element, Findings, extension
from urdfsync.urdf.reader.joint import read_joint
from urdfsync.urdf.reader.link import read_link, read_material
from urdfsync.urdf.reader.xml import Node
from urdfsync.urdf.robot import Extension, Joint, Link, Material

MODELLED = ("link", "joint", "material")
"""Children of the root that are understood."""
_XACRO = ("$", "&", "xacro:")
"""One of these is in each text that has something of xacro; `&` may stand for any character."""
_XACRO_LOGIC = ("macro", "if", "unless", "insert_block")
_TEXTS = ("name", "link", "joint", "filename", "group")
"""Attributes that may hold any text: `${…}` left over in them is odd, but no reason to refuse the robot."""


class Leftover(msgspec.Struct, frozen=True):
    """An element that xacro would have replaced, or one with an expression."""

    tag: str
    line: int
    expression: bool
    grave: bool
    """Whether it stands for a number, or for elements: such a file is not expanded."""


class Part(msgspec.Struct, frozen=True, eq=False):
    """What a child of the root says; its lines, and those of its findings, count from where it begins."""

    read: Link | Joint | Material | None
    """With its axis as written and its material not looked up; None for what is no part of the model."""
    extensions: tuple[Extension, ...]
    faults: tuple[Finding, ...]
    """What checks say of the link or joint by itself."""
    findings: Findings
    leftovers: tuple[Leftover, ...]
    actuated: tuple[Actuated, ...] = ()
    """The joints that a transmission, or an element of ros2_control, drives."""


def read_part(node: Node, path: str, text: str) -> Part:
    """Read a child of the root; `text` is its XML."""
    findings = Findings()
    extensions: list[Extension] = []
    read: Link | Joint | Material | None = None
    faults: Iterable[Finding] = ()
    driven: Iterable[Actuated] = ()
    match node.tag:
        case "link":
            element = Element(node, path, findings)
            named, link = element.text("name"), read_link(element, extensions)
            read, faults = (link, check_link(path, link)) if named else (None, ())
        case "joint":
            element = Element(node, path, findings)
            named, joint = element.text("name"), read_joint(element, extensions)
            read, faults = (joint, check_joint(path, joint)) if named and joint else (None, ())
        case "material":
            read = read_material(Element(node, path, findings))
        case _:
            extensions.append(extension("", node, "robot", MODELLED, findings))
            if node.tag in TAGS:
                driven = read_actuated(Element(node, path, findings))
    left = tuple(_leftovers(node)) if any(sign in text for sign in _XACRO) else ()
    return Part(read, tuple(extensions), tuple(faults), findings, left, tuple(driven))


def _leftovers(child: Node) -> Iterator[Leftover]:
    """What xacro has left in the element or below it."""
    for node in child.walk():
        if node.tag.startswith("xacro:"):
            yield Leftover(node.tag, node.line, expression=False, grave=node.tag[6:] in _XACRO_LOGIC)
        for name, value in node.attributes.items() if child.tag in MODELLED else ():
            if "${" in value or "$(" in value:
                yield Leftover(node.tag, node.line, expression=True, grave=name not in _TEXTS)
