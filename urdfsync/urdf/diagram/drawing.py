"""Draws the robot model's diagram as SVG. The SVG refers to no other file, and is equal on all machines."""

from __future__ import annotations

import itertools
from collections import Counter, defaultdict
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path as FilePath
from typing import Literal, NamedTuple, TypeAlias

import jinja2

from urdfsync.domain import Target
from urdfsync.urdf.assembly import Assembly
from urdfsync.urdf.diagram.layout import Diagram, LineKind, Path, Point, layout
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, JointType, Robot

Kind: TypeAlias = Literal["link", "fixed", "rotational", "translational", "free", "ball", "coupling", "sensor", "loop"]
_Entry: TypeAlias = tuple[Kind, str, float, int, float]
"""Entry of the legend: kind of icon, text, place (x, y), and width."""

# Pixels of one unit of the diagram: at 100 %, the smallest text is 10 pixels high. So the picture grows with the robot.
_PIXELS = 4
_MARGIN = 10
_HEADER = 24  # Room for the title and the names of the connectors at the top.
_FOOTER, _LEGEND = 8, 10  # Space above the legend, and height of each row of the legend.
_FONT, _SMALLEST = 3.6, 2.5
_ADVANCE = 0.56  # Mean width of a character, by font size.
_BEND = 2.0  # Radius of the bends of flange lines: they show that a line joins another line and does not cross it.

_LEGENDS: Mapping[Kind, str] = {
    "link": "link, mass",
    "fixed": "fixed joint",
    "rotational": "rotational joint",
    "translational": "translational joint",
    "free": "planar or floating joint",
    "ball": "ball joint",
    "coupling": "mimic coupling, ratio",
    "sensor": "sensor",
    "loop": "joint that closes a loop",
}
_OTHERS: Mapping[JointType, Kind] = {"fixed": "fixed", "ball": "ball"}


class _Part(NamedTuple):
    """A component with an icon."""

    kind: Kind
    text: str = ""
    """Text in the icon: mass or ratio."""
    is_driven: bool = False


def draw(robot: Robot, target: Target, options: Options) -> str:
    """Return the robot model's diagram as SVG, in the layout of the generated model, with masses and ratios."""
    assembly = Assembly(robot, options, target)
    names = assembly.connectors
    diagram, parts = layout(assembly.tree, names), dict(_parts(assembly))
    x1, y1, x2, y2 = diagram.extent
    legend, bottom = _legend({part.kind for part in parts.values()}, (x1, -y1 + _FOOTER), x2 + _MARGIN)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(FilePath(__file__).parent),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
        autoescape=True,
    )
    environment.filters |= {"number": "{:.9g}".format, "fit": _fit, "printable": _printable}
    return environment.get_template("diagram.svg.jinja").render(
        title=target.package,
        pixels=_PIXELS,
        font=_FONT,
        left=x1 - _MARGIN,
        top=-y2 - _HEADER,
        width=x2 - x1 + 2 * _MARGIN,
        height=bottom + y2 + _HEADER,
        extent=diagram.extent,
        lines=_lines(diagram),
        junctions=_junctions(diagram),
        placements={
            name: box for name, box in diagram.placements.items() if name not in ("sensorParameters", "startPositions")
        },
        parts=parts,
        axes={drive.axis: drive.motion for drive in names.drives.values()}
        | {drive.motor: "rotational" for drive in names.drives.values() if drive.motor},
        supports={drive.support: drive.motion for drive in names.drives.values()},
        sensor_frames=set(names.sensor_frames.values()),
        legend=legend,
    )


def _parts(assembly: Assembly) -> Iterator[tuple[str, _Part]]:
    """Yield the components of links, joints, couplings, sensors and loops."""
    tree, names = assembly.tree, assembly.connectors
    for link in tree.links:
        yield (
            tree.link(link.name).component,
            _Part("link", f"{_rounded(link.inertial.mass)} kg" if link.inertial else ""),
        )
    types = {joint.name: joint.type for joint in tree.joints}
    for joint in tree.joints:
        kind: Kind = MOTION_KINDS.get(joint.type) or _OTHERS.get(joint.type, "free")
        yield tree.joint(joint.name).component, _Part(kind, is_driven=joint.name in names.drives)
    for joint, mimic in tree.followers():
        ratio = f"× {_rounded(mimic.multiplier)}" if types[mimic.joint] in MOTION_KINDS else "held"
        yield names.couplings[joint.name], _Part("coupling", ratio)
    yield from ((drive.gear, _Part("coupling", "gear")) for drive in names.drives.values() if drive.gear)
    yield from ((component, _Part("sensor")) for component in names.sensors.values())
    yield from ((tree.loop(loop.name).component, _Part("loop")) for loop in tree.loops)


