"""Reads the diagram in the text of a robot model: components with their places, connections with their lines."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from urdfsync.modelica.lexer import lex
from urdfsync.modelica.tree import Leaf, Node, Statement, SyntaxTree, UnreadableError, read_tree
from urdfsync.modelica.values import literals
from urdfsync.urdf.diagram.layout import PORTS, Diagram, Path, Placement, Point, as_path

_KINDS: Mapping[tuple[int, ...], str] = {(95, 95, 95): "frame", (0, 0, 0): "rotational", (0, 127, 0): "translational"}
"""The kinds of lines by their colours in the templates and in the Modelica Standard Library."""
_END = re.compile(r"('(?:[^'\\]|\\.)*+'|\w++)(?:\[[^\]]*+\])?(?:\.(\w++))?")
"""Matches a connector: the component, subscripts, and the component's connector."""
_FARTHEST = 100_000
"""The largest coordinate that is drawn; a number beyond is damage."""
_ROW, _STEP = 15, 40
"""The components of a row below the diagram, and the distance of their middles."""


class ModelText(NamedTuple):
    """The diagram of a text, and the statements of the components that the diagram may show."""

    diagram: Diagram
    """A line has its kind, or its colour if that is no kind's."""
    components: Mapping[str, SyntaxTree]
    """The declarations of all components, by their names."""


def _read_body(text: str) -> SyntaxTree | None:
    """Return the elements and equations of a class; None if the text is not a single class, or has a syntax error."""
    tree = read_tree(text)
    part = tree.find("body") if tree else None
    if part is None or not isinstance(part.node, SyntaxTree):
        return None
    try:
        for statement in part.node.parts:
            if isinstance(statement.node, Statement):
                statement.node.parts  # noqa: B018 - reads the statement: only names were read so far
    except UnreadableError:
        return None
    return part.node


def find(node: Node, *path: str) -> str:
    """Return the value of a modifier or annotation: `annotation`, then the names of arguments; empty if there is none.

    Without `annotation`, the path begins with a modifier of a component or a base class.
    """
    first, *names = path if path[0] == "annotation" else ("arguments", *path)
    keys = [first, *(key for name in names for key in (name, "arguments"))][:-1]
    for key in (*keys, "value", "expression"):
        part = node.find(key) if isinstance(node, SyntaxTree) else None
        if part is None:
            return ""
        node = part.node
    return node.text


def find_in(text: str, key: str, *path: str) -> str:
    """Return the value of a modifier in a class: of `component NAME`, or of the first base class, `extends`."""
    body = _read_body(text)
    parts = (part.node for part in body.parts if f"{part.key} ".startswith(f"{key} ")) if body else ()
    return next((find(node, *path) for node in parts), "")


