"""Makes chains of hinges of joints with several axes: those of a YAML, Drake's universal joints, and balls in loops."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from xml.etree.ElementTree import Element

from msgspec.structs import replace

from urdfsync.formats.urdf.kinematics.poses import AXES
from urdfsync.formats.urdf.parse.closures import Closures
from urdfsync.formats.urdf.parse.fields import Reader, quoted
from urdfsync.formats.urdf.robot import Dynamics, Joint, Link, Loop

_DIRECTIONS = dict(zip("xyz", AXES, strict=True))
_DRAKE = {"ball": "", "planar": "", "universal": "xy"}
"""Types of `<drake:joint>` with the axes of their chains, by Drake's parser of URDF and its class UniversalJoint."""


def find_axes(reader: Reader, root: Element, closures: Closures) -> Mapping[str, str]:
    """Return the axes of each joint that becomes a chain, such as `xy`.

    The element of such a joint keeps nothing of an axis of its own. Joints of Drake become plain joints.
    """
    axes = dict[str, str]()
    for joint in [part for part in root if part.tag == "drake:joint" and part.get("type") in _DRAKE]:
        joint.tag = "joint"
        if letters := _DRAKE[joint.get("type", "")]:
            axes[joint.get("name", "")] = letters
            _leave_axis_out(joint, "continuous", "axis", "limit")
    joints = {joint.get("name"): joint for joint in root.findall("joint")}
    for name, (letters, line) in closures.axes.items():
        reader.put(f"axes of joint {name}", line, closures.file)
        if name in joints:
            axes[name] = letters
            _leave_axis_out(joints[name], "continuous" if letters else "fixed", "axis", "limit", "dynamics")
        else:
            message = f"there is no joint {quoted(name)}, whose type the file states"
            reader.tell("unknown-reference", f"axes of joint {name}", message)
    return {name: letters for name, letters in axes.items() if letters}


def _leave_axis_out(joint: Element, kind: str, *tags: str) -> None:
    joint.set("type", kind)
    for part in [part for part in joint if part.tag in tags]:
        joint.remove(part)


def split(
    reader: Reader, links: Iterable[Link], joints: Sequence[Joint], axes: Mapping[str, str]
) -> tuple[list[Link], list[Joint]]:
    """Return links and joints with a chain instead of each joint in `axes`: a hinge for each axis, without masses.

    The hinges count as only measured. Each of them has the damping of the joint.
    """
    all_links, all_joints = list(links), [joint for joint in joints if joint.name not in axes]
    for joint in [joint for joint in joints if joint.name in axes]:
        names = [f"{joint.name}_{axis}" for axis in axes[joint.name]]
        damping = joint.dynamics.damping if joint.dynamics else 0.0
        inner, losses = names[:-1], Dynamics(damping) if damping else None
        ends = zip(names, axes[joint.name], [joint.parent, *inner], [*inner, joint.child], strict=True)
        first, *others = (
            Joint(name, "continuous", parent, child, axis=_DIRECTIONS[axis], dynamics=losses, measured=True)
            for name, axis, parent, child in ends
        )
        rest = {"mimic": joint.mimic, "calibration": joint.calibration, "safety_controller": joint.safety_controller}
        all_joints += [replace(first, origin=joint.origin, **rest), *others]
        all_links += map(Link, inner)
        stated = next(path for path in (f"axes of joint {joint.name}", f"joint {joint.name}") if path in reader.lines)
        for path in (*(f"joint {name}" for name in names), *(f"link {name}" for name in inner)):
            own = f"{path} #2" if path in reader.lines else path  # `validate` reports two elements of one name
            reader.put(own, reader.lines[stated], reader.files.get(stated, ""))
    return all_links, all_joints


def find_balls_in_loops(joints: Iterable[Joint], loops: Iterable[Loop]) -> list[str]:
    """Return the names of the ball joints between the two ends of a loop."""
    parents, held = {joint.child: joint for joint in joints}, set[str]()
    balls = [joint.name for joint in parents.values() if joint.type == "ball"]
    for loop in loops if balls else ():
        ways = [set[str](), set[str]()]
        for way, link in zip(ways, (loop.parent, loop.child), strict=True):
            while link in parents:
                way.add(parents[link].name)
                link = parents[link].parent
        held |= ways[0] ^ ways[1]
    return [name for name in balls if name in held]
