"""Diagrams as generated texts describe them: placed components, connectors on their icons, drawn connections."""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Callable, Mapping, Sequence

from support.corpus import REPOSITORY
from support.packages import Package

Point = tuple[float, float]
Box = tuple[float, float, float, float]
"""Left, bottom, right, top."""

STANDARD: Box = (-100, -100, 100, 100)
"""Coordinate system of an icon, and of a diagram that says nothing."""

_TWO_FRAMES = {"frame_a": (-100.0, 0.0), "frame_b": (100.0, 0.0)}
_SOURCE = {"flange": (100.0, 0.0), "support": (0.0, -100.0)}
STANDARD_LIBRARY: Mapping[str, Mapping[str, Point]] = {
    "Mechanics.MultiBody.Interfaces.PartialOneFrame_a": {"frame_a": (-100, 0)},
    "Mechanics.MultiBody.Interfaces.PartialTwoFrames": _TWO_FRAMES,
    "Mechanics.MultiBody.Joints.FreeMotion": _TWO_FRAMES,
    "Mechanics.MultiBody.Joints.Prismatic": _TWO_FRAMES | {"axis": (80, 60), "support": (-40, 60)},
    "Mechanics.MultiBody.Joints.Revolute": _TWO_FRAMES | {"axis": (0, 100), "support": (-60, 100)},
    "Mechanics.MultiBody.Parts.Body": {"frame_a": (-100, 0)},
    "Mechanics.MultiBody.Parts.FixedRotation": _TWO_FRAMES,
    "Mechanics.MultiBody.World": {"frame_b": (100, 0)},
    "Mechanics.Rotational.Interfaces.PartialTwoFlanges": {"flange_a": (-100, 0), "flange_b": (100, 0)},
    "Mechanics.Rotational.Sources.Accelerate": _SOURCE | {"a_ref": (-120, 0)},
    "Mechanics.Rotational.Sources.Position": _SOURCE | {"phi_ref": (-120, 0)},
    "Mechanics.Translational.Interfaces.PartialTwoFlanges": {"flange_a": (-100, 0), "flange_b": (100, 0)},
    "Mechanics.Translational.Sources.Accelerate": _SOURCE | {"a_ref": (-120, 0)},
    "Mechanics.Translational.Sources.Position": _SOURCE | {"s_ref": (-120, 0)},
    "Blocks.Interfaces.MO": {"y": (110, 0)},
    "Blocks.Sources.Cosine": {"y": (110, 0)},
}
"""Where classes of the standard library have their connectors, on their icons."""


_NUMBER = r"-?\d+(?:\.\d+)?"
_PREFIXES = "equation|protected|public|parameter|final|constant|inner|outer|replaceable|redeclare|input|output"
_EXTENDS = re.compile(r"\s*extends\s+([\w.]+)")
_DECLARATION = re.compile(rf"\s*(?:(?:{_PREFIXES})\s+)*([\w.]+)\s+(\w+)")
_CONNECT = re.compile(r"\s*(?:equation\s+)?connect\((.*?)\)\s*annotation.*?points\s*=\s*(\{\{.*?\}\})", re.DOTALL)
_SUBSCRIPTS = re.compile(r"\[[^\[\]]*\]")


@dataclasses.dataclass(frozen=True)
class Component:
    """A component with a place; `icon` is where it stands on the icon of its class, if it is a connector."""

    name: str
    type: str
    box: Box
    icon: Box

    @property
    def is_connector(self) -> bool:
        """Whether it stands on the border of its class."""
        return ".Interfaces." in self.type


@dataclasses.dataclass(frozen=True)
class Line:
    """A connection as it is drawn."""

    start: str
    end: str
    points: tuple[Point, ...]


@dataclasses.dataclass(frozen=True)
class Diagram:
    """What a class shows, with all that it inherits."""

    extent: Box
    icon: Box
    """Coordinate system of the icon: an instance in another diagram is this, scaled to its place."""
    components: tuple[Component, ...]
    lines: tuple[Line, ...]
    ports: Mapping[str, Point]
    """Connectors on the icon of this class."""


Find = Callable[[str], Diagram]


def of_package(package: Package) -> Mapping[str, Diagram]:
    """The diagram of every model of a package, by path."""

    @functools.cache
    def find(name: str) -> Diagram:
        path = f"{name.replace('.', '/')}.mo"
        return read(package.texts[path], find) if path in package.texts else library_diagram(name)

    return {path: read(text, find) for path, text in package.models.items() if "\nmodel " in text}


