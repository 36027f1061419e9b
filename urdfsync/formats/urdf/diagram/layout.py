"""Layout of the robot model's diagram: places of links, joints and couplings, and paths of lines.

A chain runs from left to right and ends at the connector of its last link. One child joint of a link continues the
link's chain. It is the first joint with a branch of more than two links, and more than half the links of the largest
branch. Without such a branch, it is the first joint. Each other child joint starts a new chain in a row below, from the
link's column on:

    frame_a ──┬── joint ──┬── joint ──┬── joint ──┬── handFrame
              ├ link      ├ link      ├ link      └ link
              │           │
              │           └── joint ──┬── cameraFrame
              │                       └ link
              └── joint ──┬── tailFrame
                          └ link

A new leaf should change few lines of the model. So rows have one height, and columns one width. The row of a chain
follows from a hash of its joint's name, and from the free rows. Large chains choose first, and of equally large chains
the ones further left. So a new leaf displaces only other leaves. The price is empty cells and crossings: a chain may
cross the lines that lead from a link to another chain.

The spine of a row is the horizontal line of its chain. A link hangs on a short trunk at the left of its column. Lines
to chains and sensors below the link run down in the gap between two columns, each on its own track. The connectors of
axis and support stand above a joint that can be driven. A mimic coupling stands above its follower; the line from the
leader runs on a track. If a motor moves two joints, its gear stands above the first joint. The line to the second
joint runs on a track. A joint that closes a loop stands below all rows, in the column of its parent. The lines from
its links run down on tracks.

Lines consist of axis-parallel segments. All coordinates are even; y points upwards.
"""

from __future__ import annotations

import bisect
import hashlib
import itertools
from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Literal, NamedTuple, TypeAlias

from urdfsync.formats.urdf.connectors import Connectors
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.robot import MOTION_KINDS, Joint, Motion

Point: TypeAlias = tuple[int, int]
LinePath: TypeAlias = tuple[Point, ...]
LineKind: TypeAlias = Literal["frame", "rotational", "translational"]
_Cell: TypeAlias = tuple[int, int]
_End: TypeAlias = tuple[str, str]
"""One end of lines: a loop with one of its frames, or a link with `below` for its joints and sensors in other rows."""
_Spans: TypeAlias = dict[str | _End, list[int]]
"""Rows or columns of a leading joint or an `_End`. Its lines run from the first row or column to the last."""

PORTS: Mapping[str, Point] = {
    "frame_a": (-100, 0),
    "frame_b": (100, 0),
    "axis": (0, 100),
    "support": (-60, 100),
    "motor": (80, 100),
    "leader": (-100, 0),
    "follower": (100, 0),
    "flange_a": (0, -100),
    "flange_b": (100, 0),
    "flange_c": (-100, 0),
}
"""Places of connectors on the icons of components, from -100 to 100 in both directions."""

FRAME_A: Point = (-100, 0)
"""Middle of the connector `frame_a` in every robot's diagram."""

_SIZE = 20  # Width and height of components, and of frame connectors at the ends of rows.
_CONNECTOR = 12  # Width and height of a connector that stands beside a component.
_FRAME = 32  # Size of the connector of the root frame, as in the Modelica Standard Library.
_COLUMN = 40  # From a column's trunk to the gap before the next column.
_GAP = 4  # Tracks in a gap; a gap with more tracks is a multiple as wide.
_TRACK = 4  # Distance of neighbouring lines.
_NAME = 8  # Room for a name above a component.
_LINK_X = 14  # From a column's trunk to the middle of its links and couplings.
_JOINT_X = 30  # From a column's trunk to the middle of its joints.
_LINK_Y = 26  # From a row's spine down to the middle of its links.
_BELOW = 44  # From a row's spine down to the row's end: link, name, gap; a sensor is nearer.
_ABOVE = 20  # From a row's spine up to the connectors of the joints.
_MARGIN = 64  # From the last trunk to the right edge: a connector and its name.
_ASIDE = 8  # From an axis to the support's connector, and to a line around the axis's connector.


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
        """Return the place of a component's connector in the diagram."""
        x, y = PORTS[connector]
        return self.x1 + (self.x2 - self.x1) * (x + 100) // 200, self.y1 + (self.y2 - self.y1) * (y + 100) // 200


class Diagram(NamedTuple):
    """A finished layout, by component names. Coordinates are even, but those in a user's text may be odd.

    `extent` is (x1, y1, x2, y2). The key of a line has its two ends, in the order of the connect equation; its value
    has the kind of the line, or a colour of the user's. A line to a connector of the model ends in the middle of the
    connector.
    """

    extent: tuple[int, int, int, int]
    placements: dict[str, Placement]
    lines: Mapping[tuple[str, str], tuple[LineKind | str, LinePath]]


