"""Compare the connectors of two robot models, and the variables of their Run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from urdfsync.domain import Effect, ElementKey, Target, Version
from urdfsync.urdf.drives import can_be_driven, driven_joints
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.connectors import connector_names
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Motion
from urdfsync.urdf.snapshot import from_snapshot

# How the names of variables of Run end: position and effort.
_VARIABLES: Mapping[Motion, tuple[str, str]] = {"rotational": ("phi", "tau"), "translational": ("s", "f")}
_OTHER_FLANGES = "adapt what is connected to it, and joints that were exchanged"


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
    return [
        *_connectors(before, after, renames, earlier, options),
        *_variables(before, after, renames, earlier, options),
    ]


def _connectors(
    before: KinematicTree, after: KinematicTree, renames: Mapping[ElementKey, str], earlier: Options, options: Options
) -> Iterator[Effect]:
    old, new = connector_names(before, earlier), connector_names(after, options)
    links = {renames.get(("link", link.name), link.name) for link in before.links} & {link.name for link in after.links}
    joints = {renames.get(("joint", joint.name), joint.name) for joint in before.joints}
    joints &= {joint.name for joint in after.joints}
    for kind, connector, one, other, elements in (
        ("link", "frame", old.frames, new.frames, links),
        ("joint", "axis", old.axes, new.axes, joints),
        ("joint", "support", old.supports, new.supports, joints),
    ):
        known = {renames.get((kind, name), name): found for name, found in one.items()}
        for name in dict.fromkeys((*known, *other)):
            was, now = known.get(name), other.get(name)
            if was != now and name in elements:
                hint = f'list "{name}" in `frames` to keep it' if kind == "link" and now is None else ""
                yield Effect((f"{kind} {name}", connector), was, now, hint=hint)
    # An axis that keeps its name and turns where it slid, or the other way round, takes other flanges now.
    types = {joint.name: joint.type for joint in after.joints}
    for joint in before.joints:
        name = renames.get(("joint", joint.name), joint.name)
        if joint.name in old.axes and old.axes[joint.name] == new.axes.get(name):
            was, now = MOTION_KINDS[joint.type], MOTION_KINDS[types[name]]
            if was != now:
                axes = f"{old.axes[joint.name]} ({was})", f"{new.axes[name]} ({now})"
                yield Effect((f"joint {name}", "axis and support"), *axes, hint=_OTHER_FLANGES)


def _variables(
    before: KinematicTree, after: KinematicTree, renames: Mapping[ElementKey, str], earlier: Options, options: Options
) -> Iterator[Effect]:
    """Yield what differs in Run. A joint that gets or loses its axis is named with that axis."""
    now = {joint.name: joint for joint in after.joints}
    was_driven, is_driven = driven_joints(before.joints, earlier), driven_joints(after.joints, options)
    for joint in before.joints:
        name = renames.get(("joint", joint.name), joint.name)
        if name not in now or not can_be_driven(joint):
            continue
        position = effort = new_position = new_effort = None
        if joint.name in was_driven:
            one, other = _VARIABLES[MOTION_KINDS[joint.type]]
            component = before.joint(joint.name).component
            effort = f"{component}_{other}"
            position = f"{component}_{one}" if earlier.inputs == "names" else None
        if name in is_driven:
            one, other = _VARIABLES[MOTION_KINDS[now[name].type]]
            component = after.joint(name).component
            new_position, new_effort = (
                f"{component}_{one}" if options.inputs == "names" else None,
                f"{component}_{other}",
            )
        is_passive = effort and not new_effort and can_be_driven(now[name])
        hint = f'list "{name}" in `driven`, with all others that are driven, to keep it' if is_passive else ""
        if position != new_position:
            keep = hint if options.inputs == "names" else 'set `inputs = "names"` to keep it'
            lost = keep if position and not new_position else ""
            yield Effect((f"joint {name}", "position in Run"), position, new_position, hint=lost)
        if effort != new_effort:
            yield Effect((f"joint {name}", "effort in Run"), effort, new_effort, hint=hint)
    if earlier.inputs == "names" or not was_driven:
        return
    if options.inputs == "names":
        yield Effect(("robot", "input of Run"), "positions", None, hint='set `inputs = "vector"` to keep it')
        return
    known = [renames.get(("joint", joint.name), joint.name) for joint in before.joints if joint.name in was_driven]
    new = [joint.name for joint in after.joints if joint.name in is_driven]
    if known != new:
        hint = "adapt what is connected to `positions` of Run"
        yield Effect(("robot", "positions"), ", ".join(known), ", ".join(new) or None, hint=hint)
