"""Pinocchio's own reading of a URDF: nothing of ours is between the file and the reference but its XML.

Two things are added, since Pinocchio's reader leaves them out: `mimic` elements, taken from the XML, and planar
joints about any axis. The latter are given to it as two sliding joints and a turning one with massless links
between them; the first direction is the x axis, or y where the normal is close to x, at right angles to the normal.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import tostring

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.extras import install_command
from urdfsync.urdf.parse import xml
from urdfsync.urdf.physics.free_joints import SplitJoint, split_planar


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
    split_joints: Mapping[str, SplitJoint]
    """By joint: those that stand for it."""


def read(content: bytes, file: str) -> PinocchioRobot:
    """Read a URDF with Pinocchio. Raises SourceError if Pinocchio is not installed or refuses the file."""
    pin = pinocchio()
    root = xml.parse(content).root
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
    followers: dict[str, Follower] = {}
    split_joints: dict[str, SplitJoint] = {}
    for joint in root.findall("joint"):
        name = joint.get("name", "")
        for mimic in joint.findall("mimic"):
            multiplier, offset = float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
            followers[name] = Follower(mimic.get("joint", ""), multiplier, offset)
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


def pinocchio() -> Any:
    """The library; raises SourceError if it is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio
