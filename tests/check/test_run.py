"""Many robots, each in a process of its own: order, limits, crashes, interruption."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import psutil
import pytest

from urdfsync import config, processes
from urdfsync.check import run
from urdfsync.check.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.config import Config
from urdfsync.engine.options import Progress, no_progress

STAND_IN = """
import json, os, sys, time
from pathlib import Path

order = json.loads(sys.stdin.readline())
name, here = order["robot"], Path(order["folder"])
def say(what="", result=None):
    print(json.dumps({"what": what, "done": 0.5, "result": result}), flush=True)

(here / f"{name}.begun").touch()
say(f"{name}: at work")
compiled = {"model": f"{name.title()}Run", "unknowns": 10, "states": 2}
if name.startswith("slow"):
    time.sleep(600)
elif name.startswith("crash"):
    os.abort()
elif name.startswith("silent"):
    sys.exit(0)
elif name.startswith("loud"):
    print("a library greets", flush=True)
elif name.startswith("big"):
    memory = bytearray(400_000_000)
    time.sleep(1)
elif name.startswith("late"):
    while not (here / "early.done").exists():
        time.sleep(0.01)
say(result={"robot": name, "package": name.title(), "compiled": [compiled]})
(here / f"{name}.done").touch()
"""


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
    monkeypatch.setattr(run, "COMMAND", (sys.executable, "-S", "-c", STAND_IN))
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path.parent / "cache")
    names = ("late", "early", "crash", "silent", "loud", "slow", "big", "big2")
    tables = [f'[robots.{n}]\nsource = "{n}.json"\npackage = "{n.title()}"\ndomain = "rcnetwork"\n' for n in names]
    yield config.parse("\n".join(tables), tmp_path / "urdfsync.toml", "urdfsync.toml")
    assert not list((tmp_path.parent / "cache" / "work").iterdir())
    own = psutil.Process()
    assert [child for child in own.children(recursive=True) if STAND_IN in child.cmdline()] == []


def check(
    robots: Config, names: Sequence[str], options: CheckOptions | None = None, tell: Progress = no_progress
) -> Iterator[CheckResult]:
    chosen = [robot for robot in robots.robots if robot.name in names]
    return run.check_robots(robots, chosen, options or CheckOptions(jobs=2), tell)


def codes(result: CheckResult) -> list[str]:
    return [one.code for one in result.diagnostics]


def test_results_come_in_order_and_a_process_that_breaks_down_fails_its_robot_only(robots: Config) -> None:
    """The first two run at the same time: the first waits for the second."""
    steps: list[tuple[str, int, int]] = []
    names = ["late", "early", "crash", "silent", "loud"]
    late, early, *broken = check(robots, names, tell=lambda *step: steps.append(step))
    assert [one.robot for one in (late, early, broken[0])] == names[:3]
    assert late.compiled == (CompiledModel("LateRun", 10, 2),)
    assert codes(late) == codes(early) == []
    assert [codes(one) for one in broken] == [["check-crashed"]] * 3
    assert "SIGABRT" in broken[0].diagnostics[0].message or os.name == "nt"
    assert all(0 <= done <= total == 500 for _, done, total in steps)


def test_it_is_told_what_is_being_done(robots: Config, tmp_path: Path) -> None:
    """The robot waits until it has been told."""
    steps: list[tuple[str, int, int]] = []

    def tell(*step: Any) -> None:
        steps.append(step)
        if step[0] == "late: at work":
            (tmp_path / "early.done").touch()

    list(check(robots, ["late"], tell=tell))
    assert ("late: at work", 50, 100) in steps


@pytest.mark.slow
def test_time_and_memory_are_limited(robots: Config) -> None:
    early, slow = check(robots, ["early", "slow"], CheckOptions(timeout=6, jobs=2))
    assert not early.failed
    assert codes(slow) == ["check-out-of-time"]
    (big,) = check(robots, ["big"], CheckOptions(memory=0.2))
    assert codes(big) == ["check-out-of-memory"]
    assert "--memory" in big.diagnostics[0].hint


@pytest.mark.slow
def test_whoever_needs_more_than_a_share_gets_all_of_it_alone(robots: Config, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two at a time have 300 MB each; each takes 400 MB, which is there for one of them."""
    monkeypatch.setattr(run, "_EXPECTED_MEMORY", 3e8)
    found = list(check(robots, ["big", "big2"], CheckOptions(memory=0.6, jobs=2)))
    assert [codes(one) for one in found] == [[], []]


def test_an_interruption_ends_all_processes(robots: Config, tmp_path: Path) -> None:
    results = check(robots, ["early", "slow"])
    assert next(results).robot == "early"
    deadline = time.monotonic() + 60
    while not (tmp_path / "slow.begun").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    results.close()  # type: ignore[attr-defined]


def test_a_robot_that_is_gone_from_the_configuration_is_told(
    robots: Config, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The configuration was changed between the command and its process."""
    monkeypatch.setattr(run, "COMMAND", processes.python_module("urdfsync.check.robot"))
    (tmp_path / "urdfsync.toml").write_text('[robots.leg]\nsource = "leg.urdf"\npackage = "Leg"\n')
    (found,) = check(robots, ["early"], CheckOptions(package_paths=(tmp_path,)))
    assert codes(found) == ["unknown-robot"]


def test_robots_are_checked_by_the_workers_of_a_cluster(robots: Config, monkeypatch: pytest.MonkeyPatch) -> None:
    """Threads of this process stand in for workers; tests/engine/test_pool.py talks to a real scheduler."""
    addresses: list[str] = []

    def connect(address: str) -> Executor:
        addresses.append(address)
        return ThreadPoolExecutor(2)

    monkeypatch.setattr(run, "connect_cluster", connect)
    late, early, crash = check(robots, ["late", "early", "crash"], CheckOptions(executor="tcp://here:1"))
    assert addresses == ["tcp://here:1"]
    assert [codes(one) for one in (late, early, crash)] == [[], [], ["check-crashed"]]

    def lose(_: object) -> None:
        raise RuntimeError("killed worker")

    monkeypatch.setattr(run, "check_on_worker", lose)
    (lost,) = check(robots, ["early"], CheckOptions(executor="tcp://here:1"))
    assert codes(lost) == ["check-crashed"]
    assert "killed worker" in lost.diagnostics[0].message
