"""The diagram's layout: nothing overlaps, and every line runs from port to port around all components."""

from __future__ import annotations

import bisect
import dataclasses
import itertools
import random
import sys
from collections import defaultdict
from types import FrameType
from typing import TypeAlias

from hypothesis import given, settings
from hypothesis import strategies as st

from urdfsync.urdf.diagram.layout import Diagram, JointKind, Tree, TreeCoupling, TreeJoint, layout
from urdfsync.urdf.diagram.routing import Path, Placement, Point, tracks

PORTS = {
    "frame_a": (-1.0, 0.0),
    "frame_b": (1.0, 0.0),
    "axis": (0.0, 1.0),
    "support": (-0.6, 1.0),
    "leader": (-1.0, 0.0),
    "follower": (1.0, 0.0),
}
KINDS: tuple[JointKind, ...] = ("fixed", "rotational", "translational", "free")

Segment: TypeAlias = tuple[Point, Point]


@dataclasses.dataclass(frozen=True)
class Recipe:
    """A tree in numbers: joint i leads to link i + 1 from link `parents[i]`; `leaders[i]` is the joint it follows."""

    parents: tuple[int, ...]
    kinds: tuple[JointKind, ...]
    leaders: tuple[int | None, ...]
    framed: frozenset[str] = frozenset()
    """Inner links with a connector of their own."""

    def tree(self) -> Tree:
        count = len(self.parents)
        children: dict[str, list[TreeJoint]] = {f"link{index}": [] for index in range(count + 1)}
        for index in range(count):
            kind, moves = self.kinds[index], self.kinds[index] in ("rotational", "translational")
            driven = moves and self.leaders[index] is None
            names = (f"j{index}Axis", f"j{index}Support") if driven else (None, None)
            children[f"link{self.parents[index]}"].append(TreeJoint(f"j{index}", f"link{index + 1}", kind, *names))
        frames = [link for link, joints in children.items() if not joints or link in self.framed]
        couplings = [
            TreeCoupling(f"mimic{index}", f"j{leader}", f"j{index}")
            for index, leader in enumerate(self.leaders)
            if leader is not None
        ]
        return Tree("link0", children, {link: f"{link}Frame" for link in frames}, couplings)


def recipe(random_: random.Random, links: int, depth: int, mimics: float) -> Recipe:
    """A random tree: every joint starts at one of the last `depth` links; followers and leaders in any order."""
    count = links - 1
    parents = tuple(random_.randrange(max(0, index + 1 - depth), index + 1) for index in range(count))
    kinds = tuple(random_.choices(KINDS, (2, 5, 2, 1), k=count))
    movers = [index for index in range(count) if kinds[index] in ("rotational", "translational")]
    rank = {mover: place for place, mover in enumerate(random_.sample(movers, len(movers)))}
    leaders: list[int | None] = [None] * count
    for follower in movers:
        choice = [leader for leader in movers if rank[leader] < rank[follower]]
        if choice and random_.random() < mimics:
            leaders[follower] = random_.choice(choice)
    framed = frozenset(f"link{index}" for index in range(links) if random_.random() < mimics / 2)
    return Recipe(parents, kinds, tuple(leaders), framed)


recipes = st.builds(
    recipe, st.randoms(use_true_random=False), st.integers(1, 40), st.integers(1, 40), st.sampled_from([0.0, 0.2, 0.8])
)


def chain(kinds: list[JointKind]) -> Tree:
    return Recipe(tuple(range(len(kinds))), tuple(kinds), (None,) * len(kinds)).tree()


def connections(tree: Tree) -> set[tuple[str, str]]:
    """What the robot model has to connect, said independently of the layout."""
    joints = {joint.name: (link, joint) for link, found in tree.children.items() for joint in found}
    ends = {("frame_a", f"{tree.root}.frame_a")}
    ends |= {(f"{link}.frame_a", frame) for link, frame in tree.frames.items()}
    for name, (parent, joint) in joints.items():
        ends |= {(f"{parent}.frame_a", f"{name}.frame_a"), (f"{name}.frame_b", f"{joint.child}.frame_a")}
        if joint.axis and joint.support:
            ends |= {(f"{name}.axis", joint.axis), (f"{name}.support", joint.support)}
    for coupling in tree.couplings:
        ends.add((f"{coupling.name}.leader", f"{coupling.leader}.axis"))
        ends.add((f"{coupling.name}.follower", f"{coupling.follower}.axis"))
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
    """Pairs of components that overlap or touch: a sweep from left to right over the rectangles' edges."""
    edges = [(place.x1, 0, name) for name, place in placements.items()]
    edges += [(place.x2, 1, name) for name, place in placements.items()]
    active: list[tuple[int, int, str]] = []
    found = []
    for _, closes, name in sorted(edges):
        span = (placements[name].y1, placements[name].y2, name)
        at = bisect.bisect_left(active, span)
        if closes:
            active.remove(span)
            continue
        found += [(other[2], name) for other in active[max(0, at - 1) : at] if other[1] >= span[0]]
        found += [(other[2], name) for other in active[at : at + 1] if other[0] <= span[1]]
        active.insert(at, span)
    return found


