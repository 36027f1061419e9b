"""Finds places for new nodes in a diagram that the user has arranged.

A new node is placed relative to its neighbour, as in the generated diagram, or at the nearest free place. A new line
goes from one end to the other with a bend in the middle. Lengths are in units of the diagram; a place or a shift is a
complex number.
"""

from __future__ import annotations

import functools
import itertools
import math
import re
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TypeAlias

from urdfsync.modelica.tree import Child, Node, SyntaxTree, is_same

PICTURES = frozenset({"Icon", "Diagram"})
"""Annotations with graphics: new graphics of the export are added even to a layout that stays."""
_DIAGRAM, _ICON = frozenset({"transformation", "Line", "Diagram"}), frozenset({"iconTransformation", "Icon"})
"""The annotations of each of the two layers of a class."""

_STEP = 20.0
"""Step between candidate places."""
_REACH = 40
"""The greatest number of steps from the wanted place to a candidate."""
_MOST_COMPARISONS = 1_000_000
"""The greatest number of comparisons of two boxes, in about a second. Further new nodes may overlap other nodes."""
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
_PLACEMENTS = {
    place: re.compile(rf"\b{place}\s*\(((?:[^()]|\([^()]*\))*)\)") for place in ("transformation", "iconTransformation")
}
_ARRAYS = {key: re.compile(rf"\b{key}\s*=\s*(\{{[^()=]*\}})") for key in ("extent", "origin", "points")}

Rectangle: TypeAlias = tuple[complex, complex]
"""The place of a component: its lower left and its upper right corner."""


def find_users_layout(base: SyntaxTree, mine: SyntaxTree) -> frozenset[str]:
    """Return the annotations with the user's layout: all of the diagram or icon in which the user moved a node.

    A node that the user added does not count as moved.
    """
    moved: set[str] = set()
    for child in base.children:
        other = mine.find(child.key)
        if other and child.node.text != other.node.text:
            moved.update(key for key in _DIAGRAM | _ICON if _is_moved(key, child.node, other.node))
    return frozenset().union(*(layer for layer in (_DIAGRAM, _ICON) if not layer.isdisjoint(moved)))


def _is_moved(key: str, base: Node, mine: Node) -> bool:
    """Whether an element's layout annotation changed, apart from added graphics."""
    keys = ("annotation", *(("Placement",) if key.endswith("ransformation") else ()), key)
    old, new = (_inside(node, keys) for node in (base, mine))
    return old is not None and (new is None or not (_has_all(new, old) if key in PICTURES else is_same(new, old)))


def _has_all(mine: Node, base: Node) -> bool:
    """Whether all graphics of base are unchanged."""
    if not (isinstance(mine, SyntaxTree) and isinstance(base, SyntaxTree)):
        return is_same(mine, base)
    pairs = ((mine.find(child.key), child) for child in base.children)
    return all(own is not None and _has_all(own.node, child.node) for own, child in pairs)


def arrange(mine: SyntaxTree, generated: SyntaxTree, users_layout: Collection[str]) -> dict[str, str]:
    """Return the children of a generated body that `mine` lacks, by key: texts with places that fit into `mine`.

    `users_layout` has the annotations with the user's layout.
    """
    lines = {child.key: ends for child in generated.children if (ends := _ends(child))}
    shifts = {place: _shifts(mine, generated, lines, place) for place in _PLACEMENTS if place in users_layout}
    texts: dict[str, str] = {}
    for child in generated.children:
        if mine.find(child.key):
            continue
        text = child.node.text
        if child.key in lines and "Line" in users_layout:
            start, end = (shifts["transformation"].get(key, 0) for key in lines[child.key])
            text = _rerouted(text, start, end)
        for place, ways in shifts.items():
            text = _moved(text, place, ways.get(child.key, 0))
        texts[child.key] = text
    return texts


