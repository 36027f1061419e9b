"""Builds that are killed at random times, with random edits in place: the next build finishes them.

The result equals that of an undisturbed twin. `URDFSYNC_KILLS=300` sets the number of kills, with a new seed.
The test prints its counts. `state/test_crash` has each operation, full disks and saves.
"""

from __future__ import annotations

import collections
import os
import secrets
import select
import shutil
import signal
import time
from pathlib import Path
from random import Random

import pytest
from support import crashes
from support.crashes import Operation, contents, run

from urdfsync.engine.result import Result
from urdfsync.project.state.transaction import find_leftovers

KILLS = int(os.environ.get("URDFSYNC_KILLS", "20"))
SEED = secrets.randbelow(10**9) if "URDFSYNC_KILLS" in os.environ else 20
SAME = 10
"""The number of kills of one project with one change."""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system"),
]


def build_in_child(project: Path) -> tuple[int, int]:
    """Build in another process; return the process id, and a pipe that gets a byte at the first file operation."""
    reader, writer = os.pipe()

    def tell(operation: Operation) -> None:
        if operation.number == 1:
            os.write(writer, b".")

    child = crashes.forked(project, tell)
    os.close(writer)
    return child, reader


def duration(project: Path) -> tuple[float, float]:
    """Seconds of an undisturbed build in a process of its own, and from its first operation on."""
    started = time.monotonic()
    child, pipe = build_in_child(project)
    os.read(pipe, 1)
    writing = time.monotonic()
    os.close(pipe)
    os.waitpid(child, 0)
    return time.monotonic() - started, time.monotonic() - writing


def kill(project: Path, seconds: tuple[float, float], random: Random) -> None:
    """Build, and kill the build at a random time: half of the times count from its start, half from its first write."""
    whole, writing = seconds
    child, pipe = build_in_child(project)
    if random.random() < 0.5:
        time.sleep(random.uniform(0, whole))
    else:
        select.select([pipe], [], [], 60)
        time.sleep(random.uniform(0, writing))
    os.close(pipe)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)


def conflicts(result: Result) -> set[str]:
    assert not result.failed, result.diagnostics
    return {each.action.path for each in result.conflicts}


def test_a_build_that_is_killed_at_any_time_is_finished(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    random, tally = Random(SEED), collections.Counter[str]()
    for number in range(KILLS):
        if number % SAME == 0:
            shutil.rmtree(tmp_path / "original", ignore_errors=True)
            make = crashes.moved_at_random if number % (2 * SAME) else crashes.edited_at_random
            make(tmp_path / "original", random)
            twin = crashes.copy(tmp_path / "original", tmp_path / "twin")
            wanted = conflicts(run(twin)), contents(twin)
            seconds = duration(crashes.copy(tmp_path / "original", tmp_path / "work"))
        project = crashes.copy(tmp_path / "original", tmp_path / "work")
        for _ in range(random.choice((1, 1, 1, 2))):  # a build that finishes another one may be killed, too
            kill(project, seconds, random)
            tally["kills"] += 1
            tally["halfway"] += bool(find_leftovers(path for path in project.rglob("*") if path.is_dir()))
        assert (conflicts(run(project)), contents(project)) == wanted, (SEED, number)
        tally["with conflicts"] += bool(wanted[0])
    with capsys.disabled():
        print(f"\n{dict(tally)}")  # noqa: T201
