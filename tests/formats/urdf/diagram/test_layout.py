"""The diagram's layout: nothing overlaps, and every line runs from port to port around all components."""

from __future__ import annotations

import itertools
import random
from collections import defaultdict
from typing import TypeAlias

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from msgspec.structs import replace
from support.robots import assembly, random_robot

from urdfsync.formats.urdf.connectors import Connectors
from urdfsync.formats.urdf.diagram.layout import Diagram, LinePath, Placement, Point, layout
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import (
    MOTION_KINDS,
    Joint,
    JointType,
    Link,
    Loop,
    Robot,
    Sensor,
    SensorKind,
    Transmission,
)

KINDS: tuple[SensorKind, ...] = ("imu", "camera", "force_torque")
TYPES: tuple[JointType, ...] = ("fixed", "fixed", "revolute", "revolute", "prismatic", "continuous", "planar")

Segment: TypeAlias = tuple[Point, Point]


def random_names(random_: random.Random, links: int, reach: int, mimics: float) -> tuple[KinematicTree, Connectors]:
    """A random robot; some of its inner links have frames, too, some joints motors; there may be sensors."""
    names = [f"l{index}" for index in range(links)]
    robot = random_robot(random_, TYPES, names=names, mimics=mimics, reach=reach)
    geared = [replace(joint, transmission=random_.choice((None, Transmission(50.0)))) for joint in robot.joints]
    turning = [joint for joint in geared if MOTION_KINDS.get(joint.type) == "rotational" and not joint.mimic]
    for joint, other in itertools.pairwise(random_.sample(turning, len(turning))):
        if random_.random() < mimics:
            geared[geared.index(joint)] = replace(joint, transmission=Transmission(50.0, joint=other.name))
    kinds = random_.choices(KINDS, k=random_.choice((0, 1, 6)) * bool(robot.joints))
    places = [random_.choice(geared).name if kind == "force_torque" else random_.choice(names) for kind in kinds]
    sensors = [Sensor(f"s{number}", kind, at) for number, (kind, at) in enumerate(zip(kinds, places, strict=True))]
    ends = [random_.sample(names, 2) for _ in range(random_.choice((0, 1, 4)))] if links > 1 else []
    loops = tuple(Loop(f"c{number}", "ball", parent, child) for number, (parent, child) in enumerate(ends))
    tree = KinematicTree.of(replace(robot, joints=tuple(geared), sensors=tuple(sensors), loops=loops))
    framed = tuple(name for name in names if random_.random() < mimics / 2)
    # connectors have nothing to do with these loops, which can't be closed
    return tree, assembly(tree, frames=framed, drives="motor").connectors


def connections(tree: KinematicTree, names: Connectors) -> set[tuple[str, str]]:
    """What the robot model has to connect, said independently of the layout; here components have URDF's names."""
    ends = {("frame_a", f"{tree.links[0].name}.frame_a")}
    moving = {joint.name for joint in tree.joints if joint.type in MOTION_KINDS}
    ends |= {(f"{link}.frame_a", frame) for link, frame in names.frames.items()}
    for sensor in tree.sensors:
        if sensor.kind != "force_torque":
            ends |= {(f"{sensor.at}.frame_a", f"{sensor.name}.frame_a")}
        if sensor.kind == "camera":
            ends |= {(f"{sensor.name}.frame_b", f"{sensor.name}Frame")}
    for loop in tree.loops:
        ends |= {(f"{loop.parent}.frame_a", f"{loop.name}.frame_a"), (f"{loop.name}.frame_b", f"{loop.child}.frame_a")}
    for joint in tree.joints:
        ends |= {
            (f"{joint.parent}.frame_a", f"{joint.name}.frame_a"),
            (f"{joint.name}.frame_b", f"{joint.child}.frame_a"),
        }
        if joint.type in MOTION_KINDS and joint.mimic:
            coupling = f"{joint.name}Mimic"
            ends |= {(f"{coupling}.follower", f"{joint.name}.axis")}
            if joint.mimic.joint in moving:
                ends |= {(f"{coupling}.leader", f"{joint.mimic.joint}.axis")}
        elif joint.type in MOTION_KINDS:
            gear, ports = joint.transmission, ["axis", "support"]
            if gear and gear.joint:
                component = f"{joint.name}Gear"
                ends |= {(f"{component}.flange_a", f"{joint.name}Motor")}
                ends |= {
                    (f"{component}.flange_b", f"{joint.name}.axis"),
                    (f"{component}.flange_c", f"{gear.joint}.axis"),
                }
            elif gear:
                ports.append("motor")
            ends |= {(f"{joint.name}.{end}", f"{joint.name}{end.capitalize()}") for end in ports}
    return ends


