"""Chooses the tree of a robot among its joints: the others close loops, or are turned around.

In SDF, joints may form any graph; in URDF they form a tree, and a joint leads from parent to child. A loop of the
models has no drive, no limits and no losses, so it is cut at a plain joint if it has one.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import NamedTuple

from urdfsync.formats.sdf.frames import Frame
from urdfsync.formats.sdf.joints import SdfJoint

LOOP_KINDS = ("revolute", "continuous", "ball", "universal", "fixed")
"""Types of joints that can close a loop."""


class JointTree(NamedTuple):
    """The tree of a robot: `joints` are in order, parents first."""

    root: Frame
    joints: list[SdfJoint]
    loops: list[SdfJoint]
    loose: list[Frame]
    """Links that no joint connects with the root."""


def find_tree(world: Frame, links: Collection[Frame], joints: Iterable[SdfJoint], canonical: Frame) -> JointTree:
    """Return the tree of a model.

    Its root is the world if a joint leads there, else the canonical link or the first link without a joint above it.
    """
    joins = [joint for joint in joints if joint.kind != "gearbox"]
    groups, chosen = {link: {link} for link in (*links, world)}, set[Frame]()
    for joint in sorted(joins, key=_cost_of_cut, reverse=True):  # joints of one cost stay in order
        first, second = groups[joint.parent], groups[joint.child]
        if first is not second:
            chosen.add(joint.frame)
            first |= second
            groups |= dict.fromkeys(second, first)
    root = _root(world, groups, {joint.child for joint in joins if joint.frame in chosen}, canonical)
    at_link = dict[Frame, list[SdfJoint]]()
    for joint in (joint for joint in joins if joint.frame in chosen):
        at_link.setdefault(joint.parent, []).append(joint)
        at_link.setdefault(joint.child, []).append(joint)
    ordered, reached, waiting = list[SdfJoint](), {root}, [root]
    for link in waiting:  # grows
        for joint in at_link.get(link, ()):
            is_turned = joint.child is link
            other = joint.parent if is_turned else joint.child
            if other not in reached:
                ordered.append(joint._replace(parent=link, child=other, is_turned=is_turned))
                reached.add(other)
                waiting.append(other)
    loops = [joint for joint in joins if joint.frame not in chosen and joint.parent in reached]
    return JointTree(root, ordered, loops, [link for link in links if link not in reached])


def _root(world: Frame, groups: dict[Frame, set[Frame]], children: Collection[Frame], canonical: Frame) -> Frame:
    if len(groups[world]) > 1:
        return world
    tops = [link for link in groups if link in groups[canonical] and link not in children]
    return canonical if canonical in tops or not tops else tops[0]


def _cost_of_cut(joint: SdfJoint) -> int:
    """Return how much is lost if a joint closes a loop: nothing for a ball, most for a joint that can't."""
    if joint.kind not in LOOP_KINDS or joint.kind == "fixed":
        return 3
    return 2 if joint.has_numbers else int(joint.kind in ("revolute", "continuous"))
