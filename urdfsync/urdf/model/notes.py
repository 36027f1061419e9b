"""Titles and documentation texts of generated classes."""

from __future__ import annotations

from urdfsync.modelica.literals import html
from urdfsync.urdf.robot import Joint

_EDIT = "This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else."

_GENERIC = "<code>UrdfSync.Robots.GenericRobot</code>"

_COPY = (
    "Where the package has models of the links and joints, these read the records of their elements, and the numbers "
    "here are a copy: an edit here changes no such model."
)

_MOTIONS = {
    "fixed": "does not move",
    "continuous": "turns without end stops",
    "revolute": "turns within its limits",
    "prismatic": "slides within its limits",
    "planar": "slides in a plane and turns about its normal",
    "floating": "moves freely",
}


def package_note(name: str, *, bench: bool) -> str:
    """Documentation of a robot's package, as HTML; with a `bench`, the generic robot reads the record in it."""
    text = "Made by urdfsync from a URDF. "
    if bench:
        text += f"<code>{name}Generic</code> simulates the robot as {_GENERIC} reads it from "
        text += f"<code>{name}Parameters</code>. "
    text += "Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports "
    return text + "where both changed."


def link_note(name: str) -> str:
    """Documentation of a link's model, as HTML."""
    return f"Rigid body, visuals and collisions of the URDF link <code>{html(name)}</code>. {_EDIT}"


def joint_title(joint: Joint) -> str:
    """What a joint is, in words."""
    return f'{joint.type} joint "{joint.name}" from link "{joint.parent}" to link "{joint.child}"'


def joint_note(joint: Joint) -> str:
    """Documentation of a joint's model, as HTML."""
    ends = f"<code>{html(joint.child)}</code> relative to link <code>{html(joint.parent)}</code>"
    return f"The URDF joint <code>{html(joint.name)}</code>: link {ends} {_MOTIONS[joint.type]}. {_EDIT}"


def robot_note(name: str) -> str:
    """Documentation of the robot model, as HTML."""
    return (
        f"Links and joints of robot {name}, connected. Each can be exchanged in a model that extends this one. A drive "
        "of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. "
        f"{_EDIT}"
    )


def record_note(name: str, generic: bool) -> str:
    """Documentation of the record of the whole robot, as HTML."""
    numbers = f"All numbers of robot {name} in one record"
    if not generic:
        reason = "since a joint is planar or floating"
        return f"{numbers}, for studies that need them all. {_GENERIC} can't take it, {reason}. {_COPY}"
    return (
        f"{numbers}, with the tables by which {_GENERIC} reads how links and joints hang together. The tables refer to "
        f"the numbers below them. {_COPY}"
    )


def generic_note(name: str, base: str) -> str:
    """Documentation of the Generic model, as HTML."""
    text = f"Robot {name} as {_GENERIC} reads it from its record. It simulates without inputs: every axis moves inside "
    text += "its limits and comes back. "
    if base == "floating":
        text += "The generic robot touches nothing, so nothing holds it: it falls. "
    return text + _EDIT


def run_note(name: str) -> str:
    """Documentation of the Run model, as HTML."""
    return (
        f"Robot {name} in its world, with one input per axis for its position and one output for what its drive has "
        f"to give. The inputs are filtered, so that they need no derivatives. {_EDIT}"
    )


def test_note(name: str) -> str:
    """Documentation of the Test model, as HTML."""
    return (
        f"Simulates without inputs: every axis of robot {name} moves inside its limits and comes back. A warning in "
        "the log names a joint that passes one of its limits all the same, for example that of its effort. " + _EDIT
    )
