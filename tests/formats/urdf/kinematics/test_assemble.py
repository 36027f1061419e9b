"""Loops are closed at the start, and have the equations and states that an engineer would give them."""

from __future__ import annotations

import math
import random
import time
from collections.abc import Mapping, Sequence
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from msgspec.structs import replace
from support import loops
from support.strandbeest import strandbeest

from urdfsync.formats.urdf.kinematics.assemble import assemble
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops, Closure, find_loop_findings
from urdfsync.formats.urdf.kinematics.poses import compose, link_poses, pose, start_positions
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import Joint, JointType, Limit, Link, Loop, LoopKind, Mimic, Origin, Robot, Vector

Y, Z = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
FIVE_BAR, SPATIAL = map(KinematicTree.of, (loops.FIVE_BAR, loops.SPATIAL))


def joint(name: str, kind: JointType, parent: str, child: str, xyz: Vector = (0, 0, 0), **fields: Any) -> Joint:
    rpy = fields.pop("rpy", (0.0, 0.0, 0.0))
    return Joint(name, kind, parent, child, Origin(xyz, rpy), **{"axis": Z, **fields})


def tree(joints: Sequence[Joint], *loops: Loop) -> KinematicTree:
    links = dict.fromkeys(name for joint in joints for name in (joint.parent, joint.child))
    return KinematicTree.of(Robot("r", tuple(map(Link, links)), tuple(joints), loops=loops))


def assembled(tree: KinematicTree, *named: str) -> ClosedLoops:
    result = assemble(tree, frozenset(named or [joint.name for joint in tree.joints]), frozenset(named))
    assert not result.faults
    return result


def faults(tree: KinematicTree, *named: str) -> list[tuple[str, str]]:
    result = assemble(tree, frozenset(named), frozenset(named))
    return [(fault.code, fault.path.removeprefix("loop ")) for fault in result.faults]


def distances(tree: KinematicTree, closed: ClosedLoops) -> list[float]:
    """Between the frames of each loop at the start, by the poses of links that diagrams use."""
    poses = link_poses(tree, start_positions(closed.tree))
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
    assert start_positions(found.tree) == pytest.approx({"crank": crank, **expected}, abs=2e-12)
    assert (found.states, found.driven) == (("crank",), frozenset({"crank"}))
    assert found.reach == {"crank": 1.0}  # it is a crank: no way is too long
    closure = found.closures["pin"]
    assert (closure.planar, closure.weaker) == (Z, None)
    assert (closure.translations, closure.rotations) == (((1, 0, 0), (0, 1, 0)), ())


def test_a_given_start_is_kept_exactly_if_that_is_possible() -> None:
    bars = tuple(replace(each, start=2.0 if each.name == "rocker" else None) for each in four_bar().joints)
    found = assembled(replace(four_bar(), joints=bars), "crank")
    assert (start_positions(found.tree)["rocker"], found.moved, found.driven) == (2.0, {}, frozenset({"crank"}))
    assert distances(found.tree, found) == pytest.approx([0], abs=1e-11)
    crossed = assembled(four_bar(crank=1.0, coupler=0.0, rocker=1.5), "crank")
    assert start_positions(crossed.tree)["crank"] == 1.0
    assert list(crossed.moved) == ["coupler", "rocker"]
    (note,) = (found for found in find_loop_findings(crossed) if found.code == "start-moved")
    assert (note.path, "'coupler' by 0.525 rad, 'rocker' by 0.19 rad" in note.message) == ("joint coupler", True)
    far = assembled(four_bar(rocker=0.5))
    assert start_positions(far.tree)["crank"] == 0.5, "the rocker never comes there"


