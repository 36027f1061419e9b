"""What resists the motion of each joint: the diagonal of the mass matrix, at the start."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping

from urdfsync.urdf.kinematics import Pose, compose, dot, link_poses, own_range, pose, start_positions
from urdfsync.urdf.reader.checks import principal_moments
from urdfsync.urdf.robot import Joint, Link, Vector
from urdfsync.urdf.skeleton import MOTIONS, Skeleton

_ROUNDING = 1e-12
"""What is left of terms of this size that cancel each other."""
_CLEAR = 1e-9
"""A moment of inertia above that much of all terms is far from rounding."""


@dataclasses.dataclass(frozen=True, slots=True)
class _Body:
    """Mass (kg), mass times centre of mass (kg.m), inertia about the origin (kg.m2); in the frame of the root link."""

    mass: float = 0.0
    moment: Vector = (0.0, 0.0, 0.0)
    inertia: tuple[Vector, Vector, Vector] = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    def __add__(self, other: _Body) -> _Body:
        rows = zip(self.inertia, other.inertia, strict=True)
        return _Body(self.mass + other.mass, _sum(self.moment, other.moment), tuple(_sum(*row) for row in rows))  # type: ignore[arg-type]

    def about(self, point: Vector, axis: Vector) -> float:
        """Moment of inertia about an axis through a point; 0 if it is but rounding.

        The sum of m |(r - p) x n|^2 over all its points r, n being a unit vector, multiplied out.
        """
        lever = _cross(point, axis)
        terms = (
            dot(axis, tuple(dot(row, axis) for row in self.inertia)),
            -2 * dot(_cross(self.moment, axis), lever),
            self.mass * dot(lever, lever),
        )
        found = sum(terms)
        return found if found > _ROUNDING * sum(map(abs, terms)) else 0.0


def resistances(skeleton: Skeleton) -> Mapping[str, float]:
    """Mass (kg) or moment of inertia (kg.m2) that each joint with an axis moves, those of its followers included.

    These are the diagonal elements of the mass matrix where each joint is at its start; composite bodies as in
    Featherstone: Rigid Body Dynamics Algorithms, 2008, section 6.2.
    """
    poses = link_poses(skeleton, start_positions(skeleton))
    bodies = {link.name: _body(link, poses[link.name]) for link in skeleton.links}
    for joint in reversed(skeleton.joints):
        bodies[joint.parent] += bodies[joint.child]
    found = {
        joint.name: _moved(joint, poses, bodies[joint.child]) for joint in skeleton.joints if joint.type in MOTIONS
    }
    followers = skeleton.followers_by_leader()
    for joint in reversed(skeleton.leaders_first()):
        for follower, mimic in followers.get(joint.name, ()) if joint.name in found else ():
            found[joint.name] += mimic.multiplier**2 * found[follower.name]
    return found


def unresisted(skeleton: Skeleton) -> set[str]:
    """The joints with an axis, followers left out, whose resistance is 0."""
    axes = [joint for joint in skeleton.joints if joint.type in MOTIONS and joint.mimic is None]
    if _clearly_resisted(skeleton, axes):
        return set()
    found = resistances(skeleton)
    return {joint.name for joint in axes if not found[joint.name]}


def _clearly_resisted(skeleton: Skeleton, axes: Iterable[Joint]) -> bool:
    """Whether a link behind each of these joints has so much inertia that nothing need be added up to see it.

    About any axis, a body has at least its least principal moment of inertia; those of others only add to it.
    """
    least, masses, spread = _least_inertias(skeleton.links)
    if min(least.values()) < 0 or _starts_shifted(skeleton.joints):
        return False
    reach, far = 0.0, {skeleton.links[0].name: 0.0}
    for joint in skeleton.joints:
        far[joint.child] = far[joint.parent] + math.hypot(*joint.origin.xyz)
    for link in skeleton.links:
        if link.inertial is not None:
            reach = max(reach, far[link.name] + math.hypot(*link.inertial.origin.xyz))
    enough = _CLEAR * (spread + 4 * sum(masses.values()) * max(reach, *far.values()) ** 2)  # above all terms of `about`
    for joint in reversed(skeleton.joints):
        masses[joint.parent] = max(masses[joint.parent], masses[joint.child])
        least[joint.parent] = max(least[joint.parent], least[joint.child])
    return all(
        masses[joint.child] > 0 if MOTIONS[joint.type] == "translational" else least[joint.child] > enough
        for joint in axes
    )


def _least_inertias(links: Iterable[Link]) -> tuple[dict[str, float], dict[str, float], float]:
    """Least principal moments of inertia and masses by link, and the sum of all moments on diagonals."""
    least, masses, spread = {}, {}, 0.0
    for link in links:
        least[link.name] = masses[link.name] = 0.0
        if link.inertial is not None:
            inertia = link.inertial.inertia
            least[link.name], masses[link.name] = principal_moments(inertia)[0], link.inertial.mass
            spread += inertia.ixx + inertia.iyy + inertia.izz
    return least, masses, spread


def _starts_shifted(joints: Iterable[Joint]) -> bool:
    """Whether a joint may be shifted at the start; where joints follow each other, ranges are not looked into."""
    ranges = [own_range(joint) for joint in joints if MOTIONS.get(joint.type) == "translational"]
    led = bool(ranges) and any(joint.mimic is not None for joint in joints)
    return led or any(lower > 0 or upper < 0 for lower, upper in ranges)


def _moved(joint: Joint, poses: Mapping[str, Pose], body: _Body) -> float:
    if MOTIONS[joint.type] == "translational":
        return body.mass
    rotation, point = compose(poses[joint.parent], pose(joint.origin))
    return body.about(point, tuple(dot(row, joint.axis) for row in rotation))  # type: ignore[arg-type]


def _body(link: Link, at: Pose) -> _Body:
    if link.inertial is None:
        return _Body()
    mass, i = link.inertial.mass, link.inertial.inertia
    rotation, centre = compose(at, pose(link.inertial.origin))
    tensor = ((i.ixx, i.ixy, i.ixz), (i.ixy, i.iyy, i.iyz), (i.ixz, i.iyz, i.izz))
    halves = [tuple(dot(row, column) for column in tensor) for row in rotation]  # the tensor is symmetric
    square = dot(centre, centre)
    inertia = [
        [dot(half, rotation[k]) + mass * (square * (j == k) - centre[j] * centre[k]) for k in range(3)]
        for j, half in enumerate(halves)
    ]
    return _Body(mass, tuple(mass * c for c in centre), tuple(map(tuple, inertia)))  # type: ignore[arg-type]


def _sum(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
