"""Finds joints that move no mass at the start: nothing determines the motion of such a joint in a simulation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from collections.abc import Set as AbstractSet

import msgspec

from urdfsync.formats.urdf.kinematics.poses import Pose, compose, dot, link_poses, pose, start_positions
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint, Link, Motion, Vector, reflected_inertia

_ROUNDING = 1e-6  # of angles in rad, and of lengths relative to the distance from the root


class _Axis(msgspec.Struct, frozen=True):
    """The axis of a joint at the start, in the frame of the root link; `direction` is a unit vector."""

    motion: Motion
    point: Vector
    direction: Vector

    def is_same(self, other: _Axis) -> bool:
        """Return whether two joints have the same motion: about one line, or in one direction."""
        if self.motion != other.motion or math.hypot(*_cross(self.direction, other.direction)) > _ROUNDING:
            return False
        return self.motion == "translational" or not self._is_off(other.point)

    def moves(self, link: Link, at: Pose) -> bool:
        """Return whether the joint has to move a mass or inertia of the link at this pose."""
        inertial = link.inertial
        if inertial is None:
            return False
        if self.motion == "translational":
            return inertial.mass > 0
        rotation, centre = compose(at, pose(inertial.origin))
        x, y, z = (dot(column, self.direction) for column in zip(*rotation, strict=True))
        i = inertial.inertia
        # if the axis deviates from a rod by a small angle, the moment is the square of the angle times the rod's moment
        moment = i.ixx * x * x + i.iyy * y * y + i.izz * z * z + 2 * (i.ixy * x * y + i.ixz * x * z + i.iyz * y * z)
        return moment > _ROUNDING**2 * (i.ixx + i.iyy + i.izz) or (inertial.mass > 0 and self._is_off(centre))

    def _is_off(self, point: Vector) -> bool:
        lever = [coordinate - origin for coordinate, origin in zip(point, self.point, strict=True)]
        return math.hypot(*_cross(lever, self.direction)) > _ROUNDING * (math.hypot(*point) + math.hypot(*self.point))


def find_massless_joints(tree: KinematicTree, passive: AbstractSet[str] | None = None) -> Sequence[str]:
    """Return the names of the joints that move no mass, in canonical order.

    `passive` are joints without a drive; None for all. A joint is massless if no link below has inertia about the
    joint's axis, and the drive adds no inertia. Links below a passive joint on the same axis do not count, since they
    can stand still. Links that a follower moves count for its leader; followers are not in the result.
    """
    poses, children = link_poses(tree, start_positions(tree)), tree.children()
    links = {link.name: link for link in tree.links}
    axes: dict[str, _Axis] = {}
    for joint in tree.joints:
        if joint.type in MOTION_KINDS:
            rotation, point = compose(poses[joint.parent], pose(joint.origin))
            x, y, z = (dot(row, joint.axis) for row in rotation)
            axes[joint.name] = _Axis(MOTION_KINDS[joint.type], point, (x, y, z))
    followers = tree.followers_by_leader()
    heavy = {joint.name for joint in tree.joints if reflected_inertia(joint)}
    single = {name for name in axes if name not in followers} - {joint.name for joint, _ in tree.followers()} - heavy
    loose = single if passive is None else single & passive

    def moves_something(joint: Joint) -> bool:
        axis, waiting = axes[joint.name], [joint.child]
        if joint.name in heavy:
            return True
        while waiting:
            link = waiting.pop()
            if axis.moves(links[link], poses[link]):
                return True
            waiting += [
                other.child
                for other in children.get(link, ())
                if not ({joint.name, other.name} <= loose and axis.is_same(axes[other.name]))
            ]
        return any(moves_something(follower) for follower, mimic in followers.get(joint.name, ()) if mimic.multiplier)

    candidates = (joint for joint in tree.joints if joint.name in axes and joint.mimic is None)
    return [joint.name for joint in candidates if not moves_something(joint)]


def _cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