def test_drives_are_chosen_by_efforts_and_passive_names_and_told_with_the_reason() -> None:
    def chosen(**changes: Any) -> Mapping[str, str]:
        joints = [replace(each, **changes.get(each.name, {})) for each in loops.FIVE_BAR.joints]
        names = {each.name: changes.get(each.name, {}).get("name", each.name) for each in joints}
        bare = [replace(each, name=names[each.name], actuated=False) for each in joints]
        return assembled(KinematicTree.of(replace(loops.FIVE_BAR, joints=tuple(bare)))).choices

    first = "the first free one"
    assert chosen() == {"left_pivot": first, "left_pin": first}
    assert chosen(right_pivot={"limit": Limit(effort=5.0)})["right_pivot"] == "by its limit of effort"
    assert chosen(left_pivot={"name": "passive1"}) == {"left_pin": first, "right_pivot": first}
    (told,) = find_loop_findings(replace(assembled(four_bar()), gaps={}, moved={}))
    assert (told.code, told.message) == ("loop-drives", "Run and Test drive 'crank' (the first free one)")
    assert assembled(FIVE_BAR, "left_pivot").choices == {}, "a source that names drives chooses"


def test_a_slider_crank_starts_where_its_rod_reaches() -> None:
    joints = [
        joint("crank", "continuous", "base", "a", start=1.0),
        joint("rod", "continuous", "a", "b", (0.1, 0, 0), start=-1.2),
        joint("slider", "prismatic", "base", "c", axis=(1.0, 0.0, 0.0), start=0.3, limit=Limit(0, 1)),
    ]
    found = assembled(tree(joints, Loop("pin", "ball", "b", "c", Origin((0.3, 0, 0)))), "crank")
    assert start_positions(found.tree)["slider"] == pytest.approx(
        0.1 * math.cos(1) + math.sqrt(0.09 - (0.1 * math.sin(1)) ** 2), abs=1e-12
    )
    assert found.closures["pin"].planar == Z
    assert found.states == ("crank",)


def test_drives_beyond_the_freedoms_are_told() -> None:
    found = assembled(four_bar(), "crank", "rocker")
    assert (found.driven, found.excess) == (frozenset({"crank"}), ("rocker",))
    free = assembled(four_bar())  # nothing is named
    assert (free.driven, free.excess) == (frozenset({"crank"}), ())


def test_a_gap_along_the_normal_is_told_and_too_large_a_fault() -> None:
    def pin(height: float) -> Loop:
        return Loop("pin", "revolute", "b", "c", Origin((0.5, 0, height)), Origin((0.4, 0, 0)), Z)

    low = four_bar(pin=pin(5e-5))
    assert distances(low, assembled(low, "crank")) == pytest.approx([5e-5], abs=1e-11)
    assert faults(four_bar(pin=pin(2e-4)), "crank") == [("loop-open", "pin")]


def test_a_five_bar_has_two_freedoms_and_one_for_each_that_nothing_drives() -> None:
    assert assembled(FIVE_BAR, "left_pivot", "right_pivot").states == ("left_pivot", "right_pivot")
    one = assembled(FIVE_BAR, "right_pivot")
    assert (one.driven, one.states[0], len(one.states)) == (frozenset({"right_pivot"}), "right_pivot", 2)
    three = assembled(FIVE_BAR, "left_pivot", "right_pivot", "right_pin")
    assert (three.driven, three.excess) == (frozenset({"left_pivot", "right_pivot"}), ("right_pin",))


def test_cranks_that_are_geared_hold_the_tip_between_them() -> None:
    left, left_pin, right, right_pin = FIVE_BAR.joints
    follower = replace(right, mimic=Mimic("left_pivot", -1, math.pi), start=None)
    geared = replace(FIVE_BAR, joints=(left, left_pin, follower, right_pin))
    found = assembled(geared, "left_pivot")
    assert found.states == ("left_pivot",)
    assert found.joints == ("left_pivot", "left_pin", "right_pivot", "right_pin")
    assert start_positions(found.tree)["right_pivot"] == math.pi - 2.0
    (tip,) = geared.loops
    x, _, _ = compose(link_poses(geared, start_positions(found.tree))["left_rod"], pose(tip.origin))[1]
    assert x == pytest.approx(0.125, abs=1e-12)


def test_a_spatial_loop_is_closed_by_three_equations() -> None:
    found = assembled(SPATIAL, "crank_pivot")
    assert distances(SPATIAL, found) == pytest.approx([0], abs=1e-11)
    assert (found.states, start_positions(found.tree)["crank_pivot"]) == (("crank_pivot",), 1.0)
    assert found.closures["ball"] == Closure(((1, 0, 0), (0, 1, 0), (0, 0, 1)), ())