def segments(points: Path) -> list[Segment]:
    return [(min(pair), max(pair)) for pair in itertools.pairwise(points)]


def crossed(diagram: Diagram) -> list[tuple[tuple[str, str], str]]:
    """Lines that touch a component: a foreign one anywhere, one of their own anywhere but at the port."""
    found = []
    for ends, points in diagram.lines.items():
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
    for ends, points in diagram.lines.items():
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


def steps(tree: Tree) -> int:
    """Calls, of Python functions and built-in ones, that a layout takes."""
    count = 0

    def seen(frame: FrameType | None, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(seen)
    try:
        layout(tree)
    finally:
        sys.setprofile(before)
    return count


def test_one_joint_in_full() -> None:
    """frame_a at (-100, 0), base, shoulder, arm, its frame: joints on the spine, links below, connectors above."""
    shoulder = TreeJoint("shoulder", "arm", "rotational", "shoulderAxis", "shoulderSupport")
    diagram = layout(Tree("base", {"base": [shoulder]}, {"arm": "armFrame"}))
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
        ("frame_a", "base.frame_a"): ((-100, 0), (-76, 0), (-76, -26), (-72, -26)),
        ("base.frame_a", "shoulder.frame_a"): ((-72, -26), (-76, -26), (-76, 0), (-56, 0)),
        ("shoulder.frame_b", "arm.frame_a"): ((-36, 0), (-28, 0), (-28, -26), (-24, -26)),
        ("arm.frame_a", "armFrame"): ((-24, -26), (-28, -26), (-28, 0), (26, 0)),
        ("shoulder.axis", "shoulderAxis"): ((-46, 10), (-46, 20)),
        ("shoulder.support", "shoulderSupport"): ((-52, 10), (-52, 12), (-60, 12), (-60, 20)),
    }
    assert set(diagram.kinds.values()) == {"frame", "rotational"}


def test_an_inner_link_has_its_frame_below_it() -> None:
    arm = TreeJoint("mount", "hand", "fixed")
    diagram = layout(Tree("palm", {"palm": [arm]}, {"palm": "palmFrame", "hand": "handFrame"}))
    palm, frame = diagram.placements["palm"], diagram.placements["palmFrame"]
    assert frame.y2 < palm.y1
    assert frame.centre[0] == palm.centre[0]


def test_a_chain_is_one_row_from_left_to_right() -> None:
    diagram = layout(chain(["rotational", "fixed", "translational"]))
    order = ["frame_a", "link0", "j0", "link1", "j1", "link2", "j2", "link3", "link3Frame"]
    assert sorted(order, key=lambda name: diagram.placements[name].centre) == order
    heights = {name: diagram.placements[name].centre[1] for name in order}
    assert {heights[name] for name in ("frame_a", "j0", "j1", "j2", "link3Frame")} == {0}
    assert len({heights[f"link{number}"] for number in range(4)}) == 1


def test_the_first_child_goes_on_and_the_next_ones_stand_below() -> None:
    children = [TreeJoint(name, f"{name}Foot", "fixed") for name in ("first", "second", "third")]
    diagram = layout(
        Tree("trunk", {"trunk": children}, {f"{joint.name}Foot": f"{joint.name}Frame" for joint in children})
    )
    x, heights = zip(*(diagram.placements[joint.name].centre for joint in children), strict=True)
    assert len(set(x)) == 1
    assert list(heights) == sorted(heights, reverse=True)
    assert heights[0] == diagram.placements["frame_a"].centre[1]


