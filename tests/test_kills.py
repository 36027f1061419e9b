"""Builds that are killed at random times, with random edits in place: the next build finishes them.

The result equals that of an undisturbed twin. `URDFSYNC_KILLS=300` sets the number of kills, with a new seed.
The test prints its counts. `state/test_crash` has each operation, full disks and saves.
"""

from __future__ import annotations

import collections
import os
import secrets
import shutil
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pytest
from support import crashes
from support.crashes import contents, run

from urdfsync.engine.result import Result
from urdfsync.project.state.transaction import find_leftovers

KILLS = int(os.environ.get("URDFSYNC_KILLS", "20"))
SEED = secrets.randbelow(10**9) if "URDFSYNC_KILLS" in os.environ else 20
SAME = 10
"""The number of kills of one project with one change."""
BUILD = """
import os, pathlib, sys
from support import crashes

def tell(operation):
    if operation.number == 1:
        print(flush=True)

os.fsync = os.sync = lambda *_: None
print(flush=True)
with crashes.before_each(tell):
    crashes.run(pathlib.Path(sys.argv[1]))
print(flush=True)
"""
"""Builds a project, and prints a line when it begins, before its first file operation, and at its end."""

pytestmark = pytest.mark.slow


def build_in_child(project: Path) -> subprocess.Popen[bytes]:
    """Begin to build in another process."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    child = subprocess.Popen([sys.executable, "-c", BUILD, project], stdout=subprocess.PIPE, env=environment)
    wait_for_line(child)
    return child


def wait_for_line(child: subprocess.Popen[bytes]) -> float:
    """Return the time of the next line."""
    assert child.stdout
    child.stdout.readline()
    return time.monotonic()


def duration(project: Path) -> tuple[float, float]:
    """Seconds of an undisturbed build in a process of its own, and from its first operation on."""
    with build_in_child(project) as child:
        started, writing, end = time.monotonic(), wait_for_line(child), wait_for_line(child)
    assert child.returncode == 0
    return end - started, end - writing


def kill(project: Path, seconds: tuple[float, float], random: Random) -> None:
    """Build, and kill the build at a random time: half of the times count from its start, half from its first write."""
    whole, writing = seconds
    with build_in_child(project) as child:
        if random.random() < 0.5:
            time.sleep(random.uniform(0, whole))
        else:
            wait_for_line(child)
            time.sleep(random.uniform(0, writing))
        child.kill()  # as the task manager of Windows does, too


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
