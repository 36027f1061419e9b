"""Many robots, each in a process of its own: order, limits, crashes, interruption."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import psutil
import pytest

from urdfsync import config
from urdfsync.check import run
from urdfsync.check.results import CheckOptions, CheckResult, CompiledModel
from urdfsync.config import Config

STAND_IN = """
import json, os, sys, time
from pathlib import Path

order = json.loads(sys.stdin.readline())
name, here = order["robot"], Path(order["folder"])
def say(what="", is_last=False, **facts):
    result = {"robot": name, "package": name.title(), **facts}
    print(json.dumps({"what": what, "done": 0.5, "result": result, "is_last": is_last}), flush=True)

(here / f"{name}.begun").touch()
say(f"{name}: at work")
compiled = {"model": f"{name.title()}Run", "unknowns": 10, "states": 2}
if name.startswith("slow"):
    say(compiled=[compiled])
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
say(is_last=True, compiled=[compiled])
(here / f"{name}.done").touch()
"""


@pytest.fixture
def robots(rc_domain: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Config]:
    """A configuration with robots of all characters; nobody reads their sources."""
    monkeypatch.chdir(tmp_path)
    names = ("late", "early", "crash", "silent", "loud", "slow", "big", "big2")
    tables = [f'[robots.{n}]\nsource = "{n}.json"\npackage = "{n.title()}"\ndomain = "rcnetwork"\n' for n in names]
    yield config.parse("\n".join(tables), tmp_path / "urdfsync.toml", "urdfsync.toml")
    own = psutil.Process()
    assert [child for child in own.children(recursive=True) if STAND_IN in child.cmdline()] == []


def check(robots: Config, names: Sequence[str], options: CheckOptions | None = None) -> Iterator[CheckResult]:
    chosen = [robot for robot in robots.robots if robot.name in names]
    command = (sys.executable, "-c", STAND_IN)
    return run.check_robots(robots, chosen, options or CheckOptions(jobs=2), lambda what, done, total: None, command)


def codes(result: CheckResult) -> list[str]:
    return [one.code for one in result.diagnostics]


def test_verdicts_come_in_the_order_of_the_robots(robots: Config) -> None:
    """Both run at the same time: the first waits for the second."""
    found = list(check(robots, ["late", "early"]))
    assert [one.robot for one in found] == ["late", "early"]
    assert found[0].compiled == (CompiledModel("LateRun", 10, 2),)
    assert not any(codes(one) for one in found)


def test_a_process_that_breaks_down_fails_its_robot_only(robots: Config) -> None:
    early, crash, silent, loud = check(robots, ["early", "crash", "silent", "loud"])
    assert not early.failed
    assert [codes(one) for one in (crash, silent, loud)] == [["check-crashed"]] * 3
    assert "SIGABRT" in crash.diagnostics[0].message or os.name == "nt"


def test_time_is_limited_and_what_was_found_until_then_stays(robots: Config) -> None:
    early, slow = check(robots, ["early", "slow"], CheckOptions(timeout=6, jobs=2))
    assert not early.failed
    assert codes(slow) == ["check-out-of-time"]
    assert slow.compiled == (CompiledModel("SlowRun", 10, 2),)


def test_memory_is_limited(robots: Config) -> None:
    (big,) = check(robots, ["big"], CheckOptions(memory=0.2))
    assert codes(big) == ["check-out-of-memory"]
    assert "--memory" in big.diagnostics[0].hint


def test_whoever_needs_more_than_a_share_gets_all_of_it_alone(
    robots: Config, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
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


def test_a_robot_that_is_gone_from_the_configuration_is_told(robots: Config, tmp_path: Path) -> None:
    """The configuration was changed between the command and its process."""
    (tmp_path / "urdfsync.toml").write_text('[robots.leg]\nsource = "leg.urdf"\npackage = "Leg"\n')
    chosen = [robot for robot in robots.robots if robot.name == "early"]
    (found,) = run.check_robots(robots, chosen, CheckOptions(package_paths=(tmp_path,)), lambda *_: None)
    assert codes(found) == ["unknown-robot"]


def test_it_is_told_what_is_being_done(robots: Config, tmp_path: Path) -> None:
    chosen = [robot for robot in robots.robots if robot.name == "late"]
    steps: list[tuple[str, int, int]] = []

    def tell(what: str, done: int, total: int) -> None:
        steps.append((what, done, total))
        if what == "late: at work":
            (tmp_path / "early.done").touch()

    list(run.check_robots(robots, chosen, CheckOptions(), tell, (sys.executable, "-c", STAND_IN)))
    assert ("late: at work", 50, 100) in steps
