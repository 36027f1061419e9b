"""Template data of a joint that closes a loop, and the data of loops in other files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from urdfsync.formats.urdf.connectors import free_name, taken_names
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops, Closure
from urdfsync.formats.urdf.robot import MOTION_KINDS, Loop
from urdfsync.modelica.literals import html


def loop_reaches(closed: ClosedLoops) -> Mapping[str, Mapping[str, Any]]:
    """Return for each driven joint in a loop the distance that Test moves it: a parameter of the start record."""
    if not closed.reach:
        return {}
    tree, taken = closed.tree, taken_names(closed.tree)
    return {
        joint.name: {
            "parameter": free_name(tree.joint(joint.name), "Reach", taken),
            "name": joint.name,
            "motion": MOTION_KINDS[joint.type],
            "way": closed.reach[joint.name],
        }
        for joint in tree.joints
        if joint.name in closed.reach
    }


def loop_title(loop: Loop) -> str:
    """Return a description of a loop: its kind, its name and its links."""
    return f'{loop.kind} joint "{loop.name}" that closes a loop from link "{loop.parent}" to link "{loop.child}"'


def loop_note(loop: Loop, closure: Closure) -> str:
    """Return the documentation of a loop's model: its constraints and equations."""
    ends = f"<code>{html(loop.child)}</code> at a frame of link <code>{html(loop.parent)}</code>"
    text = f"The loop <code>{html(loop.name)}</code>: a frame of link {ends}, as a {loop.kind} joint holds it."
    if closure.planar:
        text += " The loop is planar: two equations in its plane close it."
    elif closure.weaker:
        text += f" It is {html(closure.weaker)}."
    return text