def test_a_coupling_joins_leader_and_follower_in_the_kind_of_each() -> None:
    left = TreeJoint("left", "leftFinger", "rotational", "leftAxis", "leftSupport")
    right = TreeJoint("right", "rightFinger", "translational")
    couplings = [TreeCoupling("mimic", "left", "right")]
    frames = {"leftFinger": "leftFrame", "rightFinger": "rightFrame"}
    diagram = layout(Tree("palm", {"palm": [left, right]}, frames, couplings))
    assert diagram.kinds["mimic.leader", "left.axis"] == "rotational"
    assert diagram.kinds["mimic.follower", "right.axis"] == "translational"
    assert diagram.placements["mimic"].y1 > diagram.placements["right"].y2


@settings(deadline=None)
@given(recipes)
def test_every_connection_has_a_line_from_port_to_port(found: Recipe) -> None:
    tree = found.tree()
    diagram = layout(tree)
    assert set(diagram.lines) == connections(tree) == set(diagram.kinds)
    for (start, end), points in diagram.lines.items():
        assert points[0] == port(diagram, start)
        assert points[-1] == port(diagram, end)


@settings(deadline=None)
@given(recipes)
def test_no_two_components_touch(found: Recipe) -> None:
    tree = found.tree()
    diagram = layout(tree)
    inner = {name for link, joints in tree.children.items() for name in (link, *(joint.name for joint in joints))}
    assert inner | {coupling.name for coupling in tree.couplings} <= set(diagram.placements)
    assert touching(dict(diagram.placements)) == []


@settings(deadline=None)
@given(recipes)
def test_everything_lies_inside_the_extent_and_on_the_grid(found: Recipe) -> None:
    diagram = layout(found.tree())
    x1, y1, x2, y2 = diagram.extent
    corners = [((place.x1, place.y1), (place.x2, place.y2)) for place in diagram.placements.values()]
    for x, y in itertools.chain(*corners, *diagram.lines.values(), [(x1, y1), (x2, y2)]):
        assert x1 <= x <= x2
        assert y1 <= y <= y2
        assert x % 2 == y % 2 == 0


@settings(deadline=None)
@given(recipes)
def test_lines_are_axis_parallel_and_bend_at_every_point(found: Recipe) -> None:
    for points in layout(found.tree()).lines.values():
        upright = [a[0] == b[0] for a, b in itertools.pairwise(points)]
        assert all((a[0] == b[0]) != (a[1] == b[1]) for a, b in itertools.pairwise(points))
        assert all(a != b for a, b in itertools.pairwise(upright))


@settings(deadline=None)
@given(recipes)
def test_no_line_runs_through_a_component(found: Recipe) -> None:
    assert crossed(layout(found.tree())) == []


@settings(deadline=None)
@given(recipes)
def test_lines_that_are_not_connected_never_lie_on_top_of_each_other(found: Recipe) -> None:
    assert overlaid(layout(found.tree())) == []


@settings(deadline=None)
@given(recipes)
def test_frames_of_root_and_leaves_stand_at_their_borders(found: Recipe) -> None:
    tree = found.tree()
    diagram = layout(tree)
    x1, _, x2, _ = diagram.extent
    assert diagram.placements["frame_a"].x1 == x1
    leaves = [frame for link, frame in tree.frames.items() if not tree.children.get(link)]
    assert {diagram.placements[frame].x2 for frame in leaves} == {x2}


def test_long_chains_wide_stars_and_large_trees_come_through() -> None:
    """3000 links: no recursion, and no work that grows with their square."""
    for depth in (1, 40, 3000):
        tree = recipe(random.Random(depth), 3000, depth, 0.0).tree()
        diagram = layout(tree)
        assert set(diagram.lines) == connections(tree)
        assert touching(dict(diagram.placements)) == []
        assert max(map(len, diagram.lines.values())) <= 7


def test_the_work_grows_with_the_links_not_with_their_square() -> None:
    for depth in (1, 20, 10_000):
        small, large = (steps(recipe(random.Random(1), links, depth, 0.2).tree()) for links in (100, 800))
        assert large < 10 * small


@settings(deadline=None)
@given(st.dictionaries(st.integers(), st.tuples(st.integers(0, 30), st.integers(0, 30)).map(sorted).map(tuple)))
def test_intervals_on_one_track_never_touch_and_no_track_is_wasted(intervals: dict[int, tuple[int, int]]) -> None:
    assigned = tracks(intervals)
    for (a, (start, end)), (b, (low, high)) in itertools.combinations(intervals.items(), 2):
        assert assigned[a] != assigned[b] or end < low or high < start
    densest = max((sum(s <= x <= e for s, e in intervals.values()) for x in range(31)), default=0)
    assert len(set(assigned.values())) == densest
