"""What resists the motion of each joint at the start: the diagonal of the mass matrix, and what is left of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence, Set
from operator import add, mul

import msgspec

from urdfsync.urdf.kinematics import Pose, compose, dot, link_poses, pose, start_positions
from urdfsync.urdf.robot import Joint, Link, Vector
from urdfsync.urdf.skeleton import MOTIONS, Skeleton

_ROUNDING = 1e-12
"""What is left of terms of this size that cancel each other."""


_Matrix = Sequence[Sequence[float]]


class _Body(msgspec.Struct, frozen=True):
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

    def matrix(self) -> _Matrix:
        """The same as a spatial inertia: of (angular velocity, velocity at the origin) to (torque about it, force)."""
        (x, y, z), m = self.moment, self.mass
        skew = ((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0))
        upper = [[*row, *cross] for row, cross in zip(self.inertia, skew, strict=True)]
        lower = [[*(-c for c in cross), *(m * (j == k) for k in range(3))] for j, cross in enumerate(skew)]
        return upper + lower


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


def yielding(skeleton: Skeleton, free: Set[str] | None = None) -> Set[str]:
    """Joints that nothing resists where each joint is at its start, since those behind them can give way.

    Such as the first of two joints on the same axis with nothing between them: the mass matrix is singular then. A
    joint is one of them if its articulated body has no inertia about or along its axis (Featherstone: Rigid Body
    Dynamics Algorithms, 2008, section 7.3). Joints that follow others, or lead some, count as fixed here, and so do
    those that are not `free`; None for all.
    """
    poses = link_poses(skeleton, start_positions(skeleton))
    bodies = {link.name: _body(link, poses[link.name]) for link in skeleton.links}
    inertias = {name: body.matrix() for name, body in bodies.items()}
    leaders = skeleton.followers_by_leader()
    found = set()
    for joint in reversed(skeleton.joints):
        inertia = inertias[joint.child]
        single = joint.type in MOTIONS and joint.mimic is None and joint.name not in leaders
        if single and (free is None or joint.name in free):
            motion = _motion(joint, poses)
            force = [_product(row, motion) for row in inertia]
            left = _product(force, motion)
            if left > _ROUNDING * _size(bodies[joint.child].matrix(), motion):
                inertia = [
                    [a - f * g / left for a, g in zip(row, force, strict=True)]
                    for row, f in zip(inertia, force, strict=True)
                ]
            else:
                found.add(joint.name)
        bodies[joint.parent] += bodies[joint.child]
        inertias[joint.parent] = [[*map(add, *rows)] for rows in zip(inertias[joint.parent], inertia, strict=True)]
    return found


def _motion(joint: Joint, poses: Mapping[str, Pose]) -> Sequence[float]:
    """Angular velocity, and velocity at the origin, per speed of the joint."""
    rotation, point = compose(poses[joint.parent], pose(joint.origin))
    axis: Vector = tuple(dot(row, joint.axis) for row in rotation)  # type: ignore[assignment]
    return (0.0, 0.0, 0.0, *axis) if MOTIONS[joint.type] == "translational" else (*axis, *_cross(point, axis))


def _product(a: Sequence[float], b: Sequence[float]) -> float:
    return math.fsum(map(mul, a, b))


def _size(matrix: _Matrix, motion: Sequence[float]) -> float:
    """Of the terms that a moment of inertia is the sum of."""
    return sum(abs(a * x * y) for row, x in zip(matrix, motion, strict=True) for a, y in zip(row, motion, strict=True))


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
