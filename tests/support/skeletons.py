"""Small robots in canonical order, from their joints."""

from __future__ import annotations

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import Joint, Limit, Link, Mimic, Robot


def skeleton(*joints: Joint, links: tuple[Link, ...] = ()) -> KinematicTree:
    """Joints and their links; those of `links` are more than a name."""
    names = {joint.parent: None for joint in joints} | {joint.child: None for joint in joints}
    known = {link.name: link for link in links}
    every = tuple(known.get(name, Link(name)) for name in names) or links
    return KinematicTree.of(Robot("r", every, joints))


GRIPPER = skeleton(
    Joint("slide", "prismatic", "palm", "left", limit=Limit(0, 0.1)),
    Joint("other", "prismatic", "palm", "right", mimic=Mimic("slide", -1)),
    Joint("turn", "continuous", "base", "palm"),
    Joint("mount", "fixed", "palm", "camera"),
    Joint("pinion", "continuous", "left", "gear", mimic=Mimic("other", 80)),
    Joint("lock", "revolute", "camera", "lens", mimic=Mimic("mount", 1, 0.5)),
)
"""Fingers and a pinion that follow, and a joint that follows one that never moves."""
