"""Draws the icons of the library's classes as SVG, so that they can be looked at without a Modelica tool.

`python tests/modelica/icons.py SHEET.svg [CLASS …]` draws one sheet; without names, of all icons there are.
Icons are inherited from classes of the library; those of the standard library are not looked up. Connectors
are drawn as plain marks where the class places them.
"""

from __future__ import annotations

import dataclasses
import functools
import html
import itertools
import math
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

LIBRARY = Path(__file__).parents[2] / "modelica" / "UrdfSync"

Point = tuple[float, float]

_TOKEN = re.compile(
    r"""\s+ | //[^\n]* | /\*.*?\*/
    | (?P<string>"(?:\\.|[^"\\])*")
    | (?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<name>(?:[A-Za-z_]\w*|'[^']*')(?:\.[A-Za-z_]\w*)*)
    | (?P<mark>.)""",
    re.VERBOSE | re.DOTALL,
)
_CLOSING = {")", "}", "]", ",", ";"}


@dataclasses.dataclass(frozen=True)
class Token:
    """A word of Modelica: its kind (string, number, name or mark) and its text."""

    kind: str
    text: str


@dataclasses.dataclass(frozen=True)
class Call:
    """What annotations are made of: `name(key=value, …)`; arguments without a key are not kept."""

    name: str
    arguments: Mapping[str, Any]

    def get(self, key: str, default: Any = None) -> Any:
        """The argument `key`, or `default` where it is not given."""
        return self.arguments.get(key, default)


@functools.cache
def tokens(text: str) -> tuple[Token, ...]:
    """The words of a Modelica text, without white space and comments."""
    return tuple(Token(match.lastgroup, match.group()) for match in _TOKEN.finditer(text) if match.lastgroup)


class _Reader:
    """Reads values of annotations: numbers, strings, names, arrays, calls; other expressions as their text."""

    def __init__(self, words: Sequence[Token], start: int = 0) -> None:
        self._words = words
        self._next = start

    def value(self) -> Any:
        """The value that begins here."""
        start = self._next
        result = self._primary()
        if self._peek() in _CLOSING:
            return result
        depth = 0
        while depth or self._peek() not in _CLOSING:
            depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(self._take().text, 0)
        return " ".join(word.text for word in self._words[start : self._next])

    def _primary(self) -> Any:
        word = self._take()
        if word.kind == "number":
            return float(word.text)
        if word.kind == "string":
            return word.text[1:-1].replace('\\"', '"').replace("\\\\", "\\")
        if word.text == "-" and self._words[self._next].kind == "number":
            return -float(self._take().text)
        if word.text == "{":
            return [value for _, value in self._items("}")]
        if word.kind == "name" and self._peek() == "(":
            self._take()
            return Call(word.text, {key: value for key, value in self._items(")") if key})
        return word.text

    def _items(self, end: str) -> Iterator[tuple[str, Any]]:
        while self._peek() != end:
            key = ""
            if self._words[self._next].kind == "name" and self._words[self._next + 1].text == "=":
                key = self._take().text
                self._take()
            result = self.value()
            yield (key or (result.name if isinstance(result, Call) and end == ")" else "")), result
            if self._peek() == ",":
                self._take()
        self._take()

    def _peek(self) -> str:
        return self._words[self._next].text

    def _take(self) -> Token:
        self._next += 1
        return self._words[self._next - 1]


def annotations_in(text: str) -> list[Call]:
    """Every `annotation (…)` of a Modelica text, in the order of the text."""
    words = tokens(text)
    return [_Reader(words, at).value() for at, word in enumerate(words) if word == Token("name", "annotation")]


@dataclasses.dataclass(frozen=True)
class Connector:
    """A connector as it is placed: its kind (the last part of its type's name) and its corners."""

    kind: str
    corners: tuple[Point, Point]

    @property
    def middle(self) -> Point:
        """The point at which connection lines end."""
        (x1, y1), (x2, y2) = self.corners
        return (x1 + x2) / 2, (y1 + y2) / 2


@dataclasses.dataclass(frozen=True)
class Icon:
    """The graphics of a class, those of its base classes first, and its placed connectors."""

    graphics: tuple[Call, ...] = ()
    connectors: tuple[Connector, ...] = ()
    extent: tuple[Point, Point] = ((-100, -100), (100, 100))
    """Lower left and upper right corner of its coordinate system."""


_CONNECTOR = re.compile(
    r"^ *(?:\w+ )?(?:Modelica|UrdfSync)\.[\w.]*Interfaces\.(\w+)\s"  # its type
    r"(?:[^;\"]|\"[^\"]*\")*?\s"  # its name and description
    r"(annotation \((?:.|\n)*?\);)",
    re.MULTILINE,
)
_EXTENDS = re.compile(r"^ *extends (UrdfSync\.[\w.]+)", re.MULTILINE)


def source(name: str, library: Path = LIBRARY) -> str:
    """Text of the class with the full name `name`, from its own file or the `package.mo` of its own folder."""
    path = library.parent.joinpath(*name.split("."))
    return (path / "package.mo" if path.is_dir() else path.with_suffix(".mo")).read_text("utf-8")


