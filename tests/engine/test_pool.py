"""Many robots at once: the same result as one after the other, with everything that can go wrong in between."""

from __future__ import annotations

import contextlib
import functools
import json
import os
import shutil
import signal
from collections.abc import Callable
from concurrent.futures import Executor, Future
from contextlib import AbstractContextManager
from multiprocessing import SimpleQueue
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from support.networks import edit, run_all
from support.replay import contents

from urdfsync.common.dependencies.facts import CONTENT, PATH
from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.common.processes.workers import workers
from urdfsync.engine import pool, remembered
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.pool import plan_in_worker
from urdfsync.project import config
from urdfsync.project.config import Config, RobotConfig

COUNT = 8


@pytest.fixture
def robots(project: Path) -> Path:
    """A project with many robots in one package that does not exist yet; the third can't be read."""
    network = json.loads((project / "ladder.json").read_text())
    tables = ['[defaults]\ndomain = "rcnetwork"\ncreate_parents = true\n']
    for number in range(COUNT):
        (project / f"n{number}.json").write_text(json.dumps({**network, "name": f"network {number}"}))
        tables.append(f'[robots.n{number}]\nsource = "n{number}.json"\npackage = "Plant.Networks.N{number}"\n')
    (project / "n2.json").write_text("{")
    (project / "urdfsync.toml").write_text("\n".join(tables))
    return project


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many processes were asked for, each time that workers started."""
    found: list[int] = []

    def start(count: int) -> AbstractContextManager[object]:
        found.append(count)
        return workers(count)

    monkeypatch.setattr("urdfsync.common.processes.workers.workers", start)
    return found


@pytest.mark.slow
def test_many_robots_at_once_are_built_as_one_after_the_other(robots: Path, started: list[int]) -> None:
    alone = run_all(jobs=1)
    assert started == []
    result = contents(robots)
    for name in ("modelica", ".urdfsync"):
        shutil.rmtree(robots / name)
    together = run_all(jobs=2)
    assert started == [2]
    assert contents(robots) == result
    assert [one.robot for one in together] == [one.robot for one in alone]
    assert [one.actions for one in together if one.robot == "n0"] == [one.actions for one in alone if one.robot == "n0"]
    assert [one.failed for one in together] == [number == 2 for number in range(COUNT)]
    assert together[2].diagnostics == alone[2].diagnostics


@pytest.mark.slow
def test_what_workers_read_is_recorded_as_a_dependency(robots: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remembered.RobotMemory, "recall", lambda *_: None)
    (robots / "n2.json").write_text((robots / "n1.json").read_text())
    run_all(jobs=1)
    with Reads() as alone:
        run_all(jobs=1)
    with Reads() as together:
        run_all(jobs=2)
    assert alone.complete
    assert together.complete
    lasting = {
        entry: fact for entry, fact in alone.entries.items() if entry[0] != CONTENT
    }  # files become old meanwhile
    assert lasting.items() <= together.entries.items()
    (robots / "n2.json").write_text("{")
    failed = run_all(jobs=2)[2]
    assert failed.failed
    assert (PATH, str(robots / "n2.json")) in failed.reads, "an error carries it as a plan does"


class LastComeFirst(Executor):
    """Does its jobs in this process: the last one first, and each not before it is told to."""

    def __init__(self) -> None:
        self.jobs: list[tuple[Future[Any], Callable[[], Any]]] = []

    def submit(self, job: Callable[..., Any], /, *arguments: Any, **named: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.jobs.append((future, functools.partial(job, *arguments, **named)))
        return future

    def work(self) -> None:
        future, job = self.jobs.pop()
        future.set_result(job())


@pytest.mark.slow
def test_progress_is_told_in_robots_that_have_been_read(robots: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (robots / "n2.json").write_text((robots / "n1.json").read_text())
    executor, told = LastComeFirst(), list[tuple[int, int]]()

    def progress(what: str, done: int, total: int) -> None:
        if what == "reading":
            told.append((done, total))
            executor.work()

    monkeypatch.setattr(
        "urdfsync.common.processes.workers.workers", lambda _: contextlib.nullcontext((executor, SimpleQueue()))
    )
    run_all(jobs=2, progress=progress)
    assert told == [(number, COUNT) for number in range(COUNT)]


@pytest.mark.slow
def test_a_process_that_dies_is_the_error_of_its_robot(robots: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pool, "plan_in_worker", _die_of_one)
    results = {result.robot: result for result in run_all(jobs=2)}
    assert {name for name, result in results.items() if result.failed} == {"n2", "n5"}
    (found,) = results["n5"].diagnostics
    assert "ended unexpectedly" in found.message
    assert "--jobs 1" in found.hint


def _die_of_one(config: Config, robot: RobotConfig, options: BuildOptions) -> object:
    if robot.name == "n5":
        os.kill(os.getpid(), signal.SIGKILL)
    return plan_in_worker(config, robot, options)


@pytest.mark.slow
def test_a_save_while_the_others_plan_is_seen(robots: Path) -> None:
    run_all(jobs=1)
    for path in robots.glob("n*.json"):
        path.write_text(path.read_text().replace("220.5", "330"))
    record = robots / "modelica/Plant/Networks/N5/Elements/R2Parameters.mo"
    loaded = config.load(Path("urdfsync.toml"))
    results = []
    for result in build(loaded, loaded.robots, BuildOptions(jobs=2)):
        results.append(result)
        if result.robot == "n3":  # the plans of those that follow are under way, or wait to be carried out
            edit(record, "220.5", "221")
    assert [each.action.path for each in results[5].conflicts] == [record.relative_to(robots).as_posix()]
    assert "221" in record.read_text()


def test_a_mistake_in_a_worker_is_told_as_one(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And not as the end of the worker, which takes the other robots with it."""
    monkeypatch.setattr(pool, "plan_robot", mock.Mock(side_effect=RecursionError("too deep")))
    loaded = config.load(Path("urdfsync.toml"))
    planned, _ = pool.plan_in_worker(loaded, loaded.robots[0], BuildOptions())
    assert isinstance(planned, UrdfsyncError)
    assert [finding.code for finding in planned.diagnostics] == ["internal"]
    assert "RecursionError" in str(planned)
