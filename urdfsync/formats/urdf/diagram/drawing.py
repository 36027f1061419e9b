"""Draws the robot model's diagram as SVG. The SVG refers to no other file, and is equal on all machines.

The diagram is that of the package on disk. Where its files differ from the generated ones, places, lines, masses and
ratios are read from their texts, and the parts that differ are marked.
"""

from __future__ import annotations

import itertools
import math
import re
from collections import Counter, defaultdict
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Literal, NamedTuple, TypeAlias

import jinja2

from urdfsync.domain import Target
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.diagram.layout import Diagram, LinePath, Point, layout
from urdfsync.formats.urdf.diagram.text import ModelText, find, find_in, read_model, type_of
from urdfsync.formats.urdf.names import Identifier
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import MOTION_KINDS, JointType, Robot
from urdfsync.modelica.tree import KnownStatements, SyntaxTree, is_same
from urdfsync.modelica.values import literals

ComponentKind: TypeAlias = Literal[
    "link", "fixed", "rotational", "translational", "free", "ball", "coupling", "sensor", "loop", "own", "changed"
]
_Entry: TypeAlias = tuple[ComponentKind, str, float, int, float]
"""Entry of the legend: kind of icon, text, place (x, y), and width."""

# Pixels of one unit of the diagram: at 100 %, the smallest text is 10 pixels high. So the picture grows with the robot.
_PIXELS = 4
_MARGIN = 10
_HEADER = 24  # Room for the title and the names of the connectors at the top.
_FOOTER, _LEGEND = 8, 10  # Space above the legend, and height of each row of the legend.
_FONT, _SMALLEST = 3.6, 2.5
_ADVANCE = 0.56  # Mean width of a character, by font size.
_BEND = 2.0  # Radius of the bends of flange lines: they show that a line joins another line and does not cross it.

_LEGENDS: Mapping[ComponentKind, str] = {
    "link": "link, mass",
    "fixed": "fixed joint",
    "rotational": "rotational joint",
    "translational": "translational joint",
    "free": "planar or floating joint",
    "ball": "ball joint",
    "coupling": "mimic coupling, ratio",
    "sensor": "sensor",
    "loop": "joint that closes a loop",
    "own": "not in the source",
    "changed": "differs from the source",
}
_MASS = "inertial", "mass"
_OTHERS: Mapping[JointType, ComponentKind] = {"fixed": "fixed", "ball": "ball"}


class _Part(NamedTuple):
    """A component with an icon."""

    kind: ComponentKind
    text: str = ""
    """Text in the icon: mass, ratio, or the class of a user's component."""
    is_driven: bool = False


def draw(robot: Robot, target: Target, options: Options, differing: Mapping[str, tuple[str, str]]) -> str:
    """Return the diagram of the robot model on disk as SVG, with masses and ratios.

    `differing` is as `urdfsync.domain.features.Drawing` says.
    """
    assembly = Assembly(robot, options, target)
    names = assembly.connectors
    diagram, files, notes = layout(assembly.tree, names), _files(assembly), list[str]()
    path, frame_a = f"{target.name}.mo", {"frame_a": diagram.placements["frame_a"]}
    statements: KnownStatements = {}  # both texts have most of their statements in common
    source, model = (read_model(text, frame_a, statements) for text in differing.get(path, ("", "")))
    parts = dict(_parts(assembly, differing, model))
    changed = {name for name in parts if not differing.keys().isdisjoint(files.get(name, ()))}
    if source and model:
        both = [(name, source.components.get(name), model.components.get(name)) for name in parts]
        changed |= {name for name, old, new in both if old and new and not is_same(old, new, layout=False)}
        own = model.components.keys() - diagram.placements.keys()
        parts |= {name: _Part("own", _class_name(model.components[name])) for name in sorted(own)}
        if absent := [name for name in diagram.placements if name not in model.diagram.placements]:
            notes.append(f"in the source, but not in {path}: {', '.join(absent)}")
        diagram = model.diagram
    elif path in differing:
        notes.append(f"{path} can't be read: this is the diagram of the source")
    parts = {name: part for name, part in parts.items() if name in diagram.placements}
    kinds: set[ComponentKind] = {part.kind for part in parts.values()} | (
        {"changed"} if changed & parts.keys() else set()
    )
    x1, y1, x2, y2 = diagram.extent
    legend, bottom = _legend(kinds, (x1, -y1 + _FOOTER), x2 + _MARGIN)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
        autoescape=True,
    )
    environment.filters |= {"number": "{:.9g}".format, "fit": _fit, "printable": _printable}
    return environment.get_template("diagram.svg.jinja").render(
        title=target.package,
        pixels=_PIXELS,
        font=_FONT,
        left=x1 - _MARGIN,
        top=-y2 - _HEADER,
        width=x2 - x1 + 2 * _MARGIN,
        height=bottom + y2 + _HEADER + _LEGEND * len(notes),
        extent=diagram.extent,
        lines=_lines(diagram),
        junctions=_junctions(diagram),
        placements={
            name: box for name, box in diagram.placements.items() if name not in ("sensorParameters", "startPositions")
        },
        parts=parts,
        changed=changed,
        notes=[(note, bottom + row * _LEGEND) for row, note in enumerate(notes)],
        axes={drive.axis: drive.motion for drive in names.drives.values()}
        | {drive.motor: "rotational" for drive in names.drives.values() if drive.motor},
        supports={drive.support: drive.motion for drive in names.drives.values()},
        sensor_frames=set(names.sensor_frames.values()),
        legend=legend,
    )


