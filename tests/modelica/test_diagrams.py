"""Diagrams of the library's models: names of components can be read, since no connection runs through them."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import icons
import pytest
from icons import Point
from support.diagram import STANDARD, Component, library_diagram

CLASSES = icons.classes()


def lines(name: str) -> list[Sequence[Point]]:
    """The points of all connection lines of a class, those of its base classes first."""
    text = icons.source(name)
    own = [note.get("Line").get("points") for note in icons.annotations_in(text) if note.get("Line")]
    return [*(line for base in icons.bases(text) for line in lines(base)), *own]


SHOWN = [name for name in CLASSES if name.startswith(("UrdfSync.Examples.", "UrdfSync.Robots.")) and lines(name)]


def crossed(components: Sequence[Component], drawn: Sequence[Sequence[Point]], inside: Sequence[str]) -> Iterator[str]:
    """Names of components that a line crosses, as wide as their icons give them room."""
    for component in components:
        name = full_name(component.type, inside)
        for graphic in icons.icon(name).graphics if name in CLASSES else ():
            if graphic.get("textString") == "%name":
                corners = [place(corner, component, icons.icon(name)) for corner in icons.corners(graphic)]
                if any(crosses(line, corners) for line in drawn):
                    yield component.name


def full_name(kind: str, inside: Sequence[str]) -> str:
    """The full name of a class as it is called inside of others, which may leave out the packages around both."""
    scopes = [name.split(".")[:count] for name in inside for count in range(name.count("."), -1, -1)]
    names = (".".join([*scope, kind]) for scope in scopes)
    return next((name for name in names if name in CLASSES), kind)


def place(point: Point, component: Component, icon: icons.Icon) -> Point:
    """Where a point of the icon lies in the diagram. No component of the library is turned."""
    (x1, y1, x2, y2), ((left, bottom), (right, top)) = component.box, icon.extent
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
    inside = [*icons.bases(icons.source(name)), name]
    assert list(crossed(library_diagram(name).components, lines(name), inside)) == []


def test_a_line_through_a_name_is_seen() -> None:
    elbow = Component("elbow", "UrdfSync.Joints.Revolute", (-10, -10, 10, 10), STANDARD)
    above, below = ((0, 10), (0, 30)), ((-40, -13), (40, -13))
    assert list(crossed([elbow], [above], ["UrdfSync"])) == []
    assert list(crossed([elbow], [above, below], ["UrdfSync"])) == ["elbow"]