def test_a_spherical_four_bar_is_closed_by_what_its_axes_leave() -> None:
    """All axes meet in one point: five equations for its pin would be three too many."""
    joints = [
        joint("crank", "continuous", "base", "a"),
        joint("coupler", "continuous", "a", "b", rpy=(0.7, 0, 0), start=1.4),
        joint("rocker", "continuous", "base", "c", rpy=(0, 1.3, 0), start=0.4),
    ]
    pin = Loop("pin", "revolute", "b", "c", Origin((0, 0, 0), (0, 0.9, 0)), Origin((0, 0, 0), (0.8, 0, 0)), Z)
    found = assembled(tree(joints, pin), "crank")
    closure = found.closures["pin"]
    assert (len(found.states), closure.translations, len(closure.rotations), closure.planar) == (1, (), 2, None)
    assert closure.weaker is not None
    assert closure.weaker.startswith("closed by 2 of 5 equations")


def delta() -> KinematicTree:
    """Three arms, and rods on universal joints to a platform 0.4 m below the base, which loops fix to two of them."""
    rod = math.hypot(0.4, 0.05)
    joints, swing = list[Joint](), math.acos(0.05 / rod)
    for k in range(3):
        joints += [
            joint(f"mount{k}", "fixed", "base", f"side{k}", rpy=(0, 0, 2 * math.pi * k / 3)),
            joint(f"arm{k}", "continuous", f"side{k}", f"upper{k}", (0.1, 0, 0), axis=Y),
            joint(f"rod{k}_y", "continuous", f"upper{k}", f"cross{k}", (0.15, 0, 0), axis=Y, start=swing + 0.1),
            joint(f"rod{k}_z", "continuous", f"cross{k}", f"lower{k}"),
            joint(f"foot{k}_z", "continuous", f"lower{k}", f"foot{k}", (rod, 0, 0)),
            joint(f"foot{k}_y", "continuous", f"foot{k}", f"end{k}", axis=Y, start=-swing),
        ]
    ends = [Origin((-0.3, 0, 0), (0, 0, -2 * math.pi * k / 3)) for k in range(3)]
    return tree(joints, *(Loop(f"platform{k}", "fixed", "end0", f"end{k}", ends[0], ends[k]) for k in (1, 2)))


def test_a_delta_has_three_freedoms_and_keeps_its_platform_level() -> None:
    robot, arms = delta(), ("arm0", "arm1", "arm2")
    found = assembled(robot, *arms)
    assert found.states == arms
    assert distances(robot, found) == pytest.approx([0, 0], abs=1e-11)
    rotation, place = link_poses(robot, start_positions(found.tree))["end0"]
    assert np.abs(np.array(rotation) - np.eye(3)).max() < 1e-11
    assert place == pytest.approx((0.3, 0, -0.4), abs=1e-11)
    assert {len(c.translations) + len(c.rotations) for c in found.closures.values()} == {6}
    assert not any(closure.weaker for closure in found.closures.values())
    assert all(0 < reach <= 1 for reach in found.reach.values())


def test_bars_that_are_too_short_leave_a_loop_open() -> None:
    short = Loop("pin", "revolute", "b", "c", Origin((0.1, 0, 0)), Origin((0.1, 0, 0)), Z)
    result = assemble(four_bar(pin=short), frozenset(), frozenset())
    assert "links 'b' and 'c' stay 2" in result.faults[0].message  # 200 mm at least


def limited(lower: float, upper: float) -> KinematicTree:
    """A four-bar whose rocker is at 1.64 rad, or at -2.2 with its bars folded to the other side."""
    joints = [
        joint("crank", "continuous", "base", "a", start=0.5),
        joint("coupler", "continuous", "a", "b", (0.2, 0, 0)),
        joint("rocker", "revolute", "base", "c", (0.6, 0, 0), limit=Limit(lower, upper)),
    ]
    return tree(joints, Loop("pin", "revolute", "b", "c", Origin((0.5, 0, 0)), Origin((0.4, 0, 0))))