@functools.cache
def library_diagram(name: str) -> Diagram:
    """The diagram of a class of UrdfSync; of a class of the standard library its connectors only."""
    if name.startswith("Modelica."):
        return Diagram(STANDARD, STANDARD, (), (), STANDARD_LIBRARY.get(name.removeprefix("Modelica."), {}))
    path = REPOSITORY / "modelica" / f"{name.replace('.', '/')}.mo"
    return read(path.read_text("utf-8"), library_diagram)


def read(text: str, find: Find) -> Diagram:
    """The diagram of the class in `text`; `find` gives those of the classes that it refers to."""
    extent = icon = STANDARD
    components: list[Component] = []
    lines: list[Line] = []
    ports: dict[str, Point] = {}
    for statement in _code(text).split(";"):
        if found := _EXTENDS.match(statement):
            base = find(found[1])
            extent, icon = base.extent, base.icon
            ports |= base.ports
            components += base.components
            lines += base.lines
        elif found := _CONNECT.match(statement):
            ends = found[1]
            while "[" in ends:  # the innermost first; all connectors of a vector stand in one place
                ends = _SUBSCRIPTS.sub("", ends)
            start, end = map(str.strip, ends.split(","))
            lines.append(Line(start, end, tuple(_points(found[2]))))
        elif re.match(r"\s*annotation\b", statement):
            extent = _extent(statement, r"Diagram\(\s*coordinateSystem") or extent
            icon = _extent(statement, r"Icon\(\s*coordinateSystem") or icon
        elif (box := _extent(statement, "transformation")) and (found := _DECLARATION.match(statement)):
            components.append(Component(found[2], found[1], box, _extent(statement, "iconTransformation") or box))
    ports |= {c.name: _center(c.icon) for c in components if c.is_connector}
    return Diagram(extent, icon, tuple(components), tuple(lines), ports)


def port(diagram: Diagram, reference: str, find: Find) -> Point:
    """Where a connection to `reference` has to end: a connector of the class, or one of a component."""
    name, _, connector = reference.partition(".")
    component = next((c for c in diagram.components if c.name == name), None)
    if component is None:
        return diagram.ports[reference]  # inherited from a class of the standard library: there icon and diagram agree
    if not connector:
        return _center(component.box)
    drawn = find(component.type)
    x, y = drawn.ports[connector]
    left, bottom, right, top = component.box
    x1, y1, x2, y2 = drawn.icon
    return left + (x - x1) / (x2 - x1) * (right - left), bottom + (y - y1) / (y2 - y1) * (top - bottom)


def overlaps(components: Sequence[Component]) -> list[tuple[str, str]]:
    """Pairs of components that share more than a border."""
    found = []
    by_left = sorted(components, key=lambda component: component.box[0])
    for number, one in enumerate(by_left):
        for other in by_left[number + 1 :]:
            if other.box[0] >= one.box[2]:
                break
            if one.box[1] < other.box[3] and other.box[1] < one.box[3]:
                found.append((one.name, other.name))
    return found


def is_inside(point: Point, box: Box) -> bool:
    """Whether a point is in a box or on its border."""
    return box[0] <= point[0] <= box[2] and box[1] <= point[1] <= box[3]


def corners(component: Component) -> tuple[Point, ...]:
    """What of a component has to be inside: its corners, of a connector its centre, since it stands on the border."""
    left, bottom, right, top = component.box
    return (_center(component.box),) if component.is_connector else ((left, bottom), (right, top))


def _code(text: str) -> str:
    """The class in a text from its first element on, without comments, and with nothing in its strings."""
    code = re.sub(r"//[^\n]*", "", re.sub(r'"(?:[^"\\]|\\.)*"', '""', text, flags=re.DOTALL))
    return re.split(r'\b(?:model|block|package|record) \w+\s*(?:"")?', code, maxsplit=1)[1]


def _extent(statement: str, owner: str) -> Box | None:
    """The first extent after the owner's name, if the statement has that name."""
    found = re.search(rf"\b{owner}\b.*?extent\s*=\s*\{{(\{{.*?\}},\s*\{{.*?\}})\}}", statement, re.DOTALL)
    if not found:
        return None
    (x1, y1), (x2, y2) = _points(found[1])
    return min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2)


def _points(text: str) -> list[Point]:
    return [(float(x), float(y)) for x, y in re.findall(rf"\{{({_NUMBER}),\s*({_NUMBER})\}}", text)]


def _center(box: Box) -> Point:
    return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
