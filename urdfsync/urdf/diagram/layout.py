"""The robot model's diagram: where links, joints and couplings stand, and how the lines between them run.

A row shows one chain, from left to right. A link's first child joint continues the link's row; every
other one starts a row of its own, below all rows of the joints before it:

    frame_a ──┬── joint ──┬── joint ──┬─────────── frame_b
              ├ link      ├ link      └ link           │
              │           └── joint ──┬────────────────┤
              │                       └ link           │
              └────── joint ──┬────────────────────────┘
                              └ link

Components keep to columns. A link hangs on a vertical trunk at the left of its column, and the joints
that start at it stand on the spines of their rows, right of the trunk: so a trunk only passes rows
that lie right of it. Above the joints of a row runs a channel with one track per flange vector, which
leads to the vector's bus, right of all columns, and on to the connector at the top. A mimic coupling
stands above its follower; the line from its leader runs through the gap between two columns.
"""

from __future__ import annotations

import functools
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, NamedTuple, TypeAlias

import msgspec

from urdfsync.urdf.diagram import routing
from urdfsync.urdf.diagram.routing import DROP, JOINT_AT, LINK_AT, SIZE, Path, Placement, Point, Row, RowNeeds, square

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
"""Where a component's connectors are in its icon, -100 to 100 both ways."""

VECTORS = ("rotationalAxis", "rotationalSupport", "translationalAxis", "translationalSupport")
"""The flange vectors at the top border, from left to right."""

FRAME_A: Point = (-100, 0)
"""Where the middle of the connector `frame_a` is in every robot's diagram."""

_FRAME = 32  # size of a frame connector, as in the Modelica Standard Library
_MARGIN = 44  # from the last trunk to the buses: a link and its name
_BUS = 6  # distance of neighbouring buses
_LEAD = 8  # from the leaf bus to the connector of the leaf frames


class TreeJoint(msgspec.Struct, frozen=True):
    """A joint that leads to the link `child`; `axis` counts from 1 in the flange vectors of its kind.

    `axis` is None for a joint whose flanges don't lead outside: fixed, free, or a mimic follower.
    """

    name: str
    child: str
    kind: JointKind
    axis: int | None = None


class TreeCoupling(msgspec.Struct, frozen=True):
    """A mimic coupling between the axis flanges of two joints; a joint follows at most one other.

    Without a `leader` the coupling holds its follower by itself.
    """

    name: str
    leader: str | None
    follower: str


class Tree(msgspec.Struct, frozen=True):
    """What the diagram shows, by component names: a tree of links and joints, and the couplings across it.

    `children` gives the joints that start at a link, in the order they are drawn; links without any
    may be left out. `leaves` gives the place of such a link in the vector `frame_b`, from 1.
    """

    root: str
    children: Mapping[str, Sequence[TreeJoint]]
    leaves: Mapping[str, int]
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
    children = tuple((link, tuple(joints)) for link, joints in tree.children.items())
    return _layout(tree.root, children, tuple(tree.leaves.items()), tuple(tree.couplings))


@functools.lru_cache(maxsize=1)  # most changes of a robot leave its structure as it is
def _layout(
    root: str,
    children: tuple[tuple[str, tuple[TreeJoint, ...]], ...],
    leaves: tuple[tuple[str, int], ...],
    couplings: tuple[TreeCoupling, ...],
) -> Diagram:
    tree = Tree(root, dict(children), dict(leaves), couplings)
    plan = _plan(tree)
    lines: dict[Connection, Path] = {}
    kinds: dict[Connection, LineKind] = {}
    for ends, kind, points in (*_frame_lines(tree, plan), *_flange_lines(plan), *_coupling_lines(tree, plan)):
        lines[ends] = routing.path(points)
        kinds[ends] = kind
    right = plan.leaf_bus + _LEAD + _FRAME
    extent = (0, plan.rows[-1].bottom, right, 0)
    return _anchored(Diagram(extent, _components(tree, plan), lines, kinds))


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
    buses: Mapping[str, int]
    leaf_bus: int
    connectors: Mapping[str, Placement]

    def link(self, name: str) -> Placement:
        row, column = self.cells.links[name]
        x = self.trunks[column] + LINK_AT + SIZE // 2
        return square((x, self.rows[row].spine - DROP))

    def joint(self, name: str) -> Placement:
        row, column = self.cells.joints[name]
        x = self.trunks[column] + JOINT_AT + SIZE // 2
        return square((x, self.rows[row].spine))

    def coupling(self, follower: str) -> Placement:
        row, column = self.cells.joints[follower]
        x = self.trunks[column] + LINK_AT + SIZE // 2
        return square((x, self.rows[row].band))


