"""Diagrams of the library's models: names of components can be read, since no connection runs through them."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import diagrams
import icons
import pytest
from diagrams import Component, Diagram
from icons import Call, Point

SHOWN = [
    name
    for name in icons.classes()
    if name.startswith(("UrdfSync.Examples.", "UrdfSync.Robots.")) and diagrams.diagram(name).lines
]


def crossings(shown: Diagram) -> Iterator[str]:
    """Names of components that a connection line crosses, as wide as their icons give them room."""
    for component in shown.components:
        for graphic in component.icon.graphics:
            if graphic.get("textString") == "%name":
                corners = [component.place(corner) for corner in icons.corners(graphic)]
                if any(crosses(line, corners) for line in shown.lines):
                    yield component.name


def crosses(line: Call, corners: list[Point]) -> bool:
    """Whether a line of level and upright parts runs through a rectangle."""
    (left, right), (bottom, top) = ((min(numbers), max(numbers)) for numbers in zip(*corners, strict=True))
    return any(
        min(x1, x2) < right and max(x1, x2) > left and min(y1, y2) < top and max(y1, y2) > bottom
        for (x1, y1), (x2, y2) in itertools.pairwise(line.get("points"))
    )


def test_robots_and_benches_have_diagrams() -> None:
    assert {"UrdfSync.Examples.SixAxisArm.SixAxisArm", "UrdfSync.Examples.SixAxisArm.SixAxisArmTest"} <= set(SHOWN)


@pytest.mark.parametrize("name", SHOWN)
def test_no_connection_crosses_a_name(name: str) -> None:
    assert list(crossings(diagrams.diagram(name))) == []


def test_a_line_through_a_name_is_seen() -> None:
    joint = Component("UrdfSync.Joints.Revolute", "elbow", ((-10, -10), (10, 10)))
    above = Call("Line", {"points": [[0, 10], [0, 30]]})
    below = Call("Line", {"points": [[-40, -13], [40, -13]]})
    extent = ((-100, -100), (100, 100))
    assert list(crossings(Diagram((joint,), (above,), extent))) == []
    assert list(crossings(Diagram((joint,), (above, below), extent))) == ["elbow"]