def _rounded(value: float) -> str:
    """Return a number with three digits, without an exponent up to 999,999."""
    return f"{float(f'{value:.3g}'):g}"


def _lines(diagram: Diagram) -> Mapping[str, list[str]]:
    """Return one path for all lines of a style, so that a shared trunk is painted once."""
    styles = defaultdict[str, list[str]](list)
    for (start, _), (kind, points) in diagram.lines.items():
        style = kind + (" support" if start.endswith(".support") else "")
        styles[style].append(_curved(points, 0 if kind == "frame" else _BEND))
    return styles


def _curved(points: Path, radius: float) -> str:
    """Return path data of a polyline. Each bend is rounded, up to the middle of its shorter side."""
    data = [f"M{points[0][0]} {-points[0][1]}"]
    for before, (x, y), after in zip(points, points[1:], points[2:], strict=False):
        # Segments are axis-parallel, so one of the two terms of each length is zero.
        sides = [(a - x, b - y, abs(a - x) + abs(b - y)) for a, b in (before, after)]
        reach = min(radius, *(length / 2 for *_, length in sides))
        (x1, y1), (x2, y2) = ((x + reach * (dx // length), y + reach * (dy // length)) for dx, dy, length in sides)
        data.append(f"L{x1:.9g} {-y1:.9g}" + (f"Q{x} {-y} {x2:.9g} {-y2:.9g}" if reach else ""))
    data.append(f"L{points[-1][0]} {-points[-1][1]}")
    return "".join(data)


def _junctions(diagram: Diagram) -> list[tuple[LineKind, Point]]:
    """Return the points where three or more segments of a net meet. A net has lines of one kind with one common end."""
    uses = Counter(end for ends in diagram.lines for end in ends)
    nets = defaultdict[tuple[LineKind, str], list[Path]](list)
    for ends, (kind, points) in diagram.lines.items():
        nets[kind, max(ends, key=uses.__getitem__)].append(points)
    junctions: list[tuple[LineKind, Point]] = []
    for (kind, _), paths in nets.items():
        across, upright = (defaultdict[int, set[tuple[int, int]]](set) for _ in range(2))
        for (x1, y1), (x2, y2) in (sorted(pair) for path in paths for pair in itertools.pairwise(path)):
            if y1 == y2:
                across[y1].add((x1, x2))
            else:
                upright[x1].add((y1, y2))
        for x, y in {point for path in paths for point in path}:
            # Coordinates are even, so no segment ends one step beside a point.
            sides = [(across[y], x - 1), (across[y], x + 1), (upright[x], y - 1), (upright[x], y + 1)]
            ways = [any(start < step < end for start, end in segments) for segments, step in sides]
            if sum(ways) > 2:
                junctions.append((kind, (x, y)))
    return sorted(junctions)


def _legend(kinds: Collection[Kind], start: Point, right: float) -> tuple[list[_Entry], int]:
    """Return the entries of the legend, in as many rows as needed, and the lower end of the legend."""
    entries: list[_Entry] = []
    x, y = float(start[0]), start[1]
    for kind, text in _LEGENDS.items():
        room = 15 + _width(text, _FONT)
        if kind not in kinds:
            continue
        if x > start[0] and x + room > right:
            x, y = float(start[0]), y + _LEGEND
        entries.append((kind, text, x, y, room))
        x += room
    return entries, y + _LEGEND


def _fit(text: str, size: float, room: float) -> tuple[str, str]:
    """Return a text and its font size. A text longer than `room` gets smaller letters, then loses its middle."""
    fitting = max(min(size, size * room / _width(text, size)), min(size, _SMALLEST))
    most = max(3, int(room / _width("x", fitting) + 1e-9))
    if len(text) > most:
        text = f"{text[: most // 2]}…{text[len(text) - (most - 1) // 2 :]}"
    return text, f"{fitting:.3g}"


def _width(text: str, size: float) -> float:
    return size * _ADVANCE * len(text)


def _printable(text: str) -> str:
    """Replace unprintable characters by spaces, since XML forbids some of them."""
    return "".join(char if char.isprintable() else " " for char in text)
