"""Effects of a change on a whole robot: mass, connectors of the robot model, and variables of Run."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence

from urdfsync.common.processes import machine
from urdfsync.domain import ElementKey, Target, Version, displaced
from urdfsync.domain.advice import brings_back
from urdfsync.domain.changes import Effect
from urdfsync.formats.urdf.assembly import Assembly, connector_options
from urdfsync.formats.urdf.connectors import Connectors, input_vector
from urdfsync.formats.urdf.kinematics.poses import compose, link_poses, pose
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import MOTION_KINDS, Motion, Vector

_DRIVE = {
    "axis": "axis",
    "support": "support",
    "motor": "motor",
    "position": "position in Run",
    "velocity": "velocity in Run",
    "effort": "effort in Run",
}
"""Fields of `Drive`, with their words in a report."""
_INPUT = "input of Run"
_LOADS: Mapping[Motion, tuple[str, str]] = {
    "rotational": ("gravity torque", "N·m"),
    "translational": ("gravity force", "N"),
}
"""Words for the greatest load of each kind of motion, and the unit."""


def effects(old: Version, new: Version) -> Sequence[Effect]:
    """Return mass, centre of mass and reach of both versions.

    The centre of mass is in metres, in the frame of the root link, with all joints at zero; None without a mass.
    """
    before, after = (KinematicTree.of(version.snapshot) for version in (old, new))
    (old_mass, old_centre), (new_mass, new_centre) = _mass_and_centre(before), _mass_and_centre(after)
    return [
        Effect(("robot", "mass"), old_mass, new_mass, "kg"),
        Effect(("robot", "centre of mass"), old_centre, new_centre, "m"),
        Effect(("robot", "reach"), _extremes(before)[0], _extremes(after)[0], "m"),
    ]


def loads(old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Sequence[Effect]:
    """Return the greatest gravity torque or force of each joint of the new version, with its limit of effort."""
    trees = [KinematicTree.of(version.snapshot) for version in (old, new)]
    before, after = (_extremes(tree)[1] for tree in trees)
    earlier, changes = {new_name: name for (kind, name), new_name in renames.items() if kind == "joint"}, list[Effect]()
    for joint in trees[1].joints:
        if joint.name in after:
            words, unit = _LOADS[MOTION_KINDS[joint.type]]
            effort = joint.limit.effort if joint.limit else None
            limit = effort if effort and effort < math.inf else None  # zero stands for no limit
            # a new joint may have the former name of a renamed joint
            name = earlier.get(joint.name, "" if ("joint", joint.name) in renames else joint.name)
            load = before.get(name)
            changes.append(Effect((f"joint {joint.name}", words), load, after[joint.name], unit, limit=limit))
    return changes


@functools.lru_cache(maxsize=2)  # one call serves reach and loads: 0.1 s for a large robot
def _extremes(tree: KinematicTree) -> tuple[float | None, Mapping[str, float]]:
    with machine.single_thread():
        from urdfsync.formats.urdf.kinematics.loads import find_extremes  # a late import saves builds 60 ms

    return find_extremes(tree)


def _mass_and_centre(tree: KinematicTree) -> tuple[float, Vector | None]:
    """Return total mass (kg) and centre of mass (m, in the root frame, all joints at zero); no centre without a mass.

    The exact sum does not depend on names and order.
    """
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
    """Return removed and renamed connectors and variables of Run, then new ones.

    If Run has its inputs in one vector, a changed order is also an effect. `options` belong to the new version, and to
    an old version without options.
    """
    earlier = old.options if isinstance(old.options, Options) else options
    if "package" not in earlier.approach:
        return ()
    if "package" not in options.approach:
        hint = brings_back('approach = ["package", "record"]')
        return [Effect(("robot", "model"), target.name, None, hint=hint)]
    after = Assembly(new.snapshot, options, target)
    old_connectors, connectors = Assembly(old.snapshot, earlier, target).connectors, after.connectors
    new_names, all_names = _names(connectors, options), _names(after.every_connector, options)
    all_names["robot", "", _INPUT] = input_vector(connectors)
    lines, displaced_elements, changes = connector_options(after), displaced(renames), list[Effect]()
    for (kind, old_element, part), old_name in _names(old_connectors, earlier).items():
        is_displaced = (kind, old_element) in displaced_elements
        element = renames.get((kind, old_element), old_element)
        new_name = None if is_displaced else new_names.pop((kind, element, part), None)
        if old_name != new_name:
            full_name = None if is_displaced else all_names.get((kind, element, part))
            hint = (
                brings_back(lines.get(full_name, ""), full_name if full_name != old_name else "") if full_name else ""
            )
            changes.append(Effect((_label(kind, element), part), old_name, new_name, hint=hint))
        elif part == "axis":  # a flange may keep its name but change its type
            old_motion, motion = old_connectors.drives[old_element].motion, connectors.drives[element].motion
            if old_motion != motion:
                changes.append(Effect((_label(kind, element), "motion"), old_motion, motion))
    inputs = [renames.get(("joint", name), name) for name in _driven(old_connectors)]
    new_inputs = _driven(connectors)
    if earlier.inputs == options.inputs == "vector" and inputs and new_inputs and inputs != new_inputs:
        path = "robot", f"order of {input_vector(connectors)}"
        changes.append(Effect(path, ", ".join(inputs), ", ".join(new_inputs)))
    added = [Effect((_label(kind, name), part), None, new_name) for (kind, name, part), new_name in new_names.items()]
    return [*changes, *added]  # names that users may have connected come first


def _names(connectors: Connectors, options: Options) -> dict[tuple[str, str, str], str]:
    """Return the names of connectors and variables, by kind, name and part of the element."""
    names = {("link", link, "frame"): frame for link, frame in connectors.frames.items()}
    for joint, drive in connectors.drives.items():
        names |= {("joint", joint, part): name for field, part in _DRIVE.items() if (name := getattr(drive, field))}
    for sensor, component in connectors.sensors.items():
        names["sensor", sensor, "component"] = component
        if sensor in connectors.sensor_frames:
            names["sensor", sensor, "frame"] = connectors.sensor_frames[sensor]
    if options.inputs == "vector" and _driven(connectors):
        names["robot", "", _INPUT] = input_vector(connectors)
    return names


def _label(kind: str, name: str) -> str:
    return f"{kind} {name}" if name else kind


def _driven(connectors: Connectors) -> list[str]:
    """Return the joints that Run drives."""
    return [name for name, drive in connectors.drives.items() if drive.command]