def _plan(tree: Tree) -> _Plan:
    cells = _arrange(tree)
    detours = _detours(tree, cells)
    needs = _needs(tree, cells, detours)
    vectors = [vector for vector in VECTORS if vector in needs[0].buses]
    rows = routing.rows(needs, VECTORS, -SIZE if vectors else 0)
    columns = range(1 + max(cell.column for cell in cells.links.values()))
    trunks = routing.trunks([_count(detours.columns.get(column, {})) for column in columns], _FRAME + _LEAD // 2)
    connectors = _flange_connectors(vectors, trunks)
    right = max([trunks[-1], *(connector.x1 for connector in connectors.values())]) + _MARGIN
    lower = {vector for need in needs[1:] for vector in need.buses}
    buses: dict[str, int] = {}
    for vector in reversed(vectors):
        if vector in lower:
            buses[vector] = right + _BUS * len(buses)
    leaf_bus = right + _BUS * len(buses)
    connectors["frame_a"] = square((_FRAME // 2, rows[0].spine), _FRAME)
    if tree.leaves:
        connectors["frame_b"] = square((leaf_bus + _LEAD + _FRAME // 2, rows[0].spine), _FRAME)
    return _Plan(cells, detours, rows, trunks, buses, leaf_bus, connectors)


def _flange_connectors(vectors: Sequence[str], trunks: Sequence[int]) -> dict[str, Placement]:
    """The connectors at the top, one per column, the last ones; right of each trunk, where no line goes up."""
    further = [trunks[-1] + routing.COLUMN * (index + 1) for index in range(len(vectors))]
    stops = [*trunks, *further][max(0, len(trunks) - len(vectors)) :]
    return {vector: square((stop + 2 * LINK_AT, -SIZE // 2)) for vector, stop in zip(vectors, stops, strict=False)}


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
    """The joints that start at a link, last one first, each with its column and its row, None for a new one."""
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
    """What every row's channel holds; the first one has the tracks of all vectors, to lead to the connectors."""
    rows = 1 + max(cell.row for cell in cells.links.values())
    buses: list[set[str]] = [set() for _ in range(rows)]
    for name, joint in cells.parts.items():
        if joint.axis is not None:
            vectors = f"{joint.kind}Axis", f"{joint.kind}Support"
            buses[cells.joints[name].row].update(vectors)
            buses[0].update(vectors)
    banded = {cells.joints[coupling.follower].row for coupling in tree.couplings}
    return [RowNeeds(frozenset(buses[row]), _count(detours.rows.get(row, {})), row in banded) for row in range(rows)]


def _count(assigned: Mapping[str, int]) -> int:
    return 1 + max(assigned.values(), default=-1)


def _components(tree: Tree, plan: _Plan) -> dict[str, Placement]:
    return (
        dict(plan.connectors)
        | {name: plan.link(name) for name in plan.cells.links}
        | {name: plan.joint(name) for name in plan.cells.joints}
        | {coupling.name: plan.coupling(coupling.follower) for coupling in tree.couplings}
    )


def _frame_lines(tree: Tree, plan: _Plan) -> Iterator[_Line]:
    for link, (row, column) in plan.cells.links.items():
        trunk, spine = plan.trunks[column], plan.rows[row].spine
        port = plan.link(link).at(PORTS["frame_a"])
        foot, head = (trunk, port[1]), (trunk, spine)
        if link == tree.root:
            yield ("frame_a", f"{link}.frame_a"), "frame", [plan.connectors["frame_a"].centre, head, foot, port]
        if link in tree.leaves:
            end = plan.connectors["frame_b"].centre
            bus = [(plan.leaf_bus, spine), (plan.leaf_bus, end[1])]
            yield (f"{link}.frame_a", f"frame_b[{tree.leaves[link]}]"), "frame", [port, foot, head, *bus, end]
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
    """From the joints to the vectors on top: along the row's track to the bus, up, along the first row's track."""
    for name, joint in plan.cells.parts.items():
        if joint.axis is None:
            continue
        row = plan.cells.joints[name].row
        for port, vector in (("axis", f"{joint.kind}Axis"), ("support", f"{joint.kind}Support")):
            start, end = plan.joint(name).at(PORTS[port]), plan.connectors[vector].centre
            points = [start, (start[0], plan.rows[row].buses[vector])]
            if row:
                points += [(plan.buses[vector], plan.rows[at].buses[vector]) for at in (row, 0)]
            points += [(end[0], plan.rows[0].buses[vector]), end]
            yield (f"{name}.{port}", f"{vector}[{joint.axis}]"), _kind(joint), points


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
        yield (f"{coupling.name}.leader", f"{leader.name}.axis"), _kind(leader), points


def _kind(joint: TreeJoint) -> LineKind:
    return "translational" if joint.kind == "translational" else "rotational"


def _anchored(diagram: Diagram) -> Diagram:
    """The diagram, moved so that `frame_a` is where the class that all robots extend has it."""
    (x, y), (at_x, at_y) = diagram.placements["frame_a"].centre, FRAME_A
    dx, dy = at_x - x, at_y - y
    x1, y1, x2, y2 = diagram.extent
    return Diagram(
        (x1 + dx, y1 + dy, x2 + dx, y2 + dy),
        {name: placement.moved(dx, dy) for name, placement in diagram.placements.items()},
        {ends: tuple((x + dx, y + dy) for x, y in points) for ends, points in diagram.lines.items()},
        diagram.kinds,
    )
