"""Edits by hand, one at a time, and then the next export of a real history: how often they meet without a conflict.

`URDFSYNC_REPLAYS=2000` sets the number of exports. The counts are printed.
"""

from __future__ import annotations

import collections
import functools
import itertools
import re
import shutil
from collections.abc import Iterator, Sequence, Set
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from pymoca import ast
from pymoca import parser as pymoca
from support import replay
from support.hand_edits import EDITS, MARK
from support.modelica import compile_task, execute
from support.packages import read
from support.replay import Fresh, Project

from urdfsync.engine.actions import Reason
from urdfsync.engine.result import Result
from urdfsync.modelica.parser import parse

STEPS = replay.STEPS or 18
LARGEST = 60 if replay.STEPS else 20
"""Links that a robot has at most; larger ones take seconds a step."""

COMPILED = ("add a component", "add a connection", "add an equation", "move a part", "save again in another style")
"""Edits after which a package compiles."""

pytestmark = pytest.mark.slow


def steps(random: Random) -> Iterator[tuple[bytes, bytes]]:
    """Exports of the histories that follow each other and differ, in random order, without end."""
    pairs = [
        (old, new)
        for versions in replay.histories().values()
        for old, new in itertools.pairwise(versions)
        if old != new and max(old.count(b"<link"), new.count(b"<link")) <= LARGEST
    ]
    while True:
        yield random.choice(pairs)


@functools.cache
def readable(version: bytes) -> bool:
    """Whether a build of this export is not refused when it is read."""
    return read(version).snapshot is not None


@functools.lru_cache(10_000)
def elements(text: str) -> Set[str]:
    """What a class declares, connects and extends, as another parser reads it."""
    tree = pymoca.parse(text, bypass_cache=True)
    assert tree is not None
    found: set[str] = set()
    classes = list(tree.classes.values())
    for one in classes:
        found.update(one.symbols)
        found.update(f"extends {base.component}" for base in one.extends)
        clauses = (clause for clause in one.equations if isinstance(clause, ast.ConnectClause))
        found.update(" -- ".join(sorted(map(str, (clause.left, clause.right)))) for clause in clauses)
        classes += one.classes.values()
    return found


def conflicts(result: Result) -> Sequence[tuple[str, str]]:
    """Why files conflict, and what about."""
    found = []
    for one in result.conflict_texts:
        if one.merge is None or one.rejected:
            found.append(("refused", one.rejected or "no base"))
        else:
            found += [("contradiction", words) for words in one.merge.contradictions[:1]]
    return found


class Trial(NamedTuple):
    """A file that was edited, and built again from the next export."""

    result: Result
    base: str
    edited: str
    generated: str
    path: Path


