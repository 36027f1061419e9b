"""Layout of the robot model's diagram: places of links, joints and couplings, and paths of the lines between them.

A row shows one chain, from left to right, and ends at the connector of its last link. A link's first child
joint continues the link's row; every other one starts a row of its own, below all rows of the joints before it:

    frame_a ──┬── joint ──┬── joint ──┬──────── handFrame
              ├ link      ├ link      └ link
              │           └── joint ──┬──────── cameraFrame
              │                       └ link
              └────── joint ──┬──────────────── tailFrame
                              └ link

Components keep to columns. A link hangs on a vertical trunk at the left of its column, and the joints
that start at it stand on the spines of their rows, right of the trunk: so a trunk only passes rows
that lie right of it. Above a joint that can be driven stand the connectors of its axis and its support.
A mimic coupling stands above its follower; the line from its leader runs through the gap between two columns.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import Literal, NamedTuple, TypeAlias

import msgspec

from urdfsync.urdf.diagram import routing
from urdfsync.urdf.diagram.routing import CONNECTOR, SIZE, Path, Placement, Point, Row, RowNeeds, square

JointKind: TypeAlias = Literal["fixed", "rotational", "translational", "free"]
LineKind: TypeAlias = Literal["frame", "rotational", "translational"]
Connection: TypeAlias = tuple[str, str]
"""The two ends of a connect equation, as they are written there."""

PORTS: Mapping[str, Point] = {
    "frame_a": (-100, 0),
    "frame_b": (100, 0),
    "axis": (0, 100),
    "support": (-60, 100),
    "leader": (-100, 0),
    "follower": (100, 0),
}
"""Connectors of components, in the coordinates of their icons, -100 to 100 both ways."""

FRAME_A: Point = (-100, 0)
"""Middle of the connector `frame_a` in every robot's diagram."""

_LINK_AT = 4  # from a column's trunk to the left edge of its links and couplings
_JOINT_AT = 20  # from a column's trunk to the left edge of its joints
_DROP = 26  # from a row's spine down to the middle of its links
_FRAME = 32  # size of a frame connector, as in the Modelica Standard Library
_TRUNK = 8  # from the connector of the root frame to the first trunk
_MARGIN = 44  # from the last trunk to the connectors at the right: a link and its name
_LEAF = 20  # size of the frame connectors at the right
_ABOVE = 20  # from a row's spine up to the connectors of its joints
_ASIDE = 8  # from an axis to the support's connector, and to the line that passes the axis's own


class TreeJoint(msgspec.Struct, frozen=True):
    """A joint that leads to the link `child`; `axis` and `support` name its connectors, None if it has none."""

    name: str
    child: str
    kind: JointKind
    axis: str | None = None
    support: str | None = None


class TreeCoupling(msgspec.Struct, frozen=True):
    """A mimic coupling between the axis flanges of two joints; a joint follows at most one other.

    Without a `leader` the coupling holds its follower by itself.
    """

    name: str
    leader: str | None
    follower: str


class Tree(msgspec.Struct, frozen=True):
    """A tree of links and joints, and the couplings between joints, all by component names.

    `children` gives the joints that start at a link, in the order they are drawn; links without any
    may be left out. `frames` names the connectors of links that have one.
    """

    root: str
    children: Mapping[str, Sequence[TreeJoint]]
    frames: Mapping[str, str]
    couplings: Sequence[TreeCoupling] = ()


class Diagram(msgspec.Struct, frozen=True):
    """A finished layout on a grid of 2, y upwards.

    `extent` (x1, y1, x2, y2) holds everything. A line leads from the first of its two ends to the
    second in axis-parallel segments; lines at one of the model's own connectors end in its middle.
    """

    extent: tuple[int, int, int, int]
    placements: Mapping[str, Placement]
    lines: Mapping[Connection, Path]
    kinds: Mapping[Connection, LineKind]


def layout(tree: Tree) -> Diagram:
    """Place every component and route every connection of the robot model, in linear time.

    No two components overlap and no line crosses a component. `tree` has to be one, with distinct
    names, and its couplings join rotational and translational joints.
    """
    plan = _plan(tree)
    dx, dy = _shift(plan)
    lines: dict[Connection, Path] = {}
    kinds: dict[Connection, LineKind] = {}
    for ends, kind, points in chain(_frame_lines(tree, plan), _flange_lines(plan), _coupling_lines(tree, plan)):
        lines[ends] = routing.path([(x + dx, y + dy) for x, y in points])
        kinds[ends] = kind
    extent = (dx, plan.rows[-1].bottom + dy, plan.right + dx, dy)
    return Diagram(extent, {name: place.moved(dx, dy) for name, place in _components(tree, plan)}, lines, kinds)


class _Cell(NamedTuple):
    row: int
    column: int


_Line: TypeAlias = tuple[Connection, LineKind, list[Point]]


