"""Finds the reach of a robot, and the greatest load of gravity in each joint, over fixed poses of each branch.

A branch leads from the root to one leaf. The grid of a branch has all combinations of a few positions of its joints;
other joints stay at their starts. A branch with too many joints has two grids: one for joints near the root, one for
joints near the leaf. Mimic joints move with their leaders. A load acts along the joint's own axis: a leader does not
carry its followers. Gravity acts along -z of the root, as in `World`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from urdfsync.formats.urdf.kinematics.mechanism import turns
from urdfsync.formats.urdf.kinematics.poses import (
    GRAVITY,
    Pose,
    compose,
    motion,
    pose,
    position_ranges,
    start_positions,
)
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint, Link

Array = NDArray[np.float64]
_Moment = tuple[float, Array]
"""Mass, and mass times centre of mass."""

_MOST = 2000
"""The greatest number of poses of a grid. So many poses take 10 ms with seven joints."""
_QUARTER = math.pi / 2


@np.errstate(all="ignore")
def find_extremes(tree: KinematicTree) -> tuple[float | None, Mapping[str, float]]:
    """Return the greatest distance of a link from the root, and the greatest load of each joint with an axis.

    A robot with loops gives None and no loads: few poses close the loops.
    """
    if tree.loops:
        return None, {}
    starts, reach, loads, children = start_positions(tree), 0.0, dict[str, float](), tree.children()
    links = {link.name: link for link in tree.links}
    folded = dict[str, _Moment]()  # the load of each joint at the start, in the frame of its parent
    for joint in reversed(tree.joints):
        at = compose(pose(joint.origin), motion(joint, starts[joint.name]))
        below = [folded[other.name] for other in children.get(joint.child, ())]
        folded[joint.name] = _placed(at, _sum([_own(links[joint.child]), *below]))
    for path, grid in find_grids(tree):
        on_path = {joint.name for joint in path}
        rotation, place = np.eye(3)[None], np.zeros((1, 3))
        placed = list[tuple[Array, Array]]()
        for joint, values in zip(path, grid, strict=True):
            turned, moved = map(np.array, pose(joint.origin))
            place, rotation = place + rotation @ moved, rotation @ turned
            if MOTION_KINDS.get(joint.type) == "rotational":
                rotation = rotation @ turns(np.array([joint.axis]), values)
            elif MOTION_KINDS.get(joint.type) == "translational":
                place = place + values[:, None] * (rotation @ np.array(joint.axis))
            placed.append((rotation, place))
            reach = max(float(np.sqrt((place**2).sum(axis=1)).max()), reach)
        mass, moment = 0.0, np.zeros((1, 3))
        for joint, (rotation, place) in zip(reversed(path), reversed(placed), strict=True):
            beside = [folded[other.name] for other in children.get(joint.child, ()) if other.name not in on_path]
            own_mass, own_moment = _sum([_own(links[joint.child]), *beside])
            mass, moment = mass + own_mass, moment + own_mass * place + rotation @ own_moment
            axis, lever = rotation @ np.array(joint.axis), moment - mass * place
            if MOTION_KINDS.get(joint.type) == "rotational":
                load = axis[:, 0] * lever[:, 1] - axis[:, 1] * lever[:, 0]
            elif MOTION_KINDS.get(joint.type) == "translational":
                load = mass * axis[:, 2]
            else:
                continue
            # the last bits differ between machines
            greatest = round(GRAVITY * float(np.abs(load).max()), 9)
            loads[joint.name] = max(greatest, loads.get(joint.name, 0.0))
    # squares and products of large numbers may overflow
    finite = {name: load for name, load in loads.items() if math.isfinite(load)}
    return round(reach, 9) if math.isfinite(reach) else None, finite


def positions(joint: Joint, lower: float, upper: float, start: float) -> list[float]:
    """Return the positions of a joint in a grid: the ends of the range, and the quarter turns between the ends."""
    if MOTION_KINDS.get(joint.type) == "rotational" and upper - lower >= 4 * _QUARTER:
        return [k * _QUARTER for k in range(4)]
    if MOTION_KINDS.get(joint.type) is None or not 0 <= upper - lower < math.inf:
        return [start]
    quarters = range(math.ceil(lower / _QUARTER), math.floor(upper / _QUARTER) + 1)
    return sorted({lower, upper, *(k * _QUARTER for k in quarters if joint.type != "prismatic")})


def find_grids(tree: KinematicTree) -> Iterator[tuple[Sequence[Joint], Sequence[Array]]]:
    """Yield the joints of each branch, each with its positions in all poses of a grid, or its only position."""
    towards = {joint.child: joint for joint in tree.joints}
    starts, ranges = start_positions(tree), position_ranges(tree)
    for leaf in tree.leaves():
        path, link = list[Joint](), leaf.name
        while link in towards:
            path.insert(0, towards[link])
            link = path[0].parent
        yield from ((path, grid) for grid in _grids(tree, path, starts, ranges))


def _grids(
    tree: KinematicTree, path: Sequence[Joint], starts: Mapping[str, float], ranges: Mapping[str, tuple[float, float]]
) -> Iterator[Sequence[Array]]:
    """Yield the grids of one branch."""
    found = {joint.name: positions(joint, *ranges[joint.name], starts[joint.name]) for joint in path if not joint.mimic}
    for names in (list(found), list(reversed(found))):
        values: dict[str, Array] = {name: np.array([start]) for name, start in starts.items()}
        chosen = list[str]()
        for name in names:
            if math.prod(len(found[other]) for other in (*chosen, name)) <= _MOST:
                chosen.append(name)
        number = np.arange(math.prod(len(found[name]) for name in chosen))
        for name in chosen:
            values[name] = np.array(found[name])[number % len(found[name])]
            number = number // len(found[name])
        for joint in tree.leaders_first():
            if joint.mimic is not None:
                values[joint.name] = joint.mimic.multiplier * values[joint.mimic.joint] + joint.mimic.offset
        yield [values[joint.name] for joint in path]
        if len(chosen) == len(names):
            return


def _own(link: Link) -> _Moment:
    if link.inertial is None:
        return 0.0, np.zeros(3)
    return link.inertial.mass, link.inertial.mass * np.array(link.inertial.origin.xyz)


def _sum(moments: Sequence[_Moment]) -> _Moment:
    return sum(mass for mass, _ in moments), np.sum([moment for _, moment in moments], axis=0)


def _placed(at: Pose, moment: _Moment) -> _Moment:
    """Return `moment`, which is in the frame at the pose `at`, in the reference frame of this pose."""
    rotation, place = map(np.array, at)
    return moment[0], rotation @ moment[1] + moment[0] * place
