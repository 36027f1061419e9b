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

_RUN: Mapping[Motion, Mapping[str, str]] = {
    "rotational": {"position": "phi", "effort": "tau"},
    "translational": {"position": "s", "effort": "f"},
}
"""How the names of variables of Run end."""
_OTHER_FLANGES = "adapt what is connected to it, and joints that were exchanged"


def interface(
    old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Options
) -> Sequence[Effect]:
    """The connectors that elements of both versions get, lose, or have by another name.

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
    one, other = connector_names(before, earlier), connector_names(after, options)
    links = {renames.get(("link", link.name), link.name) for link in before.links} & {link.name for link in after.links}
    joints = {renames.get(("joint", joint.name), joint.name) for joint in before.joints}
    joints &= {joint.name for joint in after.joints}
    return [
        *_differing("link", "frame", one.frames, other.frames, links, renames),
        *_differing("joint", "axis", one.axes, other.axes, joints, renames),
        *_differing("joint", "support", one.supports, other.supports, joints, renames),
        *_motions(before, after, renames, one.axes, other.axes),
        *_variables(before, after, joints, renames, earlier, options),
        *_positions(before, after, renames, earlier, options),
    ]


def _differing(
    kind: str,
    connector: str,
    old: Mapping[str, str],
    new: Mapping[str, str],
    elements: set[str],
    renames: Mapping[ElementKey, str],
) -> Iterator[Effect]:
    known = {renames.get((kind, name), name): found for name, found in old.items()}
    for name in (*known, *(name for name in new if name not in known)):
        before, after = known.get(name), new.get(name)
        if before == after or name not in elements:
            continue
        hint = f'list "{name}" in `frames` to keep it' if kind == "link" and after is None else ""
        yield Effect((f"{kind} {name}", connector), before, after, hint=hint)


def _motions(
    before: KinematicTree,
    after: KinematicTree,
    renames: Mapping[ElementKey, str],
    old: Mapping[str, str],
    new: Mapping[str, str],
) -> Iterator[Effect]:
    """Axes that keep their name and turn where they slid, or the other way round: they take other flanges now."""
    types = {joint.name: joint.type for joint in after.joints}
    for joint in before.joints:
        name = renames.get(("joint", joint.name), joint.name)
        if joint.name in old and old[joint.name] == new.get(name):
            one, other = MOTION_KINDS[joint.type], MOTION_KINDS[types[name]]
            if one != other:
                path = f"joint {name}", "axis and support"
                yield Effect(path, f"{old[joint.name]} ({one})", f"{new[name]} ({other})", hint=_OTHER_FLANGES)


def _variables(
    before: KinematicTree,
    after: KinematicTree,
    joints: set[str],
    renames: Mapping[ElementKey, str],
    earlier: Options,
    options: Options,
) -> Iterator[Effect]:
    """Variables of Run. A joint that gets or loses its axis is named with that axis."""
    now = {joint.name: joint for joint in after.joints if joint.name in joints}
    was_driven, is_driven = driven_joints(before.joints, earlier), driven_joints(after.joints, options)
    for joint in before.joints:
        name = renames.get(("joint", joint.name), joint.name)
        if name not in now or not can_be_driven(joint):
            continue
        component, component_now = before.joint(joint.name).component, after.joint(name).component
        old = _RUN[MOTION_KINDS[joint.type]] if joint.name in was_driven else {}
        new = _RUN[MOTION_KINDS[now[name].type]] if name in is_driven else {}
        is_passive = old and not new and can_be_driven(now[name])
        hint = f'list "{name}" in `driven`, with all others that are driven, to keep it' if is_passive else ""
        named = [(old, earlier.inputs == "names"), (new, options.inputs == "names")]
        components = component, component_now
        one, other = (
            f"{called}_{ends['position']}" if ends and by_name else None
            for called, (ends, by_name) in zip(components, named, strict=True)
        )
        if one != other:
            keep = hint if options.inputs == "names" else 'set `inputs = "names"` to keep it'
            yield Effect((f"joint {name}", "position in Run"), one, other, hint=keep if one and not other else "")
        one, other = (
            f"{called}_{ends['effort']}" if ends else None for called, ends in zip(components, (old, new), strict=True)
        )
        if one != other:
            yield Effect((f"joint {name}", "effort in Run"), one, other, hint=hint)


def _positions(
    before: KinematicTree, after: KinematicTree, renames: Mapping[ElementKey, str], earlier: Options, options: Options
) -> Iterator[Effect]:
    """The vector of positions of Run: that it is gone, or has other joints, or the same in another order."""
    was_driven, is_driven = driven_joints(before.joints, earlier), driven_joints(after.joints, options)
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