def _shifts(
    mine: SyntaxTree, generated: SyntaxTree, lines: Mapping[str, tuple[str, str]], place: str
) -> dict[str, complex]:
    """Return the shift of each component from its generated place, by key.

    Components that `mine` lacks get a free place.
    """
    boxes = {child.key: box for child in mine.children if (box := _box(child, place))}
    planned = {child.key: box for child in generated.children if (box := _box(child, place))}
    shifts = {key: sum(boxes[key]) / 2 - sum(planned[key]) / 2 for key in planned.keys() & boxes.keys()}
    neighbours = defaultdict[str, list[str]](list)
    for first, second in lines.values():
        neighbours[first].append(second)
        neighbours[second].append(first)
    comparisons, previous = _MOST_COMPARISONS, ""
    for key, (low, high) in planned.items():
        if not mine.find(key):
            # shift a new child like a connected child, else like the child before
            neighbour = next((other for other in neighbours[key] if other != key and other in shifts), previous)
            wanted = shifts.get(neighbour, 0)
            shifts[key] = wanted
            for way in _steps()[: comparisons // max(len(boxes), 1)]:
                comparisons -= len(boxes)
                shift = wanted + way
                if not any(_touch((low + shift, high + shift), box) for box in boxes.values()):
                    shifts[key] = shift
                    break
            boxes[key] = low + shifts[key], high + shifts[key]
        previous = key if key in shifts else previous
    return shifts


def _touch(box: Rectangle, other: Rectangle) -> bool:
    """Whether two boxes overlap."""
    return all(low.real < high.real and low.imag < high.imag for low, high in ((box[0], other[1]), (other[0], box[1])))


@functools.cache
def _steps() -> list[complex]:
    """Return the shifts to places around a place, sorted by distance, then by height."""
    reach = [number * _STEP for number in range(-_REACH, _REACH + 1)]
    ways = itertools.starmap(complex, itertools.product(reach, reach))
    return sorted(ways, key=lambda way: (abs(way.real) + abs(way.imag), way.imag))


# --- annotations --------------------------------------------------------------------------------------------------


def _inside(node: Node, keys: Sequence[str]) -> Node | None:
    """Return a value in nested lists of modifiers; `keys` lead from the element's `annotation` to the value."""
    inner: Node | None = node
    for key in keys:
        arguments = inner.find("arguments") if isinstance(inner, SyntaxTree) else None
        holder = arguments.node if arguments and key != keys[0] else inner
        child = holder.find(key) if isinstance(holder, SyntaxTree) else None
        inner = child.node if child else None
    return inner


def _points(array: re.Match[str] | None) -> list[complex]:
    """Return the points of an array in a text."""
    numbers = [float(number) for number in _NUMBER.findall(array[1])] if array else []
    return [complex(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]


def _arrays(text: str, place: str) -> Iterator[re.Match[str] | None]:
    """Yield the extent and the origin of a component in the diagram or in the icon."""
    placement = _PLACEMENTS[place].search(text)
    for key in ("extent", "origin"):
        yield _ARRAYS[key].search(text, *placement.span(1)) if placement else None


def _box(child: Child, place: str) -> Rectangle | None:
    """Return the place of a component in the diagram or in the icon; None without a place."""
    corners, origins = map(_points, _arrays(child.node.text, place))
    if len(corners) != 2 or not child.key.startswith("component "):
        return None
    xs, ys = sorted(corner.real for corner in corners), sorted(corner.imag for corner in corners)
    box = [complex(xs[0], ys[0]) + sum(origins), complex(xs[1], ys[1]) + sum(origins)]
    if not all(math.isfinite(abs(corner)) for corner in box):  # for example, 1e999 is infinite
        return None
    return box[0], box[1]


def _ends(child: Child) -> tuple[str, str] | None:
    """Return the keys of the components that a line connects."""
    connectors = re.findall(r"([\w']+)[\w.\[\]']*", child.node.text.partition(")")[0])[1:]
    if not child.key.startswith("connect ") or len(connectors) != 2:
        return None
    return f"component {connectors[0]}", f"component {connectors[1]}"


def _moved(text: str, place: str, way: complex) -> str:
    """Return the text of a component in another place of the diagram or of the icon."""
    extent, origin = _arrays(text, place)
    return _replaced(text, origin or extent, [point + way for point in _points(origin or extent)]) if way else text


def _rerouted(text: str, start: complex, end: complex) -> str:
    """Return the text of a connection whose ends have moved."""
    array = _ARRAYS["points"].search(text)
    points = _points(array)
    if start == end or len(points) < 2:
        return _replaced(text, array, [point + start for point in points]) if start else text
    first, last = points[0] + start, points[-1] + end
    middle = (first.real + last.real) / 2
    is_straight = first.real == last.real or first.imag == last.imag
    bends = [] if is_straight else [complex(middle, first.imag), complex(middle, last.imag)]
    return _replaced(text, array, [first, *bends, last])


def _replaced(text: str, array: re.Match[str] | None, points: Sequence[complex]) -> str:
    """Return the text with other points in an array."""
    if not array:
        return text
    new_array = ", ".join(f"{{{point.real:g}, {point.imag:g}}}" for point in points)
    new_array = f"{{{new_array}}}" if len(points) > 1 else new_array
    return f"{text[: array.start(1)]}{new_array}{text[array.end(1) :]}"
