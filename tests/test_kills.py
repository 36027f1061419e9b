"""Builds that are killed at random times, that meet a full disk and the user's saves, with edits in place.

Each disturbed build is finished by the next one, and the result equals that of a twin that nobody disturbed.
`URDFSYNC_KILLS=300` sets the number of kills; full disks and saves are a third of it each. The counts are printed.
"""

from __future__ import annotations

import collections
import errno
import gc
import itertools
import os
import select
import shutil
import signal
import time
import warnings
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import TypeAlias

import pytest
from support import crashes, edits, replay
from support.crashes import Operation, before_each, contents, run
from support.urdfs import joint, limit, link, robot

from urdfsync.outcome import Result
from urdfsync.state.journal import JournalFolder

Tally: TypeAlias = "collections.Counter[str]"

KILLS = int(os.environ.get("URDFSYNC_KILLS", "40"))
SAME = 10
"""So many disturbances of one project and one change."""
PACKAGE = "modelica/Bot"
MINE = b"\n// saved\n"
CONFIGURATION = '[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\ncross_check = false\n'

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")]


class Scene:
    """A project with edits by hand whose source has changed, and what an undisturbed build makes of it."""

    def __init__(self, folder: Path, random: Random) -> None:
        self._folder, self._original, twin = folder, folder / "original", folder / "twin"
        self._original.mkdir(parents=True)
        (self._original / "urdfsync.toml").write_text(CONFIGURATION)
        self._export(0, [])
        assert not run(self._original).failed
        hand = edits.Hand(random)
        for _ in range(random.randint(1, 5)):
            hand.edit(self._original / PACKAGE)
        run(self._original)
        for _ in range(random.randint(0, 3)):
            hand.edit(self._original / PACKAGE)
        self._export(random.random(), random.sample(["b1", "b2", "b3", "b4", "b5"], random.randint(1, 3)))
        crashes.copy(self._original, twin)
        self.operations = crashes.recorded(crashes.copy(self._original, twin))
        """The file operations of the undisturbed build."""
        self.conflicts = self._paths(run(twin))
        self.wanted = contents(twin)
        self.seconds = self._duration()
        """Duration of the undisturbed build, in a process of its own, and from its first operation."""

    def _export(self, mass: float, renamed: list[str]) -> None:
        """A chain of links, some of which have another name and a sibling more."""
        names = ["base", *(f"{name}x" if name in renamed else name for name in ("b1", "b2", "b3", "b4", "b5"))]
        elements = [link(name, 1.0 + mass * number) for number, name in enumerate(names)]
        ends = itertools.pairwise(names)
        elements += [joint(f"j{n}", "revolute", *pair, axis="0 0 1", inside=[limit()]) for n, pair in enumerate(ends)]
        for name in renamed[1:]:
            elements += [link(f"{name}new", mass), joint(f"{name}j", "fixed", "base", f"{name}new")]
        (self._original / "bot.urdf").write_text(robot(*elements))

    def copy(self) -> Path:
        """A project to disturb."""
        return crashes.copy(self._original, self._folder / "work")

    def assert_healed(self, project: Path, what: object) -> None:
        """The next build comes to what the twin has."""
        result = run(project)
        assert not result.failed, (what, result.diagnostics)
        assert self._paths(result) == self.conflicts, what
        assert contents(project) == self.wanted, what

    @staticmethod
    def _paths(result: Result) -> set[str]:
        return {action.path for action in result.conflicts}

    def _duration(self) -> tuple[float, float]:
        started = time.monotonic()
        child, pipe = _build_in_child(self.copy())
        os.read(pipe, 1)
        writing = time.monotonic()
        os.close(pipe)
        os.waitpid(child, 0)
        return time.monotonic() - started, time.monotonic() - writing


def _build_in_child(project: Path) -> tuple[int, int]:
    """Build in another process; returns its number, and a pipe that has a byte from the first file operation on."""
    reader, writer = os.pipe()

    def tell(operation: Operation) -> None:
        if operation.number == 1:
            os.write(writer, b".")

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # the test runner's threads do not matter to the child
        child = os.fork()
    if child == 0:
        gc.disable()
        try:
            with before_each(tell):
                run(project)
        finally:
            os._exit(0)
    os.close(writer)
    return child, reader


