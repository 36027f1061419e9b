"""Effects of a change on a whole robot: its mass, the connectors of its model, and the variables of its Run."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Effect, ElementKey, Target, Version, brings_back, displaced
from urdfsync.urdf.connectors import Connectors, connector_names, connector_options, every_connector, input_vector
from urdfsync.urdf.kinematics.poses import compose, link_poses, pose
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Vector
from urdfsync.urdf.snapshot import from_snapshot

_JUMP = 9.99
"""Ratio of two masses that is no change of the design: a factor of 10, which rounding may have made smaller."""
_DRIVE = {
    "axis": "axis",
    "support": "support",
    "motor": "motor",
    "position": "position in Run",
    "velocity": "velocity in Run",
    "effort": "effort in Run",
}
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


def find_doubtful(old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Iterator[tuple[str, Diagnostic]]:
    """Yield one warning, at the first of all links that have ten times their mass, or a tenth of it."""
    before = {renames.get(("link", name), name): link for name, link in old.snapshot["links"].items()}
    jumps = []
    for name, link in new.snapshot["links"].items():
        mass, new_mass = (snapshot.get("inertial", {}).get("mass", 0.0) for snapshot in (before.get(name, {}), link))
        if min(mass, new_mass) > 0 and max(mass, new_mass) >= _JUMP * min(mass, new_mass):
            jumps.append((f"link {name}", f"{mass:g} kg → {new_mass:g} kg"))
    if jumps:
        path, change = jumps[0]
        more = f" (and {len(jumps) - 1} more like it)" if len(jumps) > 1 else ""
        message, hint = f"{path}: its mass jumps, {change}{more}", "check the unit and the material in the exporter"
        yield f"{path} / inertial / mass", Diagnostic(Severity.WARNING, "mass-jump", message, hint=hint)


def interface(
    old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Options
) -> Sequence[Effect]:
    """Return the connectors and the variables of Run that go or have another name, then those that come.

    If Run has its inputs in one vector, their order is an effect, too. `options` are those of the new version, and of
    the old one unless it has its own.
    """
    earlier = old.options if isinstance(old.options, Options) else options
    if "package" not in earlier.approach:
        return ()
    if "package" not in options.approach:
        hint = brings_back('approach = ["package", "record"]')
        return [Effect(("robot", "model"), target.name, None, hint=hint)]
    before, after = (KinematicTree.of(from_snapshot(version.snapshot), (target.name,)) for version in (old, new))
    old_names, new_names = connector_names(before, earlier), connector_names(after, options)
    all_names = every_connector(after, options)
    lines, changes = connector_options(after, options), list[Effect]()

    def add(element: str, part: str, old_name: str | None, new_name: str | None, full: str | None) -> None:
        """Add an effect if a name differs; `full` is the new name that it has if no option leaves it out."""
        if old_name != new_name:
            hint = "" if new_name or not full else brings_back(lines.get(full, ""), full if full != old_name else "")
            changes.append(Effect((element, part), old_name, new_name, hint=hint))

    links, new_links = ([link.name for link in tree.links] for tree in (before, after))
    for link, new_link in _matches("link", links, new_links, renames):
        frames = old_names.frames.get(link), new_names.frames.get(new_link), all_names.frames.get(new_link)
        add(f"link {new_link or link}", "frame", *frames)
    joints, new_joints = ([joint.name for joint in tree.joints] for tree in (before, after))
    for joint, new_joint in _matches("joint", joints, new_joints, renames):
        drives = old_names.drives.get(joint), new_names.drives.get(new_joint), all_names.drives.get(new_joint)
        element, (drive, new_drive, _) = f"joint {new_joint or joint}", drives
        if drive and new_drive and drive.axis == new_drive.axis and drive.motion != new_drive.motion:
            changes.append(Effect((element, "motion"), drive.motion, new_drive.motion))
        for field, part in _DRIVE.items():
            add(element, part, *(getattr(names, field, None) for names in drives))
    for name in dict.fromkeys([*old_names.sensors, *new_names.sensors]):
        add(f"sensor {name}", "component", old_names.sensors.get(name), new_names.sensors.get(name), None)
        add(f"sensor {name}", "frame", old_names.sensor_frames.get(name), new_names.sensor_frames.get(name), None)
    inputs = [renames.get(("joint", name), name) for name in _driven(old_names)] if earlier.inputs == "vector" else []
    new_inputs = _driven(new_names) if options.inputs == "vector" else []
    vector, new_vector = input_vector(old_names), input_vector(new_names)
    add("robot", "input of Run", vector if inputs else None, new_vector if new_inputs else None, new_vector)
    if inputs and new_inputs and inputs != new_inputs:
        changes.append(Effect(("robot", f"order of {new_vector}"), ", ".join(inputs), ", ".join(new_inputs)))
    return sorted(changes, key=lambda change: change.old is None)  # names that users may have connected come first


def _driven(connectors: Connectors) -> list[str]:
    """Return the joints that Run drives."""
    return [name for name, drive in connectors.drives.items() if drive.command]


def _matches(
    kind: str, before: Iterable[str], after: Iterable[str], renames: Mapping[ElementKey, str]
) -> Iterator[tuple[str, str]]:
    """Yield old and new name of each element; a new element has an empty old name, a removed one an empty new name."""
    displaced_elements, new_names = displaced(renames), dict.fromkeys(after)
    for old_name in before:
        name = renames.get((kind, old_name), old_name)
        has_match = name in new_names and (kind, old_name) not in displaced_elements
        yield old_name, name if has_match else ""
        if has_match:
            del new_names[name]
    yield from (("", name) for name in new_names)
