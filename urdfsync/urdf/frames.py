"""Which links have a frame connector of their own in the robot model."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Link


def frame_links(skeleton: KinematicTree, options: Options) -> tuple[Link, ...]:
    """The leaves and the links that the option `frames` names, each once, in canonical order.

    Names that are no link are left out: `check_options` reports them.
    """
    if options.frames == "all":
        return skeleton.links  # with the root, although it has frame_a: a link that becomes the root keeps its frame
    named: Iterable[str] = () if isinstance(options.frames, str) else options.frames
    wanted = {leaf.name for leaf in skeleton.leaves()}.union(named)
    return tuple(link for link in skeleton.links if link.name in wanted)