def _kill(project: Path, scene: Scene, random: Random) -> None:
    """Build, and kill that at a random time: half of the times since its start, half since it has begun to write."""
    whole, writing = scene.seconds
    child, pipe = _build_in_child(project)
    if random.random() < 0.5:
        time.sleep(random.uniform(0, whole))
    else:
        select.select([pipe], [], [], 60)
        time.sleep(random.uniform(0, writing))
    os.close(pipe)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)


@pytest.fixture
def random() -> Random:
    return Random(20)


@pytest.fixture
def tally(capsys: pytest.CaptureFixture[str]) -> Iterator[Tally]:
    """Counts of what a test did, which are printed after it."""
    counts: Tally = collections.Counter()
    yield counts
    with capsys.disabled():
        print(f"\n{dict(counts)}")  # noqa: T201


@pytest.fixture(autouse=True)
def _templates_compiled_once() -> Iterator[None]:
    with replay.in_haste():
        yield


def _scenes(folder: Path, random: Random, count: int) -> Iterator[tuple[int, Scene]]:
    """Scenes for so many disturbances; each serves some."""
    scene = None
    for number in range(count):
        if scene is None or number % SAME == 0:
            shutil.rmtree(folder / "scene", ignore_errors=True)
            scene = Scene(folder / "scene", random)
        yield number, scene


def test_a_build_that_is_killed_at_any_time_is_finished(tmp_path: Path, random: Random, tally: Tally) -> None:
    for number, scene in _scenes(tmp_path, random, KILLS):
        project = scene.copy()
        for _ in range(random.choice((1, 1, 1, 2))):  # what finishes a build may be killed, too
            _kill(project, scene, random)
            tally["kills"] += 1
            tally["halfway"] += JournalFolder(project, project / ".urdfsync/journal").phase() is not None
        scene.assert_healed(project, number)
        tally["healed"] += 1
        tally["with conflicts"] += bool(scene.conflicts)


def test_a_build_on_a_full_disk_is_finished_when_there_is_room(tmp_path: Path, random: Random, tally: Tally) -> None:
    for number, scene in _scenes(tmp_path, random, KILLS // 3):
        project, first = scene.copy(), random.randint(1, len(scene.operations))
        lasting = random.random() < 0.5

        def refuse(found: Operation, first: int = first, lasting: bool = lasting) -> None:
            writes = found.name in (*crashes.WRITES, "make_folder", "exchange", "place", "replace")
            if writes and (found.number == first or (lasting and found.number > first)):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(found.paths[0]))

        with before_each(refuse):
            tally["failed"] += run(project).failed
        tally["full disks"] += 1
        tally["halfway"] += JournalFolder(project, project / ".urdfsync/journal").phase() is not None
        scene.assert_healed(project, (number, first))
        tally["healed"] += 1


def test_what_is_saved_during_a_build_survives(tmp_path: Path, random: Random, tally: Tally) -> None:
    """A file is saved before a random operation of the build, and found again after two builds."""
    for number, scene in _scenes(tmp_path, random, KILLS // 3):
        project = scene.copy()
        targets = [
            path
            for op in scene.operations
            for path in op.paths
            if path.suffix == ".mo" and ".urdfsync" not in path.parts
        ]
        target = project / random.choice(targets).relative_to(tmp_path / "scene/twin")
        at, by_renaming, saved = random.randint(1, len(scene.operations)), random.random() < 0.5, b""

        def save(found: Operation, target: Path = target, at: int = at, by_renaming: bool = by_renaming) -> None:
            nonlocal saved
            if found.number == at and target.parent.is_dir():
                saved = (target.read_bytes() if target.exists() else b"") + MINE
                place = target.with_name("editor~") if by_renaming else target
                place.write_bytes(saved)
                place.replace(target)

        with before_each(save):
            assert not run(project).failed, number
        assert not run(project).failed, number
        if saved:
            tally["saves"] += 1
            files = [path for path in project.rglob("*") if path.is_file() and path.read_bytes() == saved]
            assert [path for path in files if ".urdfsync" not in path.parts], (number, at, target)
            tally["conflicts"] += bool(run(project, dry=True).conflicts)
