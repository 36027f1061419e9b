"""What a change does to a robot as a whole: its mass, the connectors of its model, and the variables of its Run."""

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
    """Yield a warning if links have ten times their mass, or a tenth of it: one for all of them, at the first."""
    before = {renames.get(("link", name), name): link for name, link in old.snapshot["links"].items()}
    jumps = []
    for name, link in new.snapshot["links"].items():
        one, other = (snapshot.get("inertial", {}).get("mass", 0.0) for snapshot in (before.get(name, {}), link))
        if min(one, other) > 0 and max(one, other) >= _JUMP * min(one, other):
            jumps.append((f"link {name}", f"{one:g} kg → {other:g} kg"))
    if jumps:
        path, change = jumps[0]
        more = f" (and {len(jumps) - 1} more like it)" if len(jumps) > 1 else ""
        message, hint = f"{path}: its mass jumps, {change}{more}", "check the unit and the material in the exporter"
        yield f"{path} / inertial / mass", Diagnostic(Severity.WARNING, "mass-jump", message, hint=hint)


def interface(
    old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Options
) -> Sequence[Effect]:
    """Return the connectors and the variables of Run that go or have another name, then those that come.

    With positions in one vector, its order too. `options` are those of the new version; the old one has its own if it
    says so.
    """
    earlier = old.options if isinstance(old.options, Options) else options
    if "package" not in earlier.approach:
        return ()
    if "package" not in options.approach:
        hint = brings_back('approach = ["package", "record"]')
        return [Effect(("robot", "model"), target.name, None, hint=hint)]
    before, after = (KinematicTree.of(from_snapshot(version.snapshot), (target.name,)) for version in (old, new))
    was, now, every = connector_names(before, earlier), connector_names(after, options), every_connector(after, options)
    lines, found = connector_options(after, options), list[Effect]()

    def add(element: str, part: str, one: str | None, other: str | None, full: str | None) -> None:
        """Add what becomes of a name; `full` is what it would be if no option left it out."""
        if one != other:
            hint = "" if other or not full else brings_back(lines.get(full, ""), full if full != one else "")
            found.append(Effect((element, part), one, other, hint=hint))

    links, new_links = ([link.name for link in tree.links] for tree in (before, after))
    for old_name, name in _matches("link", links, new_links, renames):
        frames = was.frames.get(old_name), now.frames.get(name), every.frames.get(name)
        add(f"link {name or old_name}", "frame", *frames)
    joints, new_joints = ([joint.name for joint in tree.joints] for tree in (before, after))
    for old_name, name in _matches("joint", joints, new_joints, renames):
        drives = was.drives.get(old_name), now.drives.get(name), every.drives.get(name)
        element, (one, other, _) = f"joint {name or old_name}", drives
        if one and other and one.axis == other.axis and one.motion != other.motion:
            found.append(Effect((element, "motion"), one.motion, other.motion))
        for field, part in _DRIVE.items():
            add(element, part, *(getattr(drive, field, None) for drive in drives))
    for name in dict.fromkeys([*was.sensors, *now.sensors]):
        add(f"sensor {name}", "component", was.sensors.get(name), now.sensors.get(name), None)
        add(f"sensor {name}", "frame", was.sensor_frames.get(name), now.sensor_frames.get(name), None)
    inputs = [renames.get(("joint", name), name) for name in _driven(was)] if earlier.inputs == "vector" else []
    new_inputs = _driven(now) if options.inputs == "vector" else []
    vector, new_vector = input_vector(was), input_vector(now)
    add("robot", "input of Run", vector if inputs else None, new_vector if new_inputs else None, new_vector)
    if inputs and new_inputs and inputs != new_inputs:
        found.append(Effect(("robot", f"order of {new_vector}"), ", ".join(inputs), ", ".join(new_inputs)))
    return sorted(found, key=lambda one: one.old is None)  # what users lose comes first


def _driven(connectors: Connectors) -> list[str]:
    """Return the joints that Run drives."""
    return [name for name, drive in connectors.drives.items() if drive.command]


def _matches(
    kind: str, before: Iterable[str], after: Iterable[str], renames: Mapping[ElementKey, str]
) -> Iterator[tuple[str, str]]:
    """Yield old and new name of each element; empty for one that is new, or gone."""
    gone, new_names = displaced(renames), dict.fromkeys(after)
    for old_name in before:
        name = renames.get((kind, old_name), old_name)
        is_there = name in new_names and (kind, old_name) not in gone
        yield old_name, name if is_there else ""
        if is_there:
            del new_names[name]
    yield from (("", name) for name in new_names)