class _Cells(msgspec.Struct, frozen=True):
    """The cell of every link and joint: a joint stands in its parent's column and in its child's row."""

    links: Mapping[str, _Cell]
    joints: Mapping[str, _Cell]
    parts: Mapping[str, TreeJoint]


class _Detours(msgspec.Struct, frozen=True):
    """Track numbers of the lines from leaders to couplings: in a row, in the gap left of a column; by leader."""

    rows: Mapping[int, Mapping[str, int]]
    columns: Mapping[int, Mapping[str, int]]


class _Plan(msgspec.Struct, frozen=True):
    """All coordinates before anchoring: the left border at x = 0, the upper one at y = 0."""

    cells: _Cells
    detours: _Detours
    rows: Sequence[Row]
    trunks: Sequence[int]
    right: int
    connectors: dict[str, Placement]

    def link(self, name: str) -> Placement:
        row, column = self.cells.links[name]
        x = self.trunks[column] + _LINK_AT + SIZE // 2
        return square((x, self.rows[row].spine - _DROP))

    def joint(self, name: str) -> Placement:
        row, column = self.cells.joints[name]
        x = self.trunks[column] + _JOINT_AT + SIZE // 2
        return square((x, self.rows[row].spine))

    def coupling(self, follower: str) -> Placement:
        row, column = self.cells.joints[follower]
        x = self.trunks[column] + _LINK_AT + SIZE // 2
        return square((x, self.rows[row].band))


