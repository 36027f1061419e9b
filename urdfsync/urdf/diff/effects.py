"""What a change does to a robot as a whole: its mass, the connectors of its model, and the variables of its Run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from urdfsync.domain import Effect, ElementKey, Target, Version
from urdfsync.urdf.connectors import Drive, connector_names
from urdfsync.urdf.kinematics.poses import compose, link_poses, pose
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Vector
from urdfsync.urdf.snapshot import from_snapshot

_DRIVE = {"axis": "axis", "support": "support", "position": "position in Run", "effort": "effort in Run"}
"""Fields of `Drive`, and what they are in a report."""


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


def interface(
    old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Options
) -> Sequence[Effect]:
    """Return the connectors that elements of both versions get, lose, or have by another name.

    Also variables of Run of joints that keep their axis: whose motion is another one, or that become passive or driven.
    With positions in one vector, its order too, where that is another one for joints of both versions; and the vector
    itself, where positions become inputs by name. `options` are those of the new version; the old one has its own if it
    says so.
    """
    earlier = old.options if isinstance(old.options, Options) else options
    if "package" not in earlier.approach:
        return ()
    if "package" not in options.approach:
        hint = 'list "package" in `approach` to keep it, with its connectors'
        return [Effect(("robot", "model"), target.name, None, hint=hint)]
    before, after = (KinematicTree.of(from_snapshot(version.snapshot), (target.name,)) for version in (old, new))
    was, now = connector_names(before, earlier), connector_names(after, options)
    found: list[Effect] = []
    for link in before.links:
        name = renames.get(("link", link.name), link.name)
        if ("link", name) in after.names:
            one, other = was.frames.get(link.name), now.frames.get(name)
            hint = "" if other else f'list "{name}" in `frames` to keep it'
            found += [Effect((f"link {name}", "frame"), one, other, hint=hint)] if one != other else []
    for joint in before.joints:
        name = renames.get(("joint", joint.name), joint.name)
        if ("joint", name) in after.names:
            found += _of_drive(name, was.drives.get(joint.name), now.drives.get(name))
    positions = [renames.get(("joint", name), name) for name, drive in was.drives.items() if drive.effort]
    if earlier.inputs == "names" or not positions:
        return found
    if options.inputs == "names":
        return [*found, Effect(("robot", "input of Run"), "positions", None)]
    new_positions = [name for name, drive in now.drives.items() if drive.effort]
    if positions != new_positions:
        found.append(Effect(("robot", "order of positions"), ", ".join(positions), ", ".join(new_positions) or None))
    return found


def _of_drive(joint: str, old: Drive | None, new: Drive | None) -> Iterator[Effect]:
    """Yield what becomes of the names of one joint. The variables of Run of a joint that gets an axis are left out."""
    element, hint = f"joint {joint}", ""
    if old and new and old.axis == new.axis and old.motion != new.motion:
        yield Effect((element, "motion"), old.motion, new.motion)
    if new and not new.effort:
        hint = f'list "{joint}" in `driven`, with all others that are driven, to keep it'
    for field, part in _DRIVE.items():
        one, other = getattr(old, field, None), getattr(new, field, None)
        is_of_run = field in ("position", "effort")
        if one != other and (old or not is_of_run):
            yield Effect((element, part), one, other, hint=hint if is_of_run else "")