def _files(assembly: Assembly) -> dict[str, tuple[str, str]]:
    """Return model and record of each link, joint and loop, by its component."""
    return {
        name.component: (f"{folder}/{name.type}.mo", f"{folder}/{name.record}.mo")
        for (kind, _), name in assembly.tree.names.items()
        for folder in ["Links" if kind == "link" else "Joints"]
    }


def _class_name(declaration: SyntaxTree) -> str:
    """Return the last name of a component's class."""
    return re.split(r"[.\s]", type_of(declaration))[-1]


def _parts(
    assembly: Assembly, differing: Mapping[str, tuple[str, str]], model: ModelText | None
) -> Iterator[tuple[str, _Part]]:
    """Yield the components of links, joints, couplings, sensors and loops."""
    tree, names, files = assembly.tree, assembly.connectors, _files(assembly)

    def number(name: Identifier, value: float | None, *path: str) -> str:
        """Return a number of an element's record as the package on disk has it; empty without a number."""
        component = model.components.get(name.component) if model else None
        texts = [differing.get(file, ("", ""))[1] for file in files[name.component]]
        expression = next(filter(None, _expressions(name, component, *texts, *path)), "")
        numbers = literals(expression)
        if isinstance(numbers, tuple) and len(numbers) == 1:
            (value,) = numbers
            expression = ""
        return "" if value is None else expression or _rounded(value)

    for link in tree.links:
        mass = number(tree.link(link.name), link.inertial.mass if link.inertial else None, *_MASS)
        yield tree.link(link.name).component, _Part("link", mass and f"{mass} kg")
    types = {joint.name: joint.type for joint in tree.joints}
    for joint in tree.joints:
        kind: ComponentKind = MOTION_KINDS.get(joint.type) or _OTHERS.get(joint.type, "free")
        yield tree.joint(joint.name).component, _Part(kind, is_driven=joint.name in names.drives)
    for joint, mimic in tree.followers():
        ratio = f"× {number(tree.joint(joint.name), mimic.multiplier, 'mimic', 'multiplier')}"
        yield names.couplings[joint.name], _Part("coupling", ratio if types[mimic.joint] in MOTION_KINDS else "held")
    yield from ((drive.gear, _Part("coupling", "gear")) for drive in names.drives.values() if drive.gear)
    yield from ((component, _Part("sensor")) for component in names.sensors.values())
    yield from ((tree.loop(loop.name).component, _Part("loop")) for loop in tree.loops)


def _expressions(name: Identifier, component: SyntaxTree | None, model: str, record: str, *path: str) -> Iterator[str]:
    """Yield the expressions of a number in the texts on disk, the outermost first; `?` if a text has another form.

    `component` is the declaration in the robot model. `model` and `record` are empty if they are as generated.
    """
    if component:
        yield find(component, "parameters", *path)
        yield "" if _class_name(component) == name.type else "?"
    if model and path == _MASS:
        expression = find_in(model, "component body", "m")
        yield "" if expression == f"parameters.{'.'.join(_MASS)}" else expression or "?"
    if record:
        yield find_in(record, "extends", *path) or "?"


