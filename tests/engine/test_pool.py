"""Many robots at once: the same result as one after the other, with everything that can go wrong in between."""

from __future__ import annotations

import json
import os
import shutil
import signal
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
from support.networks import edit, run_all
from support.replay import contents

from urdfsync import config
from urdfsync.diagnostics import ConfigError
from urdfsync.engine import pool
from urdfsync.engine.build import build
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.workers import Workers, workers

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

    def start(count: int, address: str = "") -> AbstractContextManager[Workers]:
        found.append(count)
        return workers(count, address)

    monkeypatch.setattr(pool, "workers", start)
    return found


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


def test_no_process_is_started_for_what_is_in_step(robots: Path, started: list[int]) -> None:
    run_all(jobs=1)
    (robots / "n2.json").write_text((robots / "n1.json").read_text())
    (robots / "n5.json").unlink()
    results = run_all(jobs=2)
    assert [one.in_step for one in results] == [number not in (2, 5) for number in range(COUNT)]
    assert results[5].failed
    assert started == []


def test_the_daemon_sees_all_edits_after_workers_have_planned(robots: Path, started: list[int]) -> None:
    """What workers see does not get into its cache: the next builds look at all files again."""
    cache = Cache()
    run_all(jobs=2, cache=cache)
    assert started == [2]
    record = robots / "modelica/Plant/Networks/N5/Elements/R2Parameters.mo"
    edit(record, "220.5", "221")
    for number in (0, 5):
        edit(robots / f"n{number}.json", "220.5", "330")
    results = run_all(jobs=2, cache=cache)
    assert {one.robot for one in results if any(action.writes for action in one.actions)} == {"n0"}
    assert [action.path for action in results[5].conflicts] == [record.relative_to(robots).as_posix()]
    again = run_all(jobs=1, cache=cache)
    assert [one.in_step for one in again] == [number not in (2, 5) for number in range(COUNT)]


def test_a_process_that_dies_is_an_error_in_words(robots: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pool, "plan_robot", _die)
    results = run_all(jobs=2)
    assert all(result.failed for result in results)
    (found,) = results[0].diagnostics
    assert "ended unexpectedly" in found.message
    assert "--jobs 1" in found.hint


def _die(*_: object) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.slow
def test_a_cluster_plans_what_this_process_writes(robots: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    from distributed import LocalCluster

    scratch = tmp_path_factory.mktemp("dask")
    with LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(scratch)
    ) as cluster:
        together = run_all(executor=cluster.scheduler_address)
    assert [one.failed for one in together] == [number == 2 for number in range(COUNT)]
    assert together[2].diagnostics == run_all(jobs=1)[2].diagnostics
    result = contents(robots / "modelica")
    for name in ("modelica", ".urdfsync"):
        shutil.rmtree(robots / name)
    run_all(jobs=1)
    assert contents(robots / "modelica") == result


def test_a_cluster_that_does_not_answer_is_an_error_in_words(robots: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.workers._PATIENCE", 1)
    with pytest.raises(ConfigError, match="no Dask scheduler answers"):
        run_all(executor="tcp://127.0.0.1:9")


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
    assert [action.path for action in results[5].conflicts] == [record.relative_to(robots).as_posix()]
    assert "221" in record.read_text()
