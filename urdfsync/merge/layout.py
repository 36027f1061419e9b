"""Places for new things in a diagram that the user has arranged himself.

Something new gets the place beside its neighbour that it has in the generated diagram, or the nearest one that is free;
a new line goes from one end to the other with a bend in the middle. Lengths are in units of the diagram.
"""

from __future__ import annotations

import functools
import itertools
import math
import re
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

from urdfsync.modelica.tree import Leaf, Part, SyntaxTree

_STEP = 20.0
"""Places are looked for at multiples of this from the wanted one."""
_REACH = 40
"""So many steps away a place is looked for."""
_MOST_COMPARISONS = 1_000_000
"""So often two boxes are compared at most: a second. What is new after that may lie upon something."""
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")


class Point(NamedTuple):
    """A place, or the way from one to another."""

    x: float
    y: float

    def shifted(self, by: Point) -> Point:
        """The place so far away."""
        return Point(self.x + by.x, self.y + by.y)

    def to(self, other: Point) -> Point:
        """The way to another place."""
        return Point(other.x - self.x, other.y - self.y)


_NOWHERE = Point(0, 0)
"""The way to where one is."""


class Extent(NamedTuple):
    """The place of a component."""

    low: Point
    high: Point

    @property
    def centre(self) -> Point:
        """The middle."""
        return Point((self.low.x + self.high.x) / 2, (self.low.y + self.high.y) / 2)

    def shifted(self, by: Point) -> Extent:
        """The box so far away."""
        return Extent(self.low.shifted(by), self.high.shifted(by))

    def touches(self, other: Extent) -> bool:
        """Whether the two lie upon each other."""
        return all(one.low[axis] < two.high[axis] for one, two in ((self, other), (other, self)) for axis in (0, 1))


def arrange(mine: SyntaxTree, generated: SyntaxTree) -> dict[str, str]:
    """Return the texts of the parts of a generated body that `mine` lacks, by key, with places that fit to `mine`."""
    new = [part for part in generated.parts if not mine.find(part.key)]
    lines = {part.key: ends for part in generated.parts if (ends := _ends(part))}
    shifts, icon_shifts = (_shifts(mine, generated, lines, place) for place in ("transformation", "iconTransformation"))
    found: dict[str, str] = {}
    for part in new:
        if part.key in lines:
            start, end = (shifts.get(one, _NOWHERE) for one in lines[part.key])
            found[part.key] = _rerouted(part, start, end)
        else:
            ways = {"transformation": shifts.get(part.key), "iconTransformation": icon_shifts.get(part.key)}
            found[part.key] = _moved(part, {place: way for place, way in ways.items() if way})
    return found


def _shifts(
    mine: SyntaxTree, generated: SyntaxTree, lines: Mapping[str, tuple[str, str]], place: str
) -> dict[str, Point]:
    """Return how far each component is from its generated place, by key; those that `mine` lacks get a free one."""
    boxes = {part.key: box for part in mine.parts if (box := _box(part, place))}
    planned = {part.key: box for part in generated.parts if (box := _box(part, place))}
    shifts = {key: planned[key].centre.to(boxes[key].centre) for key in planned.keys() & boxes.keys()}
    left = _MOST_COMPARISONS
    for key in planned:
        if not mine.find(key):
            steps = left // max(len(boxes), 1)
            shifts[key], count = _find_shift(key, planned, shifts, lines, boxes.values(), steps)
            left -= count * len(boxes)
            boxes[key] = planned[key].shifted(shifts[key])
    return shifts


def _find_shift(
    key: str,
    planned: Mapping[str, Extent],
    shifts: Mapping[str, Point],
    lines: Mapping[str, tuple[str, str]],
    taken: Collection[Extent],
    steps: int,
) -> tuple[Point, int]:
    """How far from its generated place a new component goes: as far as its neighbour did, and on to a free place.

    Of the places around, so many as `steps` are looked at; returns also how many were.
    """
    around = [other for ends in lines.values() if key in ends for other in ends if other != key and other in shifts]
    earlier = [other for other in itertools.takewhile(lambda other: other != key, planned) if other in shifts]
    neighbour = next(iter(around), earlier[-1] if earlier else "")
    wanted = shifts.get(neighbour, _NOWHERE)
    number = 0
    for number, way in enumerate(_steps()[:steps], start=1):
        shift = wanted.shifted(way)
        box = planned[key].shifted(shift)
        if not any(box.touches(other) for other in taken):
            return shift, number
    return wanted, number


