"""Computes the force and torque of the ground on a standing robot: Pinocchio has no contacts.

The base is held level, so that no robot tips, and the joints stay at the start. The force on each point follows the law
of the library's `Contacts.Functions.point`. The law is written here a second time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from urdfsync.domain import Import
from urdfsync.urdf.kinematics.poses import compose, link_poses, pose, start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.shapes import touching
from urdfsync.urdf.physics.reference import Array
from urdfsync.urdf.robot import Box, Capsule, Contact, Cylinder, Ellipsoid, Sphere

GRAVITY = 9.80665
PENETRATION, DAMPING_RATIO, FRICTION, SLIP_SPEED = 3e-4, 2.0, 0.8, 1e-3
"""Numbers of the ground for links without their own numbers."""
_LEVEL = np.eye(3)
_UPRIGHT, _TILTED = 1e-3, 0.15
"""Sines of a cylinder's tilt: between these two, the contact moves from its end to its rim."""


class ContactPoint(NamedTuple):
    """A point of a link that may touch the ground."""

    place: Array
    """Vector from the root link's origin to the point, raised by the link's `min_depth` (the depth without a force)."""
    share: float
    """Weight of this point among the points of its shape."""
    stiffness: float
    damping: float
    """Damping as a fraction of the spring force, in s/m."""
    contact: Contact


class Stand(NamedTuple):
    """A robot of a given weight, and the points that carry the robot."""

    tree: KinematicTree
    imports: Mapping[str, Import]
    weight: float
    lowest: float
    """Height of the lowest point above the root link's origin."""
    depth: float
    """Depth of the lowest point in the ground when the ground carries the weight."""

    def wrench(self, rise: float = 0.0, slide: Sequence[float] = (0.0, 0.0), axes: Array = _LEVEL) -> Array:
        """Return the ground's force and torque about the root link's origin, while the robot rises and slides.

        `axes` are those of the root link in the world. The result is resolved in `axes`.
        """
        total, speed = np.zeros(6), math.hypot(*slide)
        for point in _points(self.tree, self.imports, self.weight, axes):
            depth = max(0.0, self.depth + self.lowest - point.place[2])
            spring = point.stiffness * depth * max(0.0, 1 - point.damping * rise)
            normal = point.share * max(0.0, spring - (point.contact.kd or 0.0) * rise) if depth else 0.0
            mu = FRICTION if point.contact.mu is None else point.contact.mu
            slip = SLIP_SPEED * max(1.0, mu / FRICTION)
            force = np.array([*(-mu * normal / math.hypot(speed, slip) * np.array(slide)), normal])
            lever = point.place - [0, 0, point.contact.min_depth or 0.0]
            total += [*axes.T @ force, *axes.T @ np.cross(lever, force)]
        return total


def stand(tree: KinematicTree, imports: Mapping[str, Import], weight: float) -> Stand | None:
    """Return the stand of a robot; None for a robot without weight, or without shapes that can touch the ground."""
    points = list(_points(tree, imports, weight, _LEVEL)) if 0 < weight < math.inf else []
    if not points:
        return None
    lowest = min(float(point.place[2]) for point in points)
    stiffness = moment = 0.0
    for point in sorted(points, key=lambda point: float(point.place[2])):
        height = float(point.place[2]) - lowest
        if stiffness and weight + moment <= stiffness * height:
            break
        stiffness += point.share * point.stiffness
        moment += point.share * point.stiffness * height
    depth = (weight + moment) / stiffness if stiffness else math.inf
    return Stand(tree, imports, weight, lowest, depth) if math.isfinite(lowest) and math.isfinite(depth) else None


def _points(tree: KinematicTree, imports: Mapping[str, Import], weight: float, root: Array) -> Iterator[ContactPoint]:
    poses = link_poses(tree, start_positions(tree))
    for link in tree.links:
        contact = link.contact or Contact()
        stiffness = weight / PENETRATION if contact.kp is None else contact.kp
        damping = 2 * DAMPING_RATIO / math.sqrt(GRAVITY * weight / stiffness) if stiffness > 0 else 0.0
        for origin, shape in touching(link, imports):
            axes, place = (root @ part for part in map(np.array, compose(poses[link.name], pose(origin))))
            for offset, share in _lowest(axes, shape):
                raised = place + offset + [0, 0, contact.min_depth or 0.0]
                yield ContactPoint(raised, share, stiffness, damping, contact)


def _lowest(axes: Array, shape: Any) -> Iterable[tuple[Array, float]]:
    """Yield the touching points of a shape as vectors from its origin, in the world's axes, with weights."""
    match shape:
        case Box(size=size):
            corners = np.array(np.meshgrid(*[(-edge / 2, edge / 2) for edge in size])).reshape(3, -1).T
            yield from ((axes @ corner, 1.0) for corner in corners)
        case Sphere(radius=radius):
            yield np.array([0, 0, -radius]), 1.0
        case Ellipsoid(radii=radii):
            # `stretch` makes the ellipsoid of a unit sphere, whose point in `direction` becomes the lowest
            stretch = axes * radii
            direction = -stretch[2]
            yield stretch @ direction / (np.linalg.norm(direction) or 1.0), 1.0
        case Capsule(radius=radius, length=length):
            yield from ((side * length / 2 * axes[:, 2] - [0, 0, radius], 1.0) for side in (-1, 1))
        case Cylinder(radius=radius, length=length):
            cosine = axes[2, 2]
            sine = 1 - cosine**2
            down = radius / math.sqrt(sine + _UPRIGHT**2) * (cosine * axes[:, 2] - [0, 0, 1])
            end = -math.copysign(length / 2, cosine) * axes[:, 2]
            yield from ((side * end + down, 1.0) for side in (-1, 1))
            for side in (-radius, radius):
                yield from ((end + side * axes[:, k], max(0.0, 1 - sine / _TILTED**2)) for k in (0, 1))
        case points:
            yield from ((axes @ point, 1.0) for point in points)
