"""An edit that only adds code, then an export that changes the tree: the result is a fresh package with the addition.

Both approaches at once: the package, and the record of the whole robot. `-m large` takes all robots of the corpus.
"""

from __future__ import annotations

import collections
import functools
import re
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from random import Random

import pytest
from support import corpus as robots_of
from support import replay
from support.packages import read
from support.replay import Project
from support.tree_changes import CHANGES, changed

from urdfsync.modelica.lexer import lex
from urdfsync.modelica.stamp import split
from urdfsync.modelica.tree import comments

GOLDEN = Path(__file__).parent / "golden"
CONFIGURATION = 'on_conflict = "merge"\napproach = ["package", "record"]\n'
SENSOR = (
    "\n\n  Modelica.Blocks.Sources.Constant byHand(k = 3) // byHand\n"
    '    "By hand"\n    annotation (Placement(transformation(extent={{500, 500}, {520, 520}})));'
)
PARAMETER = "\n  parameter Real byHand = 1;"
EQUATION = '\n  assert(time < 1e9, "byHand");'
DRAWING = ',\n      Ellipse(extent={{0, 0}, {1, 1}}, fillColor={7, 7, 7}, textString="byHand")'


def in_front(text: str) -> str | None:
    """Add a parameter before all other statements of the class."""
    found = re.search(r'^(?:record|model) \w+ ".*"', text, re.MULTILINE)
    return found and f"{text[: found.end()]}{PARAMETER}{text[found.end() :]}"


def behind(text: str) -> str | None:
    """Add a component with a place of its own, behind all others."""
    place = next((text.find(word) for word in ("\n\nequation\n", "\n\n  annotation (", "\nend ") if word in text), -1)
    return f"{text[:place]}{SENSOR}{text[place:]}"


def in_the_middle(text: str) -> str | None:
    """Add a parameter behind a component in the middle."""
    *_, body = re.split(r'^(?:record|model) \w+ "', text, maxsplit=1, flags=re.MULTILINE)
    declared = body.partition("\nequation\n")[0].partition("\n  annotation (")[0]
    places = [len(text) - len(body) + found.end() for found in re.finditer(r";(?=\n\n  )", declared)]
    place = places[len(places) // 2] if places else None
    return f"{text[:place]}{PARAMETER}{text[place:]}" if place else None


def equation(text: str) -> str | None:
    """Add an equation behind all others."""
    head, word, rest = text.partition("\nequation\n")
    place = rest.rfind("\n\n  annotation (")
    return f"{head}{word}{rest[:place]}{EQUATION}{rest[place:]}" if word and place >= 0 else None


def drawing(text: str) -> str | None:
    """Add graphics to the icon, on top of all others."""
    place = text.rfind(")}),\n    Diagram(")
    return f"{text[: place + 1]}{DRAWING}{text[place + 1 :]}" if "\n    Icon(" in text and place >= 0 else None


ADDITIONS = {
    in_front: PARAMETER, behind: SENSOR, in_the_middle: PARAMETER, equation: EQUATION, drawing: DRAWING,
}  # fmt: skip


def words(text: str) -> list[str]:
    """The words of a text, comments included."""
    return [*(token.text for token in lex(text)[0]), *comments(text)]


class Robots:
    """Projects of one robot in a work folder: each is built once."""

    def __init__(self, work: Path, content: bytes) -> None:
        self.base = replay.base_of([content])
        self.work = work
        self._fresh: dict[bytes, Mapping[str, str]] = {}

    def project(self, name: str, content: bytes) -> Project | None:
        """A new project with a build; None if the build refuses the source."""
        shutil.rmtree(self.work / name, ignore_errors=True)
        project = Project(self.work / name, self.base)
        project.configure(CONFIGURATION)
        project.save(content)
        return None if project.build().failed else project

    def fresh(self, content: bytes) -> Mapping[str, str]:
        """The texts of a freshly built package; none if the build refuses the source."""
        if content not in self._fresh:
            built = self.project("fresh", content)
            self._fresh[content] = texts(built) if built else {}
        return self._fresh[content]


def texts(project: Project) -> dict[str, str]:
    """The classes of a package by their files."""
    return {path: text.decode() for path, text in project.files().items() if path.endswith(".mo")}


def differences(content: bytes, work: Path, random: Random, tally: collections.Counter[str]) -> Iterator[str]:
    """The differences of a package with additions, after an export, from the fresh package with these additions."""
    if read(content).snapshot is None:
        tally["robots that are refused"] += 1
        return
    robots = Robots(work, content)
    for kind in CHANGES:
        export = changed(content, kind, random)
        fresh = robots.fresh(export) if export else {}
        project = robots.project("project", content) if fresh else None
        if not (project and export):
            tally[f"{kind}: nothing to change so, or refused"] += 1
            continue
        edits = {}
        for path, text in texts(project).items():
            edit = random.choice(list(ADDITIONS))
            edited = None if path.endswith("package.mo") else edit(text)
            if edited:
                (project.package / path).write_text(edited)
                edits[path] = edit
        project.save(export)
        result = project.build()
        if result.failed or result.conflicts:
            yield f"{kind}: {result.diagnostics} {[one.action.path for one in result.conflicts]}"
            continue
        merged = {path: split(text)[0] for path, text in texts(project).items()}
        for path, stamped in fresh.items():
            text, _ = split(stamped)
            without = functools.reduce(lambda rest, one: rest.replace(one, ""), ADDITIONS.values(), merged[path])
            tally[f"{kind}: files with an addition"] += without != merged[path]
            if path in edits and merged[path].count(ADDITIONS[edits[path]]) != 1:
                yield f"{kind}: {path} lost its addition ({edits[path].__name__})"
            elif words(without) != words(text):
                yield f"{kind}: {path} differs ({edits[path].__name__ if path in edits else 'moved or not edited'})"


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["twig.urdf", pytest.param("menagerie.urdf", marks=pytest.mark.large)])
def test_an_addition_meets_any_export(robot: str, tmp_path: Path) -> None:
    found = list(differences((GOLDEN / robot).read_bytes(), tmp_path, Random(5), collections.Counter()))
    assert found == []


@pytest.mark.slow
@pytest.mark.large
def test_additions_meet_the_exports_of_all_robots(
    corpus: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    random, tally, found = Random(replay.SEED), collections.Counter[str](), []
    for robot in robots_of.robots():
        one = differences((corpus / robot).read_bytes(), tmp_path / robots_of.label(robot), random, tally)
        found += [f"{robot}: {what}" for what in one]
    with capsys.disabled():
        print("", *(f"{what}: {count}" for what, count in sorted(tally.items())), sep="\n")  # noqa: T201
    assert found == []
