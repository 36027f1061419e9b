"""What a change does to a robot as a whole: its mass, the connectors of its model, and the variables of its Run."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from urdfsync.domain import Effect, ElementKey, Target, Version
from urdfsync.urdf.connectors import connector_names
from urdfsync.urdf.drives import driven_joints
from urdfsync.urdf.kinematics.poses import compose, link_poses, pose
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Motion, Vector
from urdfsync.urdf.snapshot import from_snapshot

# How the names of variables of Run end: position and effort.
_VARIABLES: Mapping[Motion, tuple[str, str]] = {"rotational": ("phi", "tau"), "translational": ("s", "f")}
_FLANGES, _POSITION, _EFFORT = "axis and support", "position in Run", "effort in Run"


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
    was, now = _names(before, earlier, renames), _names(after, options, {})
    both = {f"{kind} {renames.get((kind, name), name)}" for kind, name in before.names}
    both &= {f"{kind} {name}" for kind, name in after.names}
    found = []
    for element, part in dict.fromkeys((*was, *now)):
        one, other = was.get((element, part)), now.get((element, part))
        if one == other or element not in both:
            continue
        has_new_axis = was.get((element, "axis")) != now.get((element, "axis"))  # told by itself
        if has_new_axis and (part == _FLANGES or (part in (_POSITION, _EFFORT) and (element, "axis") not in was)):
            continue
        name, hint = element.partition(" ")[2], ""
        if part == "frame" and not other:
            hint = f'list "{name}" in `frames` to keep it'
        elif part in (_POSITION, _EFFORT) and (element, "axis") in now and (element, _EFFORT) not in now:
            hint = f'list "{name}" in `driven`, with all others that are driven, to keep it'
        found.append(Effect((element, part), one, other, hint=hint))
    return [*found, *_vector(before, after, renames, earlier, options)]


def _names(tree: KinematicTree, options: Options, renames: Mapping[ElementKey, str]) -> dict[tuple[str, str], str]:
    """Return the names of connectors and variables of Run, by element under its new name and what they are."""
    connectors, driven = connector_names(tree, options), driven_joints(tree.joints, options)
    names = {(f"link {renames.get(('link', link), link)}", "frame"): frame for link, frame in connectors.frames.items()}
    for joint in (joint for joint in tree.joints if joint.name in connectors.axes):
        element, motion = f"joint {renames.get(('joint', joint.name), joint.name)}", MOTION_KINDS[joint.type]
        names[element, "axis"] = connectors.axes[joint.name]
        names[element, "support"] = connectors.supports[joint.name]
        names[element, _FLANGES] = f"{connectors.axes[joint.name]} ({motion})"
        component, (position, effort) = tree.joint(joint.name).component, _VARIABLES[motion]
        if joint.name in driven and options.inputs == "names":
            names[element, _POSITION] = f"{component}_{position}"
        if joint.name in driven:
            names[element, _EFFORT] = f"{component}_{effort}"
    return names


def _vector(
    before: KinematicTree, after: KinematicTree, renames: Mapping[ElementKey, str], earlier: Options, options: Options
) -> Sequence[Effect]:
    """Return what happens to positions in one vector."""
    was, now = driven_joints(before.joints, earlier), driven_joints(after.joints, options)
    if earlier.inputs == "names" or not was:
        return ()
    if options.inputs == "names":
        return [Effect(("robot", "input of Run"), "positions", None)]
    old = [renames.get(("joint", joint.name), joint.name) for joint in before.joints if joint.name in was]
    new = [joint.name for joint in after.joints if joint.name in now]
    return [Effect(("robot", "positions"), ", ".join(old), ", ".join(new) or None)] if old != new else ()
