"""Template data of a joint that closes a loop, and what loops change in the data of other files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from msgspec.structs import replace

from urdfsync.modelica.literals import html
from urdfsync.urdf.connectors import free_name, taken_names
from urdfsync.urdf.drives import assembly, can_be_driven
from urdfsync.urdf.kinematics.loops import Closure
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Loop


class LoopData(NamedTuple):
    """The parts of a package that loops change."""

    tree: KinematicTree
    """The robot; joints in loops begin where these are closed."""
    dependent: frozenset[str]
    """Joints whose positions follow from those of others through loops."""
    reaches: Mapping[str, Mapping[str, Any]]
    """Longest way of the sweep in Test, by driven joint in a loop, as a parameter of the start record."""
    closures: Mapping[str, Closure]


def loop_data(tree: KinematicTree, options: Options) -> LoopData:
    """Return the data of a robot's loops; there are no closures if these can't be closed."""
    closed = assembly(tree, options)
    taken, joints, reaches = taken_names(tree), list[Joint](), dict[str, Mapping[str, Any]]()
    for joint in tree.joints:
        name, is_closed = joint.name, joint.name in closed.joints and can_be_driven(joint)
        joints.append(replace(joint, start=closed.positions[name]) if is_closed else joint)
        if name in closed.reach:
            parameter, motion = free_name(tree.joint(name), "Reach", taken), MOTION_KINDS[joint.type]
            reaches[name] = {"parameter": parameter, "name": name, "motion": motion, "way": closed.reach[name]}
    return LoopData(replace(tree, joints=tuple(joints)), closed.dependent, reaches, closed.closures)


def loop_title(loop: Loop) -> str:
    """Return a description of a loop: its kind, its name and its links."""
    return f'{loop.kind} joint "{loop.name}" that closes a loop from link "{loop.parent}" to link "{loop.child}"'


def loop_note(loop: Loop, closure: Closure) -> str:
    """Return the documentation of a loop's model: what it holds, and by which equations."""
    ends = f"<code>{html(loop.child)}</code> at a frame of link <code>{html(loop.parent)}</code>"
    text = f"The loop <code>{html(loop.name)}</code>: a frame of link {ends}, as a {loop.kind} joint holds it."
    if closure.planar:
        text += " The loop is planar: two equations in its plane close it."
    elif closure.weaker:
        text += f" It is {html(closure.weaker)}."
    return text


def loop_record(loop: Loop, closure: Closure) -> dict[str, Any]:
    """Return the numbers of a loop."""
    return {
        "closing": loop,
        "translations": closure.translations,
        "rotations": [u for u, _ in closure.rotations],
        "child_rotations": [v for _, v in closure.rotations],
    }