class _Grid(NamedTuple):
    """Points of the diagram by URDF names, and its edges."""

    links: Mapping[str, Point]
    """Points where the trunk of a link meets the spine of its row."""
    joints: Mapping[str, Point]
    """Points where the trunk of a joint's parent meets the spine of the joint's row."""
    sensors: Mapping[str, Point]
    """Points where the trunk of a sensor's link meets the row of the sensor."""
    couplings: Mapping[str, Point]
    """Middles of the couplings, by follower, and of gears, by joint."""
    detours: Mapping[str, Point]
    """Points, by follower, where the line to the leader leaves the gap between columns for the leader's row."""
    loops: Mapping[str, Point]
    """Middles of the joints that close a loop."""
    descents: Mapping[_End, int]
    """The x of an end's lines on their way down in the gap between columns."""
    top: int
    right: int
    bottom: int


def layout(tree: KinematicTree, names: Connectors) -> Diagram:
    """Place all components and route all connections of the robot model, in linear time.

    Components do not overlap, and no line crosses a component.
    """
    grid = _grid(tree, names)
    placements = _placements(tree, names, grid)
    extent = placements["frame_a"].x1, grid.bottom, grid.right, grid.top
    router = _Router(tree, names, grid, placements)
    for route in (router.route_links, router.route_loops, router.route_drives, router.route_couplings):
        route()
    return Diagram(extent, placements, router.lines)


def find_rows(starts: Mapping[str, tuple[int, range]], taken: set[_Cell]) -> dict[str, int]:
    """Return a row for each name, from its first row downwards, where its columns are free; the cells become `taken`.

    A hash of the name chooses among one row, then two, three and ever more. First all names try their first choice,
    then names without a row try their second choice. So a new name displaces few other names.
    """
    rows: dict[str, int] = {}
    waiting = [
        (int.from_bytes(hashlib.sha256(name.encode("utf-8", "surrogatepass")).digest()), name) for name in starts
    ]
    waiting.sort()
    room, shift = 1, 0
    while waiting:
        displaced = []
        for digest, name in waiting:
            first, columns = starts[name]
            row = first + (digest >> shift % 128) % room
            if taken.isdisjoint((row, column) for column in columns):
                taken.update((row, column) for column in columns)
                rows[name] = row
            else:
                displaced.append((digest, name))
        waiting, room, shift = displaced, room + 1 + room // 8, shift + 1
    return rows


