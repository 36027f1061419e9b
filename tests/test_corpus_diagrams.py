"""The diagrams of the whole corpus, read from the generated texts: nothing overlaps, lines end where they should."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from support import corpus, diagram
from support.diagram import Diagram, Find, corners, is_inside, of_package, overlaps, port
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
