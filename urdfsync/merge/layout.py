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

from urdfsync.modelica.tree import Leaf, Node, Part, SyntaxTree

PICTURES = frozenset({"Icon", "Diagram"})
"""Annotations with graphics: what the export adds to them is drawn there, whoever has the layout."""
_DIAGRAM, _ICON = frozenset({"transformation", "Line", "Diagram"}), frozenset({"iconTransformation", "Icon"})
"""The annotations that belong together in the two layers of a class."""

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


def find_users_layout(base: SyntaxTree, mine: SyntaxTree) -> frozenset[str]:
    """Return the annotations about layout that are the user's: all of the diagram, or of the icon, if he moved any.

    What he added is no move.
    """
    moved: set[str] = set()
    for part in base.parts:
        other = mine.find(part.key)
        if other and part.node.text != other.node.text:
            moved.update(key for key in _DIAGRAM | _ICON if _is_moved(key, part.node, other.node))
    return frozenset().union(*(layer for layer in (_DIAGRAM, _ICON) if not layer.isdisjoint(moved)))


def _is_moved(key: str, base: Node, mine: Node) -> bool:
    """Whether an annotation about layout of one element is not as it was, but for graphics that were added."""
    keys = ("annotation", *(("Placement",) if key.endswith("ransformation") else ()), key)
    old, new = (_inside(node, keys) for node in (base, mine))
    return old is not None and (
        new is None or not (_has_all(new, old) if key in PICTURES else new.meaning == old.meaning)
    )


def _has_all(mine: Node, base: Node) -> bool:
    """Whether all that base draws is there as it was."""
    if not (isinstance(mine, SyntaxTree) and isinstance(base, SyntaxTree)):
        return mine.meaning == base.meaning
    pairs = ((mine.find(part.key), part) for part in base.parts)
    return all(own is not None and _has_all(own.node, part.node) for own, part in pairs)


def arrange(mine: SyntaxTree, generated: SyntaxTree, kept: Collection[str]) -> dict[str, str]:
    """Return the texts of the parts of a generated body that `mine` lacks, by key, with places that fit to `mine`.

    `kept` are the annotations in which the layout is the user's.
    """
    new = [part for part in generated.parts if not mine.find(part.key)]
    lines = {part.key: ends for part in generated.parts if (ends := _ends(part))}
    shifts = {
        place: _shifts(mine, generated, lines, place)
        for place in ("transformation", "iconTransformation")
        if place in kept
    }
    found: dict[str, str] = {}
    for part in new:
        if part.key in lines and "Line" in kept:
            start, end = (shifts["transformation"].get(one, _NOWHERE) for one in lines[part.key])
            found[part.key] = _rerouted(part, start, end)
        elif part.key not in lines:
            found[part.key] = _moved(
                part, {place: ways[part.key] for place, ways in shifts.items() if part.key in ways}
            )
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


def _inside(node: Node, keys: Sequence[str]) -> Node | None:
    """What stands in lists of modifiers within each other: the element's `annotation`, then the names in it."""
    inner: Node | None = node
    for key in keys:
        arguments = inner.find("arguments") if isinstance(inner, SyntaxTree) else None
        holder = arguments.node if arguments and key != keys[0] else inner
        found = holder.find(key) if isinstance(holder, SyntaxTree) else None
        inner = found.node if found else None
    return inner


def _find(part: Part, *keys: str) -> Leaf | None:
    """The value of an annotation of an element: `_find(part, "Line", "points")`."""
    node = _inside(part.node, ("annotation", *keys))
    for key in ("value", "expression"):
        found = node.find(key) if isinstance(node, SyntaxTree) else None
        node = found.node if found else None
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
