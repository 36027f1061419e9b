"""What annotations of models say of their diagrams: icons of components, and the lines between them."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator

import icons
from icons import Call, Point

_COMPONENT = re.compile(
    r"^  (?:inner |replaceable |parameter )*"
    r"((?:\w+\.)*[A-Z]\w*) (\w+)(?:\[[^\]]*\])?(?=[\s(;])"  # its type and name
    r"(?:[^;\"]|\"(?:\\.|[^\"\\])*\")*;",
    re.MULTILINE,
)


@dataclasses.dataclass(frozen=True)
class Component:
    """A component of a model, with the corners of its icon in the diagram."""

    kind: str
    """Full name of its class."""
    name: str
    corners: tuple[Point, Point]

    @property
    def icon(self) -> icons.Icon:
        """The icon of its class; an empty one if the library does not have the class."""
        return icons.icon(self.kind) if _exists(self.kind) else icons.Icon()

    def place(self, point: Point) -> Point:
        """Where a point of the icon lies in the diagram. No component of the library is turned."""
        (x1, y1), (x2, y2) = self.corners
        (left, bottom), (right, top) = self.icon.extent
        across, up = (point[0] - left) / (right - left), (point[1] - bottom) / (top - bottom)
        return (x1 + (x2 - x1) * across, y1 + (y2 - y1) * up)


@dataclasses.dataclass(frozen=True)
class Diagram:
    """What a model shows: its components and the points of its connection lines, those of its base classes first."""

    components: tuple[Component, ...]
    lines: tuple[Call, ...]
    extent: tuple[Point, Point]


def diagram(name: str) -> Diagram:
    """The diagram of the class with the full name `name`."""
    text = icons.source(name)
    notes = icons.annotations_in(text)
    bases = [diagram(base) for base in icons.bases(text)]
    system = next((note.get("Diagram").get("coordinateSystem") for note in notes if note.get("Diagram")), None)
    lower, upper = system.get("extent") if system else ((-100, -100), (100, 100))
    return Diagram(
        (*(component for base in bases for component in base.components), *_components(name, text)),
        (*(line for base in bases for line in base.lines), *(note.get("Line") for note in notes if note.get("Line"))),
        ((lower[0], lower[1]), (upper[0], upper[1])),
    )


def _components(name: str, text: str) -> Iterator[Component]:
    for match in _COMPONENT.finditer(text):
        placements = [note.get("Placement") for note in icons.annotations_in(match[0])]
        for placement in filter(None, placements):
            (x1, y1), (x2, y2) = placement.get("transformation").get("extent")
            yield Component(_full_name(match[1], name), match[2], ((x1, y1), (x2, y2)))


def _full_name(kind: str, inside: str) -> str:
    """The full name of a class as it is called inside of another, which may leave out the packages around both."""
    packages = inside.split(".")[:-1]
    names = (".".join([*packages[:count], kind]) for count in range(len(packages), 0, -1))
    return next(filter(_exists, names), kind)


def _exists(name: str) -> bool:
    path = icons.LIBRARY.parent.joinpath(*name.split("."))
    return path.with_name(f"{path.name}.mo").is_file() or (path / "package.mo").is_file()
