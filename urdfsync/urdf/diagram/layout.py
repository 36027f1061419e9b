"""Layout of the robot model's diagram: places of links, joints and couplings, and paths of the lines between them.

A chain runs from left to right and ends at the connector of its last link. One child joint of a link continues the
link's chain: the first that leads to more than a leaf, else the first. Every other one starts a chain below those of
the joints before it, in the first row where its columns are free:

    frame_a ──┬── joint ──┬── joint ──┬── joint ──┬── handFrame
              ├ link      ├ link      ├ link      └ link
              │           │           └── joint ──┬── cameraFrame
              │           │                       └ link
              └── joint ──┬── tailFrame
                          └ link

So a new leaf moves only the components below a place that it takes. Components keep to columns. A link hangs on a
vertical trunk at the left of its column. The joints that start at it stand on the spines of their rows, right of the
trunk: a trunk passes nothing of its own column. Above a joint that can be driven stand the connectors of its axis and
its support. A mimic coupling stands above its follower; the line from its leader runs through the gap between two
columns, on a track that no other line has there. A joint that closes a loop stands below all rows, in the column of its
parent; the lines from its links run down to it on such tracks.

Lines consist of axis-parallel segments. All coordinates are even, y points upwards.
"""

from __future__ import annotations

import heapq
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from typing import Literal, NamedTuple, TypeAlias

from urdfsync.urdf.connectors import Connectors
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.robot import MOTION_KINDS, Joint

Point: TypeAlias = tuple[int, int]
Path: TypeAlias = tuple[Point, ...]
LineKind: TypeAlias = Literal["frame", "rotational", "translational"]
_Cell: TypeAlias = tuple[int, int]
_End: TypeAlias = tuple[str, str]
"""A loop and one of its frames."""
_Spans: TypeAlias = dict[str | _End, list[int]]
"""Places per leader, or end of a loop; its lines run from the first to the last of them."""

PORTS: Mapping[str, Point] = {
    "frame_a": (-100, 0),
    "frame_b": (100, 0),
    "axis": (0, 100),
    "support": (-60, 100),
    "motor": (80, 100),
    "leader": (-100, 0),
    "follower": (100, 0),
}
"""Connectors of components, in the coordinates of their icons, -100 to 100 both ways."""

FRAME_A: Point = (-100, 0)
"""Middle of the connector `frame_a` in every robot's diagram."""

_SIZE = 20  # width and height of a component, and of the frame connectors at the ends of rows
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
_MARGIN = 64  # from the last trunk to the right edge: a connector and its name
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
        """Middle of the rectangle."""
        return (self.x1 + self.x2) // 2, (self.y1 + self.y2) // 2

    def port(self, connector: str) -> Point:
        """Return the place in the diagram of a component's connector."""
        x, y = PORTS[connector]
        return self.x1 + (self.x2 - self.x1) * (x + 100) // 200, self.y1 + (self.y2 - self.y1) * (y + 100) // 200


class Diagram(NamedTuple):
    """A finished layout, by component names; all coordinates are even.

    `extent` (x1, y1, x2, y2) holds everything. A line leads from the first of its two ends, as they stand in the
    connect equation, to the second; lines at one of the model's own connectors end in its middle.
    """

    extent: tuple[int, int, int, int]
    placements: dict[str, Placement]
    lines: dict[tuple[str, str], tuple[LineKind, Path]]


class _Grid(NamedTuple):
    """Points of the diagram by URDF names, and its edges."""

    links: Mapping[str, Point]
    """Points at which the trunk of a link meets the spine of its row."""
    joints: Mapping[str, Point]
    """Points at which the trunk of a joint's parent meets the spine of the joint's row."""
    couplings: Mapping[str, Point]
    """Middles of the couplings, by follower."""
    detours: Mapping[str, Point]
    """Points, by follower, at which the line to its leader leaves the gap between columns for the leader's row."""
    loops: Mapping[str, Point]
    """Middles of the joints that close a loop."""
    descents: Mapping[_End, int]
    """Where, from left to right, the lines of loops run down in the gaps between columns."""
    top: int
    right: int
    bottom: int


def layout(tree: KinematicTree, names: Connectors) -> Diagram:
    """Place every component and route every connection of the robot model, in linear time.

    No two components overlap and no line crosses a component.
    """
    grid = _grid(tree, names)
    placements = _placements(tree, names, grid)
    extent = placements["frame_a"].x1, grid.bottom, grid.right, grid.top
    return Diagram(extent, placements, _lines(tree, names, grid, placements))