def test_a_loop_closes_within_limits() -> None:
    assert start_positions(assembled(limited(1, 2), "crank").tree)["rocker"] == pytest.approx(1.638122723047)
    folded = assembled(limited(-3, -1), "crank")
    assert -3 <= start_positions(folded.tree)["rocker"] <= -1
    assert distances(limited(-3, -1), folded) == pytest.approx([0], abs=1e-11)
    assert assembled(limited(0, 0), "crank").states == ("crank",)  # limits that were left out


@pytest.mark.slow
def test_limits_that_keep_a_loop_open_are_named() -> None:
    result = assemble(limited(2.9, 3), frozenset(), frozenset())
    assert "'rocker'" in result.faults[0].hint


FINGERS = (
    ((0.5, 0.3, 0.4, 0.6), ((-1.4, 1.0), (-0.2, 2.4), (-1.5, 1.1))),
    ((0.6, 0.2, 0.7, 0.8), ((-1.2, 1.6), (-1.0, 0.8), (-0.2, 2.6))),
    ((0.2, 0.8, 0.5, 0.8), ((1.2, 4.1), (1.4, 4.2), (0.8, 3.4))),
)
"""Lengths of crank, coupler, rocker and base of four-bars, and the limits of their joints.

None closes from the start; they close from different poses: the first one near it, the last one from others only.
"""


def hand(fingers: Sequence[Any] = FINGERS) -> KinematicTree:
    joints, pins = list[Joint](), list[Loop]()
    for k, ((crank, coupler, rocker, base), limits) in enumerate(fingers):
        ends = ((f"crank{k}", "palm", f"a{k}", 0.0), (f"coupler{k}", f"a{k}", f"b{k}", crank))
        for (name, parent, child, x), (lower, upper) in zip(
            (*ends, (f"rocker{k}", "palm", f"c{k}", base)), limits, strict=True
        ):
            joints.append(joint(name, "revolute", parent, child, (x, 0, 0), limit=Limit(lower, upper)))
        pins.append(Loop(f"pin{k}", "revolute", f"b{k}", f"c{k}", Origin((coupler, 0, 0)), Origin((rocker, 0, 0)), Z))
    return tree(joints, *pins)


def test_each_finger_of_a_hand_is_closed_from_a_pose_of_its_own() -> None:
    found = assembled(hand())
    assert distances(hand(), found) == pytest.approx([0, 0, 0], abs=1e-11)
    starts = start_positions(found.tree)
    assert all(each.limit.lower <= starts[each.name] <= each.limit.upper for each in hand().joints if each.limit)
    assert len(found.states) == 3
    assert all(starts[name] == round(starts[name], 9) for name in found.driven), "a start that reads well"


def test_a_loop_that_stays_open_is_told_without_the_others() -> None:
    bad = ((0.2, 0.5, 0.4, 0.6), ((-3.0, 3.0), (-3.0, 3.0), (2.9, 3.0)))
    (fault,) = assemble(hand((*FINGERS, bad)), frozenset(), frozenset()).faults
    assert (fault.code, fault.path) == ("loop-open", "loop pin3")
    assert fault.hint == "the loop closes beyond the limits of 'rocker3': correct the limits, or its frames"


def test_loops_that_close_only_alone_are_told_so() -> None:
    """Two pins hold one bar at places on the ground that are too far apart."""
    joints = [
        joint("swing", "continuous", "base", "a"),
        joint("turn", "continuous", "a", "b", (0.2, 0, 0)),
        joint("end", "continuous", "b", "c", (0.5, 0, 0)),
    ]
    pins = [Loop(f"pin{x:g}", "ball", "base", link, Origin((x, 0, 0))) for x, link in ((0.6, "c"), (0.2, "b"))]
    found = assemble(tree(joints, *pins), frozenset(), frozenset()).faults
    assert {(fault.code, "not with other loops" in fault.hint) for fault in found} == {("loop-open", True)}


