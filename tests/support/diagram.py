"""Diagrams as generated texts describe them: placed components, connectors on their icons, drawn connections."""

from __future__ import annotations

import dataclasses
import functools
import math
import re
from collections.abc import Callable, Mapping, Sequence

from support.annotations import Call, statements
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
    graphics: tuple[Call, ...] = ()
    """The icon itself."""


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
    graphics: list[Call] = []
    for statement, note in statements(text):
        first = statement[0] if statement else ""
        if first == "extends":
            base = find(_name(statement[1:]))
            extent, icon = base.extent, base.icon
            ports |= base.ports
            components += base.components
            lines += base.lines
            graphics += base.graphics
        elif first == "connect":
            ends = "".join(statement[2:-1])
            while "[" in ends:  # all connectors of a vector stand in one place
                ends = re.sub(r"\[[^\[\]]*\]", "", ends)
            start, end = ends.split(",")
            lines.append(Line(start, end, tuple((x, y) for x, y in note.get("Line").get("points"))))
        elif not statement:
            drawn, shown = note.get("Diagram", Call()), note.get("Icon", Call())
            extent, icon = _box(drawn.get("coordinateSystem")) or extent, _box(shown.get("coordinateSystem")) or icon
            graphics += shown.get("graphics", [])
        elif place := note.get("Placement"):
            box, kind = _box(place.get("transformation")) or STANDARD, _name(statement)
            name = statement[2 * kind.count(".") + 1]
            components.append(Component(name, kind, box, _box(place.get("iconTransformation")) or box))
    ports |= {c.name: _center(c.icon) for c in components if c.is_connector}
    return Diagram(extent, icon, tuple(components), tuple(lines), ports, tuple(graphics))


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


def outline(graphic: Call) -> list[Point]:
    """The points that bound a graphic, turned and moved as `rotation` and `origin` say (coordinates of the icon)."""
    points: list[Point] = [(x, y) for x, y in graphic.get("points") or graphic.get("extent")]
    if graphic.get("extent"):
        (x1, y1), (x2, y2) = points
        points = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
    angle = math.radians(graphic.get("rotation", 0.0))
    x0, y0 = graphic.get("origin", [0.0, 0.0])
    c, s = math.cos(angle), math.sin(angle)
    return [(x0 + c * x - s * y, y0 + s * x + c * y) for x, y in points]


def _name(statement: Sequence[str]) -> str:
    """The name with all its dots that begins here."""
    end = 1
    while statement[end : end + 1] == ["."]:
        end += 2
    return "".join(statement[:end])


def _box(owner: Call | None) -> Box | None:
    """The extent of a coordinate system or of a transformation, if there is one."""
    if owner is None:
        return None
    (x1, y1), (x2, y2) = owner.get("extent")
    return min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2)


def _center(box: Box) -> Point:
    return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