def _plan(tree: Tree) -> _Plan:
    cells = _arrange(tree)
    detours = _detours(tree, cells)
    rows = routing.rows(_needs(tree, cells, detours), 0)
    columns = range(1 + max(cell.column for cell in cells.links.values()))
    trunks = routing.trunks([_count(detours.columns.get(column, {})) for column in columns], _FRAME + _TRUNK // 2)
    right = trunks[-1] + _MARGIN + _LEAF
    plan = _Plan(cells, detours, rows, trunks, right, {"frame_a": square((_FRAME // 2, rows[0].spine), _FRAME)})
    plan.connectors.update(_connectors(tree, plan))
    return plan


def _connectors(tree: Tree, plan: _Plan) -> Iterator[tuple[str, Placement]]:
    """Yield the model's own connectors: frames of leaves at the right, all others beside their link or joint."""
    for name, joint in plan.cells.parts.items():
        x, y = plan.joint(name).centre
        if joint.axis and joint.support:
            support = x + SIZE * PORTS["support"][0] // 200
            yield joint.axis, square((x, y + _ABOVE), CONNECTOR)
            yield joint.support, square((support - _ASIDE, y + _ABOVE), CONNECTOR)
    for link, frame in tree.frames.items():
        row = plan.rows[plan.cells.links[link].row]
        if tree.children.get(link):
            icon = plan.link(link)
            yield frame, square((icon.centre[0], icon.y1 - CONNECTOR), CONNECTOR)
        else:
            yield frame, square((plan.right - _LEAF // 2, row.spine), _LEAF)


def _arrange(tree: Tree) -> _Cells:
    links = {tree.root: _Cell(0, 0)}
    joints: dict[str, _Cell] = {}
    parts: dict[str, TreeJoint] = {}
    last = 0
    stack = _branches(tree, tree.root, links[tree.root])
    while stack:
        joint, column, row = stack.pop()
        if row is None:
            row = last = last + 1
        parts[joint.name] = joint
        joints[joint.name] = _Cell(row, column)
        links[joint.child] = _Cell(row, column + 1)
        stack += _branches(tree, joint.child, links[joint.child])
    return _Cells(links, joints, parts)


def _branches(tree: Tree, link: str, cell: _Cell) -> list[tuple[TreeJoint, int, int | None]]:
    """Return the joints that start at a link, last one first, each with column and row; None is a new row."""
    children = tree.children.get(link, ())
    return [(joint, cell.column, None if index else cell.row) for index, joint in enumerate(children)][::-1]


def _detours(tree: Tree, cells: _Cells) -> _Detours:
    followers: defaultdict[str, list[_Cell]] = defaultdict(list)
    for coupling in tree.couplings:
        if coupling.leader is not None:
            followers[coupling.leader].append(cells.joints[coupling.follower])
    across: defaultdict[int, dict[str, tuple[int, int]]] = defaultdict(dict)
    along: defaultdict[int, dict[str, tuple[int, int]]] = defaultdict(dict)
    for leader, found in followers.items():
        row, column = cells.joints[leader]
        passed = [column, *(cell.column for cell in found)]
        across[row][leader] = min(passed), max(passed)
        for cell in found:
            low, high = along[cell.column].get(leader, (row, row))
            along[cell.column][leader] = min(low, cell.row), max(high, cell.row)
    return _Detours(
        {row: routing.tracks(intervals) for row, intervals in across.items()},
        {column: routing.tracks(intervals) for column, intervals in along.items()},
    )


def _needs(tree: Tree, cells: _Cells, detours: _Detours) -> list[RowNeeds]:
    """Return the contents of each row, from top to bottom."""
    driven = {cells.joints[name].row for name, joint in cells.parts.items() if joint.axis}
    banded = {cells.joints[coupling.follower].row for coupling in tree.couplings}
    framed = {cells.links[link].row for link in tree.frames if tree.children.get(link)}
    return [
        RowNeeds(_count(detours.rows.get(row, {})), row in banded, row in driven, row in framed)
        for row in range(1 + max(cell.row for cell in cells.links.values()))
    ]


def _count(assigned: Mapping[str, int]) -> int:
    return 1 + max(assigned.values(), default=-1)


def _components(tree: Tree, plan: _Plan) -> Iterator[tuple[str, Placement]]:
    yield from plan.connectors.items()
    for name in plan.cells.links:
        yield name, plan.link(name)
    for name in plan.cells.joints:
        yield name, plan.joint(name)
    for coupling in tree.couplings:
        yield coupling.name, plan.coupling(coupling.follower)


def _frame_lines(tree: Tree, plan: _Plan) -> Iterator[_Line]:
    for link, (row, column) in plan.cells.links.items():
        trunk, spine = plan.trunks[column], plan.rows[row].spine
        port = plan.link(link).at(PORTS["frame_a"])
        foot, head = (trunk, port[1]), (trunk, spine)
        if link == tree.root:
            yield ("frame_a", f"{link}.frame_a"), "frame", [plan.connectors["frame_a"].centre, head, foot, port]
        if frame := tree.frames.get(link):
            end = plan.connectors[frame].centre
            yield (f"{link}.frame_a", frame), "frame", [port, foot, (trunk, end[1]), end]
        for joint in tree.children.get(link, ()):
            icon = plan.joint(joint.name)
            start, end = icon.at(PORTS["frame_a"]), icon.at(PORTS["frame_b"])
            yield (f"{link}.frame_a", f"{joint.name}.frame_a"), "frame", [port, foot, (trunk, start[1]), start]
            child = plan.link(joint.child).at(PORTS["frame_a"])
            turn = plan.trunks[column + 1]
            yield (
                (f"{joint.name}.frame_b", f"{joint.child}.frame_a"),
                "frame",
                [end, (turn, end[1]), (turn, child[1]), child],
            )


def _flange_lines(plan: _Plan) -> Iterator[_Line]:
    """Yield the lines from joints to the connectors above them."""
    for name, joint in plan.cells.parts.items():
        if joint.axis and joint.support:
            icon = plan.joint(name)
            axis, support = icon.at(PORTS["axis"]), icon.at(PORTS["support"])
            yield (f"{name}.axis", joint.axis), _kind(joint), [axis, plan.connectors[joint.axis].centre]
            end = plan.connectors[joint.support].centre
            bend = support[1] + 2
            yield (f"{name}.support", joint.support), _kind(joint), [support, (support[0], bend), (end[0], bend), end]


def _coupling_lines(tree: Tree, plan: _Plan) -> Iterator[_Line]:
    for coupling in tree.couplings:
        icon, follower = plan.coupling(coupling.follower), plan.cells.parts[coupling.follower]
        start, end = icon.at(PORTS["follower"]), plan.joint(follower.name).at(PORTS["axis"])
        yield (f"{coupling.name}.follower", f"{follower.name}.axis"), _kind(follower), [start, (end[0], start[1]), end]
        if coupling.leader is None:
            continue
        leader = plan.cells.parts[coupling.leader]
        row, column = plan.cells.joints[leader.name].row, plan.cells.joints[follower.name].column
        y = plan.rows[row].tracks[plan.detours.rows[row][leader.name]]
        x = routing.gap_track(plan.trunks[column], plan.detours.columns[column][leader.name])
        start, end = icon.at(PORTS["leader"]), plan.joint(leader.name).at(PORTS["axis"])
        points = [start, (x, start[1]), (x, y), (end[0], y), end]
        if leader.axis:  # the connector stands above the axis: pass it
            aside, bend = end[0] + _ASIDE, end[1] + 2
            points = [start, (x, start[1]), (x, y), (aside, y), (aside, bend), (end[0], bend), end]
        yield (f"{coupling.name}.leader", f"{leader.name}.axis"), _kind(leader), points


def _kind(joint: TreeJoint) -> LineKind:
    return "translational" if joint.kind == "translational" else "rotational"


def _shift(plan: _Plan) -> Point:
    """Return the offset that brings `frame_a` to its place in the class that all robots extend."""
    (x, y), (at_x, at_y) = plan.connectors["frame_a"].centre, FRAME_A
    return at_x - x, at_y - y
