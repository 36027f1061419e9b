"""The diagram's layout: nothing overlaps, and every line runs from port to port around all components."""

from __future__ import annotations

import itertools
import random
import sys
from collections import defaultdict
from types import FrameType
from typing import TypeAlias

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from support.robots import random_robot, tree

from urdfsync.urdf.connectors import Connectors, connector_names
from urdfsync.urdf.diagram.layout import Diagram, Path, Placement, Point, layout
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Joint, JointType

PORTS = {
    "frame_a": (-1.0, 0.0),
    "frame_b": (1.0, 0.0),
    "axis": (0.0, 1.0),
    "support": (-0.6, 1.0),
    "leader": (-1.0, 0.0),
    "follower": (1.0, 0.0),
}
TYPES: tuple[JointType, ...] = ("fixed", "fixed", "revolute", "revolute", "prismatic", "continuous", "planar")

Segment: TypeAlias = tuple[Point, Point]


def random_names(random_: random.Random, links: int, reach: int, mimics: float) -> tuple[KinematicTree, Connectors]:
    """A random robot; some of its inner links have frames, too."""
    names = [f"l{index}" for index in range(links)]
    tree = KinematicTree.of(random_robot(random_, TYPES, names=names, mimics=mimics, reach=reach))
    framed = tuple(name for name in names if random_.random() < mimics / 2)
    return tree, connector_names(tree, Options(frames=framed))


def connections(tree: KinematicTree, names: Connectors) -> set[tuple[str, str]]:
    """What the robot model has to connect, said independently of the layout; here components have URDF's names."""
    ends = {("frame_a", f"{tree.links[0].name}.frame_a")}
    moving = {joint.name for joint in tree.joints if joint.type in MOTION_KINDS}
    ends |= {(f"{link}.frame_a", frame) for link, frame in names.frames.items()}
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
            ends |= {(f"{joint.name}.{end}", f"{joint.name}{end.capitalize()}") for end in ("axis", "support")}
    return ends


def port(diagram: Diagram, end: str) -> tuple[float, float]:
    name, _, connector = end.partition(".")
    place = diagram.placements[name]
    x, y = PORTS[connector] if connector else (0.0, 0.0)
    return (
        (place.x1 + place.x2) / 2 + x * (place.x2 - place.x1) / 2,
        (place.y1 + place.y2) / 2 + y * (place.y2 - place.y1) / 2,
    )


def touching(placements: dict[str, Placement]) -> list[tuple[str, str]]:
    """Pairs of components that overlap or touch."""
    names, (left, low, right, high) = list(placements), np.array(list(placements.values())).T
    found = []
    for index, name in enumerate(names):
        others = (left <= right[index]) & (right >= left[index]) & (low <= high[index]) & (high >= low[index])
        found += [(name, names[other]) for other in np.flatnonzero(others) if other != index]
    return found


def segments(points: Path) -> list[Segment]:
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


def steps(tree: KinematicTree, names: Connectors) -> int:
    """Calls, of Python functions and built-in ones, that a layout takes."""
    count = 0

    def seen(frame: FrameType | None, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(seen)
    try:
        layout(tree, names)
    finally:
        sys.setprofile(before)
    return count


def test_one_joint_in_full() -> None:
    """frame_a at (-100, 0), base, shoulder, arm, its frame: joints on the spine, links below, connectors above."""
    skeleton = tree(Joint("shoulder", "revolute", "base", "arm"))
    diagram = layout(skeleton, connector_names(skeleton, Options()))
    assert diagram.extent == (-116, -44, 36, 34)
    assert diagram.placements == {
        "frame_a": Placement(-116, -16, -84, 16),
        "base": Placement(-72, -36, -52, -16),
        "shoulder": Placement(-56, -10, -36, 10),
        "arm": Placement(-24, -36, -4, -16),
        "armFrame": Placement(16, -10, 36, 10),
        "shoulderAxis": Placement(-52, 14, -40, 26),
        "shoulderSupport": Placement(-66, 14, -54, 26),
    }
    assert diagram.lines == {
        ("frame_a", "base.frame_a"): ("frame", ((-100, 0), (-76, 0), (-76, -26), (-72, -26))),
        ("base.frame_a", "shoulder.frame_a"): ("frame", ((-72, -26), (-76, -26), (-76, 0), (-56, 0))),
        ("shoulder.frame_b", "arm.frame_a"): ("frame", ((-36, 0), (-28, 0), (-28, -26), (-24, -26))),
        ("arm.frame_a", "armFrame"): ("frame", ((-24, -26), (-28, -26), (-28, 0), (26, 0))),
        ("shoulder.axis", "shoulderAxis"): ("rotational", ((-46, 10), (-46, 20))),
        ("shoulder.support", "shoulderSupport"): ("rotational", ((-52, 10), (-52, 12), (-60, 12), (-60, 20))),
    }


@settings(deadline=None, max_examples=200)
@given(st.randoms(use_true_random=False), st.integers(1, 40), st.integers(1, 40), st.sampled_from([0.0, 0.2, 0.8]))
def test_any_robot_is_drawn_well(random_: random.Random, links: int, reach: int, mimics: float) -> None:
    tree, names = random_names(random_, links, reach, mimics)
    diagram = layout(tree, names)
    assert set(diagram.lines) == connections(tree, names)
    inner = {link.name for link in tree.links} | {joint.name for joint in tree.joints} | {*names.couplings.values()}
    assert inner < set(diagram.placements)
    x1, y1, x2, y2 = diagram.extent
    for ends, (_, points) in diagram.lines.items():
        assert (points[0], points[-1]) == (port(diagram, ends[0]), port(diagram, ends[1]))
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
    assert {diagram.placements[names.frames[leaf.name]].x2 for leaf in tree.leaves()} == {x2}


def test_long_chains_wide_stars_and_large_trees_come_through() -> None:
    """3000 links: no recursion, and no work that grows with their square."""
    for reach in (1, 40, 3000):
        tree, names = random_names(random.Random(reach), 3000, reach, 0.0)
        diagram = layout(tree, names)
        assert set(diagram.lines) == connections(tree, names)
        assert touching(dict(diagram.placements)) == []
        assert max(len(points) for _, points in diagram.lines.values()) <= 7
        small, large = (steps(*random_names(random.Random(1), links, reach, 0.2)) for links in (100, 800))
        assert large < 10 * small
