"""Diagrams as the texts of generated packages have them: nothing overlaps, and lines end where they should."""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest
from support import corpus
from support.annotations import Call, statements
from support.modelica import URDFSYNC
from support.packages import Package, generate, proposed_base, read
from support.urdfs import dynamics, joint, limit, link, robot

from urdfsync.domain import Target

Point = tuple[float, float]
Box = tuple[float, float, float, float]
"""Left, bottom, right, top."""

STANDARD: Box = (-100, -100, 100, 100)
"""Coordinate system of an icon, and of a diagram that says nothing."""

TWO_FRAMES = {"frame_a": (-100.0, 0.0), "frame_b": (100.0, 0.0)}
MOVED = {"flange": (100.0, 0.0), "support": (0.0, -100.0)}
STANDARD_LIBRARY: Mapping[str, Mapping[str, Point]] = {
    "Mechanics.MultiBody.Interfaces.PartialOneFrame_a": {"frame_a": (-100, 0)},
    "Mechanics.MultiBody.Interfaces.PartialTwoFrames": TWO_FRAMES,
    "Mechanics.MultiBody.Joints.FreeMotion": TWO_FRAMES,
    "Mechanics.MultiBody.Joints.Prismatic": TWO_FRAMES | {"axis": (80, 60), "support": (-40, 60)},
    "Mechanics.MultiBody.Joints.Revolute": TWO_FRAMES | {"axis": (0, 100), "support": (-60, 100)},
    "Mechanics.MultiBody.Parts.Body": {"frame_a": (-100, 0)},
    "Mechanics.MultiBody.Parts.FixedRotation": TWO_FRAMES,
    "Mechanics.MultiBody.World": {"frame_b": (100, 0)},
    "Mechanics.Rotational.Interfaces.PartialTwoFlanges": {"flange_a": (-100, 0), "flange_b": (100, 0)},
    "Mechanics.Rotational.Sources.Accelerate": MOVED | {"a_ref": (-120, 0)},
    "Mechanics.Rotational.Sources.Position": MOVED | {"phi_ref": (-120, 0)},
    "Mechanics.Translational.Interfaces.PartialTwoFlanges": {"flange_a": (-100, 0), "flange_b": (100, 0)},
    "Mechanics.Translational.Sources.Accelerate": MOVED | {"a_ref": (-120, 0)},
    "Mechanics.Translational.Sources.Position": MOVED | {"s_ref": (-120, 0)},
    "Blocks.Interfaces.MO": {"y": (110, 0)},
    "Blocks.Sources.Cosine": {"y": (110, 0)},
}
"""Where classes of the standard library have their connectors, on their icons."""


@dataclasses.dataclass(frozen=True)
class Component:
    """A component with a place; `icon` is where it stands on the icon of its class, if it is a connector."""

    name: str
    type: str
    box: Box
    icon: Box

    @property
    def is_connector(self) -> bool:
        """Whether it stands on the border of its class."""
        return ".Interfaces." in self.type


@dataclasses.dataclass(frozen=True)
class Line:
    """A connection as it is drawn."""

    start: str
    end: str
    points: tuple[Point, ...]


@dataclasses.dataclass(frozen=True)
class Diagram:
    """What a class shows, with all that it inherits."""

    extent: Box
    icon: Box
    """Coordinate system of the icon: an instance in another diagram is this, scaled to its place."""
    components: tuple[Component, ...]
    lines: tuple[Line, ...]
    ports: Mapping[str, Point]
    """Connectors on the icon of this class."""


Find = Callable[[str], Diagram]


def of_package(package: Package) -> Mapping[str, Diagram]:
    """The diagram of every model of a package, by path."""

    @functools.cache
    def find(name: str) -> Diagram:
        path = f"{name.replace('.', '/')}.mo"
        return drawn(package.texts[path], find) if path in package.texts else library_diagram(name)

    return {path: drawn(text, find) for path, text in package.models.items() if "\nmodel " in text}


