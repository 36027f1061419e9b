"""How a mobile robot stands: the height of its root frame, and the record of it, `<Robot>Stance.mo`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from urdfsync.domain import Import, Target
from urdfsync.urdf.kinematics.poses import compose, link_poses, lowest_point, pose, start_positions
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.shapes import hull


def stance_data(ground: KinematicTree, imports: Mapping[str, Import], target: Target) -> dict[str, Any]:
    """Data of the record; `ground` has the joints, and what may touch the ground."""
    return {
        "within": target.package,
        "record": f"{target.name}Stance",
        "title": f"robot {target.name}",
        "height": standing_height(ground, imports),
    }


def standing_height(skeleton: KinematicTree, imports: Mapping[str, Import]) -> float | None:
    """Height of the root frame when the lowest collision shape just touches the ground; None without any shape."""
    poses = link_poses(skeleton, start_positions(skeleton))
    heights = [
        lowest_point(shape.geometry, compose(poses[link.name], pose(shape.origin)), hull(shape.geometry, imports))
        for link in skeleton.links
        for shape in link.collisions
    ]
    lowest = min((height for height in heights if height is not None and math.isfinite(height)), default=None)
    return None if lowest is None else round(-lowest, 12)