def _grid(tree: KinematicTree, names: Connectors) -> _Grid:
    links, joints = _cells(tree)
    last_row, last_column = (max(places) for places in zip(*links.values(), strict=True))

    # Tracks for lines to leaders, above each row and left of each column. A leader that does not move has no line.
    moving = {joint.name for joint in tree.joints if joint.type in MOTION_KINDS}
    leaders = {joint.name: mimic.joint for joint, mimic in tree.followers() if mimic.joint in moving}
    spans_above, spans_left = (defaultdict[int, _Spans](lambda: defaultdict(list)) for _ in range(2))
    for follower, leader in leaders.items():
        (row, column), (follower_row, follower_column) = joints[leader], joints[follower]
        spans_above[row][leader] += column, follower_column
        spans_left[follower_column][leader] += row, follower_row
    links_of_loops = {(loop.name, "frame_a"): loop.parent for loop in tree.loops}
    links_of_loops |= {(loop.name, "frame_b"): loop.child for loop in tree.loops}
    for end, link in links_of_loops.items():
        row, column = links[link]
        spans_left[column][end] += row, last_row + 1
    tracks_above = [_tracks(spans_above[row]) for row in range(last_row + 1)]
    tracks_left = [_tracks(spans_left[column]) for column in range(last_column + 1)]

    with_axes = {joints[name][0] for name in names.drives}
    with_motors = {joints[name][0] for name, drive in names.drives.items() if drive.motor}
    with_couplings = {joints[name][0] for name in names.couplings}
    highest = defaultdict[int, int](int)  # by row, the most sensors below one link
    for link, count in Counter(_carriers(tree).values()).items():
        highest[links[link][0]] = max(highest[links[link][0]], count)
    parents = {joint.parent for joint in tree.joints}
    with_frames = {links[name][0] for name in names.frames if name in parents}
    tops, spines, y = list[int](), list[int](), 0
    for row, tracks in enumerate(tracks_above):
        height = _TRACK * _count(tracks) + _NAME + _SIZE // 2
        height += (_CONNECTOR + _TRACK) * ((row in with_axes) + (row in with_motors)) + (_NAME + _SIZE) * (
            row in with_couplings
        )
        tops.append(y if row else FRAME_A[1] + height)
        spines.append(tops[row] - height)
        y = spines[row] - _BELOW - (_CONNECTOR + _TRACK) * (row in with_frames) - (_SIZE + _NAME) * highest[row]
    trunks = [FRAME_A[0] + _FRAME // 2 + _TRUNK // 2 + _TRACK * (_count(tracks_left[0]) + 1)]
    for tracks in tracks_left[1:]:
        trunks.append(trunks[-1] + _COLUMN + _TRACK * max(0, _count(tracks) - 1))

    couplings, detours = {}, {}
    for name in names.couplings:
        row, column = joints[name]
        y_coupling = tops[row] - _TRACK * _count(tracks_above[row]) - _NAME - _SIZE // 2
        couplings[name] = trunks[column] + _LINK_X, y_coupling
        if name in leaders:
            row = joints[leaders[name]][0]
            track_above, track_left = tracks_above[row][leaders[name]], tracks_left[column][leaders[name]]
            detours[name] = trunks[column] - _TRACK * (track_left + 1), tops[row] - _TRACK * (track_above + 1)
    loops = {
        loop.name: (trunks[links[loop.parent][1]] + _LINK_X, y - _NAME - _SIZE // 2 - place * (_SIZE + 2 * _NAME))
        for place, loop in enumerate(tree.loops)
    }
    return _Grid(
        links={name: (trunks[column], spines[row]) for name, (row, column) in links.items()},
        joints={name: (trunks[column], spines[row]) for name, (row, column) in joints.items()},
        couplings=couplings,
        detours=detours,
        loops=loops,
        descents={
            end: trunks[links[link][1]] - _TRACK * (tracks_left[links[link][1]][end] + 1)
            for end, link in links_of_loops.items()
        },
        top=tops[0],
        right=trunks[-1] + _MARGIN,
        bottom=y
        - max((_SIZE + _NAME) * (bool(tree.sensors) + _has_starts(tree)), (_SIZE + 2 * _NAME) * len(tree.loops)),
    )


def _cells(tree: KinematicTree) -> tuple[Mapping[str, _Cell], Mapping[str, _Cell]]:
    """Return row and column of each link and joint: a joint stands in its parent's column and in its child's row."""
    root, parents = tree.links[0].name, {joint.parent for joint in tree.joints}
    columns, children = {root: 0}, dict[str, list[Joint]]()
    for joint in tree.joints:
        columns[joint.child] = columns[joint.parent] + 1
    for link, starting in tree.children().items():
        first = next((joint for joint in starting if joint.child in parents), starting[0])
        children[link] = [first, *(joint for joint in starting if joint is not first)]
    ends = dict(columns)  # the last column of the row that goes on from a link
    for joint in reversed(tree.joints):
        if joint is children[joint.parent][0]:
            ends[joint.parent] = ends[joint.child]

    links, joints = {root: (0, 0)}, {}
    lowest = [0] * (max(columns.values()) + 1)  # the last row that has something in a column
    todo = children.get(root, [])[::-1]
    while todo:
        joint = todo.pop()
        row, column = links[joint.parent]
        if joint is not children[joint.parent][0]:
            across = slice(column, ends[joint.child] + 1)
            row = 1 + max(lowest[across])
            lowest[across] = [row] * len(lowest[across])
        joints[joint.name], links[joint.child] = (row, column), (row, column + 1)
        todo += children.get(joint.child, [])[::-1]
    return {link.name: links[link.name] for link in tree.links}, joints


def _carriers(tree: KinematicTree) -> dict[str, str]:
    """Return the link below which each sensor stands: that of force and torque below the joint's child."""
    children = {joint.name: joint.child for joint in tree.joints}
    return {sensor.name: children[sensor.at] if sensor.kind == "force_torque" else sensor.at for sensor in tree.sensors}


def _placements(tree: KinematicTree, names: Connectors, grid: _Grid) -> dict[str, Placement]:
    """Return the places of all components, in the order in which they are drawn."""
    links = {name: Placement.around((x + _LINK_X, y - _LINK_Y)) for name, (x, y) in grid.links.items()}
    joints = {name: Placement.around((x + _JOINT_X, y)) for name, (x, y) in grid.joints.items()}
    placements = {"frame_a": Placement.around(FRAME_A, _FRAME)}
    for name, drive in names.drives.items():
        (x, y), (support_x, _) = joints[name].centre, joints[name].port("support")
        placements[drive.axis] = Placement.around((x, y + _ABOVE), _CONNECTOR)
        placements[drive.support] = Placement.around((support_x - _ASIDE, y + _ABOVE), _CONNECTOR)
        if drive.motor:
            placements[drive.motor] = Placement.around((x, y + _ABOVE + _CONNECTOR + _TRACK), _CONNECTOR)
    leaves = {leaf.name for leaf in tree.leaves()}
    for name, frame in names.frames.items():
        if name in leaves:
            x, y = grid.links[name]
            placements[frame] = Placement.around((x + _JOINT_X, y))
        else:
            placements[frame] = Placement.around((links[name].centre[0], links[name].y1 - _CONNECTOR), _CONNECTOR)
    below = {
        name: placements[names.frames[name]].y1 if name in names.frames and name not in leaves else place.y1
        for name, place in links.items()
    }
    records = ["startPositions"] * _has_starts(tree) + ["sensorParameters"] * bool(tree.sensors)
    for row, record in enumerate(records):
        y = grid.bottom + _SIZE // 2 + row * (_SIZE + _NAME)
        placements[record] = Placement.around((FRAME_A[0], y))
    for sensor, link in _carriers(tree).items():
        middle = links[link].centre[0], below[link] - _NAME - _SIZE // 2
        placements[names.sensors[sensor]] = place = Placement.around(middle)
        below[link] = place.y1
        if sensor in names.sensor_frames:
            placements[names.sensor_frames[sensor]] = Placement.around(
                (place.x2 + _TRACK + _CONNECTOR // 2, middle[1]), _CONNECTOR
            )
    placements |= {tree.link(name).component: place for name, place in links.items()}
    placements |= {tree.joint(name).component: place for name, place in joints.items()}
    placements |= {tree.loop(name).component: Placement.around(middle) for name, middle in grid.loops.items()}
    return placements | {names.couplings[name]: Placement.around(middle) for name, middle in grid.couplings.items()}


def _lines(
    tree: KinematicTree, names: Connectors, grid: _Grid, placements: Mapping[str, Placement]
) -> dict[tuple[str, str], tuple[LineKind, Path]]:
    """Return the lines: of frames link by link, then of flanges, then of couplings."""
    lines: dict[tuple[str, str], tuple[LineKind, Path]] = {}
    children = tree.children()
    motions = {joint.name: MOTION_KINDS[joint.type] for joint in tree.joints if joint.type in MOTION_KINDS}
    carried = defaultdict[str, list[str]](list)
    for sensor in tree.sensors:
        if sensor.kind != "force_torque":
            carried[sensor.at].append(sensor.name)

    def place(end: str) -> Point:
        component, _, port = end.partition(".")
        return placements[component].port(port) if port else placements[component].centre

    def route(kind: LineKind, start: str, end: str, *bends: Point) -> None:
        lines[start, end] = kind, _path([place(start), *bends, place(end)])

    def route_frames(start: str, end: str, x: int) -> None:
        route("frame", start, end, (x, place(start)[1]), (x, place(end)[1]))

    for name, (trunk, _) in grid.links.items():
        frame_a = f"{tree.link(name).component}.frame_a"
        if name == tree.links[0].name:
            route_frames("frame_a", frame_a, trunk)
        if name in names.frames:
            route_frames(frame_a, names.frames[name], trunk)
        for called in carried[name]:
            route_frames(frame_a, f"{names.sensors[called]}.frame_a", trunk)
            if frame := names.sensor_frames.get(called):
                route("frame", f"{names.sensors[called]}.frame_b", frame)
        for joint in children.get(name, ()):
            component, child = tree.joint(joint.name).component, tree.link(joint.child).component
            route_frames(frame_a, f"{component}.frame_a", trunk)
            route_frames(f"{component}.frame_b", f"{child}.frame_a", grid.links[joint.child][0])
    for loop in tree.loops:
        component = tree.loop(loop.name).component
        parent, end = (f"{tree.link(link).component}.frame_a" for link in (loop.parent, loop.child))
        route_frames(parent, f"{component}.frame_a", grid.descents[loop.name, "frame_a"])
        start, down = f"{component}.frame_b", grid.descents[loop.name, "frame_b"]
        x, y = place(start)
        # a link that is further left is reached below the joint
        height = y if down > x + _TRACK else placements[component].y1 - _TRACK
        bends = [(x + _TRACK, y), (x + _TRACK, height), (down, height), (down, place(end)[1])]
        route("frame", start, end, *bends)
    for name, drive in names.drives.items():
        axis, support, motor = (f"{tree.joint(name).component}.{port}" for port in ("axis", "support", "motor"))
        route(drive.motion, axis, drive.axis)
        x, y = place(support)
        route(drive.motion, support, drive.support, (x, y + 2), (place(drive.support)[0], y + 2))
        if drive.motor:  # its connector stands above that of the axis: the line passes this
            route("rotational", motor, drive.motor, (place(motor)[0], place(drive.motor)[1]))
    for joint, mimic in tree.followers():
        coupling, leader = names.couplings[joint.name], mimic.joint
        start, axis = f"{coupling}.follower", f"{tree.joint(joint.name).component}.axis"
        route(motions[joint.name], start, axis, (place(axis)[0], place(start)[1]))
        if joint.name in grid.detours:
            start, axis, (x, y) = f"{coupling}.leader", f"{tree.joint(leader).component}.axis", grid.detours[joint.name]
            end_x, end_y = place(axis)
            bends = [(end_x, y)]
            if leader in names.drives:  # its connector stands above the axis: pass it, and the line of its motor
                aside = end_x + _ASIDE + (_TRACK if names.drives[leader].motor else 0)
                bends = [(aside, y), (aside, end_y + 2), (end_x, end_y + 2)]
            route(motions[leader], start, axis, (x, place(start)[1]), (x, y), *bends)
    return lines


def _has_starts(tree: KinematicTree) -> bool:
    """Return whether the robot model has a record of start positions: joints in loops begin where these are closed."""
    return bool(tree.starts() or tree.loops)


def _tracks(spans: _Spans) -> dict[str | _End, int]:
    """Number the tracks of a channel, from 0, so that spans on one track don't touch.

    The left-edge method: as few tracks as the densest place of the channel needs.
    """
    assigned: dict[str | _End, int] = {}
    busy: list[tuple[int, int]] = []  # end, and track
    for key, places in sorted(spans.items(), key=lambda item: (min(item[1]), max(item[1]))):
        assigned[key] = heapq.heappop(busy)[1] if busy and busy[0][0] < min(places) else len(busy)
        heapq.heappush(busy, (max(places), assigned[key]))
    return assigned


def _count(tracks: Mapping[str | _End, int]) -> int:
    return 1 + max(tracks.values(), default=-1)


def _path(points: Iterable[Point]) -> Path:
    """Return the polyline without repeated points and without points inside a straight run."""
    corners: list[Point] = []
    for point in points:
        if corners and point == corners[-1]:
            continue
        if len(corners) > 1:
            (x1, y1), (x2, y2) = corners[-2:]
            if x1 == x2 == point[0] or y1 == y2 == point[1]:
                corners.pop()
        corners.append(point)
    return tuple(corners)