def _rounded(value: float) -> str:
    """Return a number with three digits, without an exponent up to 999,999."""
    return f"{float(f'{value:.3g}'):g}"


def _lines(diagram: Diagram) -> Mapping[str, list[str]]:
    """Return one path for all lines of a style, so that a shared trunk is painted once."""
    styles = defaultdict[str, list[str]](list)
    for ends, (kind, points) in diagram.lines.items():
        style = kind + (" support" if any(end.endswith(".support") for end in ends) else "")
        styles[style].append(_curved(points, 0 if kind == "frame" else _BEND))
    return styles


def _curved(points: LinePath, radius: float) -> str:
    """Return path data of a polyline. Each bend is rounded, up to the middle of its shorter side."""
    data = [f"M{points[0][0]} {-points[0][1]}"]
    for before, (x, y), after in zip(points, points[1:], points[2:], strict=False):
        sides = [(a - x, b - y, math.hypot(a - x, b - y)) for a, b in (before, after)]
        reach = min(radius, *(length / 2 for *_, length in sides))
        (x1, y1), (x2, y2) = ((x + reach * dx / length, y + reach * dy / length) for dx, dy, length in sides)
        # a difference, since `-y1` would be written as -0
        data.append(f"L{x1:.9g} {0 - y1:.9g}" + (f"Q{x} {-y} {x2:.9g} {0 - y2:.9g}" if reach else ""))
    data.append(f"L{points[-1][0]} {-points[-1][1]}")
    return "".join(data)


def _junctions(diagram: Diagram) -> list[tuple[str, Point]]:
    """Return the points where three or more segments of a net meet. A net has lines of one kind with one common end."""
    uses = Counter(end for ends in diagram.lines for end in ends)
    nets = defaultdict[tuple[str, str], list[LinePath]](list)
    for ends, (kind, points) in diagram.lines.items():
        nets[kind, max(ends, key=uses.__getitem__)].append(points)
    junctions: list[tuple[str, Point]] = []
    for (kind, _), paths in nets.items():
        across, upright = (defaultdict[int, set[tuple[int, int]]](set) for _ in range(2))
        for (x1, y1), (x2, y2) in (sorted(pair) for path in paths for pair in itertools.pairwise(path)):
            if y1 == y2:
                across[y1].add((x1, x2))
            elif x1 == x2:
                upright[x1].add((y1, y2))
        for x, y in {point for path in paths for point in path}:
            # Coordinates are whole, so no segment ends half a step beside a point.
            sides = [(across[y], x - 0.5), (across[y], x + 0.5), (upright[x], y - 0.5), (upright[x], y + 0.5)]
            ways = [any(start < step < end for start, end in segments) for segments, step in sides]
            if sum(ways) > 2:
                junctions.append((kind, (x, y)))
    return sorted(junctions)


def _legend(kinds: Collection[ComponentKind], start: Point, right: float) -> tuple[list[_Entry], int]:
    """Return the entries of the legend, in as many rows as needed, and the lower end of the legend."""
    entries: list[_Entry] = []
    x, y = float(start[0]), start[1]
    for kind, text in _LEGENDS.items():
        room = 15 + _width(text, _FONT)
        if kind not in kinds:
            continue
        if x > start[0] and x + room > right:
            x, y = float(start[0]), y + _LEGEND
        entries.append((kind, text, x, y, room))
        x += room
    return entries, y + _LEGEND


def _fit(text: str, size: float, room: float) -> tuple[str, str]:
    """Return a text and its font size. A text longer than `room` gets smaller letters, then loses its middle."""
    fitting = max(min(size, size * room / _width(text, size)), min(size, _SMALLEST))
    most = max(3, int(room / _width("x", fitting) + 1e-9))
    if len(text) > most:
        text = f"{text[: most // 2]}…{text[len(text) - (most - 1) // 2 :]}"
    return text, f"{fitting:.3g}"


def _width(text: str, size: float) -> float:
    return size * _ADVANCE * len(text)


def _printable(text: str) -> str:
    """Replace unprintable characters by spaces, since XML forbids some of them."""
    return "".join(char if char.isprintable() else " " for char in text)