def touching(placements: dict[str, Placement]) -> list[tuple[str, str]]:
    """Pairs of components that overlap or touch."""
    names, (left, low, right, high) = list(placements), np.array(list(placements.values())).T
    found = []
    for index, name in enumerate(names):
        others = (left <= right[index]) & (right >= left[index]) & (low <= high[index]) & (high >= low[index])
        found += [(name, names[other]) for other in np.flatnonzero(others) if other != index]
    return found


def segments(points: LinePath) -> list[Segment]:
    return [(min(pair), max(pair)) for pair in itertools.pairwise(points)]


def crossed(diagram: Diagram) -> list[tuple[tuple[str, str], str]]:
    """Lines that touch a component: a foreign one anywhere, one of their own anywhere but at the port."""
    found = []
    for ends, (_, points) in diagram.lines.items():
        own = {end.partition(".")[0]: "." in end for end in ends}
        runs = segments(points)
        for name, place in diagram.placements.items():
            if not own.get(name, True):
                continue  # a connector of the model: its line ends in its middle
            margin = 1 if name in own else 0
            for (x1, y1), (x2, y2) in runs:
                across = x1 <= place.x2 - margin and x2 >= place.x1 + margin
                if across and y1 <= place.y2 - margin and y2 >= place.y1 + margin:
                    found.append((ends, name))
    return found


def nets(ends: tuple[str, str]) -> set[str]:
    """What a line belongs to: the port it shares with others."""
    ports = [end for end in ends if "." in end]
    hubs = {port for port in ports if port.endswith(".axis")} or {port for port in ports if port.endswith(".frame_a")}
    children = {ends[1]} if ends[0].endswith(".frame_a") and ends[1].endswith(".frame_a") else set()
    return hubs - children or set(ports)


def overlaid(diagram: Diagram) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """Pairs of lines that share a piece of their way and nothing else."""
    joined = {ends: nets(ends) for ends in diagram.lines}
    straight: defaultdict[tuple[bool, int], list[tuple[int, int, tuple[str, str]]]] = defaultdict(list)
    for ends, (_, points) in diagram.lines.items():
        for (x1, y1), (x2, y2) in segments(points):
            upright = x1 == x2
            span = (y1, y2) if upright else (x1, x2)
            straight[upright, x1 if upright else y1].append((*span, ends))
    found = []
    for pieces in straight.values():
        open_: list[tuple[int, tuple[str, str]]] = []
        for start, end, ends in sorted(pieces):
            open_ = [piece for piece in open_ if piece[0] > start]
            found += [(other, ends) for _, other in open_ if not joined[other] & joined[ends]]
            open_.append((end, ends))
    return found


