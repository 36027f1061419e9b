"""Reads the diagram in the text of a robot model: components with their places, connections with their lines."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from urdfsync.formats.urdf.diagram.layout import PORTS, Diagram, LinePath, Placement, as_path
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.tree import KnownStatements, Leaf, Node, Statement, SyntaxTree, UnreadableError, read_tree
from urdfsync.modelica.values import literals

_KINDS: Mapping[tuple[int, ...], str] = {(95, 95, 95): "frame", (0, 0, 0): "rotational", (0, 127, 0): "translational"}
"""The kinds of lines by their colours in the templates and in the Modelica Standard Library."""
_COMPONENT = re.compile(r"'(?:[^'\\]|\\.)*+'|\w++")
"""Matches the component at the beginning of a connector's name."""
_VARIABLE = re.compile(r"\b(?:parameter|constant|input|output|discrete|Real|Integer|Boolean|String|SI|Units)\b")
"""Matches the type of a component that no diagram shows."""
_FARTHEST = 100_000
"""The largest coordinate that is drawn."""
_ROW, _STEP = 15, 40
"""The number of components in a row below the diagram, and the distance of their middles."""


class ModelText(NamedTuple):
    """The diagram in the text of a robot model, and the declarations of all components by their names."""

    diagram: Diagram
    components: Mapping[str, SyntaxTree]


def _read_body(text: str, statements: KnownStatements) -> SyntaxTree | None:
    """Return the elements and equations of a class; None if the text is not a single class, or has a syntax error."""
    tree = read_tree(text, statements)
    child = tree.find("body") if tree else None
    if child is None or not isinstance(child.node, SyntaxTree):
        return None
    try:
        for statement in child.node.children:
            if isinstance(statement.node, Statement):
                statement.node.children  # noqa: B018 - reads the statement: `read_tree` reads only its name
    except UnreadableError:
        return None
    return child.node


def find(node: Node, *path: str) -> str:
    """Return the expression of a modifier of a component or base class, or, after `annotation`, of an annotation.

    The expression is empty if there is none.
    """
    first, *names = path if path[0] == "annotation" else ("arguments", *path)
    keys = [first, *(key for name in names for key in (name, "arguments"))][:-1]
    for key in (*keys, "value", "expression"):
        child = node.find(key) if isinstance(node, SyntaxTree) else None
        if child is None:
            return ""
        node = child.node
    return node.text


def type_of(declaration: Node) -> str:
    """Return the class of a component, with prefixes and without subscripts."""
    child = declaration.find("type") if isinstance(declaration, SyntaxTree) else None
    return child.node.text.partition("[")[0].strip() if child else ""


def find_in(text: str, key: str, *path: str) -> str:
    """Return the expression of a modifier in a class: of `component NAME`, or of the first base class, `extends`."""
    body = _read_body(text, {})
    nodes = (child.node for child in body.children if f"{child.key} ".startswith(f"{key} ")) if body else ()
    return next((find(node, *path) for node in nodes), "")


