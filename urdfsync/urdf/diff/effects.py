"""Compare mass and centre of mass of two robots."""

from __future__ import annotations

import math
from collections.abc import Sequence

from urdfsync.domain import Effect, Version
from urdfsync.urdf.kinematics.poses import compose, link_poses, pose
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import Vector
from urdfsync.urdf.snapshot import from_snapshot


def effects(old: Version, new: Version) -> Sequence[Effect]:
    """Return mass and centre of mass of both versions.

    The centre of mass is in metres, in the frame of the root link, with all joints at zero; it is None for a robot
    without mass.
    """
    before, after = (KinematicTree.of(from_snapshot(snapshot)) for snapshot in (old.snapshot, new.snapshot))
    (old_mass, old_centre), (new_mass, new_centre) = _mass(before), _mass(after)
    return [
        Effect(("robot", "mass"), old_mass, new_mass, "kg"),
        Effect(("robot", "centre of mass"), old_centre, new_centre, "m"),
    ]


def _mass(tree: KinematicTree) -> tuple[float, Vector | None]:
    """Return total mass and centre of mass; summed exactly, so that names and order make no difference."""
    poses = link_poses(tree, {})
    masses, moments = [], []
    for link in tree.links:
        if link.inertial is not None:
            _, centre = compose(poses[link.name], pose(link.inertial.origin))
            masses.append(link.inertial.mass)
            moments.append([link.inertial.mass * coordinate for coordinate in centre])
    total = math.fsum(masses)
    if not total > 0:
        return total, None
    x, y, z = (math.fsum(column) / total for column in zip(*moments, strict=True))
    return total, (x, y, z)
