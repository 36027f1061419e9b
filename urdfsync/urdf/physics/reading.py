"""Pinocchio's own reading of a URDF: nothing of ours is between the file and the reference but its XML.

Two things are added, since Pinocchio's reader leaves them out: `mimic` elements, taken from the XML, and planar
joints about any axis. The latter are given to it as two sliding joints and a turning one with massless links
between them; the first direction is the x axis, or y where the normal is close to x, at right angles to the normal.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

import numpy as np
from numpy.typing import NDArray

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.extras import install_command
from urdfsync.urdf.parse import xml

Array = NDArray[np.float64]

_CLOSE_TO_X = 0.9  # cosine of the angle to x from which on a normal counts as close to it


class Follower(NamedTuple):
    """Position = `multiplier` · position of `leader` + `offset`."""

    leader: str
    multiplier: float
    offset: float


class PinocchioRobot(NamedTuple):
    """What the reference knows of a robot."""

    model: Any
    """Pinocchio's model; its first joint is the free motion of the root link."""
    followers: Mapping[str, Follower]
    """By joint: the mimic elements."""
    planar_parts: Mapping[str, tuple[str, ...]]
    """By planar joint: the three joints that stand for it, from the parent to the child."""


def read(content: bytes, file: str) -> PinocchioRobot:
    """Read a URDF with Pinocchio. Raises SourceError if Pinocchio is not installed or refuses the file."""
    pin = pinocchio()
    root = xml.parse(content).root
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
    followers = {}
    for joint in root.findall("joint"):
        for mimic in joint.findall("mimic"):
            multiplier, offset = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
            followers[joint.get("name", "")] = Follower(mimic.get("joint", ""), multiplier, offset)
    planar = [joint for joint in root.findall("joint") if joint.get("type") == "planar"]
    parts = {joint.get("name", ""): _split_planar(root, joint, unused) for joint in planar}
    text = tostring(root, "unicode") if parts else content.decode("utf-8-sig")
    try:
        model = pin.buildModelFromXML(text, pin.JointModelFreeFlyer(), unused)
    except (ValueError, RuntimeError) as error:
        message = f"Pinocchio can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or compare it without physics"
        raise SourceError(Diagnostic(Severity.ERROR, "pinocchio-refuses", message, file, hint=hint)) from error
    return PinocchioRobot(model, followers, parts)


def pinocchio() -> Any:
    """Return the library; raises SourceError if it is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio


def _split_planar(root: Element, joint: Element, unused: str) -> tuple[str, ...]:
    """Replace a planar joint by three with links between them; return their names. No name contains `unused`."""
    name, axis, parent, child = joint.get("name", ""), joint.find("axis"), joint.find("parent"), joint.find("child")
    parts = name, f"{name}{unused}2", f"{name}{unused}3"
    ends = ["" if end is None else end.get("link", "") for end in (parent, child)]
    ends[1:1] = parts[1:]
    normal = "1 0 0" if axis is None else axis.get("xyz", "1 0 0")
    axes = directions(np.array([float(number) for number in normal.split()]))
    for k, kind in enumerate(("prismatic", "prismatic", "continuous")):
        part = SubElement(root, "joint", name=parts[k], type=kind)
        part.extend(copy.deepcopy(joint.findall("dynamics")))
        if k == 0:
            part.extend(joint.findall("origin"))
        else:
            SubElement(root, "link", name=ends[k])
        SubElement(part, "parent", link=ends[k])
        SubElement(part, "child", link=ends[k + 1])
        SubElement(part, "axis", xyz=" ".join(repr(float(number)) for number in axes[k]))
        SubElement(part, "limit", lower="-1000", upper="1000", effort="1000", velocity="1000")
    root.remove(joint)
    return parts


def directions(normal: Array) -> Array:
    """Return the axes of a planar joint as rows: two in the plane, and the unit vector along `normal`."""
    axis = normal / np.linalg.norm(normal)
    other = np.eye(3)[0 if abs(axis[0]) < _CLOSE_TO_X else 1]
    first = other - (other @ axis) * axis
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(axis, first), axis])
