"""Draw the robot model's diagram as SVG: the text refers to no other file, and a robot always gives the same one."""

from __future__ import annotations

import bisect
import html
import itertools
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Literal, NamedTuple, TypeAlias

from urdfsync.domain import Target
from urdfsync.urdf.diagram.layout import Diagram, JointKind, LineKind, layout
from urdfsync.urdf.diagram.routing import Path, Placement, Point
from urdfsync.urdf.kinematics.tree import MOTION_KINDS, KinematicTree
from urdfsync.urdf.model.robot import connector_names, couplings, tree
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Robot

Kind: TypeAlias = Literal["link", "coupling"] | JointKind

# Size of one unit of the diagram. It grows with the robot, so that the smallest text is 10 pixels high at 100 %:
# a viewer scrolls over a wide robot.
_PIXELS = 4
_MARGIN = 10
_HEADER = 24  # room for the title and the names of the connectors at the top
_FOOTER, _LEGEND = 8, 10  # room for the legend: in any case, and per row
_FONT, _SMALLEST = 3.6, 2.5
_ADVANCE = 0.56  # mean width of a character, by font size
_BEND = 2.0  # radius of the bends of flange lines: joining a bus looks unlike crossing it


class Label(NamedTuple):
    """Kind and name of a component, and the text inside its icon: mass or ratio."""

    kind: Kind
    name: str
    detail: str = ""


class _Look(NamedTuple):
    fill: str
    stroke: str
    rounding: int
    glyph: str
    detail: float
    """Distance of the text inside the icon from the icon's middle, downwards."""
    legend: str


_LOOKS: Mapping[Kind, _Look] = {
    "link": _Look(
        "#e4e7eb", "#7d848f", 3, "M-3 -3.2a3 3 0 1 0 6 0a3 3 0 1 0 -6 0M-3 -3.2H3M0 -6.2V-0.2", 5.2, "link, mass"
    ),
    "fixed": _Look("#f8f9fa", "#9aa0a9", 3, "M-7 0H7M-2.2 -2.2L2.2 2.2M-2.2 2.2L2.2 -2.2", 7, "fixed joint"),
    "rotational": _Look(
        "#fdebc8",
        "#a86800",
        5,
        "M-5.4 3.6A6.5 6.5 0 1 1 5.4 3.6M7.9 2.5L5.4 3.6L5.3 0.9",
        0.3,
        "rotational joint",
    ),
    "translational": _Look(
        "#dbf0dd",
        "#1f7a33",
        2,
        "M-7 5.5H7M-5 3.7L-7 5.5L-5 7.3M5 3.7L7 5.5L5 7.3",
        -1.6,
        "translational joint",
    ),
    "free": _Look(
        "#ebe4f7",
        "#6b46b8",
        5,
        "M-1 1V-7M-2.8 -5L-1 -7L0.8 -5M-1 1H7M5 -0.8L7 1L5 2.8M-1 1L-6 6M-6 3.4V6H-3.4",
        7,
        "planar or floating joint",
    ),
    "coupling": _Look(
        "#dceafa",
        "#2766a3",
        2,
        "M-6.6 -3a3.3 3.3 0 1 0 6.6 0a3.3 3.3 0 1 0 -6.6 0M0 -3a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0 -4.8 0",
        5.2,
        "mimic coupling, ratio",
    ),
}

_LINE_LOOKS = ("frame", "translational support", "rotational support", "translational", "rotational")

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
    skeleton = KinematicTree.of(robot, taken=(target.name,))
    names = connector_names(skeleton, options)
    labels = {}
    for link in skeleton.links:
        component = skeleton.link(link.name).component
        labels[component] = Label("link", component, f"{_rounded(link.inertial.mass)} kg" if link.inertial else "")
    ratios: dict[str, str] = {}
    for joint in skeleton.joints:
        component = skeleton.joint(joint.name).component
        kind = MOTION_KINDS.get(joint.type) or ("fixed" if joint.type == "fixed" else "free")
        labels[component] = Label(kind, component)
        if joint.mimic:
            ratios[component] = f"× {_rounded(joint.mimic.multiplier)}"
    for coupling in couplings(skeleton, names):
        ratio = ratios[coupling.follower] if coupling.leader else "held"
        labels[coupling.component] = Label("coupling", coupling.component, ratio)
    return svg(layout(tree(skeleton, names)), labels, target.package)


def _rounded(value: float) -> str:
    """Three digits; from a thousand on, the others are zeros rather than an exponent."""
    return f"{float(f'{value:.3g}'):g}"