def bases(text: str) -> list[str]:
    """Full names of the classes of the library that a Modelica text extends."""
    return _EXTENDS.findall(text)


@functools.cache
def icon(name: str, library: Path = LIBRARY) -> Icon:
    """The icon of the class with the full name `name`."""
    text = source(name, library)
    inherited = [icon(base, library) for base in bases(text)]
    own = [
        graphic for note in annotations_in(text) for graphic in note.get("Icon", Call("Icon", {})).get("graphics", [])
    ]
    connectors = [_connector(kind, annotations_in(note)[0]) for kind, note in _CONNECTOR.findall(text)]
    notes = [note.get("Icon") for note in annotations_in(text) if note.get("Icon")]
    system = next((note.get("coordinateSystem") for note in notes), None)
    lower, upper = system.get("extent") if system else next((base.extent for base in inherited), Icon.extent)
    return Icon(
        (*(graphic for base in inherited for graphic in base.graphics), *own),
        (*(mark for base in inherited for mark in base.connectors), *filter(None, connectors)),
        ((lower[0], lower[1]), (upper[0], upper[1])),
    )


def _connector(kind: str, note: Call) -> Connector | None:
    placement = note.get("Placement")
    if placement is None:
        return None
    transformation = placement.get("iconTransformation") or placement.get("transformation")
    first, second = ((float(x), float(y)) for x, y in transformation.get("extent"))
    x, y = transformation.get("origin", [0.0, 0.0])
    return Connector(kind, ((first[0] + x, first[1] + y), (second[0] + x, second[1] + y)))


def corners(graphic: Call) -> list[Point]:
    """The points that bound a graphic, turned and moved as `rotation` and `origin` say (coordinates of the icon)."""
    points: list[Point] = [(x, y) for x, y in graphic.get("points") or graphic.get("extent")]
    if "extent" in graphic.arguments:
        (x1, y1), (x2, y2) = points
        points = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
    angle = math.radians(graphic.get("rotation", 0.0))
    x0, y0 = graphic.get("origin", [0.0, 0.0])
    c, s = math.cos(angle), math.sin(angle)
    return [(x0 + c * x - s * y, y0 + s * x + c * y) for x, y in points]


def _colour(rgb: Sequence[float] | None) -> str:
    return "#{:02x}{:02x}{:02x}".format(*(int(part) for part in rgb or (0, 0, 0)))


def _pen(graphic: Call, colour: str, width: str) -> str:
    if graphic.get("pattern") == "LinePattern.None":
        return 'stroke="none"'
    thickness = 4 * graphic.get(width, 0.25)
    dashes = {"LinePattern.Dash": "8 5", "LinePattern.Dot": "2 4", "LinePattern.DashDot": "8 4 2 4"}
    pattern = dashes.get(graphic.get("pattern", ""))
    dash = f' stroke-dasharray="{pattern}"' if pattern else ""
    return f'stroke="{_colour(graphic.get(colour))}" stroke-width="{thickness:g}" stroke-linejoin="round"{dash}'


def _brush(graphic: Call) -> str:
    solid = graphic.get("fillPattern", "FillPattern.None") != "FillPattern.None"
    return f'fill="{_colour(graphic.get("fillColor"))}"' if solid else 'fill="none"'


def _place(graphic: Call) -> str:
    x, y = graphic.get("origin", [0.0, 0.0])
    return f'transform="translate({x:g} {-y:g}) rotate({-graphic.get("rotation", 0.0):g})"'


def _box(graphic: Call) -> tuple[float, float, float, float]:
    """Left, top (SVG: y down), width and height of the extent."""
    (x1, y1), (x2, y2) = graphic.get("extent")
    return min(x1, x2), -max(y1, y2), abs(x2 - x1), abs(y2 - y1)


def _path(points: Sequence[Sequence[float]], smooth: bool) -> str:
    """Straight lines, or (Modelica's `Smooth.Bezier`) curves from middle to middle of the segments."""
    if not smooth or len(points) < 3:
        return "M" + " L".join(f"{x:g} {-y:g}" for x, y in points)
    path = f"M{points[0][0]:g} {-points[0][1]:g}"
    middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in itertools.pairwise(points)]
    path += f" L{middles[0][0]:g} {-middles[0][1]:g}"
    for (x, y), (mx, my) in zip(points[1:-1], middles[1:], strict=True):
        path += f" Q{x:g} {-y:g} {mx:g} {-my:g}"
    return f"{path} L{points[-1][0]:g} {-points[-1][1]:g}"


def _rectangle(graphic: Call, name: str) -> str:
    x, y, width, height = _box(graphic)
    return (
        f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="{graphic.get("radius", 0):g}" '
        f"{_brush(graphic)} {_pen(graphic, 'lineColor', 'lineThickness')} {_place(graphic)}/>"
    )


