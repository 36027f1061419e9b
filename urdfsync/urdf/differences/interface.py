"""What differences do to the connectors of the robot model, and to the order of its positions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from urdfsync.difference import Effect, ElementKey, Version
from urdfsync.domain import Target
from urdfsync.urdf.drives import driven_joints
from urdfsync.urdf.model.robot import connector_names
from urdfsync.urdf.options import Options
from urdfsync.urdf.skeleton import Skeleton
from urdfsync.urdf.snapshot import from_snapshot


def interface(
    old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Options
) -> Sequence[Effect]:
    """The connectors that elements of both versions get, lose, or have by another name, as `options` have it now.

    With positions in one vector, also its order where that is another one for joints of both versions.
    """
    if "package" not in options.approach:
        return ()
    before, after = (Skeleton.of(from_snapshot(version.snapshot), (target.name,)) for version in (old, new))
    one, other = connector_names(before, options), connector_names(after, options)
    links = {renames.get(("link", link.name), link.name) for link in before.links} & {link.name for link in after.links}
    joints = {renames.get(("joint", joint.name), joint.name) for joint in before.joints}
    joints &= {joint.name for joint in after.joints}
    return [
        *_differing("link", "frame", one.frames, other.frames, links, renames),
        *_differing("joint", "axis", one.axes, other.axes, joints, renames),
        *_differing("joint", "support", one.supports, other.supports, joints, renames),
        *(_order(before, after, renames, options) if options.inputs == "vector" else ()),
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


def _order(before: Skeleton, after: Skeleton, renames: Mapping[ElementKey, str], options: Options) -> Iterator[Effect]:
    old, new = (
        [joint.name for joint in skeleton.joints if joint.name in driven_joints(skeleton.joints, options)]
        for skeleton in (before, after)
    )
    known = [renames.get(("joint", name), name) for name in old]
    if any(name in new and new.index(name) != place for place, name in enumerate(known)):
        hint = "adapt what is connected to `positions` of Run"
        yield Effect(("robot", "positions"), ", ".join(known), ", ".join(new), hint=hint)