def svg(diagram: Diagram, labels: Mapping[str, Label], title: str = "") -> str:
    """Draw a layout; `labels` has an entry for each placed component except the model's own connectors.

    Raises KeyError for a component without label.
    """
    x1, y1, x2, y2 = diagram.extent
    kinds = {label.kind for name, label in labels.items() if name in diagram.placements}
    legend = _legend_rows([kind for kind in _LOOKS if kind in kinds], x2 - x1 + _MARGIN)
    left, top = x1 - _MARGIN, -y2 - _HEADER
    width, height = x2 - x1 + 2 * _MARGIN, y2 - y1 + _HEADER + _FOOTER + _LEGEND * len(legend)
    own = {end: diagram.kinds[ends] for ends in diagram.lines for end in ends if "." not in end}
    flanges = {name: kind for name, kind in own.items() if kind != "frame"}
    frames = own.keys() - flanges.keys()
    driven = {start: end for start, end in diagram.lines if start.endswith(".support")}
    supports = set(driven.values())
    body = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width * _PIXELS}" height="{height * _PIXELS}" '
        f'viewBox="{left} {top} {width} {height}">',
        f"<title>{_escaped(title)}</title>",
        f"<style>\n{_STYLE}\n</style>",
        f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="#f4f5f7"/>',
        f'<rect x="{x1}" y="{-y2}" width="{x2 - x1}" height="{y2 - y1}" fill="#ffffff" stroke="#d5d8dd" '
        'stroke-width="0.5"/>',
        _text((x1, -y2 - 13), title, "title", 7, x2 - x1),
        *_lines(diagram),
        *(f'<circle class="dot-{kind}" cx="{x}" cy="{-y}" r="1.2"/>' for kind, (x, y) in _junctions(diagram)),
    ]
    for name, placement in diagram.placements.items():
        if name in flanges:
            body += _flange(placement, flanges[name], is_support=name in supports)
        elif name in frames:
            body += _frame(name, placement, is_root=name == "frame_a")
        else:
            body += _component(labels[name], placement, driven=f"{name}.support" in driven)
    body += _legend(legend, (x1, -y1 + _FOOTER))
    return "\n".join([*filter(None, body), "</svg>", ""])


def _component(label: Label, placement: Placement, *, driven: bool) -> Iterator[str]:
    x, y = placement.centre
    yield "<g>"
    yield f"<title>{_escaped(label.name)}</title>"
    yield from _icon(label.kind, (x, -y), 1.0, glyph=label.kind != "link" or bool(label.detail))
    yield _text((x, -y + _LOOKS[label.kind].detail + 1.3), label.detail, "middle", _FONT, 17)
    if label.kind == "link":
        yield _text((placement.x1, -placement.y1 + 4), label.name, "", _FONT, 40)
    elif driven:  # above the connectors, since the next joint's stand right of them
        yield from _haloed((placement.x1, -placement.y2 - 16.5), label.name, 42)
    elif label.kind in ("rotational", "translational"):
        yield from _haloed((x + 1.5, -placement.y2 - 2.4), label.name, 34)
    else:
        yield from _haloed((placement.x1, -placement.y2 - 2.4), label.name, 42)
    yield "</g>"


def _haloed(at: tuple[float, float], text: str, room: float, style: str = "") -> Iterator[str]:
    """Draw a name over lines, with a white border, so that the lines stop short of its letters."""
    yield _text(at, text, f"{style} halo".strip(), _FONT, room)
    yield _text(at, text, style, _FONT, room)


def _icon(kind: Kind, centre: tuple[float, float], scale: float, glyph: bool = True) -> Iterator[str]:
    look = _LOOKS[kind]
    zoom = "" if scale == 1 else f" scale({scale:.9g})"
    yield f'<g transform="translate({centre[0]:.9g} {centre[1]:.9g}){zoom}" stroke="{look.stroke}">'
    yield f'<rect x="-10" y="-10" width="20" height="20" rx="{look.rounding}" fill="{look.fill}" stroke-width="0.6"/>'
    if glyph:
        yield f'<path class="glyph" d="{look.glyph}"/>'
    yield "</g>"