def _ellipse(graphic: Call, name: str) -> str:
    x, y, width, height = _box(graphic)
    start, end = (math.radians(graphic.get(key, full)) for key, full in (("startAngle", 0.0), ("endAngle", 360.0)))
    steps = max(2, round(abs(end - start) / math.radians(5)))
    angles = [start + (end - start) * step / steps for step in range(steps + 1)]
    points = [(x + width / 2 * (1 + math.cos(a)), -y - height / 2 * (1 - math.sin(a))) for a in angles]
    whole = math.isclose(abs(end - start), 2 * math.pi)
    closure = graphic.get("closure", "EllipseClosure.Chord" if whole else "EllipseClosure.Radial")
    if closure == "EllipseClosure.Radial" and not whole:
        points.append((x + width / 2, -y - height / 2))
    return _outline(graphic, points, closed=closure != "EllipseClosure.None", colour="lineColor", width="lineThickness")


def _polygon(graphic: Call, name: str) -> str:
    return _outline(graphic, graphic.get("points"), closed=True, colour="lineColor", width="lineThickness")


def _line(graphic: Call, name: str) -> str:
    return _outline(graphic, graphic.get("points"), closed=False, colour="color", width="thickness")


def _outline(graphic: Call, points: Sequence[Sequence[float]], *, closed: bool, colour: str, width: str) -> str:
    path = _path(points, graphic.get("smooth") == "Smooth.Bezier") + ("Z" if closed else "")
    brush = _brush(graphic) if closed else 'fill="none"'
    return f'<path d="{path}" {brush} {_pen(graphic, colour, width)} {_place(graphic)}/>'


def _text(graphic: Call, name: str) -> str:
    x, y, width, height = _box(graphic)
    text = graphic.get("textString", "").replace("%name", name)
    size = graphic.get("fontSize", 0.0) or min(0.8 * height, width / (0.58 * max(1, len(text))))
    anchor, left = {
        "TextAlignment.Left": ("start", x),
        "TextAlignment.Right": ("end", x + width),
    }.get(graphic.get("horizontalAlignment", ""), ("middle", x + width / 2))
    colour = _colour(graphic.get("textColor") or graphic.get("lineColor"))
    return (
        f'<text x="{left:g}" y="{y + height / 2 + 0.35 * size:g}" font-size="{size:g}" text-anchor="{anchor}" '
        f'font-family="DejaVu Sans, sans-serif" fill="{colour}" {_place(graphic)}>{html.escape(text)}</text>'
    )


_DRAWERS = {"Rectangle": _rectangle, "Ellipse": _ellipse, "Polygon": _polygon, "Line": _line, "Text": _text}


def _mark(connector: Connector) -> str:
    (x1, y1), (x2, y2) = connector.corners
    fill, stroke = "#ffffff", "#5f5f5f"
    if connector.kind.startswith("Flange"):
        fill = stroke = "#878787"
    elif connector.kind.startswith("Real"):
        fill = stroke = "#00007f"
    return (
        f'<rect x="{min(x1, x2):g}" y="{-max(y1, y2):g}" width="{abs(x2 - x1):g}" height="{abs(y2 - y1):g}" '
        f'fill="{fill}" stroke="{stroke}" stroke-width="2"/>'
    )


def draw(shown: Icon, name: str) -> str:
    """SVG elements of an icon, y down, in the icon's own units; `name` stands for `%name`."""
    visible = [graphic for graphic in shown.graphics if graphic.get("visible") != "false"]
    return "\n".join([*(_DRAWERS[g.name](g, name) for g in visible), *map(_mark, shown.connectors)])


def sheet(names: Sequence[str], library: Path = LIBRARY, columns: int = 5) -> str:
    """One SVG with the icons of the named classes, in rows; a thin frame shows the extent of each."""
    cell = 340
    columns = min(columns, len(names))
    rows = math.ceil(len(names) / columns)
    tallest = max(icon(name, library).extent[1][1] for name in names)
    above = max(0, tallest - 100)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{columns * cell}" height="{rows * (cell + above):g}">',
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]
    for number, name in enumerate(names):
        x, y = (number % columns + 0.5) * cell, (number // columns + 1) * (cell + above) - cell / 2
        frame = '<rect x="-100" y="-100" width="200" height="200" fill="none" stroke="#e8e8e8"/>'
        drawn = draw(icon(name, library), name.rpartition(".")[2])
        parts.append(f'<g transform="translate({x:g} {y:g})">\n{frame}\n{drawn}\n</g>')
    return "\n".join([*parts, "</svg>", ""])


def classes(library: Path = LIBRARY) -> list[str]:
    """Full names of all classes of the library that have a file of their own, packages included."""
    files = sorted(library.rglob("*.mo"))
    paths = [file.parent if file.name == "package.mo" else file.with_suffix("") for file in files]
    return [".".join(path.relative_to(library.parent).parts) for path in paths]


def main(arguments: Sequence[str]) -> None:
    """Write the sheet that the command line asks for."""
    target, *names = arguments
    shown = names or [name for name in classes() if icon(name).graphics]
    Path(target).write_text(sheet(shown), "utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