@functools.cache
def library_diagram(name: str) -> Diagram:
    """The diagram of a class of UrdfSync; of a class of the standard library its connectors only."""
    if name.startswith("Modelica."):
        return Diagram(STANDARD, STANDARD, (), (), STANDARD_LIBRARY.get(name.removeprefix("Modelica."), {}))
    path = URDFSYNC.parent / f"{name.replace('.', '/')}.mo"
    return drawn(path.read_text("utf-8"), library_diagram)


def drawn(text: str, find: Find) -> Diagram:
    """The diagram of the class in `text`; `find` gives those of the classes that it refers to."""
    extent = icon = STANDARD
    components: list[Component] = []
    lines: list[Line] = []
    ports: dict[str, Point] = {}
    for statement, note in statements(text):
        first = statement[0] if statement else ""
        if first == "extends":
            base = find(type_name(statement[1:]))
            extent, icon = base.extent, base.icon
            ports |= base.ports
            components += base.components
            lines += base.lines
        elif first == "connect":
            ends = "".join(statement[2:-1])
            while "[" in ends:  # all connectors of a vector stand in one place
                ends = re.sub(r"\[[^\[\]]*\]", "", ends)
            start, end = ends.split(",")
            lines.append(Line(start, end, tuple((x, y) for x, y in note.get("Line").get("points"))))
        elif not statement:
            whole, shown = note.get("Diagram", Call()), note.get("Icon", Call())
            extent, icon = (
                extent_of(whole.get("coordinateSystem")) or extent,
                extent_of(shown.get("coordinateSystem")) or icon,
            )
        elif place := note.get("Placement"):
            box, kind = extent_of(place.get("transformation")) or STANDARD, type_name(statement)
            name = statement[2 * kind.count(".") + 1]
            components.append(Component(name, kind, box, extent_of(place.get("iconTransformation")) or box))
    ports |= {c.name: center(c.icon) for c in components if c.is_connector}
    return Diagram(extent, icon, tuple(components), tuple(lines), ports)


def port(diagram: Diagram, reference: str, find: Find) -> Point:
    """Where a connection to `reference` has to end: a connector of the class, or one of a component."""
    name, _, connector = reference.partition(".")
    component = next((c for c in diagram.components if c.name == name), None)
    if component is None:
        return diagram.ports[reference]  # inherited from a class of the standard library: there icon and diagram agree
    if not connector:
        return center(component.box)
    shown = find(component.type)
    x, y = shown.ports[connector]
    left, bottom, right, top = component.box
    x1, y1, x2, y2 = shown.icon
    return left + (x - x1) / (x2 - x1) * (right - left), bottom + (y - y1) / (y2 - y1) * (top - bottom)


def overlaps(components: Sequence[Component]) -> list[tuple[str, str]]:
    """Pairs of components that share more than a border."""
    found = []
    by_left = sorted(components, key=lambda component: component.box[0])
    for number, one in enumerate(by_left):
        for other in by_left[number + 1 :]:
            if other.box[0] >= one.box[2]:
                break
            if one.box[1] < other.box[3] and other.box[1] < one.box[3]:
                found.append((one.name, other.name))
    return found


def type_name(statement: Sequence[str]) -> str:
    """The name with all its dots that begins here."""
    end = 1
    while statement[end : end + 1] == ["."]:
        end += 2
    return "".join(statement[:end])


def extent_of(owner: Call | None) -> Box | None:
    """The extent of a coordinate system or of a transformation, if there is one."""
    if owner is None:
        return None
    (x1, y1), (x2, y2) = owner.get("extent")
    return min(x1, x2), min(y1, y2), max(x1, x2), max(y1, y2)


def center(box: Box) -> Point:
    return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2


# --- Generated packages


BOT = Target("Bot", "Bot")
SOURCES = corpus.by_source(corpus.distinct_files())

