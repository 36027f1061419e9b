"""Many robots, some at the same time: order, limits, crashes, interruption."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import psutil
import pytest
from support import checks

from urdfsync.analysis.checks import run
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.engine.options import Progress, no_progress
from urdfsync.project import config
from urdfsync.project.config import Config

TESTS = Path(__file__).parents[2]


@pytest.fixture
def tmp_path(tmp_path: Path) -> Path:
    """A folder whose name is not UTF-8, where there are such."""
    folder = tmp_path / os.fsdecode(b"caf\xe9") if sys.platform == "linux" else tmp_path / "cafe"
    folder.mkdir()
    return folder


@pytest.fixture
def robots(rc_domain: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Config]:
    """A configuration with robots of all characters; nobody reads their sources."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(TESTS))
    monkeypatch.setattr(run, "check_robot", checks.check_robot)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path.parent / "cache")
    names = ("late", "early", "crash", "slow", "big", "big2")
    tables = [f'[robots.{n}]\nsource = "{n}.json"\npackage = "{n.title()}"\ndomain = "rcnetwork"\n' for n in names]
    before = psutil.Process().children(recursive=True)
    yield config.parse("\n".join(tables), tmp_path / "urdfsync.toml", "urdfsync.toml")
    assert not list((tmp_path.parent / "cache" / "work").glob("*"))
    children = [
        one for one in psutil.Process().children(recursive=True) if "resource_tracker" not in str(one.cmdline())
    ]
    assert set(children) <= set(before)


def check(
    robots: Config, names: Sequence[str], options: CheckOptions | None = None, tell: Progress = no_progress
) -> Iterator[CheckResult]:
    chosen = [robot for robot in robots.robots if robot.name in names]
    return run.check_robots(robots, chosen, options or CheckOptions(jobs=2), tell)


def codes(result: CheckResult) -> list[str]:
    return [one.code for one in result.diagnostics]


def test_a_remembered_check_needs_no_worker(robots: Config, monkeypatch: pytest.MonkeyPatch) -> None:
    remembered = CheckResult("late", "Late")  # its check would wait for ever
    monkeypatch.setattr(run, "recall_check", lambda _, robot, *__: remembered if robot.name == "late" else None)
    late, early = check(robots, ["late", "early"], CheckOptions(jobs=1))
    assert late is remembered
    assert early.robot == "early"
    monkeypatch.setattr("urdfsync.common.processes.workers.workers", None)
    assert list(check(robots, ["late"])) == [remembered]


def test_results_come_in_order_and_each_step_is_told(robots: Config, tmp_path: Path) -> None:
    """The first waits for the second, which runs at the same time."""
    steps: list[tuple[str, int, int]] = []
    late, early = check(robots, ["late", "early"], tell=lambda *step: steps.append(step))
    assert [late.robot, early.robot] == ["late", "early"]
    assert late.compiled == (CompiledModel("LateRun", 10),)
    assert codes(late) == codes(early) == []
    (tmp_path / "early.done").unlink()

    def answer(*step: Any) -> None:
        steps.append(step)
        if step[0] == "late: at work":
            (tmp_path / "early.done").touch()

    list(check(robots, ["late"], tell=answer))
    assert ("late: at work", 0, 1) in steps
    assert all(0 <= done <= total for _, done, total in steps)


def test_a_process_that_breaks_down_is_one_clear_error(robots: Config) -> None:
    for found in check(robots, ["crash"]):
        assert codes(found) == ["check-crashed"]
        assert "the check of robot `crash`: its process ended unexpectedly" in found.diagnostics[0].message


@pytest.mark.slow
def test_time_and_memory_are_limited(robots: Config) -> None:
    early, slow = check(robots, ["early", "slow"], CheckOptions(timeout=3, jobs=2))
    assert not early.failed
    assert codes(slow) == ["out-of-time"]
    (big,) = check(robots, ["big"], CheckOptions(memory=0.2))
    assert codes(big) == ["out-of-memory"]
    assert "--memory" in big.diagnostics[0].hint


@pytest.mark.slow
def test_whoever_needs_more_than_a_share_gets_all_of_it_alone(robots: Config, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two at a time have 300 MB each; each takes 400 MB, which is there for one of them."""
    monkeypatch.setattr(run, "_EXPECTED_MEMORY", 3e8)
    found = list(check(robots, ["big", "big2"], CheckOptions(memory=0.6, jobs=2)))
    assert [codes(one) for one in found] == [[], []]


@pytest.mark.slow
def test_an_interruption_ends_all_processes(robots: Config, tmp_path: Path) -> None:
    results = check(robots, ["early", "slow"])
    assert next(results).robot == "early"
    deadline = time.monotonic() + 60
    while not (tmp_path / "slow.begun").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(0.5)  # until its process has started
    results.close()  # type: ignore[attr-defined]
