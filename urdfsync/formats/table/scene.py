"""A table as a picture: a box for each element, a line for each connection.

`urdfsync.domain.scene.Pictures` describes the functions; those about meshes are asked of no scene without meshes.
"""

from __future__ import annotations

import colorsys
import math
from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from urdfsync.domain import Import, Target
from urdfsync.domain.scene import Body, Hinge, PagePose, Scene, Shape
from urdfsync.formats.table.model import FROM, TO, Table, TableOptions, component_names, shown_unit

_MOST = 500
"""The greatest number of elements of a picture."""
_BOX = 0.6, 0.3, 0.3
_LINE = 0.03


def scene(
    table: Table,
    imports: Mapping[str, Import],  # noqa: ARG001 - a table refers to no files
    target: Target,
    options: TableOptions,
) -> tuple[Scene, Mapping[str, str]]:
    """Return the picture of a table, which has no meshes."""
    places, root = _places(table), f"table {target.name}"
    names = component_names(table.elements, target)
    kinds = sorted({str(row.get(options.kind, "")) for row in table.elements.values()})
    bodies, hinges, lines = list[Body](), list[Hinge](), list[Shape]()
    for key, (x, y) in places.items():
        row, name = table.elements[key], names[key]
        facts = [
            (
                column,
                f"{value:g} {shown_unit(table.columns[column])}".rstrip() if isinstance(value, float) else str(value),
            )
            for column, value in row.items()
        ]
        hue = kinds.index(str(row.get(options.kind, ""))) / len(kinds)
        box = Shape("visual", "box", _BOX, _pose(), (*colorsys.hls_to_rgb((hue + 0.58) % 1, 0.6, 0.45), 1.0))
        bodies.append(Body(f"element {key}", name, tuple(facts), (box,)))
        hinges.append(Hinge("", name, (), root, f"element {key}", _pose(x, y), (0.0, 0.0, 1.0)))
    for row in table.connections.values():
        if (start := places.get(str(row[FROM]))) and (end := places.get(str(row[TO]))):
            size = (math.dist(start, end), _LINE, _LINE)
            middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
            pose = _pose(*middle, math.atan2(end[1] - start[1], end[0] - start[0]))
            lines.append(Shape("visual", "box", size, pose, (0.55, 0.55, 0.55, 1.0)))
    rest = len(table.elements) - len(places)
    missing = (f"{rest:,} further elements",) if rest else ()
    return Scene((Body(root, target.name, (), tuple(lines)), *bodies), tuple(hinges), missing, noun="table"), {}


def with_numbers(
    table: Table, numbers: Mapping[tuple[str, str], Sequence[float]]
) -> tuple[Table, Collection[tuple[str, str]]]:
    """Return the table as it is: its picture shows no numbers."""
    return table, numbers.keys()


def named_poses(source: Path, table: Table) -> tuple[Mapping[str, Mapping[str, float]], Sequence[str]]:  # noqa: ARG001 - see `Pictures`
    """Return no poses: nothing moves."""
    return {}, ()


def _places(table: Table) -> dict[str, tuple[float, float]]:
    """Return x and y of each element: connected groups one below the other, then rows of other elements."""
    beside = defaultdict[str, dict[str, None]](dict)
    for row in table.connections.values():
        ends = str(row[FROM]), str(row[TO])
        for one, other in (ends, ends[::-1]):
            beside[one][other] = None
    places, bottom = dict[str, tuple[float, float]](), 0.0
    for first in sorted(beside, key=lambda key: -len(beside[key])):
        if first in places:
            continue
        columns, seen = [[first]], {first}
        while columns[-1]:
            new = dict.fromkeys(other for key in columns[-1] for other in beside[key] if other not in seen)
            columns.append([*new])
            seen |= new.keys()
        height = max(map(len, columns))
        for number, column in enumerate(columns):
            for row_number, key in enumerate(column):
                places[key] = 1.4 * number, bottom - 0.7 * (row_number + (height - len(column)) / 2)
        bottom -= 0.7 * height
    alone, width = [key for key in table.elements if key not in beside], math.ceil(math.sqrt(len(table.elements)))
    for number, key in enumerate(alone):
        places[key] = 1.0 * (number % width), bottom - 0.7 * (number // width) - 0.7
    return {key: places[key] for key in sorted(places)[:_MOST]}


def _pose(x: float = 0.0, y: float = 0.0, angle: float = 0.0) -> PagePose:
    cos, sin = math.cos(angle), math.sin(angle)
    return (cos, sin, 0.0, 0.0, -sin, cos, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, _BOX[2] / 2, 1.0)