def read_model(text: str, inherited: Mapping[str, Placement], statements: KnownStatements) -> ModelText | None:
    """Return the diagram in a robot model's text; None if the text is not a single class, or has a syntax error.

    `inherited` has the connectors of base classes. Components without a place stand below the others. Known
    `statements` are not read again, and new ones are added.
    """
    body = _read_body(text, statements)
    if body is None:
        return None
    components = dict(_components(body))
    places = {**inherited, **{name: place for name, node in components.items() if (place := _placement(node))}}
    note = body.find("annotation")
    extent = _numbers(note.node, "Diagram", "coordinateSystem", "extent") if note else ()
    boxes = [*places.values(), *([Placement(*extent)] if len(extent) == 4 else ())]
    x1, y1, x2, y2 = (side(values) for side, values in zip((min, min, max, max), zip(*boxes, strict=True), strict=True))
    connections = {_ends(child.node): child.node for child in body.children if child.key.startswith("connect ")}
    connected = {match[0] for ends in connections for end in ends if (match := _COMPONENT.match(end))}
    shown = (name for name, node in components.items() if name in connected or not _VARIABLE.search(type_of(node)))
    unplaced = [name for name in shown if name not in places]
    for number, name in enumerate(unplaced):
        row, column = divmod(number, _ROW)
        places[name] = Placement.around((x1 + (2 * column + 1) * _STEP // 2, y1 - (2 * row + 1) * _STEP // 2))
    y1 -= _STEP * math.ceil(len(unplaced) / _ROW)
    drawn = [(ends, _line(node, ends, places)) for ends, node in connections.items()]
    lines = {ends: line for ends, line in drawn if line}
    return ModelText(Diagram((x1, y1, x2, y2), places, lines), components)


def _components(body: SyntaxTree) -> Iterator[tuple[str, SyntaxTree]]:
    """Yield each component with its declaration; one of several in a declaration gets a declaration of its own."""
    for child in body.children:
        if not (child.key.startswith("component ") and isinstance(child.node, SyntaxTree)):
            continue
        if child.node.find("components") is None:
            yield child.key.removeprefix("component "), child.node
            continue
        depth, commas, text = 0, [-1], child.node.text.rstrip(";")
        for token in lex(text)[0]:
            depth += (token.text in "([{") - (token.text in ")]}")
            if token.text == "," and not depth:
                commas.append(token.start)
        first, *others = (text[at + 1 : end] for at, end in zip(commas, [*commas[1:], len(text)], strict=True))
        type_ = Statement(f"{first};", is_equation=False).find("type")
        for one in (first, *(f"{type_.node.text if type_ else ''} {other}" for other in others)):
            statement = Statement(f"{one};", is_equation=False)
            if name := statement.find("name"):
                yield name.node.text, statement


def _numbers(node: Node, *path: str) -> tuple[int, ...]:
    """Return the coordinates of an annotation, in whole units; empty if there are none that can be drawn."""
    values = literals(find(node, "annotation", *path))
    if not isinstance(values, tuple) or any(abs(value) > _FARTHEST for value in values):
        return ()
    return tuple(round(value) for value in values)


def _placement(statement: Node) -> Placement | None:
    """Return the place of a component; a turned component has the rectangle around it."""
    extent, origin, turn = (
        _numbers(statement, "Placement", "transformation", name) for name in ("extent", "origin", "rotation")
    )
    if len(extent) != 4:
        return None
    (x, y), angle = origin if len(origin) == 2 else (0, 0), math.radians(turn[0] if turn else 0)
    cos, sin = math.cos(angle), math.sin(angle)
    corners = [(round(x + a * cos - b * sin), round(y + a * sin + b * cos)) for a in extent[::2] for b in extent[1::2]]
    across, upright = zip(*corners, strict=True)
    return Placement(min(across), min(upright), max(across), max(upright))


def _ends(connection: Node) -> tuple[str, str]:
    """Return the names of both connectors, in alphabetical order."""
    child = connection.find("connect") if isinstance(connection, SyntaxTree) else None
    one, other = child.node.words if child and isinstance(child.node, Leaf) else ("", "")
    return str(one), str(other)


def _line(node: Node, ends: tuple[str, str], places: Mapping[str, Placement]) -> tuple[str, LinePath] | None:
    """Return the line of a connection with its kind or colour: without a Line, a short way; None without places."""
    numbers, color = (_numbers(node, "Line", name) for name in ("points", "color"))
    points = list(zip(numbers[::2], numbers[1::2], strict=False))
    kind = _KINDS.get(color or (0, 0, 0), f"rgb{color}")
    if not points:
        for end in ends:
            match = _COMPONENT.match(end)
            if match is None or match[0] not in places:
                return None
            port, place = end.removeprefix(match[0]).rpartition(".")[2], places[match[0]]
            points.append(place.port(port) if port in PORTS else place.centre)
            kind = "frame" if "frame" in (port or end).lower() else kind
        points.insert(1, (points[1][0], points[0][1]))
    path = as_path(points)
    return (kind, path) if len(path) > 1 else None
