"""Joints that nothing drives: how each kind begins, what Pinocchio has for it, and its state there.

Planar and floating joints have no drives in generated packages: they begin with the positions and speeds of `Planar`
and `Floating`, and move as the forces want. Pinocchio's reader knows floating joints, but leaves out planar ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias
from xml.etree.ElementTree import Element, SubElement

import numpy as np
from numpy.typing import NDArray

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.physics import motion
from urdfsync.urdf.robot import Joint, Vector

Array = NDArray[np.float64]

_PARTS = ("prismatic", "prismatic", "continuous")
"""Types of the joints that stand for a planar one."""
_CLOSE_TO_X = 0.9  # cosine of the angle to x from which on a normal counts as close to it


class Planar(NamedTuple):
    """Start of a planar joint: along its two directions (m, m/s), and about the normal (rad, rad/s)."""

    s: tuple[float, float]
    v: tuple[float, float]
    phi: float
    w: float


class Floating(NamedTuple):
    """Start of a floating joint, resolved in the joint frame: m, rad (roll, pitch, yaw), m/s and rad/s."""

    r: Vector
    rpy: Vector
    v: Vector
    w: Vector


Start: TypeAlias = Planar | Floating
"""Its fields are the parameters `s_start`, … of the joint's model."""


class SplitJoint(NamedTuple):
    """A joint that Pinocchio's reader leaves out, as it is given to it: several with one axis each."""

    parts: tuple[str, ...]
    """Their names, from the parent to the child."""
    axes: Array
    """Their axes as rows, resolved in the joint frame."""


class FrameMotion(NamedTuple):
    """How a frame moves in another one, such as the world or the frame of a joint; all resolved in the other one."""

    place: Array
    axes: Array
    """The axes of the frame as columns."""
    velocity: Array
    turning: Array
    """Angular velocity."""


def free_joints(tree: KinematicTree) -> tuple[Joint, ...]:
    """Joints without a drive, each after those that carry it."""
    return tuple(obstacles(tree.joints))


def duration(tree: KinematicTree) -> float:
    """End of the motion, in s."""
    return motion.INSTANT if any(joint.type == "floating" for joint in tree.joints) else motion.DURATION


def free_start(joint: Joint) -> Start:
    """Where a planar or floating joint begins, and how fast."""
    draw = motion.random_numbers(joint)

    def vector() -> Vector:
        return motion.signed(draw, 0.1, 0.6), motion.signed(draw, 0.1, 0.6), motion.signed(draw, 0.1, 0.6)

    if joint.type == "planar":
        (x, y, v_x), (v_y, phi, w) = vector(), vector()
        return Planar((x, y), (v_x, v_y), phi, w)
    return Floating(vector(), vector(), vector(), vector())


# --- as Pinocchio has them ----------------------------------------------------------------------------------------


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


def start_motion(pin: Any, start: Start, split: SplitJoint | None) -> FrameMotion:
    """Return how the child of a free joint begins to move in the joint frame; `pin` is Pinocchio."""
    if isinstance(start, Floating) or split is None:
        r, rpy, v, w = map(np.array, start)
        return FrameMotion(r, pin.rpy.rpyToMatrix(*rpy), v, w)
    x, y, normal = split.axes
    place, velocity = (part[0] * x + part[1] * y for part in (start.s, start.v))
    return FrameMotion(place, pin.exp3(start.phi * normal), velocity, start.w * normal)


def coordinates(pin: Any, frame: FrameMotion, split: SplitJoint | None) -> Sequence[tuple[Sequence[float], ...]]:
    """Return q and v of each joint of Pinocchio that stands for a free one; `frame` is its child in the joint frame."""
    place, axes, velocity, turning = frame
    if split is None:
        attitude = pin.Quaternion(axes).normalized().coeffs()
        return [((*place, *attitude), (*axes.T @ velocity, *axes.T @ turning))]
    x, y, normal = split.axes
    cosine, sine = x @ axes @ x, y @ axes @ x
    turn = np.array([cosine, sine]) / np.hypot(cosine, sine)
    slides = [((x @ place,), (x @ velocity,)), ((y @ place,), (y @ velocity,))]
    return [*slides, (tuple(turn), (normal @ turning,))]
