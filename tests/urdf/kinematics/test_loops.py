"""Loops are closed at the start, and have the equations and states that an engineer would give them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import pytest

from urdfsync.urdf.kinematics.loops import Assembly, LoopFault, assemble
from urdfsync.urdf.kinematics.poses import compose, link_poses, pose
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import Joint, JointType, Limit, Link, Loop, Origin, Robot, Vector

Z = (0.0, 0.0, 1.0)


def joint(name: str, kind: JointType, parent: str, child: str, xyz: Vector = (0, 0, 0), **fields: Any) -> Joint:
    rpy = fields.pop("rpy", (0.0, 0.0, 0.0))
    return Joint(name, kind, parent, child, Origin(xyz, rpy), **{"axis": Z, **fields})


def tree(joints: Sequence[Joint], *loops: Loop) -> KinematicTree:
    links = dict.fromkeys(name for joint in joints for name in (joint.parent, joint.child))
    return KinematicTree.of(Robot("r", tuple(map(Link, links)), tuple(joints), loops=loops))


def assembled(tree: KinematicTree, *named: str) -> Assembly:
    result = assemble(tree, frozenset(named or [joint.name for joint in tree.joints]), frozenset(named))
    assert isinstance(result, Assembly), result
    return result


def faults(tree: KinematicTree, *named: str) -> list[tuple[str, str]]:
    result = assemble(tree, frozenset(named), frozenset(named))
    assert not isinstance(result, Assembly), result
    assert all(isinstance(fault, LoopFault) for fault in result)
    return [(fault.code, fault.loop) for fault in result]


def distances(tree: KinematicTree, assembly: Assembly) -> list[float]:
    """Between the frames of each loop at the start, by the poses of links that diagrams use."""
    poses = link_poses(tree, assembly.positions)
    sides = [((loop.parent, loop.origin), (loop.child, loop.child_origin)) for loop in tree.loops]
    ends = [[compose(poses[link], pose(origin))[1] for link, origin in side] for side in sides]
    return [math.dist(a, b) for a, b in ends]


def four_bar(crank: float = 0.5, coupler: float = 1.0, rocker: float = 1.5, pin: Loop | None = None) -> KinematicTree:
    """Bars of 0.2, 0.5 and 0.4 m on a base of 0.6 m."""
    joints = [
        joint("crank", "continuous", "base", "a", start=crank),
        joint("coupler", "continuous", "a", "b", (0.2, 0, 0), start=coupler),
        joint("rocker", "continuous", "base", "c", (0.6, 0, 0), start=rocker),
    ]
    return tree(joints, pin or Loop("pin", "revolute", "b", "c", Origin((0.5, 0, 0)), Origin((0.4, 0, 0)), Z))


@pytest.mark.parametrize("crank", [0.5, 1.5, -2.0])
def test_a_four_bar_has_the_angles_of_its_triangles(crank: float) -> None:
    x, y = 0.6 - 0.2 * math.cos(crank), -0.2 * math.sin(crank)
    diagonal = math.hypot(x, y)
    to_coupler = math.acos((0.5**2 + diagonal**2 - 0.4**2) / (2 * 0.5 * diagonal))
    to_rocker = math.acos((0.4**2 + diagonal**2 - 0.5**2) / (2 * 0.4 * diagonal))
    expected = {"coupler": math.atan2(y, x) + to_coupler - crank, "rocker": math.pi + math.atan2(y, x) - to_rocker}
    start = {name: value + 0.2 for name, value in expected.items()}
    found = assembled(four_bar(crank, start["coupler"], start["rocker"]), "crank")
    assert found.positions == pytest.approx({"crank": crank, **expected}, abs=2e-12)
    assert (found.freedoms, found.states, found.driven) == (1, ("crank",), ("crank",))
    assert found.reach == {"crank": 1.0}  # it is a crank: no way is too long
    closure = found.closures["pin"]
    assert (closure.planar, closure.weaker) == (Z, None)
    assert (closure.translations, closure.rotations) == (((1, 0, 0), (0, 1, 0)), ())


def test_the_start_has_twelve_digits() -> None:
    positions = assembled(four_bar(), "crank").positions
    assert all(round(value, 12) == value for value in positions.values())


def test_a_slider_crank_starts_where_its_rod_reaches() -> None:
    joints = [
        joint("crank", "continuous", "base", "a", start=1.0),
        joint("rod", "continuous", "a", "b", (0.1, 0, 0), start=-1.2),
        joint("slider", "prismatic", "base", "c", axis=(1.0, 0.0, 0.0), start=0.3, limit=Limit(0, 1)),
    ]
    found = assembled(tree(joints, Loop("pin", "ball", "b", "c", Origin((0.3, 0, 0)))), "crank")
    assert found.positions["slider"] == pytest.approx(
        0.1 * math.cos(1) + math.sqrt(0.09 - (0.1 * math.sin(1)) ** 2), abs=1e-12
    )
    assert found.closures["pin"].planar == Z
    assert found.states == ("crank",)


def test_drives_beyond_the_freedoms_are_told() -> None:
    found = assembled(four_bar(), "crank", "rocker")
    assert (found.driven, found.excess) == (("crank",), ("rocker",))
    free = assembled(four_bar())  # nothing is named
    assert (free.driven, free.excess) == (("crank",), ())


def test_a_gap_along_the_normal_is_told_and_too_large_a_fault() -> None:
    def pin(height: float) -> Loop:
        return Loop("pin", "revolute", "b", "c", Origin((0.5, 0, height)), Origin((0.4, 0, 0)), Z)

    low = four_bar(pin=pin(5e-5))
    assert distances(low, assembled(low, "crank")) == pytest.approx([5e-5], abs=1e-11)
    assert faults(four_bar(pin=pin(2e-4)), "crank") == [("loop-open", "pin")]


def test_bars_that_are_too_short_leave_a_loop_open() -> None:
    short = Loop("pin", "revolute", "b", "c", Origin((0.1, 0, 0)), Origin((0.1, 0, 0)), Z)
    result = assemble(four_bar(pin=short), frozenset(), frozenset())
    assert isinstance(result, tuple)
    assert "links 'b' and 'c' stay 2" in result[0].message  # 200 mm at least


def test_a_four_bar_in_line_is_singular() -> None:
    joints = [
        joint("crank", "continuous", "base", "a"),
        joint("coupler", "continuous", "a", "b", (0.2, 0, 0)),
        joint("rocker", "continuous", "base", "c", (0.6, 0, 0), start=math.pi),
    ]
    in_line = tree(joints, Loop("pin", "ball", "b", "c", Origin((0.5, 0, 0)), Origin((-0.1, 0, 0))))
    assert faults(in_line, "crank") == [("loop-singular", "pin")]
