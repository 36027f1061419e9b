"""Draw the robot model's diagram as SVG: the text refers to no other file, and a robot always gives the same one."""

from __future__ import annotations

import bisect
import html
import itertools
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Literal, NamedTuple, TypeAlias

from urdfsync.domain import Target
from urdfsync.urdf.connectors import Connectors, connector_names
from urdfsync.urdf.diagram.layout import Diagram, LineKind, Path, Placement, Point, layout
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import MOTION_KINDS, Motion, Robot

Kind: TypeAlias = Literal["link", "fixed", "rotational", "translational", "free", "coupling"]
_Segment: TypeAlias = tuple[int, int, int]  # the line that it is on, start and end

# Size of one unit of the diagram. It grows with the robot, so that the smallest text is 10 pixels high at 100 %:
# a viewer scrolls over a wide robot.
_PIXELS = 4
_MARGIN = 10
_HEADER = 24  # room for the title and the names of the connectors at the top
_FOOTER, _LEGEND = 8, 10  # above the legend, and height of each of its rows
_FONT, _SMALLEST = 3.6, 2.5
_ADVANCE = 0.56  # mean width of a character, by font size
_BEND = 2.0  # radius of the bends of flange lines: joining a bus looks unlike crossing it


class _Icon(NamedTuple):
    fill: str
    stroke: str
    rounding: int
    glyph: str
    detail: float
    """Distance of the text inside the icon from the icon's middle, downwards."""
    legend: str


_ICONS: Mapping[Kind, _Icon] = {
    "link": _Icon(
        "#e4e7eb", "#7d848f", 3, "M-3 -3.2a3 3 0 1 0 6 0a3 3 0 1 0 -6 0M-3 -3.2H3M0 -6.2V-0.2", 5.2, "link, mass"
    ),
    "fixed": _Icon("#f8f9fa", "#9aa0a9", 3, "M-7 0H7M-2.2 -2.2L2.2 2.2M-2.2 2.2L2.2 -2.2", 7, "fixed joint"),
    "rotational": _Icon(
        "#fdebc8",
        "#a86800",
        5,
        "M-5.4 3.6A6.5 6.5 0 1 1 5.4 3.6M7.9 2.5L5.4 3.6L5.3 0.9",
        0.3,
        "rotational joint",
    ),
    "translational": _Icon(
        "#dbf0dd",
        "#1f7a33",
        2,
        "M-7 5.5H7M-5 3.7L-7 5.5L-5 7.3M5 3.7L7 5.5L5 7.3",
        -1.6,
        "translational joint",
    ),
    "free": _Icon(
        "#ebe4f7",
        "#6b46b8",
        5,
        "M-1 1V-7M-2.8 -5L-1 -7L0.8 -5M-1 1H7M5 -0.8L7 1L5 2.8M-1 1L-6 6M-6 3.4V6H-3.4",
        7,
        "planar or floating joint",
    ),
    "coupling": _Icon(
        "#dceafa",
        "#2766a3",
        2,
        "M-6.6 -3a3.3 3.3 0 1 0 6.6 0a3.3 3.3 0 1 0 -6.6 0M0 -3a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0 -4.8 0",
        5.2,
        "mimic coupling, ratio",
    ),
}

_LINE_STYLES = ("frame", "translational support", "rotational support", "translational", "rotational")

_STYLE = """
text { font-family: Helvetica, Arial, "Liberation Sans", sans-serif; fill: #2b2f36; }
.title { font-weight: bold; }
.middle { text-anchor: middle; }
.end { text-anchor: end; }
.port, .legend { fill: #666c76; }
.line { fill: none; stroke-width: 0.6; stroke-linejoin: round; }
.frame { stroke: #5f5f5f; stroke-width: 1.1; }
.rotational { stroke: #000000; }
.rotational.support { stroke: #999999; }
.translational { stroke: #007f00; }
.translational.support { stroke: #8cc78c; }
.dot-frame { fill: #5f5f5f; }
.dot-rotational { fill: #000000; }
.dot-translational { fill: #007f00; }
.halo { stroke: #ffffff; stroke-width: 1.4; stroke-linejoin: round; }
.glyph { fill: none; stroke-width: 0.7; stroke-linecap: round; stroke-linejoin: round; }
""".strip()