def test_test_moves_a_rocker_as_far_as_its_loop_allows() -> None:
    found = assembled(four_bar(rocker=2.0), "rocker")
    (reach,) = found.reach.values()
    assert 0 < reach < 1
    crank, coupler, rocker = start_positions(found.tree).values()
    moved = assembled(four_bar(crank, coupler, rocker + reach), "rocker")
    assert start_positions(moved.tree)["rocker"] == rocker + reach


def slider_crank(angle: float) -> KinematicTree:
    starts = {"crank_pivot": angle, "crank_pin": -1.2 * angle, "slide": 0.5 - 0.1 * angle}
    joints = tuple(replace(joint, start=starts[joint.name]) for joint in loops.SLIDER_CRANK.joints)
    return KinematicTree.of(replace(loops.SLIDER_CRANK, joints=joints))


def test_a_slider_does_not_drive_a_crank_in_line() -> None:
    assert faults(slider_crank(0), "slide") == [("loop-singular", "wrist_pin")]
    assert assembled(slider_crank(0), "crank_pivot").driven == {"crank_pivot"}
    assert assembled(slider_crank(1), "slide").driven == {"slide"}


def test_loops_that_have_no_model_are_faults() -> None:
    bars = [joint("crank", "continuous", "base", "a"), joint("bar", "fixed", "base", "b")]
    assert faults(tree([bars[1]], Loop("weld", "fixed", "base", "b"))) == [("loop-rigid", "weld")]
    plane = joint("table", "planar", "base", "b")
    assert faults(tree([bars[0], plane], Loop("pin", "ball", "a", "b"))) == [("loop-free-joint", "pin")]
    (pin,) = four_bar().loops
    twice = replace(four_bar(), loops=(pin, replace(pin, name="same")))
    assert faults(twice) == [("loop-redundant", "same")]
    thrice = replace(twice, loops=(*twice.loops, replace(pin, name="still")))
    assert faults(thrice) == [("loop-redundant", "same"), ("loop-redundant", "still")]
    far = replace(four_bar(), loops=(replace(pin, origin=Origin((1e200, 0, 0))),))
    assert faults(far) == [("loop-open", "pin")]


@pytest.mark.slow
def test_rounding_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    robots = [four_bar(), FIVE_BAR, SPATIAL, delta(), hand()]
    before = [assembled(robot) for robot in robots]
    noise, exact = np.random.default_rng(0), np.linalg.eigh

    def rounded(matrix: Any) -> Any:
        return exact(matrix * (1 + 1e-13 * noise.normal()) + 1e-14 * np.diag(noise.normal(size=len(matrix))))

    monkeypatch.setattr(np.linalg, "eigh", rounded)
    assemble.cache_clear()
    assert [assembled(robot) for robot in robots] == before


def random_loop(seed: int) -> tuple[KinematicTree, Mapping[str, float]]:
    """A chain of joints somewhere in a plane or in space, whose ends a loop holds, and its closed positions."""
    source = random.Random(seed)
    is_planar, kind = source.random() < 0.4, source.choice(get_args(LoopKind))

    def vector() -> Vector:
        x, y, z = (source.uniform(-1, 1) for _ in range(3))
        return (x, y, 0 if is_planar else z)

    def turn() -> Vector:
        roll, pitch, yaw = (source.uniform(-2, 2) for _ in range(3))
        return (0, 0, yaw) if is_planar else (roll, pitch, yaw)

    joints = []
    for k in range(source.randint(4, 8)):
        slides = source.random() < 0.2
        x, y, z = vector() if slides or not is_planar else Z
        axis = (x / math.hypot(x, y, z), y / math.hypot(x, y, z), z / math.hypot(x, y, z))
        type_: JointType = "prismatic" if slides else "continuous"
        joints.append(joint(f"j{k}", type_, f"l{k}", f"l{k + 1}", vector(), rpy=turn(), axis=axis, limit=Limit(-9, 9)))
    closed = {joint.name: source.uniform(-1, 1) for joint in joints}
    end = Origin(vector(), turn())
    last = f"l{len(joints)}"
    rotation, place = compose(link_poses(tree(joints), closed)[last], pose(end))
    (a, _, _), (b, _, _), (c, d, e) = rotation
    frame = Origin(place, (math.atan2(d, e), math.asin(-c), math.atan2(b, a)))
    joints = [replace(joint, start=closed[joint.name] + source.uniform(-0.05, 0.05)) for joint in joints]
    return tree(joints, Loop("loop", kind, "l0", last, frame, end, Z, (1.0, 0.0, 0.0))), closed


