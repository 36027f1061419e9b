"""Pinocchio's own reading of a URDF: nothing of ours is between the file and the reference but its XML.

Two things are added, since Pinocchio's reader leaves them out: `mimic` elements, taken from the XML, and planar
joints about any axis. The latter are given to it as two sliding joints and a turning one with massless links
between them; the first direction is the x axis, or y where the normal is close to x, at right angles to the normal.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.extras import install_command
from urdfsync.urdf.parse import xml
from urdfsync.urdf.physics.completion import Element, attribute, children

Array = NDArray[np.float64]

_CLOSE_TO_X = 0.9  # cosine of the angle to x from which on a normal counts as close to it


class Follower(NamedTuple):
    """Position = `multiplier` · position of `leader` + `offset`."""

    leader: str
    multiplier: float
    offset: float


class Plane(NamedTuple):
    """A planar joint as Pinocchio has it."""

    parts: tuple[str, str, str]
    """Names of the joints that stand for it: two slide, the last one turns."""
    axes: Array
    """Their axes as rows, resolved in the joint frame."""


class PinocchioRobot(NamedTuple):
    """What the reference knows of a robot."""

    model: Any
    """Pinocchio's model; its first joint is the free motion of the root link."""
    followers: Mapping[str, Follower]
    """By joint: the mimic elements."""
    planes: Mapping[str, Plane]
    """By planar joint."""


def read(content: bytes, file: str) -> PinocchioRobot:
    """Read a URDF with Pinocchio. Raises SourceError if Pinocchio is not installed or refuses the file."""
    pin = pinocchio()
    root = xml.parse_tree(content)
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter("{*}link", "{*}joint")))
    joints = {joint.get("name", ""): joint for joint in children(root, "joint")}
    followers, planes = {}, {}
    for name, joint in joints.items():
        for mimic in children(joint, "mimic"):
            multiplier, offset = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
            followers[name] = Follower(mimic.get("joint", ""), multiplier, offset)
        if joint.get("type") == "planar":
            normal = np.array([float(number) for number in attribute(joint, "axis", "xyz", "1 0 0").split()])
            planes[name] = Plane((name, f"{name}{unused}2", f"{name}{unused}3"), directions(normal))
    for name, plane in planes.items():
        _split(root, joints[name], plane)
    text = etree.tostring(root, encoding="unicode") if planes else content.decode("utf-8-sig")
    try:
        model = pin.buildModelFromXML(text, pin.JointModelFreeFlyer(), unused)
    except (ValueError, RuntimeError) as error:
        message = f"Pinocchio can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or compare it without physics"
        raise SourceError(Diagnostic(Severity.ERROR, "pinocchio-refuses", message, file, hint=hint)) from error
    return PinocchioRobot(model, followers, planes)


def pinocchio() -> Any:
    """The library; raises SourceError if it is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio


def directions(normal: Array) -> Array:
    """The axes of a planar joint as rows: two in the plane, and the unit vector along `normal`."""
    axis = normal / np.linalg.norm(normal)
    other = np.eye(3)[0 if abs(axis[0]) < _CLOSE_TO_X else 1]
    first = other - (other @ axis) * axis
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(axis, first), axis])


def _split(root: Element, joint: Element, plane: Plane) -> None:
    """Replace a planar joint by three with one axis each, and two massless links."""
    ends = [attribute(joint, "parent", "link"), *plane.parts[1:], attribute(joint, "child", "link")]
    for k, (name, kind) in enumerate(zip(plane.parts, ("prismatic", "prismatic", "continuous"), strict=True)):
        part = etree.SubElement(root, "joint", name=name, type=kind)
        part.extend(copy.deepcopy(list(children(joint, "dynamics"))))
        if k == 0:
            part.extend(copy.deepcopy(list(children(joint, "origin"))))
        else:
            etree.SubElement(root, "link", name=ends[k])
        etree.SubElement(part, "parent", link=ends[k])
        etree.SubElement(part, "child", link=ends[k + 1])
        etree.SubElement(part, "axis", xyz=" ".join(repr(float(number)) for number in plane.axes[k]))
        etree.SubElement(part, "limit", lower="-1000", upper="1000", effort="1000", velocity="1000")
    root.remove(joint)
