"""Reads which joints a source calls actuated.

Two elements of the robot say so: `<transmission>` by the joints in it, and `<ros2_control>` by the joints in it that
have a `<command_interface>` (those without one are only measured) and by its own transmissions. Both stay extensions
as well: nothing else of them is read.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

import msgspec

from urdfsync.diagnostics import Severity
from urdfsync.urdf.reader.checks import Finding, nearest
from urdfsync.urdf.reader.fields import Element
from urdfsync.urdf.reader.xml import Node

TAGS = ("transmission", "ros2_control")
"""Children of the root that may name actuated joints."""


class Actuated(msgspec.Struct, frozen=True):
    """A joint that an element of the source drives, whether the robot has that joint or not."""

    joint: str
    path: str
    """Of the place that names it, as in findings: `transmission wheel_trans / joint wheel`."""


def read_actuated(element: Element) -> Iterator[Actuated]:
    """The joints that a transmission, or an element of ros2_control, drives."""
    for joint in _driven(element.node):
        if name := joint.attributes.get("name", ""):
            place = Element(joint, f"{element.path} / joint {name}", element.findings)
            yield Actuated(name, place.path)


def check_actuated(actuated: Iterable[Actuated], joints: Collection[str]) -> Iterator[Finding]:
    """A warning for each joint that does not exist: after a slip, the joint that is meant would count as passive."""
    for named in actuated:
        if named.joint not in joints:
            element = named.path.partition(" / ")[0]
            meant = nearest(named.joint, joints)
            hint = f"perhaps {meant!r} is meant" if meant else "correct its name, or take it out"
            message = f"{element} drives joint {named.joint!r}, which does not exist"
            yield Finding(Severity.WARNING, "unknown-actuated-joint", named.path, message, hint)


def _driven(node: Node) -> Iterator[Node]:
    """The `<joint>` elements of joints that are driven."""
    for child in node.children:
        if child.tag == "transmission" and node.tag == "ros2_control":
            yield from _driven(child)
        elif child.tag == "joint" and (node.tag == "transmission" or _has_command(child)):
            yield child


def _has_command(joint: Node) -> bool:
    """Whether ros2_control can move a joint, and not only measure it."""
    return any(child.tag == "command_interface" for child in joint.children)