def rank(tree: KinematicTree, positions: Mapping[str, float]) -> int:
    """Of the equations of a loop, by differences."""
    (loop,) = tree.loops

    def left(values: Mapping[str, float]) -> Any:
        rotation, place = compose(link_poses(tree, values)[loop.child], pose(loop.child_origin))
        frame = np.array(pose(loop.origin)[0])
        turned = frame.T @ np.array(rotation)
        held = {"ball": [], "revolute": turned[:, 2], "universal": turned[2, :1], "fixed": turned.ravel()}[loop.kind]
        return np.concatenate([place, held])

    steps = [{**positions, name: value + 1e-6} for name, value in positions.items()]
    columns = [(left(step) - left(positions)) / 1e-6 for step in steps]
    return int(np.linalg.matrix_rank(np.array(columns), tol=1e-4))


@pytest.mark.slow
@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10**9))
@example(709)  # no freedom, and hardly regular
def test_a_random_loop_is_closed_and_has_the_freedoms_that_its_equations_leave(seed: int) -> None:
    robot, closed = random_loop(seed)
    found = assembled(robot)
    assert distances(robot, found) == pytest.approx([0], abs=1e-9)
    assert len(found.states) == len(robot.joints) - rank(robot, closed)


def row_of_four_bars(count: int) -> KinematicTree:
    """Four-bars, each on the rocker of the one before it."""
    joints, loops, ground = list[Joint](), list[Loop](), "base"
    for k in range(count):
        joints += [
            joint(f"crank{k}", "continuous", ground, f"c{k}", (0.1, 0, 0), start=1.2),
            joint(f"pin{k}", "continuous", f"c{k}", f"d{k}", (0.2, 0, 0), start=-0.8),
            joint(f"rocker{k}", "continuous", ground, f"r{k}", (0.6, 0, 0), start=1.5),
        ]
        loops.append(Loop(f"pin of {k}", "revolute", f"d{k}", f"r{k}", Origin((0.6, 0, 0)), Origin((0.4, 0, 0))))
        ground = f"r{k}"
    return tree(joints, *loops)


@pytest.mark.slow
def test_the_36_loops_of_a_strandbeest_are_closed_in_two_seconds() -> None:
    robot, begin = KinematicTree.of(strandbeest()), time.thread_time()
    found = assembled(robot, "crank")
    assert time.thread_time() - begin < 2
    assert found.states == ("crank",)
    assert distances(robot, found) == pytest.approx([0] * 36, abs=1e-11)


@pytest.mark.slow
def test_many_loops_are_closed_in_seconds() -> None:
    robot, begin = row_of_four_bars(110), time.thread_time()
    assert len(assembled(robot).states) == 110
    assert time.thread_time() - begin < 15


def test_more_loops_than_can_be_closed_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    (fault,) = assemble(row_of_four_bars(201), frozenset(), frozenset()).faults
    assert (fault.code, fault.message) == ("loop-limit", "201 loops with 603 joints take too long to close")
    monkeypatch.setattr("urdfsync.formats.urdf.kinematics.assemble._MOST_WORK", 1000)
    assert faults(row_of_four_bars(3)) == [("loop-limit", "pin of 0")]


@pytest.mark.slow
def test_a_four_bar_in_line_is_singular() -> None:
    joints = [
        joint("crank", "continuous", "base", "a"),
        joint("coupler", "continuous", "a", "b", (0.2, 0, 0)),
        joint("rocker", "continuous", "base", "c", (0.6, 0, 0), start=math.pi),
    ]
    in_line = tree(joints, Loop("pin", "ball", "b", "c", Origin((0.5, 0, 0)), Origin((-0.1, 0, 0))))
    assert faults(in_line, "crank") == [("loop-singular", "pin")]