@functools.cache
def _steps() -> list[Point]:
    """Ways to the places around one, the nearest first, and of those the one below."""
    reach = [number * _STEP for number in range(-_REACH, _REACH + 1)]
    return sorted(
        itertools.starmap(Point, itertools.product(reach, reach)), key=lambda way: (abs(way.x) + abs(way.y), way.y)
    )


# --- annotations --------------------------------------------------------------------------------------------------


def _find(part: Part, *keys: str) -> Leaf | None:
    """The value of an annotation of an element: `_find(part, "Line", "points")`."""
    node = part.node
    for key in ("annotation", *itertools.chain.from_iterable((key, "arguments") for key in keys[:-1]), keys[-1]):
        found = node.find(key) if isinstance(node, SyntaxTree) else None
        if found is None:
            return None
        node = found.node
    for key in ("value", "expression"):
        found = node.find(key) if isinstance(node, SyntaxTree) else None
        if found is None:
            return None
        node = found.node
    return node if isinstance(node, Leaf) else None


def _points(leaf: Leaf | None) -> list[Point]:
    numbers = [float(number) for number in _NUMBER.findall(leaf.text)] if leaf else []
    return [Point(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]


def _box(part: Part, place: str) -> Extent | None:
    """The place of a component in the diagram or in the icon; None for what has none."""
    corners = _points(_find(part, "Placement", place, "extent"))
    origin = next(iter(_points(_find(part, "Placement", place, "origin"))), _NOWHERE)
    if len(corners) != 2 or not all(map(math.isfinite, (*itertools.chain(*corners), *origin))):
        return None  # such as 1e999
    (left, right), (low, high) = (sorted(one) for one in zip(*corners, strict=True))
    return Extent(Point(left, low), Point(right, high)).shifted(origin)


def _ends(part: Part) -> tuple[str, str] | None:
    """The keys of the components that a line connects."""
    if not part.key.startswith("connect ") or not isinstance(part.node, SyntaxTree):
        return None
    connect = part.node.find("connect")
    names = re.findall(r"[\w.\[\]']+", connect.node.text)[1:] if connect else []
    return (f"component {_first(names[0])}", f"component {_first(names[1])}") if len(names) == 2 else None


def _first(name: str) -> str:
    return re.split(r"[.\[]", name, maxsplit=1)[0]


def _moved(part: Part, ways: Mapping[str, Point]) -> str:
    """The text of a component in other places of the diagram and of the icon."""
    found = []
    for place, way in ways.items():
        leaf = _find(part, "Placement", place, "origin") or _find(part, "Placement", place, "extent")
        found.append((leaf, [point.shifted(way) for point in _points(leaf)]))
    return _replaced(part, found)


def _rerouted(part: Part, start: Point, end: Point) -> str:
    """The text of a connection whose ends have moved."""
    leaf = _find(part, "Line", "points")
    points = _points(leaf)
    if start == end or len(points) < 2:
        return _replaced(part, [(leaf, [point.shifted(start) for point in points])])
    first, last = points[0].shifted(start), points[-1].shifted(end)
    middle = (first.x + last.x) / 2
    bends = [] if first.x == last.x or first.y == last.y else [Point(middle, first.y), Point(middle, last.y)]
    return _replaced(part, [(leaf, [first, *bends, last])])


def _replaced(part: Part, found: Sequence[tuple[Leaf | None, list[Point]]]) -> str:
    """The text of a part with other points in annotations."""
    text = part.node.text
    known = [(leaf, points) for leaf, points in found if leaf]
    for leaf, points in sorted(known, key=lambda one: one[0].start, reverse=True):
        said = ", ".join(f"{{{point.x:g}, {point.y:g}}}" for point in points)
        said = f"{{{said}}}" if len(points) > 1 else said
        place = leaf.start - part.node.start
        text = f"{text[:place]}{said}{text[place + len(leaf.text) :]}"
    return text
