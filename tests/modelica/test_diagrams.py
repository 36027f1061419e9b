"""Diagrams of the library's models: names of components can be read, since no connection runs through them."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence

import pytest
from support.diagram import STANDARD, Component, Diagram, Point, library_diagram, outline
from support.modelica import URDFSYNC

CLASSES = [".".join(file.relative_to(URDFSYNC.parent).with_suffix("").parts) for file in sorted(URDFSYNC.rglob("*.mo"))]
SHOWN = [
    name
    for name in CLASSES
    if re.match(r"UrdfSync\.(Examples|Robots)\.(?!.*package$)", name) and library_diagram(name).lines
]


def crossed(components: Sequence[Component], drawn: Sequence[Sequence[Point]], inside: str) -> Iterator[str]:
    """Names of components that a line crosses, as wide as their icons give them room."""
    for component in components:
        icon = library_diagram(full_name(component.type, inside))
        for graphic in icon.graphics:
            if graphic.get("textString") == "%name":
                corners = [place(corner, component, icon) for corner in outline(graphic)]
                if any(crosses(line, corners) for line in drawn):
                    yield component.name


def full_name(kind: str, inside: str) -> str:
    """The full name of a class as it is called inside of another, which may leave out the packages around both."""
    packages = inside.split(".")
    names = (".".join([*packages[:count], kind]) for count in range(len(packages), -1, -1))
    return next((name for name in names if name in CLASSES), f"Modelica.{kind}")


def place(point: Point, component: Component, icon: Diagram) -> Point:
    """Where a point of the icon lies in the diagram. No component of the library is turned."""
    (x1, y1, x2, y2), (left, bottom, right, top) = component.box, icon.icon
    across, up = (point[0] - left) / (right - left), (point[1] - bottom) / (top - bottom)
    return (x1 + (x2 - x1) * across, y1 + (y2 - y1) * up)


def crosses(line: Sequence[Point], corners: list[Point]) -> bool:
    """Whether a line of level and upright parts runs through a rectangle."""
    (left, right), (bottom, top) = ((min(numbers), max(numbers)) for numbers in zip(*corners, strict=True))
    return any(
        min(x1, x2) < right and max(x1, x2) > left and min(y1, y2) < top and max(y1, y2) > bottom
        for (x1, y1), (x2, y2) in itertools.pairwise(line)
    )


@pytest.mark.parametrize("name", SHOWN)
def test_no_connection_crosses_a_name(name: str) -> None:
    drawn = library_diagram(name)
    assert list(crossed(drawn.components, [line.points for line in drawn.lines], name)) == []


def test_a_line_through_a_name_is_seen() -> None:
    elbow = Component("elbow", "UrdfSync.Joints.Revolute", (-10, -10, 10, 10), STANDARD)
    above, below = ((0, 10), (0, 30)), ((-40, -13), (40, -13))
    assert list(crossed([elbow], [above], "UrdfSync")) == []
    assert list(crossed([elbow], [above, below], "UrdfSync")) == ["elbow"]