OWN = robot(
    link("base", 1.0),
    *(link(f"part{k}", 1.0) for k in range(6)),
    joint("skate", "planar", "base", "part0", axis="0 0 1", inside=[dynamics(1, 2)]),
    joint("glide", "planar", "base", "part1", axis="0 0 1"),
    joint("air", "floating", "part0", "part2"),
    joint("turn", "continuous", "part0", "part3", inside=[dynamics(1, 2)]),
    joint("slide", "prismatic", "part0", "part4", inside=[limit(), dynamics(1, 2)]),
    joint("bare", "prismatic", "part4", "part5", inside=[limit()]),
)
"""Joints that the corpus does not have."""


def assert_well_drawn(package: Package, place: str) -> None:
    diagrams = of_package(package)
    names = {path.removesuffix(".mo").replace("/", "."): one for path, one in diagrams.items()}

    def find(name: str) -> Diagram:
        return names.get(name) or library_diagram(name)

    for path, shown in diagrams.items():
        assert overlaps(shown.components) == [], f"{place}: {path}"
        assert outside(shown) == [], f"{place}: {path}"
        assert astray(shown, find) == [], f"{place}: {path}"


def outside(shown: Diagram) -> list[str]:
    """Components and lines that leave the diagram's extent; a connector may stand on it, so its centre counts."""
    shapes: list[tuple[str, Sequence[Point]]] = [
        (c.name, (center(c.box),) if c.is_connector else (c.box[:2], c.box[2:])) for c in shown.components
    ]
    shapes += [(f"{line.start} to {line.end}", line.points) for line in shown.lines]
    left, bottom, right, top = shown.extent
    return [name for name, points in shapes if not all(left <= x <= right and bottom <= y <= top for x, y in points)]


def astray(shown: Diagram, find: Find) -> list[str]:
    """Connectors that a connection names and its line does not reach."""
    ends = [end for line in shown.lines for end in ((line.start, line.points[0]), (line.end, line.points[-1]))]
    return [reference for reference, point in ends if port(shown, reference, find) != pytest.approx(point)]


def versions(files: Sequence[str], folder: Path) -> list[tuple[str, bytes]]:
    """The files that a package can be made of."""
    contents = [(file, (folder / file).read_bytes()) for file in files]
    return [(file, content) for file, content in contents if read(content).snapshot is not None]


@pytest.mark.parametrize("files", SOURCES.values(), ids=SOURCES)
def test_diagrams_of_the_corpus_are_well_drawn(files: Sequence[str], corpus: Path) -> None:
    """The last version of each robot, as `init` proposes it."""
    for file, content in versions(files, corpus)[-1:]:
        assert_well_drawn(generate(corpus / file, BOT, base=proposed_base(content)), file)


@pytest.mark.parametrize("visualizer", ["standard", "visualization2"])
def test_diagrams_of_all_joints_are_well_drawn(visualizer: str) -> None:
    assert_well_drawn(generate(OWN.encode(), BOT, visualizer=visualizer), "own")


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("{{2, -130}, {2, -120}}", "{{2, -130}, {3, -120}}", "slideAxis"),
        ("{{2, -130}, {2, -120}}", "{{2, -129}, {2, -120}}", "slide.axis"),
        ("extent={{-116, -262}, {132, 18}}", "extent={{-116, -262}, {120, 18}}", "part1Frame"),
        ("extent={{-8, -150}, {12, -130}}", "extent={{8, -150}, {32, -130}}", "slide"),
    ],
)
def test_what_is_badly_drawn_is_noticed(old: str, new: str, what: str) -> None:
    package = generate(OWN.encode(), BOT)
    text = package.texts["Bot.mo"]
    assert old in text
    texts = {**package.texts, "Bot.mo": text.replace(old, new, 1)}
    with pytest.raises(AssertionError, match=re.escape(what)):
        assert_well_drawn(dataclasses.replace(package, texts=texts), "own")