def _grid(tree: KinematicTree, names: Connectors) -> _Grid:
    cells = _cells(tree)
    links, joints = cells.links, cells.joints
    last_row = max(row for row, _ in (*links.values(), *cells.sensors.values()))
    last_column = max(column for _, column in links.values())

    # Tracks above each row and left of each column. A leader that does not move has no line.
    moving = {joint.name for joint in tree.joints if joint.type in MOTION_KINDS}
    leaders = {joint.name: mimic.joint for joint, mimic in tree.followers() if mimic.joint in moving}
    gears = {name: drive.other for name, drive in names.drives.items() if drive.gear and drive.other}
    leaders |= gears
    spans_above, spans_left = (defaultdict[int, _Spans](lambda: defaultdict(list)) for _ in range(2))
    for link, row in cells.below:
        spans_left[links[link][1]][link, "below"] += links[link][0], row
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

    parents = {joint.parent for joint in tree.joints}
    above = _TRACK * max(map(_count, tracks_above)) + _NAME + _SIZE // 2 + (_CONNECTOR + _TRACK)
    above += (_CONNECTOR + _TRACK) * any(drive.motor for drive in names.drives.values())
    above += (_NAME + _SIZE) * bool(names.couplings or gears)
    below = _BELOW + (_CONNECTOR + _TRACK) * (not parents.isdisjoint(names.frames))
    spines = [FRAME_A[1] - (above + below) * row for row in range(last_row + 1)]
    bottom = spines[-1] - below
    gaps = [_TRACK * (_GAP * max(1, -(-_count(tracks) // _GAP)) + 1) for tracks in tracks_left]
    trunks = [FRAME_A[0] + _FRAME // 2 + gaps[0]]
    for gap in gaps[1:]:
        trunks.append(trunks[-1] + _COLUMN + gap)

    def point(cell: _Cell) -> Point:
        return trunks[cell[1]], spines[cell[0]]

    couplings, detours = {}, {}
    for name in (*names.couplings, *gears):
        row, column = joints[name]
        y_coupling = spines[row] + above - _TRACK * max(map(_count, tracks_above)) - _NAME - _SIZE // 2
        couplings[name] = trunks[column] + _LINK_X, y_coupling
        if name in leaders:
            row = joints[leaders[name]][0]
            track_above, track_left = tracks_above[row][leaders[name]], tracks_left[column][leaders[name]]
            detours[name] = trunks[column] - _TRACK * (track_left + 1), spines[row] + above - _TRACK * (track_above + 1)
    loops = {
        loop.name: (trunks[links[loop.parent][1]] + _LINK_X, bottom - _NAME - _SIZE // 2 - place * (_SIZE + 2 * _NAME))
        for place, loop in enumerate(tree.loops)
    }
    return _Grid(
        links={name: point(cell) for name, cell in links.items()},
        joints={name: point(cell) for name, cell in joints.items()},
        sensors={name: point(cell) for name, cell in cells.sensors.items()},
        couplings=couplings,
        detours=detours,
        loops=loops,
        descents={
            end: trunks[column] - _TRACK * (track + 1)
            for column, tracks in enumerate(tracks_left)
            for end, track in tracks.items()
            if isinstance(end, tuple)
        },
        top=FRAME_A[1] + above,
        right=trunks[-1] + _MARGIN,
        bottom=bottom
        - max((_SIZE + _NAME) * (bool(tree.sensors) + _has_starts(tree)), (_SIZE + 2 * _NAME) * len(tree.loops)),
    )


class _Cells(NamedTuple):
    """Row and column of each component."""

    links: Mapping[str, _Cell]
    joints: Mapping[str, _Cell]
    """A joint stands in the column of its parent link and in the row of its child link."""
    sensors: Mapping[str, _Cell]
    below: list[tuple[str, int]]
    """Pairs of a link and a lower row with a joint or sensor of the link."""


def _cells(tree: KinematicTree) -> _Cells:
    root, children = tree.links[0].name, tree.children()
    columns, sizes = {root: 0}, {link.name: 1 for link in tree.links}
    for joint in tree.joints:
        columns[joint.child] = columns[joint.parent] + 1
    for joint in reversed(tree.joints):
        sizes[joint.parent] += sizes[joint.child]
    # A new leaf makes few chains large.
    is_large = {joint.name: sizes[joint.child] > 2 for joint in tree.joints}
    following = dict[str, Joint]()
    for link, starting in children.items():
        half = max(sizes[joint.child] for joint in starting) / 2
        large = (joint for joint in starting if is_large[joint.name] and sizes[joint.child] > half)
        following[link] = next(large, starting[0])
    ends = dict(columns)  # the last column of the chain that continues from a link
    for joint in reversed(tree.joints):
        if joint is following[joint.parent]:
            ends[joint.parent] = ends[joint.child]

    links: dict[str, _Cell] = {}
    below: list[tuple[str, int]] = []

    def start(row: int, link: str) -> None:
        links[link] = row, columns[link]
        while link in following:
            link = following[link].child
            links[link] = row, columns[link]

    def rank(joint: Joint) -> tuple[bool, int]:
        """Rank large chains first, then chains further left: so the chain of the parent link always comes first."""
        return not is_large[joint.name], columns[joint.parent]

    start(0, root)
    taken = {(0, column) for column in range(ends[root] + 1)}
    heads = sorted((joint for joint in tree.joints if joint is not following[joint.parent]), key=rank)
    for _, group in itertools.groupby(heads, key=rank):
        chains = {joint.name: joint for joint in group}
        starts = {
            name: (links[joint.parent][0] + 1, range(columns[joint.parent], ends[joint.child] + 1))
            for name, joint in chains.items()
        }
        for name, row in find_rows(starts, taken).items():
            below.append((chains[name].parent, row))
            start(row, chains[name].child)
    joints = {joint.name: (links[joint.child][0], columns[joint.parent]) for joint in tree.joints}

    carriers = _carriers(tree)
    starts = {name: (links[link][0] + 1, range(columns[link], columns[link] + 1)) for name, link in carriers.items()}
    rows = find_rows(starts, taken)
    below += ((sensor.at, rows[sensor.name]) for sensor in tree.sensors if not sensor.is_in_joint)
    sensors = {name: (rows[name], columns[link]) for name, link in carriers.items()}
    return _Cells({link.name: links[link.name] for link in tree.links}, joints, sensors, below)


def _carriers(tree: KinematicTree) -> dict[str, str]:
    """Return the link above each sensor. A force-torque sensor stands below the child of its joint."""
    children = {joint.name: joint.child for joint in tree.joints}
    return {sensor.name: children[sensor.at] if sensor.is_in_joint else sensor.at for sensor in tree.sensors}


def _placements(tree: KinematicTree, names: Connectors, grid: _Grid) -> dict[str, Placement]:
    """Return the places of all components, in the order of drawing."""
    links = {name: Placement.around((x + _LINK_X, y - _LINK_Y)) for name, (x, y) in grid.links.items()}
    joints = {name: Placement.around((x + _JOINT_X, y)) for name, (x, y) in grid.joints.items()}
    placements = {"frame_a": Placement.around(FRAME_A, _FRAME)}
    for name, drive in names.drives.items():
        (x, y), (support_x, _) = joints[name].centre, joints[name].port("support")
        placements[drive.axis] = Placement.around((x, y + _ABOVE), _CONNECTOR)
        placements[drive.support] = Placement.around((support_x - _ASIDE, y + _ABOVE), _CONNECTOR)
        if drive.motor:
            motor_x = grid.couplings[name][0] if drive.gear else x
            placements[drive.motor] = Placement.around((motor_x, y + _ABOVE + _CONNECTOR + _TRACK), _CONNECTOR)
    leaves = {leaf.name for leaf in tree.leaves()}
    for name, frame in names.frames.items():
        if name in leaves:
            x, y = grid.links[name]
            placements[frame] = Placement.around((x + _JOINT_X, y))
        else:
            placements[frame] = Placement.around((links[name].centre[0], links[name].y1 - _CONNECTOR), _CONNECTOR)
    records = ["startPositions"] * _has_starts(tree) + ["sensorParameters"] * bool(tree.sensors)
    for row, record in enumerate(records):
        y = grid.bottom + _SIZE // 2 + row * (_SIZE + _NAME)
        placements[record] = Placement.around((FRAME_A[0], y))
    for sensor, (x, y) in grid.sensors.items():
        placements[names.sensors[sensor]] = Placement.around((x + _LINK_X, y))
        if sensor in names.sensor_frames:
            placements[names.sensor_frames[sensor]] = Placement.around((x + _LINK_X + _SIZE, y), _CONNECTOR)
    placements |= {tree.link(name).component: place for name, place in links.items()}
    placements |= {tree.joint(name).component: place for name, place in joints.items()}
    placements |= {tree.loop(name).component: Placement.around(middle) for name, middle in grid.loops.items()}
    couplings = names.couplings | {name: drive.gear for name, drive in names.drives.items() if drive.gear}
    return placements | {couplings[name]: Placement.around(middle) for name, middle in grid.couplings.items()}


class _Router:
    """Routes the lines of a diagram, and collects them in `lines`."""

    def __init__(
        self, tree: KinematicTree, names: Connectors, grid: _Grid, placements: Mapping[str, Placement]
    ) -> None:
        self.tree, self.names, self.grid, self.placements = tree, names, grid, placements
        self.lines: dict[tuple[str, str], tuple[LineKind, LinePath]] = {}

    def place(self, end: str) -> Point:
        """Return the place of a connector, of a component or of the model."""
        component, _, port = end.partition(".")
        return self.placements[component].port(port) if port else self.placements[component].centre

    def route(self, kind: LineKind, start: str, end: str, *bends: Point) -> None:
        """Add a line with bends."""
        self.lines[start, end] = kind, as_path([self.place(start), *bends, self.place(end)])

    def route_frames(self, start: str, end: str, x: int) -> None:
        """Add a line between two frames, with a vertical part at x."""
        self.route("frame", start, end, (x, self.place(start)[1]), (x, self.place(end)[1]))

    def route_links(self) -> None:
        """Add the lines of each link: to its connector, its sensors and its joints, and from these to their links."""
        tree, names, grid, children = self.tree, self.names, self.grid, self.tree.children()
        carried = defaultdict[str, list[str]](list)
        for sensor in tree.sensors:
            if not sensor.is_in_joint:
                carried[sensor.at].append(sensor.name)
        root = tree.links[0].name
        self.route_frames("frame_a", f"{tree.link(root).component}.frame_a", grid.links[root][0])
        for name, (trunk, spine) in grid.links.items():
            frame_a, track = f"{tree.link(name).component}.frame_a", grid.descents.get((name, "below"), trunk)
            if name in names.frames:
                self.route_frames(frame_a, names.frames[name], trunk)
            for called in carried[name]:
                self.route_frames(frame_a, f"{names.sensors[called]}.frame_a", track)
                if frame := names.sensor_frames.get(called):
                    self.route("frame", f"{names.sensors[called]}.frame_b", frame)
            for joint in children.get(name, ()):
                component, child = tree.joint(joint.name).component, tree.link(joint.child).component
                x = trunk if grid.joints[joint.name][1] == spine else track
                self.route_frames(frame_a, f"{component}.frame_a", x)
                self.route_frames(f"{component}.frame_b", f"{child}.frame_a", grid.links[joint.child][0])

    def route_loops(self) -> None:
        """Add the lines from the two links of each loop to its joint, below all rows."""
        for loop in self.tree.loops:
            component = self.tree.loop(loop.name).component
            parent, end = (f"{self.tree.link(link).component}.frame_a" for link in (loop.parent, loop.child))
            self.route_frames(parent, f"{component}.frame_a", self.grid.descents[loop.name, "frame_a"])
            start, down = f"{component}.frame_b", self.grid.descents[loop.name, "frame_b"]
            x, y = self.place(start)
            # the line to a link further left passes below the joint
            height = y if down > x + _TRACK else self.placements[component].y1 - _TRACK
            bends = [(x + _TRACK, y), (x + _TRACK, height), (down, height), (down, self.place(end)[1])]
            self.route("frame", start, end, *bends)

    def route_drives(self) -> None:
        """Add the lines from each joint that can be driven to its connectors above."""
        for name, drive in self.names.drives.items():
            component = self.tree.joint(name).component
            axis, support, motor = (f"{component}.{port}" for port in ("axis", "support", "motor"))
            self.route(drive.motion, axis, drive.axis)
            x, y = self.place(support)
            self.route(drive.motion, support, drive.support, (x, y + 2), (self.place(drive.support)[0], y + 2))
            if drive.motor and drive.gear:
                self.route("rotational", f"{drive.gear}.flange_a", drive.motor)
            elif drive.motor:  # the line passes the axis's connector on its way to the motor's connector above
                self.route("rotational", motor, drive.motor, (self.place(motor)[0], self.place(drive.motor)[1]))

    def route_couplings(self) -> None:
        """Add the lines from each coupling, and from each gear of two joints, to the axes of its joints."""
        names = self.names
        couplings = [(j.name, m.joint, names.couplings[j.name], "follower", "leader") for j, m in self.tree.followers()]
        gears = ((name, drive.other, drive.gear) for name, drive in names.drives.items())
        couplings += [(name, other, gear, "flange_b", "flange_c") for name, other, gear in gears if other and gear]
        motions = {j.name: MOTION_KINDS[j.type] for j in self.tree.joints if j.type in MOTION_KINDS}
        for joint, leader, coupling, near, far in couplings:
            self._route_axis(motions[joint], f"{coupling}.{near}", joint)
            if joint in self.grid.detours:
                start, (x, y) = f"{coupling}.{far}", self.grid.detours[joint]
                self._route_axis(motions[leader], start, leader, (x, self.place(start)[1]), (x, y))

    def _route_axis(self, motion: Motion, start: str, joint: str, *bends: Point) -> None:
        """Add a line to the axis of a joint, down from the line's last bend or from its start."""
        axis, y = f"{self.tree.joint(joint).component}.axis", (self.place(start), *bends)[-1][1]
        x, end_y = self.place(axis)
        down: list[Point] = [(x, y)]
        if joint in self.names.drives:  # the line passes the axis's connector and the line of the motor
            aside = x + _ASIDE + (_TRACK if self.names.drives[joint].motor else 0)
            down = [(aside, y), (aside, end_y + 2), (x, end_y + 2)]
        self.route(motion, start, axis, *bends, *down)


def _has_starts(tree: KinematicTree) -> bool:
    """Return whether the robot model has a record of start positions. A robot with loops always has such a record."""
    return bool(tree.starts() or tree.loops)


def _tracks(spans: _Spans) -> dict[str | _End, int]:
    """Number the tracks of a channel, from 0: each span gets the first track on which it touches no earlier span."""
    assigned: dict[str | _End, int] = {}
    tracks: list[list[tuple[int, int]]] = []  # the spans of each track, in order
    for key, places in spans.items():
        span = min(places), max(places)
        for number in itertools.count():
            if number == len(tracks):
                tracks.append([])
            at = bisect.bisect(tracks[number], span)
            if all(other[1] < span[0] for other in tracks[number][at - 1 : at]) and all(
                other[0] > span[1] for other in tracks[number][at : at + 1]
            ):
                tracks[number].insert(at, span)
                assigned[key] = number
                break
    return assigned


def _count(tracks: Mapping[str | _End, int]) -> int:
    return 1 + max(tracks.values(), default=-1)


def as_path(points: Iterable[Point]) -> LinePath:
    """Return the polyline without repeated points, and without points inside a straight line."""
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