def draw(robot: Robot, target: Target, options: Options) -> str:
    """Return the robot model's diagram as SVG, in the layout of the generated model, with masses and ratios."""
    tree = KinematicTree.of(robot, taken=(target.name,))
    names = connector_names(tree, options)
    diagram = layout(tree, names)
    parts = _parts(tree, names)
    kinds = {kind for kind, _ in parts.values()}
    x1, y1, x2, y2 = diagram.extent
    legend, bottom = _legend([kind for kind in _ICONS if kind in kinds], (x1, -y1 + _FOOTER), x2 + _MARGIN)
    left, top, width = x1 - _MARGIN, -y2 - _HEADER, x2 - x1 + 2 * _MARGIN
    height = bottom - top
    body = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width * _PIXELS}" height="{height * _PIXELS}" '
        f'viewBox="{left} {top} {width} {height}">',
        f"<title>{_escaped(target.package)}</title>",
        f"<style>\n{_STYLE}\n</style>",
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="#f4f5f7"/>',
        f'<rect x="{x1}" y="{-y2}" width="{x2 - x1}" height="{y2 - y1}" fill="#ffffff" stroke="#d5d8dd" '
        'stroke-width="0.5"/>',
        _text((x1, -y2 - 13), target.package, "title", 7, x2 - x1),
        *_lines(diagram),
        *(f'<circle class="dot-{kind}" cx="{x}" cy="{-y}" r="1.2"/>' for kind, (x, y) in _junctions(diagram)),
    ]
    axes = {drive.axis: drive.motion for drive in names.drives.values()}
    supports = {drive.support: drive.motion for drive in names.drives.values()}
    driven = {tree.joint(name).component for name in names.drives}
    for name, placement in diagram.placements.items():
        if name in parts:
            body += _component(name, *parts[name], placement, is_driven=name in driven)
        elif name in axes:
            body.append(_flange(placement, axes[name], is_filled=True))
        elif name in supports:
            body.append(_flange(placement, supports[name], is_filled=False))
        else:
            body += _frame(name, placement)
    return "\n".join([*filter(None, [*body, *legend]), "</svg>", ""])


def _parts(tree: KinematicTree, names: Connectors) -> dict[str, tuple[Kind, str]]:
    """Return the kind of each component, and the text inside its icon: mass or ratio."""
    parts: dict[str, tuple[Kind, str]] = {}
    for link in tree.links:
        parts[tree.link(link.name).component] = "link", f"{_rounded(link.inertial.mass)} kg" if link.inertial else ""
    types = {joint.name: joint.type for joint in tree.joints}
    for joint in tree.joints:
        kind: Kind = MOTION_KINDS.get(joint.type) or ("fixed" if joint.type == "fixed" else "free")
        parts[tree.joint(joint.name).component] = kind, ""
    for joint, mimic in tree.followers():
        ratio = f"× {_rounded(mimic.multiplier)}" if types[mimic.joint] in MOTION_KINDS else "held"
        parts[names.couplings[joint.name]] = "coupling", ratio
    return parts


def _rounded(value: float) -> str:
    """Return three digits; from a thousand on, the others are zeros rather than an exponent."""
    return f"{float(f'{value:.3g}'):g}"


