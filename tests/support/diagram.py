"""Diagrams as generated texts describe them: placed components, connectors on their icons, drawn connections."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator, Mapping, Sequence

from support.corpus import REPOSITORY
from support.packages import Package
from support.words import Word, words

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
    for statement in _statements(words(text)):
        first = statement[0].text
        if first == "extends":
            base = find(_name(statement[1:]))
            extent, icon = base.extent, base.icon
            ports |= base.ports
            components += base.components
            lines += base.lines
        elif first == "connect":
            lines.append(_line(statement))
        elif first == "annotation":
            extent, icon = _system(statement, "Diagram") or extent, _system(statement, "Icon") or icon
        elif box := _extent(statement, "transformation"):
            components.append(_component(statement, box))
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


def _statements(sequence: Sequence[Word]) -> Iterator[Sequence[Word]]:
    """Declarations, equations and annotations of the one class in a text, without the words that go before them."""
    begin = next(k for k, word in enumerate(sequence) if word.text in ("model", "block", "package", "record"))
    statement: list[Word] = []
    depth = 0
    for word in sequence[begin + (3 if sequence[begin + 2].kind == "string" else 2) :]:
        depth += (word.text in "({[") - (word.text in ")}]") if word.kind == "mark" else 0
        if word.text == ";" and not depth:
            yield statement
            statement = []
        elif statement or word.text not in _PREFIXES:
            statement.append(word)


_PREFIXES = frozenset(
    "equation protected public parameter final constant inner outer replaceable redeclare input output".split()
)


def _component(statement: Sequence[Word], box: Box) -> Component:
    type_name = _name(statement)
    name = statement[2 * type_name.count(".") + 1].text
    return Component(name, type_name, box, _extent(statement, "iconTransformation") or box)


def _name(statement: Sequence[Word]) -> str:
    """The name with all its dots that begins here."""
    end = 1
    while end < len(statement) and statement[end].text == ".":
        end += 2
    return "".join(word.text for word in statement[:end])


def _line(statement: Sequence[Word]) -> Line:
    texts = [word.text for word in statement]
    middle, end = texts.index(","), texts.index("annotation")
    while texts[2:middle].count("[") != texts[2:middle].count("]"):
        middle = texts.index(",", middle + 1)
    numbers = _numbers(statement, texts.index("points", end))
    points = tuple(zip(numbers[::2], numbers[1::2], strict=True))
    return Line(_reference(texts[2:middle]), _reference(texts[middle + 1 : end - 1]), points)


def _reference(texts: Sequence[str]) -> str:
    """A connector's name without subscripts: all connectors of a vector stand in one place."""
    text = "".join(texts)
    while "[" in text:
        text = text[: text.index("[")] + text[text.index("]") + 1 :]
    return text


def _system(statement: Sequence[Word], owner: str) -> Box | None:
    """The coordinate system of an icon or a diagram, if the annotation has one for it."""
    texts = [word.text for word in statement]
    stated = owner in texts and texts[texts.index(owner) + 1 :][:2] == ["(", "coordinateSystem"]
    return _extent(statement, owner) if stated else None


def _extent(statement: Sequence[Word], owner: str) -> Box | None:
    texts = [word.text for word in statement]
    if owner not in texts:
        return None
    x1, y1, x2, y2 = _numbers(statement, texts.index("extent", texts.index(owner)))
    return min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2)


def _numbers(statement: Sequence[Word], start: int) -> list[float]:
    """The numbers in the braces after `start`."""
    numbers, depth, sign = [], 0, 1
    for word in statement[start + 2 :]:
        depth += (word.text == "{") - (word.text == "}")
        if word.kind == "number":
            numbers.append(sign * float(word.text))
        sign = -1 if word.text == "-" else 1
        if depth == 0:
            break
    return numbers


def _center(box: Box) -> Point:
    return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
