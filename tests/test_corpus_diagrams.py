"""The diagrams of the whole corpus, read from the generated texts: nothing overlaps, lines end where they should."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from support import corpus, diagram
from support.diagram import STANDARD, Component, Diagram, Find, corners, is_inside, of_package, overlaps, port
from support.packages import Package, generate, proposed_base, read
from support.urdfs import dynamics, joint, limit, link, robot

from urdfsync.domain import Role, Target

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
    names = {path.removesuffix(".mo").replace("/", "."): drawn for path, drawn in diagrams.items()}

    def find(name: str) -> Diagram:
        return names.get(name) or diagram.library_diagram(name)

    for path, drawn in diagrams.items():
        assert overlaps(drawn.components) == [], f"{place}: {path}"
        assert outside(drawn) == [], f"{place}: {path}"
        assert astray(drawn, find) == [], f"{place}: {path}"


def outside(drawn: Diagram) -> list[str]:
    """Components and lines that leave the diagram's extent."""
    shapes = [(c.name, corners(c)) for c in drawn.components]
    shapes += [(f"{line.start} to {line.end}", line.points) for line in drawn.lines]
    return [name for name, points in shapes if not all(is_inside(point, drawn.extent) for point in points)]


def astray(drawn: Diagram, find: Find) -> list[str]:
    """Connectors that a connection names and its line does not reach."""
    ends = [(line.start, line.points[0]) for line in drawn.lines] + [
        (line.end, line.points[-1]) for line in drawn.lines
    ]
    return [reference for reference, point in ends if port(drawn, reference, find) != pytest.approx(point)]


def versions(files: Sequence[str], folder: Path) -> list[tuple[str, bytes]]:
    """The files that a package can be made of."""
    contents = [(file, (folder / file).read_bytes()) for file in files]
    return [(file, content) for file, content in contents if read(content).snapshot is not None]


@pytest.mark.parametrize("files", SOURCES.values(), ids=SOURCES)
def test_diagrams_of_the_corpus_are_well_drawn(files: Sequence[str], corpus: Path) -> None:
    """The last version of each robot, as `init` proposes it."""
    for file, content in versions(files, corpus)[-1:]:
        assert_well_drawn(generate(corpus / file, BOT, base=proposed_base(content)), file)


@pytest.mark.slow
@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.parametrize("files", SOURCES.values(), ids=SOURCES)
def test_diagrams_of_all_versions_are_well_drawn(files: Sequence[str], base: str, corpus: Path) -> None:
    drawn: set[frozenset[tuple[str, str]]] = set()
    for file, _ in versions(files, corpus):
        package = generate(corpus / file, BOT, base=base)
        models = frozenset((path, text) for path, text in package.models.items() if package.roles[path] != Role.RECORD)
        if models not in drawn:
            assert_well_drawn(package, file)
        drawn.add(models)


@pytest.mark.parametrize("visualizer", ["standard", "visualization2"])
def test_diagrams_of_all_joints_are_well_drawn(visualizer: str) -> None:
    assert_well_drawn(generate(OWN.encode(), BOT, visualizer=visualizer), "own")


def component(name: str, *box: float) -> Component:
    return Component(name, "Some.Type", box, box)  # type: ignore[arg-type]


def test_overlapping_components_are_noticed() -> None:
    one, two, three = component("one", 0, 0, 10, 10), component("two", 10, 0, 20, 10), component("three", 19, 9, 30, 30)
    assert overlaps([three, two, one]) == [("two", "three")]


ROBOT = """
within A;

model Robot "Example with an icon that grows with its connectors"
  Modelica.Mechanics.Rotational.Interfaces.Flange_a elbowAxis
    "Axis"
    annotation (Placement(
      transformation(extent={{-10, 0}, {0, 10}}),
      iconTransformation(extent={{-105, 235}, {-95, 245}})));

  replaceable Joints.Elbow elbow constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
    phi_start = 0.5,
    checkLimits = checkLimits)
    "Joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{40, -10}, {60, 10}})));

equation
  connect(elbow.axis, elbowAxis)
    annotation (Line(points={{50, 10}, {-5, 5}}));

  annotation (Icon(coordinateSystem(extent={{-100, -100}, {100, 250}}), graphics={Line(points={{0, 0}, {1, 1}})}));
end Robot;
"""
BENCH = """
within A;

model Bench "Example with a robot at one and a half times its size"
  extends Robot;

  replaceable Robot robot constrainedby Robot(fixedStart = false)
    annotation (Placement(transformation(extent={{20, -200}, {320, 325}})));

  annotation (Icon(graphics={Line(points={{0, 0}, {1, 1}})}));
end Bench;
"""


def test_an_icon_that_grows_is_scaled_to_its_place() -> None:
    joint = Diagram(STANDARD, STANDARD, (), (), {"axis": (0, 100)})
    robot = diagram.read(ROBOT, lambda name: {"Joints.Elbow": joint}[name])
    assert (robot.extent, robot.icon) == (STANDARD, (-100, -100, 100, 250))
    assert [(c.name, c.type) for c in robot.components][1] == ("elbow", "Joints.Elbow")
    assert astray(robot, lambda name: joint) == []
    bench = diagram.read(BENCH, lambda name: robot)
    assert bench.icon == robot.icon, "inherited, since its own icon says nothing of it"
    assert port(bench, "robot.elbowAxis", lambda name: robot) == (20, 310)