def _component(name: str, kind: Kind, detail: str, placement: Placement, *, is_driven: bool) -> Iterator[str]:
    x, y = placement.centre
    yield "<g>"
    yield f"<title>{_escaped(name)}</title>"
    yield from _icon(kind, (x, -y), has_glyph=kind != "link" or bool(detail))
    yield _text((x, -y + _ICONS[kind].detail + 1.3), detail, "middle", _FONT, 17)
    if kind == "link":
        yield _text((placement.x1, -placement.y1 + 4), name, "", _FONT, 40)
    elif is_driven:  # above the connectors, since the next joint's stand right of them
        yield from _over_lines((placement.x1, -placement.y2 - 16.5), name, 42)
    elif kind in ("rotational", "translational"):
        yield from _over_lines((x + 1.5, -placement.y2 - 2.4), name, 34)
    else:
        yield from _over_lines((placement.x1, -placement.y2 - 2.4), name, 42)
    yield "</g>"


def _icon(kind: Kind, centre: tuple[float, float], *, zoom: str = "", has_glyph: bool = True) -> Iterator[str]:
    icon = _ICONS[kind]
    yield f'<g transform="translate({centre[0]:.9g} {centre[1]:.9g}){zoom}" stroke="{icon.stroke}">'
    yield f'<rect x="-10" y="-10" width="20" height="20" rx="{icon.rounding}" fill="{icon.fill}" stroke-width="0.6"/>'
    if has_glyph:
        yield f'<path class="glyph" d="{icon.glyph}"/>'
    yield "</g>"