@pytest.mark.slow
@settings(max_examples=60)
@given(st.randoms(use_true_random=False), st.integers(1, 40), st.integers(1, 40), st.sampled_from([0.0, 0.2, 0.8]))
def test_any_robot_is_drawn_well(random_: random.Random, links: int, reach: int, mimics: float) -> None:
    tree, names = random_names(random_, links, reach, mimics)
    diagram = layout(tree, names)
    assert set(diagram.lines) == connections(tree, names)
    inner = {tree.names[key].component for key in tree.names} | {*names.couplings.values()}
    assert inner < set(diagram.placements)
    x1, y1, x2, y2 = diagram.extent
    for ends, (_, points) in diagram.lines.items():
        for point, (name, _, port) in zip((points[0], points[-1]), (end.partition(".") for end in ends), strict=True):
            assert point == (diagram.placements[name].port(port) if port else diagram.placements[name].centre)
        upright = [a[0] == b[0] for a, b in itertools.pairwise(points)]
        assert all((a[0] == b[0]) != (a[1] == b[1]) for a, b in itertools.pairwise(points)), "parallel to an axis"
        assert all(a != b for a, b in itertools.pairwise(upright)), "bends at every point"
    corners = [((place.x1, place.y1), (place.x2, place.y2)) for place in diagram.placements.values()]
    for x, y in itertools.chain(*corners, *(points for _, points in diagram.lines.values())):
        assert x1 <= x <= x2
        assert y1 <= y <= y2
        assert x % 2 == y % 2 == 0
    assert touching(dict(diagram.placements)) == []
    assert crossed(diagram) == []
    assert overlaid(diagram) == []
    assert diagram.placements["frame_a"].x1 == x1
    for leaf in tree.leaves():
        (x, y), link = diagram.placements[names.frames[leaf.name]].centre, diagram.placements[leaf.name]
        assert (x > link.centre[0], y > link.y2) == (True, True), "at the end of the row that its link hangs on"


@pytest.mark.slow
def test_long_chains_wide_stars_and_large_trees_come_through() -> None:
    """1500 links: no recursion."""
    for reach in (1, 40, 1500):
        tree, names = random_names(random.Random(reach), 1500, reach, 0.0)
        diagram = layout(tree, names)
        assert set(diagram.lines) == connections(tree, names)
        assert touching(dict(diagram.placements)) == []
        assert max(len(points) for _, points in diagram.lines.values()) <= 7


def with_leaf(robot: Robot, parent: str) -> Robot:
    """The robot with one fixed link more, whose joint is the last of its parent's."""
    joint = Joint("zz", "fixed", parent, "zz_link")
    return replace(robot, links=(*robot.links, Link("zz_link")), joints=(*robot.joints, joint))


def large(tree: KinematicTree) -> set[str]:
    """The joints that lead to more than two links, and of these those that a chain may go on with."""
    count = {link.name: 1 for link in tree.links}
    for joint in reversed(tree.joints):
        count[joint.parent] += count[joint.child]
    most = {link: max(count[joint.child] for joint in joints) for link, joints in tree.children().items()}
    joints = [joint for joint in tree.joints if count[joint.child] > 2]
    return {joint.name for joint in joints} | {
        f"{joint.name} leads on" for joint in joints if 2 * count[joint.child] > most[joint.parent]
    }


@pytest.mark.slow
@settings(max_examples=60)
@given(st.randoms(use_true_random=False), st.integers(2, 40), st.integers(1, 40))
def test_a_new_leaf_moves_other_leaves_at_most(random_: random.Random, links: int, reach: int) -> None:
    robot = random_robot(random_, TYPES, names=[f"l{index}" for index in range(links)], mimics=0, reach=reach)
    tree = KinematicTree.of(robot)
    grown = KinematicTree.of(with_leaf(robot, random_.choice(robot.links).name))
    assume(large(tree) == large(grown))
    before, after = (layout(each, assembly(each).connectors) for each in (tree, grown))
    for joint in tree.joints:
        if joint.name in large(tree):
            assert before.placements[joint.name].y1 == after.placements[joint.name].y1


CHAIN = [Joint(f"j{k}", "revolute", f"l{k - 1}", f"l{k}") for k in range(1, 7)]
TREE = Robot(
    "arm",
    tuple(Link(name) for name in ("l0", "l1", "l2", "l3", "l4", "l5", "l6", "lamp")),
    (*CHAIN, Joint("hang", "fixed", "l2", "lamp")),
)


@pytest.mark.parametrize("parent", [f"l{k}" for k in range(7) if k not in (1, 2)])
def test_a_leaf_in_a_free_place_moves_nothing(parent: str) -> None:
    """At the end of a chain, or below a chain beside another one."""
    before, after = (
        layout(tree, assembly(tree).connectors) for tree in map(KinematicTree.of, (TREE, with_leaf(TREE, parent)))
    )
    common = before.placements.keys() & after.placements.keys()
    assert [name for name in common if before.placements[name] != after.placements[name]] == []
    assert all(after.lines[ends] == line for ends, line in before.lines.items() if ends in after.lines)
