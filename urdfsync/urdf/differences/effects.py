"""What differences do to the robot as a whole: mass, centre of mass, connectors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from urdfsync.difference import Effect, ElementKey, Version
from urdfsync.urdf.kinematics import compose, link_poses, pose
from urdfsync.urdf.model.connectors import Connectors, connectors
from urdfsync.urdf.naming import natural_key
from urdfsync.urdf.robot import Vector
from urdfsync.urdf.skeleton import Skeleton
from urdfsync.urdf.snapshot import from_snapshot


def effects(old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Sequence[Effect]:
    """Mass and centre of mass of both versions, and the connectors that have another name.

    The centre of mass is in metres, in the frame of the root link, with all joints at zero; it is None for a robot
    without mass.
    """
    before, after = (Skeleton.of(from_snapshot(snapshot)) for snapshot in (old.snapshot, new.snapshot))
    old_names, new_names = _connectors(before), _connectors(after)
    (old_mass, old_centre), (new_mass, new_centre) = _mass(before), _mass(after)
    return [
        Effect(("robot", "mass"), old_mass, new_mass, "kg"),
        Effect(("robot", "centre of mass"), old_centre, new_centre, "m"),
        *_renamed("joint", old_names.axes, new_names.axes, renames),
        *_renamed("link", old_names.frames, new_names.frames, renames),
    ]


def _mass(skeleton: Skeleton) -> tuple[float, Vector | None]:
    """Total mass, and centre of mass; summed exactly, so that names and order make no difference."""
    poses = link_poses(skeleton, {})
    masses, moments = [], []
    for link in skeleton.links:
        if link.inertial is not None:
            _, centre = compose(poses[link.name], pose(link.inertial.origin))
            masses.append(link.inertial.mass)
            moments.append([link.inertial.mass * coordinate for coordinate in centre])
    total = math.fsum(masses)
    if not total > 0:
        return total, None
    x, y, z = (math.fsum(column) / total for column in zip(*moments, strict=True))
    return total, (x, y, z)


def _connectors(skeleton: Skeleton) -> Connectors:
    return connectors(skeleton, (link.name for link in skeleton.leaves()))


def _renamed(
    kind: str, old: Mapping[str, str], new: Mapping[str, str], renames: Mapping[ElementKey, str]
) -> Iterator[Effect]:
    """Connectors of elements that both versions connect, where they are not the same."""
    known = {renames.get((kind, name), name): connector for name, connector in old.items()}
    for name in sorted(known.keys() & new.keys(), key=natural_key):
        if known[name] != new[name]:
            yield Effect((f"{kind} {name}", "connector"), known[name], new[name])