class Exports:
    """Projects with one build of an export, and the packages of fresh builds; each is built once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._projects: dict[bytes, Project | None] = {}
        self._fresh: dict[str, Fresh] = {}

    def package(self, content: bytes, base: str) -> replay.Files:
        """The files of a fresh build; none where the export is refused."""
        return self._fresh.setdefault(base, Fresh(self._folder / "fresh" / base, base))(content)[0]

    def project(self, content: bytes, folder: Path) -> Project | None:
        """A project in a folder, in step with an export; None where that is refused."""
        if content not in self._projects:
            built = Project(self._folder / str(len(self._projects)), replay.base_of([content]))
            built.configure('on_conflict = "merge"\n')
            built.save(content)
            self._projects[content] = None if built.build().failed else built
        built_before = self._projects[content]
        return built_before and built_before.clone(folder)


def trial(exports: Exports, folder: Path, old: bytes, new: bytes, kind: str, random: Random) -> Trial | None:
    """Build an export, edit a file of the package, and build the next one; None if nothing can be edited so."""
    if not (readable(old) and readable(new)):
        return None
    project, changed = exports.project(old, folder), exports.package(new, replay.base_of([old]))
    if project is None:
        return None
    # an edit that the export does not touch never conflicts; half of them are made in the models of the robot
    names = [name for name, text in project.files().items() if name.endswith(".mo") and changed.get(name, b"") != text]
    files = [project.package / name for name in names if not name.endswith("package.mo")]
    tops = [path for path in files if path.parent == project.package]
    if not files:
        return None
    path = random.choice(tops if tops and random.random() < 0.5 else files)
    text = path.read_text()
    edited = EDITS[kind](text, random)
    if edited is None or edited == text:
        return None
    assert not parse(edited).faults, (kind, edited)
    path.write_text(edited)
    project.save(new)
    result = project.build()
    generated = changed.get(path.relative_to(project.package).as_posix(), b"").decode()
    return None if result.failed else Trial(result, text, edited, generated, path)


def test_edits_and_exports_meet(corpus: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    random, tally = Random(replay.SEED), collections.Counter[tuple[str, str]]()
    reasons = collections.Counter[str]()
    source, number, exports = steps(random), 0, Exports(tmp_path / "exports")
    with replay.in_haste():
        while number < STEPS:
            kind = list(EDITS)[number % len(EDITS)]
            old, new = next(source)
            shutil.rmtree(tmp_path / "project", ignore_errors=True)
            done = trial(exports, tmp_path / "project", old, new, kind, random)
            if done is None:
                continue
            number += 1
            found = conflicts(done.result)
            tally[kind, "steps"] += 1
            tally[kind, found[0][0] if found else "met"] += 1
            reasons.update(f"{kind}: {why}: {what}" for why, what in found)
            if not found and done.path.is_file() and done.generated:
                check(done, kind)
    lines = [
        f"{kind}: " + ", ".join(f"{what} {count}" for (of, what), count in sorted(tally.items()) if of == kind)
        for kind in EDITS
    ]
    lines += [f"{count} {reason}" for reason, count in reasons.most_common()]
    with capsys.disabled():
        print("", *lines, sep="\n")  # noqa: T201
    refused = sum(count for (_, what), count in tally.items() if what == "refused")
    assert refused <= 0.02 * STEPS


def test_merged_packages_compile(corpus: Path, modelica_library: Path, tmp_path: Path) -> None:
    """What does not compile before the merge is left out: other types, and names that other models use."""
    random, source, number = Random(replay.SEED), steps(Random(replay.SEED)), 0
    merged, exports = 0, Exports(tmp_path / "exports")
    while merged < max(2, replay.STEPS // 10):
        number += 1
        old, new = next(source)
        kind = COMPILED[number % len(COMPILED)]
        project = tmp_path / str(number) / "project"
        with replay.in_haste():
            done = trial(exports, project, old, new, kind, random)
        if done and not done.result.conflicts and any(one.reason is Reason.MERGE for one in done.result.actions):
            merged += 1
            tasks = [compile_task(f"Bot.{model}") for model in ("BotRun", "BotTest")]
            outcomes = execute(modelica_library, [project / replay.PACKAGE], tasks)
            assert [outcome.error for outcome in outcomes] == ["", ""], (kind, project)


def check(done: Trial, kind: str) -> None:
    """Nothing that was edited by hand is lost, and nothing that the export has; but what was renamed by hand."""
    merged = done.path.read_text()
    assert not parse(merged).faults
    marks = rf"7171\.5|{MARK}\.\w+"
    assert set(re.findall(marks, done.edited)) <= set(re.findall(marks, merged))
    base, edited, generated, now = map(elements, (done.base, done.edited, done.generated, merged))
    if kind == "rename a part":
        new = next(name for name in edited - base if name.startswith(MARK) and " " not in name)
        assert new in now or new.removeprefix(f"{MARK}_") not in generated
        return
    ends = {end for one in now for end in one.split(" -- ")}
    for one in edited - base - now:
        # a connection by hand goes to the part under its new name
        assert any(end in ends and MARK in end for end in one.split(" -- ")), one
    assert generated <= now
    assert base - generated <= base - now
