"""Titles and documentation texts of the generated models of links and joints."""

from __future__ import annotations

from urdfsync.modelica.literals import html
from urdfsync.urdf.robot import JOINT_KINDS, Joint

_EDIT = "This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else."


def link_note(name: str) -> str:
    """Return the documentation of a link's model, as HTML."""
    return f"Rigid body, visuals and collisions of the URDF link <code>{html(name)}</code>. {_EDIT}"


def joint_title(joint: Joint) -> str:
    """Return what a joint is, in words."""
    return f'{joint.type} joint "{joint.name}" from link "{joint.parent}" to link "{joint.child}"'


def joint_note(joint: Joint) -> str:
    """Return the documentation of a joint's model, as HTML."""
    ends = f"<code>{html(joint.child)}</code> relative to link <code>{html(joint.parent)}</code>"
    does = JOINT_KINDS[joint.type].does
    return f"The URDF joint <code>{html(joint.name)}</code>: link {ends} {does}. {_EDIT}"
