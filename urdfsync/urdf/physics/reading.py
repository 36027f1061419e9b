"""Pinocchio's own reading of a URDF: nothing of ours is between the file and the reference but its XML.

Two things are added, since Pinocchio's reader leaves them out: `mimic` elements, taken from the XML, and planar
joints about any axis. The latter are given to it as two sliding joints and a turning one with massless links
between them; the first direction is the x axis, or y where the normal is close to x, at right angles to the normal.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

import numpy as np
from numpy.typing import NDArray

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.extras import install_command
from urdfsync.urdf.parse import xml
from urdfsync.urdf.robot import Mimic

Array = NDArray[np.float64]

_PARTS = ("prismatic", "prismatic", "continuous")
"""Types of the joints that stand for a planar one."""
_CLOSE_TO_X = 0.9  # cosine of the angle to x from which on a normal counts as close to it


class SplitJoint(NamedTuple):
    """A joint that Pinocchio's reader leaves out, as it is given to it: several with one axis each."""

    parts: tuple[str, ...]
    """Their names, from the parent to the child."""
    axes: Array
    """Their axes as rows, resolved in the joint frame."""


class PinocchioRobot(NamedTuple):
    """What the reference knows of a robot."""

    model: Any
    """Pinocchio's model; its first joint is the free motion of the root link."""
    followers: Mapping[str, Mimic]
    """By joint."""
    split_joints: Mapping[str, SplitJoint]
    """By joint: those that stand for it."""


def read(content: bytes, file: str) -> PinocchioRobot:
    """Read a URDF with Pinocchio. Raises SourceError if Pinocchio is not installed or refuses the file."""
    pin = pinocchio()
    root = xml.parse(content).root
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
    followers: dict[str, Mimic] = {}
    split_joints: dict[str, SplitJoint] = {}
    for joint in root.findall("joint"):
        name = joint.get("name", "")
        for mimic in joint.findall("mimic"):
            multiplier, offset = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
            followers[name] = Mimic(mimic.get("joint", ""), multiplier, offset)
        if joint.get("type") == "planar":
            split_joints[name] = split_planar(root, joint, unused)
    text = tostring(root, "unicode") if split_joints else content.decode("utf-8-sig")
    try:
        model = pin.buildModelFromXML(text, pin.JointModelFreeFlyer(), unused)
    except (ValueError, RuntimeError) as error:
        message = f"Pinocchio can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or compare it without physics"
        raise SourceError(Diagnostic(Severity.ERROR, "pinocchio-refuses", message, file, hint=hint)) from error
    return PinocchioRobot(model, followers, split_joints)


def directions(normal: Array) -> Array:
    """The axes of a planar joint as rows: two in the plane, and the unit vector along `normal`."""
    axis = normal / np.linalg.norm(normal)
    other = np.eye(3)[0 if abs(axis[0]) < _CLOSE_TO_X else 1]
    first = other - (other @ axis) * axis
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(axis, first), axis])


def split_planar(root: Element, joint: Element, unused: str) -> SplitJoint:
    """Replace a planar joint of a URDF by several, with massless links between them. No name contains `unused`."""
    name = joint.get("name", "")
    parent, child, axis = (joint.find(tag) for tag in ("parent", "child", "axis"))
    normal = np.array([1.0, 0.0, 0.0] if axis is None else axis.get("xyz", "1 0 0").split(), dtype=float)
    split = SplitJoint((name, f"{name}{unused}2", f"{name}{unused}3"), directions(normal))
    first, last = ("" if end is None else end.get("link", "") for end in (parent, child))
    ends = [first, *split.parts[1:], last]
    for k, kind in enumerate(_PARTS):
        part = SubElement(root, "joint", name=split.parts[k], type=kind)
        part.extend(joint.findall("dynamics"))
        if k == 0:
            part.extend(joint.findall("origin"))
        else:
            SubElement(root, "link", name=ends[k])
        SubElement(part, "parent", link=ends[k])
        SubElement(part, "child", link=ends[k + 1])
        SubElement(part, "axis", xyz=" ".join(repr(float(number)) for number in split.axes[k]))
        SubElement(part, "limit", lower="-1000", upper="1000", effort="1000", velocity="1000")
    root.remove(joint)
    return split


def pinocchio() -> Any:
    """The library; raises SourceError if it is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio
