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
A mimic coupling stands above its follower; the line from its leader runs through the gap between two columns,
on a track that no other line has there.

Lines consist of axis-parallel segments. All coordinates are even, y points upwards.
"""

from __future__ import annotations

import heapq
from collections import defaultdict
from collections.abc import Hashable, Iterable, Mapping
from typing import Literal, NamedTuple, TypeAlias, TypeVar

from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.connectors import Connectors
from urdfsync.urdf.robot import MOTION_KINDS

Point: TypeAlias = tuple[int, int]
Path: TypeAlias = tuple[Point, ...]
LineKind: TypeAlias = Literal["frame", "rotational", "translational"]
Key = TypeVar("Key", bound=Hashable)

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

_SIZE = 20  # width and height of a component, and of the frame connectors at the right
_CONNECTOR = 12  # width and height of a connector that stands beside a component
_FRAME = 32  # size of the connector of the root frame, as in the Modelica Standard Library
_COLUMN = 48  # from trunk to trunk, as long as one track is enough in the gap between
_TRACK = 4  # distance of neighbouring lines
_NAME = 8  # room for a name above a component
_LINK_X = 14  # from a column's trunk to the middle of its links and couplings
_JOINT_X = 30  # from a column's trunk to the middle of its joints
_LINK_Y = 26  # from a row's spine down to the middle of its links
_BELOW = 44  # from a row's spine down to its end: link, its name, a gap
_ABOVE = 20  # from a row's spine up to the connectors of its joints
_TRUNK = 8  # from the connector of the root frame to the first trunk
_MARGIN = 44  # from the last trunk to the connectors at the right: a link and its name
_ASIDE = 8  # from an axis to the support's connector, and to the line that passes the axis's own


class Placement(NamedTuple):
    """A component's rectangle in the diagram: lower left corner (x1, y1), upper right corner (x2, y2)."""

    x1: int
    y1: int
    x2: int
    y2: int

    @classmethod
    def around(cls, centre: Point, size: int = _SIZE) -> Placement:
        """Return a square around a point."""
        (x, y), half = centre, size // 2
        return cls(x - half, y - half, x + half, y + half)

    @property
    def centre(self) -> Point:
        """The middle of the rectangle."""
        return (self.x1 + self.x2) // 2, (self.y1 + self.y2) // 2

    def port(self, connector: str) -> Point:
        """Return the place in the diagram of a component's connector."""
        x, y = PORTS[connector]
        return self.x1 + (self.x2 - self.x1) * (x + 100) // 200, self.y1 + (self.y2 - self.y1) * (y + 100) // 200


class Diagram(NamedTuple):
    """A finished layout on a grid of 2, by component names.

    `extent` (x1, y1, x2, y2) holds everything. A line leads from the first of its two ends, as they stand in the
    connect equation, to the second; lines at one of the model's own connectors end in its middle.
    """

    extent: tuple[int, int, int, int]
    placements: dict[str, Placement]
    lines: dict[tuple[str, str], tuple[LineKind, Path]]


class _Row(NamedTuple):
    """Heights of a row."""

    spine: int
    band: int
    """Middle of its couplings."""
    tracks: list[int]
    bottom: int


def layout(tree: KinematicTree, names: Connectors) -> Diagram:
    """Place every component and route every connection of the robot model, in linear time.

    No two components overlap and no line crosses a component.
    """
    # Cells, as (row, column): a joint stands in its parent's column and in its child's row.
    links, joints = {tree.links[0].name: (0, 0)}, {}
    last, continued = 0, set()
    for joint in tree.joints:
        row, column = links[joint.parent]
        if joint.parent in continued:
            row = last = last + 1
        continued.add(joint.parent)
        joints[joint.name], links[joint.child] = (row, column), (row, column + 1)
    columns = 1 + max(column for _, column in links.values())
    # A leader that does not move has no line to its coupling.
    motions = {joint.name: MOTION_KINDS.get(joint.type) for joint in tree.joints}
    leaders = {joint.name: mimic.joint for joint, mimic in tree.followers() if motions[mimic.joint]}
    across, along = _detours(leaders, joints)

    banded = {joints[name][0] for name in names.couplings}
    driven = {joints[name][0] for name in names.axes}
    framed = {links[name][0] for name in names.frames if name in continued}
    top, rows = 0, list[_Row]()
    for _ in range(2):  # the second time with `frame_a`, which is on the first spine, at its height
        top, rows = FRAME_A[1] - (rows[0].spine if rows else 0), []
        below = top
        for row in range(last + 1):
            lanes = [below - _TRACK * (track + 1) for track in range(_count(across.get(row, {})))]
            below -= _TRACK * len(lanes)
            band = below - _NAME - _SIZE // 2
            below -= (_NAME + _SIZE) * (row in banded) + (_CONNECTOR + _TRACK) * (row in driven)
            spine = below - _NAME - _SIZE // 2
            below = spine - _BELOW - (_CONNECTOR + _TRACK) * (row in framed)
            rows.append(_Row(spine, band, lanes, below))
    left = FRAME_A[0] - _FRAME // 2
    trunks = [left + _FRAME + _TRUNK // 2 + _TRACK * (_count(along.get(0, {})) + 1)]
    for column in range(1, columns):
        trunks.append(trunks[-1] + _COLUMN + _TRACK * max(0, _count(along.get(column, {})) - 1))
    right = trunks[-1] + _MARGIN + _SIZE

    link_boxes, joint_boxes = {}, {}
    for name, (row, column) in links.items():
        link_boxes[name] = Placement.around((trunks[column] + _LINK_X, rows[row].spine - _LINK_Y))
    for name, (row, column) in joints.items():
        joint_boxes[name] = Placement.around((trunks[column] + _JOINT_X, rows[row].spine))
    placements = {"frame_a": Placement.around(FRAME_A, _FRAME)}
    for name, axis in names.axes.items():
        (x, _), y = joint_boxes[name].centre, joint_boxes[name].centre[1] + _ABOVE
        placements[axis] = Placement.around((x, y), _CONNECTOR)
        aside = joint_boxes[name].port("support")[0] - _ASIDE
        placements[names.supports[name]] = Placement.around((aside, y), _CONNECTOR)
    for name, frame in names.frames.items():
        if name in continued:
            below_link = link_boxes[name].centre[0], link_boxes[name].y1 - _CONNECTOR
            placements[frame] = Placement.around(below_link, _CONNECTOR)
        else:
            placements[frame] = Placement.around((right - _SIZE // 2, rows[links[name][0]].spine))
    placements |= {tree.link(name).component: box for name, box in link_boxes.items()}
    placements |= {tree.joint(name).component: box for name, box in joint_boxes.items()}
    for name, coupling in names.couplings.items():
        row, column = joints[name]
        placements[coupling] = Placement.around((trunks[column] + _LINK_X, rows[row].band))

    lines: dict[tuple[str, str], tuple[LineKind, Path]] = {}
    children = tree.children()
    for name, (row, column) in links.items():
        component, trunk, port = tree.link(name).component, trunks[column], link_boxes[name].port("frame_a")
        own, foot = f"{component}.frame_a", (trunk, port[1])
        if name == tree.links[0].name:
            lines["frame_a", own] = "frame", _path([FRAME_A, (trunk, rows[row].spine), foot, port])
        if name in names.frames:
            end = placements[names.frames[name]].centre
            lines[own, names.frames[name]] = "frame", _path([port, foot, (trunk, end[1]), end])
        for joint in children.get(name, ()):
            joint_name, box = tree.joint(joint.name).component, joint_boxes[joint.name]
            start, end = box.port("frame_a"), box.port("frame_b")
            lines[own, f"{joint_name}.frame_a"] = "frame", _path([port, foot, (trunk, start[1]), start])
            child, turn = link_boxes[joint.child].port("frame_a"), trunks[column + 1]
            ends = f"{joint_name}.frame_b", f"{tree.link(joint.child).component}.frame_a"
            lines[ends] = "frame", _path([end, (turn, end[1]), (turn, child[1]), child])
    for name, axis in names.axes.items():
        component, box = tree.joint(name).component, joint_boxes[name]
        kind, start, support = motions[name] or "frame", box.port("axis"), box.port("support")
        lines[f"{component}.axis", axis] = kind, _path([start, placements[axis].centre])
        end, bend = placements[names.supports[name]].centre, support[1] + 2
        points = [support, (support[0], bend), (end[0], bend), end]
        lines[f"{component}.support", names.supports[name]] = kind, _path(points)
    for name, coupling in names.couplings.items():
        follower, box, end = tree.joint(name).component, placements[coupling], joint_boxes[name].port("axis")
        start = box.port("follower")
        points = [start, (end[0], start[1]), end]
        lines[f"{coupling}.follower", f"{follower}.axis"] = motions[name] or "frame", _path(points)
        if name in leaders:
            leader = leaders[name]
            row, column = joints[leader][0], joints[name][1]
            start, end = box.port("leader"), joint_boxes[leader].port("axis")
            x = trunks[column] - _TRACK * (along[column][leader] + 1)
            y = rows[row].tracks[across[row][leader]]
            points = [start, (x, start[1]), (x, y), (end[0], y), end]
            if leader in names.axes:  # its connector stands above the axis: pass it
                aside, bend = end[0] + _ASIDE, end[1] + 2
                points = [start, (x, start[1]), (x, y), (aside, y), (aside, bend), (end[0], bend), end]
            ends = f"{coupling}.leader", f"{tree.joint(leader).component}.axis"
            lines[ends] = motions[leader] or "frame", _path(points)
    return Diagram((left, rows[-1].bottom, right, top), placements, lines)


_Tracks: TypeAlias = Mapping[int, Mapping[str, int]]


def _detours(leaders: Mapping[str, str], joints: Mapping[str, tuple[int, int]]) -> tuple[_Tracks, _Tracks]:
    """Return the track of each leader's lines: above each row, and in the gap left of each column.

    `leaders` has the leader of each follower, `joints` the cells of joints.
    """
    followers = defaultdict[str, list[tuple[int, int]]](list)
    for follower, leader in leaders.items():
        followers[leader].append(joints[follower])
    across, along = (defaultdict[int, dict[str, tuple[int, int]]](dict) for _ in range(2))
    for leader, cells in followers.items():
        row, column = joints[leader]
        passed = [column, *(cell[1] for cell in cells)]
        across[row][leader] = min(passed), max(passed)
        for cell in cells:
            low, high = along[cell[1]].get(leader, (row, row))
            along[cell[1]][leader] = min(low, cell[0]), max(high, cell[0])
    return (
        {row: tracks(intervals) for row, intervals in across.items()},
        {column: tracks(intervals) for column, intervals in along.items()},
    )


def tracks(intervals: Mapping[Key, tuple[int, int]]) -> dict[Key, int]:
    """Number the tracks of a channel, from 0, so that closed intervals on one track don't touch.

    The left-edge method: as few tracks as the densest place of the channel needs.
    """
    assigned: dict[Key, int] = {}
    busy: list[tuple[int, int]] = []
    for key, (start, end) in sorted(intervals.items(), key=lambda item: item[1]):
        track = heapq.heappop(busy)[1] if busy and busy[0][0] < start else len(busy)
        assigned[key] = track
        heapq.heappush(busy, (end, track))
    return assigned


def _count(assigned: Mapping[str, int]) -> int:
    return 1 + max(assigned.values(), default=-1)


def _path(points: Iterable[Point]) -> Path:
    """Return the polyline without repeated points and without points inside a straight run."""
    found: list[Point] = []
    for point in points:
        if found and point == found[-1]:
            continue
        if len(found) > 1 and (found[-2][0] == found[-1][0] == point[0] or found[-2][1] == found[-1][1] == point[1]):
            found.pop()
        found.append(point)
    return tuple(found)