def _frame(name: str, placement: Placement) -> Iterator[str]:
    x, y = placement.centre
    half = (placement.y2 - placement.y1) // 2
    yield _rectangle((x, y), (half // 3, half), 'fill="#ffffff" stroke="#5f5f5f"')
    yield _rectangle((x, y), (1.5, 1.5), 'fill="#5f5f5f"')
    if name == "frame_a":
        yield _text((x, -placement.y1 + 4.5), name, "port middle", _FONT, 40)
    else:
        yield from _over_lines((placement.x2 - 2, -placement.y1 + 4.5), name, 58, "port end")


def _flange(placement: Placement, motion: Motion, *, is_filled: bool) -> str:
    """Draw a connector of a joint. It has no name in the picture: the joint's stands above it."""
    half = (placement.y2 - placement.y1) // 3
    colour, rounding = ("#000000", half) if motion == "rotational" else ("#007f00", 0)
    fill = colour if is_filled else "#ffffff"
    return _rectangle(placement.centre, (half, half), f'rx="{rounding}" fill="{fill}" stroke="{colour}"')


def _rectangle(centre: Point, half: tuple[float, float], style: str) -> str:
    (x, y), (across, up) = centre, half
    return f'<rect x="{x - across:.9g}" y="{-y - up:.9g}" width="{2 * across:.9g}" height="{2 * up:.9g}" {style}/>'


def _lines(diagram: Diagram) -> Iterator[str]:
    """Draw all lines of one style as one path, so that a shared trunk is painted once."""
    styles: dict[str, list[str]] = {style: [] for style in _LINE_STYLES}
    for (start, _), (kind, points) in diagram.lines.items():
        style = kind + (" support" if start.endswith(".support") else "")
        styles[style].append(_curved(points, 0 if kind == "frame" else _BEND))
    for style, paths in styles.items():
        if paths:
            yield f'<path class="line {style}" d="{" ".join(paths)}"/>'


def _curved(points: Path, radius: float) -> str:
    """Return path data of a polyline. Each bend is rounded, at most up to the middle of its shorter side."""
    data = [f"M{points[0][0]} {-points[0][1]}"]
    for before, (x, y), after in zip(points, points[1:], points[2:], strict=False):
        # One of the two terms of each length is zero, since segments are axis-parallel.
        sides = [(a - x, b - y, abs(a - x) + abs(b - y)) for a, b in (before, after)]
        reach = min(radius, *(length / 2 for *_, length in sides))
        (x1, y1), (x2, y2) = ((x + reach * (dx // length), y + reach * (dy // length)) for dx, dy, length in sides)
        data.append(f"L{x1:.9g} {-y1:.9g}" + (f"Q{x} {-y} {x2:.9g} {-y2:.9g}" if reach else ""))
    data.append(f"L{points[-1][0]} {-points[-1][1]}")
    return "".join(data)


def _junctions(diagram: Diagram) -> list[tuple[LineKind, Point]]:
    """Return the points where three or more segments of a net meet. The lines of a net share their kind and one end."""
    uses = Counter(end for ends in diagram.lines for end in ends)
    nets = defaultdict[tuple[LineKind, str], list[Path]](list)
    for ends, (kind, points) in diagram.lines.items():
        nets[kind, max(ends, key=uses.__getitem__)].append(points)
    found = set[tuple[LineKind, Point]]()
    for (kind, _), paths in nets.items():
        segments = [sorted(pair) for path in paths for pair in itertools.pairwise(path)]
        across = _united((y1, x1, x2) for (x1, y1), (x2, y2) in segments if y1 == y2)
        upright = _united((x1, y1, y2) for (x1, y1), (x2, y2) in segments if x1 == x2)
        for x, y in {point for path in paths for point in path}:
            # Coordinates are even: one step beside a point lies inside a segment or outside of all.
            ways = [_has_inside(across, y, x + step) + _has_inside(upright, x, y + step) for step in (-1, 1)]
            if sum(ways) > 2:
                found.add((kind, (x, y)))
    return sorted(found)


def _united(segments: Iterable[_Segment]) -> list[_Segment]:
    """Join segments of one line that touch or overlap; the result is sorted."""
    united: list[_Segment] = []
    for line, start, end in sorted(segments):
        if united and united[-1][0] == line and start <= united[-1][2]:
            united[-1] = line, united[-1][1], max(end, united[-1][2])
        else:
            united.append((line, start, end))
    return united


def _has_inside(segments: list[_Segment], line: int, value: int) -> bool:
    index = bisect.bisect_left(segments, (line, value)) - 1
    return index >= 0 and segments[index][0] == line and value < segments[index][2]


def _legend(kinds: Iterable[Kind], start: Point, right: float) -> tuple[list[str], int]:
    """Return the legend, in as many rows as it takes, and where it ends below."""
    body: list[str] = []
    x, y = float(start[0]), start[1]
    for kind in kinds:
        text = _ICONS[kind].legend
        room = 15 + _width(text, _FONT)
        if x > start[0] and x + room > right:
            x, y = float(start[0]), y + _LEGEND
        body += _icon(kind, (x + 4, y), zoom=" scale(0.35)")
        body.append(_text((x + 9, y + 1.3), text, "legend", _FONT, room))
        x += room
    return body, y + _LEGEND


def _text(at: tuple[float, float], text: str, style: str, size: float, room: float) -> str:
    """Draw a text. One that is longer than `room` gets smaller letters, and then loses its middle."""
    if not text:
        return ""
    fitting = max(min(size, size * room / _width(text, size)), min(size, _SMALLEST))
    most = max(3, int(room / _width("x", fitting) + 1e-9))
    if len(text) > most:
        text = f"{text[: most // 2]}…{text[len(text) - (most - 1) // 2 :]}"
    style = f' class="{style}"' if style else ""
    return f'<text{style} x="{at[0]:.9g}" y="{at[1]:.9g}" font-size="{fitting:.3g}">{_escaped(text)}</text>'


def _over_lines(at: tuple[float, float], text: str, room: float, style: str = "") -> Iterator[str]:
    """Draw a name over lines, with a white border, so that the lines stop short of its letters."""
    yield _text(at, text, f"{style} halo".strip(), _FONT, room)
    yield _text(at, text, style, _FONT, room)


def _width(text: str, size: float) -> float:
    return size * _ADVANCE * len(text)


def _escaped(text: str) -> str:
    """Escape a text for XML; characters that can't be printed become spaces, since XML forbids some of them."""
    return html.escape("".join(char if char.isprintable() else " " for char in text))