def _frame(name: str, placement: Placement, *, is_root: bool) -> Iterator[str]:
    x, y = placement.centre
    half = (placement.y2 - placement.y1) // 2
    yield _rectangle((x, y), (half // 3, half), 'fill="#ffffff" stroke="#5f5f5f"')
    yield f'<rect x="{x - 1.5}" y="{-y - 1.5}" width="3" height="3" fill="#5f5f5f"/>'
    if is_root:
        yield _text((x, -placement.y1 + 4.5), name, "port middle", _FONT, 40)
    else:
        yield from _haloed((placement.x2 - 2, -placement.y1 + 4.5), name, 58, "port end")


def _flange(placement: Placement, motion: LineKind, *, is_support: bool) -> Iterator[str]:
    """Draw a connector of a joint. It has no name in the picture: the joint's stands above it."""
    half = (placement.y2 - placement.y1) // 3
    colour = "#000000" if motion == "rotational" else "#007f00"
    fill = "#ffffff" if is_support else colour
    rounding = half if motion == "rotational" else 0
    yield _rectangle(placement.centre, (half, half), f'rx="{rounding}" fill="{fill}" stroke="{colour}"')


def _rectangle(centre: Point, half: Point, style: str) -> str:
    (x, y), (across, up) = centre, half
    return f'<rect x="{x - across}" y="{-y - up}" width="{2 * across}" height="{2 * up}" {style}/>'


def _lines(diagram: Diagram) -> Iterator[str]:
    """Draw all lines of one look as one path, so that a shared trunk is painted once."""
    looks: dict[str, list[str]] = {look: [] for look in _LINE_LOOKS}
    for ends, points in diagram.lines.items():
        look = diagram.kinds[ends] + (" support" if ends[0].endswith(".support") else "")
        looks[look].append(_curved(points, 0 if look == "frame" else _BEND))
    for look, paths in looks.items():
        if paths:
            yield f'<path class="line {look}" d="{" ".join(paths)}"/>'


def _curved(points: Path, radius: float) -> str:
    """Return path data of a polyline. Each bend is rounded, at most up to the middle of its shorter side."""
    if not points:
        return ""
    data = [f"M{points[0][0]} {-points[0][1]}"]
    for before, bend, after in zip(points, points[1:], points[2:], strict=False):
        reach = min(radius, _distance(before, bend) / 2, _distance(bend, after) / 2)
        (x1, y1), (x2, y2) = _towards(bend, before, reach), _towards(bend, after, reach)
        data.append(f"L{x1:.9g} {-y1:.9g}" + (f"Q{bend[0]} {-bend[1]} {x2:.9g} {-y2:.9g}" if reach else ""))
    data.append(f"L{points[-1][0]} {-points[-1][1]}")
    return "".join(data)


def _distance(a: Point, b: Point) -> int:
    return abs(a[0] - b[0]) + abs(a[1] - b[1])


def _sign(value: int) -> int:
    return (value > 0) - (value < 0)


def _towards(a: Point, b: Point, distance: float) -> tuple[float, float]:
    return a[0] + distance * _sign(b[0] - a[0]), a[1] + distance * _sign(b[1] - a[1])


def _junctions(diagram: Diagram) -> list[tuple[LineKind, Point]]:
    """Return the points where three or more segments of a net meet. The lines of a net share their kind and one end."""
    uses = Counter(end for ends in diagram.lines for end in ends)
    nets: defaultdict[tuple[LineKind, str], list[Path]] = defaultdict(list)
    for ends, points in diagram.lines.items():
        nets[diagram.kinds[ends], max(ends, key=uses.__getitem__)].append(points)
    return sorted({(kind, point) for (kind, _), net in nets.items() for point in _branchings(net)})


def _branchings(net: Iterable[Path]) -> Iterator[Point]:
    points: set[Point] = set()
    across: defaultdict[int, list[tuple[int, int]]] = defaultdict(list)
    upright: defaultdict[int, list[tuple[int, int]]] = defaultdict(list)
    for path in net:
        points.update(path)
        for (x1, y1), (x2, y2) in itertools.pairwise(path):
            if y1 == y2:
                across[y1].append((min(x1, x2), max(x1, x2)))
            else:
                upright[x1].append((min(y1, y2), max(y1, y2)))
    runs = {y: _united(intervals) for y, intervals in across.items()}
    falls = {x: _united(intervals) for x, intervals in upright.items()}
    for x, y in points:  # coordinates are even: one step beside a point lies inside a segment or outside of all
        run, fall = runs.get(y, []), falls.get(x, [])
        if _inside(x - 1, run) + _inside(x + 1, run) + _inside(y - 1, fall) + _inside(y + 1, fall) > 2:
            yield x, y


def _united(intervals: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """Join intervals that touch or overlap; the result is sorted."""
    united: list[tuple[int, int]] = []
    for start, end in sorted(intervals):
        if united and start <= united[-1][1]:
            united[-1] = united[-1][0], max(end, united[-1][1])
        else:
            united.append((start, end))
    return united


def _inside(value: int, intervals: list[tuple[int, int]]) -> bool:
    index = bisect.bisect_left(intervals, (value, value)) - 1
    return index >= 0 and value < intervals[index][1]


def _legend_rows(kinds: Iterable[Kind], width: float) -> list[list[Kind]]:
    """Arrange the legend's kinds in rows, each as long as `width` allows."""
    rows: list[list[Kind]] = []
    used = width
    for kind in kinds:
        used += _legend_width(kind)
        if used > width:
            rows.append([])
            used = _legend_width(kind)
        rows[-1].append(kind)
    return rows


def _legend_width(kind: Kind) -> float:
    return 15 + _width(_LOOKS[kind].legend, _FONT)


def _legend(rows: list[list[Kind]], start: Point) -> Iterator[str]:
    for index, row in enumerate(rows):
        x, y = float(start[0]), start[1] + _LEGEND * index
        for kind in row:
            yield from _icon(kind, (x + 4, y), 0.35)
            yield _text((x + 9, y + 1.3), _LOOKS[kind].legend, "legend", _FONT, _legend_width(kind))
            x += _legend_width(kind)


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


def _width(text: str, size: float) -> float:
    return size * _ADVANCE * len(text)


def _escaped(text: str) -> str:
    """Escape a text for XML; characters that can't be printed become spaces, since XML forbids some of them."""
    return html.escape("".join(char if char.isprintable() else " " for char in text))
