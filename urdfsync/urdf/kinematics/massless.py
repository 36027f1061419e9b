"""Find joints that move no mass where each joint is at its start: nothing defines their motion in a simulation."""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet

import msgspec

from urdfsync.urdf.kinematics.poses import Pose, compose, dot, link_poses, pose, start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Link, Motion, Vector

_ROUNDING = 1e-6  # of angles, and of lengths in relation to where they are
_ROUNDING_SQUARED = _ROUNDING**2


class Massless(enum.Enum):
    """Why a joint moves no mass."""

    NOTHING_BEHIND = enum.auto()
    """No link behind the joint has a mass; of a joint that turns, none has an inertia either."""
    ON_AXIS = enum.auto()
    """All that is behind the joint lies on its axis, and has no inertia about it."""
    UNDONE = enum.auto()
    """A joint behind it on the same axis can undo its motion, with no mass between the two."""


class _Axis(msgspec.Struct, frozen=True):
    """The axis of a joint at the start, in the frame of the root link; `direction` is a unit vector."""

    motion: Motion
    point: Vector
    direction: Vector

    def is_same(self, other: _Axis) -> bool:
        """Return whether two joints move in the same way: about one line, or in one direction."""
        if self.motion != other.motion or _length(_cross(self.direction, other.direction)) > _ROUNDING:
            return False
        return self.motion == "translational" or not self._is_off(other.point)

    def moves(self, link: Link, at: Pose) -> bool:
        """Return whether the link, which is at that pose, has a mass or inertia that the joint has to move."""
        inertial = link.inertial
        if inertial is None:
            return False
        if self.motion == "translational":
            return inertial.mass > 0
        rotation, centre = compose(at, pose(inertial.origin))
        x, y, z = (dot(column, self.direction) for column in zip(*rotation, strict=True))
        i = inertial.inertia
        moment = i.ixx * x * x + i.iyy * y * y + i.izz * z * z + 2 * (i.ixy * x * y + i.ixz * x * z + i.iyz * y * z)
        if moment > _ROUNDING_SQUARED * (i.ixx + i.iyy + i.izz):
            return True
        return inertial.mass > 0 and self._is_off(centre)

    def _is_off(self, point: Vector) -> bool:
        lever = _length(_cross(_difference(point, self.point), self.direction))
        return lever > _ROUNDING * (_length(point) + _length(self.point))


def find_massless_joints(tree: KinematicTree, free: AbstractSet[str] | None = None) -> Mapping[str, Massless]:
    """Return the joints with an axis that move no mass, by name in canonical order, and why.

    Joints that follow others are left out; what they move counts for their leader. Joints that are not `free` move as
    prescribed, so that they undo no motion; None for all.
    """
    poses, children = link_poses(tree, start_positions(tree)), tree.children()
    links = {link.name: link for link in tree.links}
    axes = {joint.name: _axis(joint, poses) for joint in tree.joints if joint.type in MOTION_KINDS}
    followers = tree.followers_by_leader()
    single = {name for name in axes if name not in followers} - {joint.name for joint, _ in tree.followers()}
    free = single if free is None else single & free

    def moves_something(joint: Joint, undone: bool = False) -> bool:
        """Return whether the joint moves a mass; with `undone`, not what is behind a free joint on the same axis."""
        axis, waiting = axes[joint.name], [joint.child]
        while waiting:
            link = waiting.pop()
            if axis.moves(links[link], poses[link]):
                return True
            waiting += [
                other.child
                for other in children.get(link, ())
                if not (undone and other.name in free and axis.is_same(axes[other.name]))
            ]
        moved = (follower for follower, mimic in followers.get(joint.name, ()) if mimic.multiplier)
        return any(map(moves_something, moved))

    heavy = _heavy_links(tree)
    found: dict[str, Massless] = {}
    for joint in tree.joints:
        if joint.name not in axes or joint.mimic is not None:
            continue
        if not moves_something(joint):
            turns_something = joint.child in heavy and axes[joint.name].motion == "rotational"
            found[joint.name] = Massless.ON_AXIS if turns_something else Massless.NOTHING_BEHIND
        elif joint.name in free and not moves_something(joint, undone=True):
            found[joint.name] = Massless.UNDONE
    return found


def has_mass(link: Link) -> bool:
    """Return whether a link has a mass or an inertia."""
    inertial = link.inertial
    return inertial is not None and any(
        (inertial.mass, inertial.inertia.ixx, inertial.inertia.iyy, inertial.inertia.izz)
    )


def _heavy_links(tree: KinematicTree) -> set[str]:
    """Return the names of links that have a mass or an inertia, or carry one that has."""
    heavy = {link.name for link in tree.links if has_mass(link)}
    for joint in reversed(tree.joints):
        if joint.child in heavy:
            heavy.add(joint.parent)
    return heavy


def _axis(joint: Joint, poses: Mapping[str, Pose]) -> _Axis:
    rotation, point = compose(poses[joint.parent], pose(joint.origin))
    x, y, z = (dot(row, joint.axis) for row in rotation)
    return _Axis(MOTION_KINDS[joint.type], point, (x, y, z))


def _difference(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _length(vector: Sequence[float]) -> float:
    return math.hypot(*vector)