def read_model(text: str, inherited: Mapping[str, Placement]) -> ModelText | None:
    """Return the diagram in a robot model's text; None if the text is not a single class, or has a syntax error.

    `inherited` has the connectors of base classes. Connected components without a place stand below the others.
    """
    body = _read_body(text)
    if body is None:
        return None
    components = dict(_components(body))
    named = {name: _placement(statement) for name, statement in components.items()}
    places = {**inherited, **{name: place for name, place in named.items() if place}}
    connections = [part.node for part in body.parts if part.key.startswith("connect ")]
    ends = [_ends(statement) for statement in connections]
    x1, y1, x2, y2 = _extent(body, places)
    connected = dict.fromkeys(match[1] for pair in ends for end in pair if (match := _END.match(end)))
    for number, name in enumerate(name for name in connected if name in named and name not in places):
        row, column = divmod(number, _ROW)
        places[name] = Placement.around((x1 + _STEP // 2 + column * _STEP, y1 - _STEP * row - _STEP // 2))
    y1 = min([y1, *(place.y1 - _STEP // 4 for place in places.values())])
    drawn = [(pair, _line(node, pair, places)) for pair, node in zip(ends, connections, strict=True)]
    lines = {pair: line for pair, line in drawn if line}
    return ModelText(Diagram((x1, y1, x2, y2), places, lines), components)


def _components(body: SyntaxTree) -> Iterator[tuple[str, SyntaxTree]]:
    """Yield each component with its declaration; one of several in a declaration gets a declaration of its own."""
    for part in body.parts:
        if not (part.key.startswith("component ") and isinstance(part.node, SyntaxTree)):
            continue
        listed = part.node.find("components")
        first, *others = _split(listed.node.text) if listed else [part.node.text.rstrip(";")]
        statement = Statement(f"{first};", is_equation=False)
        type_ = statement.find("type")
        for text in (first, *(f"{type_.node.text if type_ else ''} {other}" for other in others)):
            statement = Statement(f"{text};", is_equation=False)
            if name := statement.find("name"):
                yield name.node.text, statement


def _split(text: str) -> list[str]:
    """Return the parts of a text between its commas, but not those in brackets."""
    depth, commas = 0, [-1]
    for token in lex(text)[0]:
        depth += (token.text in "([{") - (token.text in ")]}")
        if token.text == "," and not depth:
            commas.append(token.start)
    return [text[start + 1 : stop] for start, stop in zip(commas, [*commas[1:], len(text)], strict=True)]


def _numbers(node: Node, *path: str) -> tuple[int, ...]:
    """Return the coordinates of an annotation, in whole units; empty if there are none that can be drawn."""
    values = literals(find(node, "annotation", *path))
    if not isinstance(values, tuple) or not all(abs(value) <= _FARTHEST for value in values):
        return ()
    return tuple(map(round, values))


def _placement(statement: Node) -> Placement | None:
    """Return the place of a component; a turned component has the rectangle around it."""
    where = "Placement", "transformation"
    extent = _numbers(statement, *where, "extent")
    if len(extent) != 4:
        return None
    x, y = _numbers(statement, *where, "origin") or (0, 0)
    angle = math.radians(next(iter(_numbers(statement, *where, "rotation")), 0))
    cos, sin = math.cos(angle), math.sin(angle)
    corners = [(a, b) for a in extent[::2] for b in extent[1::2]]
    across, upright = (
        [round(x + a * cos - b * sin) for a, b in corners],
        [round(y + a * sin + b * cos) for a, b in corners],
    )
    return Placement(min(across), min(upright), max(across), max(upright))


def _extent(body: SyntaxTree, places: Mapping[str, Placement]) -> tuple[int, int, int, int]:
    """Return the extent of the diagram; components outside of it make it larger."""
    note = body.find("annotation")
    extent = _numbers(note.node, "Diagram", "coordinateSystem", "extent") if note else ()
    boxes = [*places.values(), *([Placement(*extent)] if len(extent) == 4 else [])]
    return (
        min(box.x1 for box in boxes),
        min(box.y1 for box in boxes),
        max(box.x2 for box in boxes),
        max(box.y2 for box in boxes),
    )


def _ends(connection: Node) -> tuple[str, str]:
    """Return both connectors, in alphabetical order."""
    part = connection.find("connect") if isinstance(connection, SyntaxTree) else None
    first, second = part.node.words if part and isinstance(part.node, Leaf) else ("", "")
    return str(first), str(second)


def _line(connection: Node, ends: tuple[str, str], places: Mapping[str, Placement]) -> tuple[str, Path] | None:
    """Return the line of a connection with its kind or colour: without a Line, a short way; None without places."""
    numbers, color = _numbers(connection, "Line", "points"), _numbers(connection, "Line", "color") or (0, 0, 0)
    points: list[Point] = list(zip(numbers[::2], numbers[1::2], strict=False))
    kind = _KINDS.get(color, f"rgb{color}")
    if not points:
        matches = [_END.match(end) for end in ends]
        named = [(places.get(match[1]), match[2]) for match in matches if match]
        points = [place.port(port) if port in PORTS else place.centre for place, port in named if place]
        kind = "frame" if any(re.search(r"frame(_\w+)?$", end, re.IGNORECASE) for end in ends) else "rotational"
        points[1:1] = [(points[-1][0], points[0][1])] if points else []
    path = as_path(points)
    return (kind, path) if len(path) > 1 else None
