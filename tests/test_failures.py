"""Each failure of a command has its exit code, and is reported in one line."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import Future
from multiprocessing import SimpleQueue
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.workplace import changes, contents

from urdfsync.commands import cli
from urdfsync.common import diagnostics
from urdfsync.domain import Reading
from urdfsync.formats.urdf.domain import UrdfDomain
from urdfsync.project import config
from urdfsync.project.state.lock import Lock

Capture = pytest.CaptureFixture[str]

URDF = """<robot name="arm">
  <link name="base"/>
  <link name="tip"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="hold" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>
"""

REPOSITORY = Path(__file__).parents[1]


@pytest.fixture
def traces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder for temporary files."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    diagnostics._save_traceback.cache_clear()
    return folder


@pytest.mark.parametrize("command", ["build --check", "status", "diff", "check", "resolve --all --keep", "watch"])
def test_what_nobody_foresaw_ends_in_2_with_its_traceback_in_a_file(
    project: Path, traces: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    def fail(*_: object) -> None:
        raise ValueError("no number")

    monkeypatch.setattr(config, "load", fail)
    streams = execute(*command.split(), code=2)
    (line,) = streams.err.splitlines()
    assert streams.out == ""
    assert line.startswith("error: ValueError in test_failures.py, line ")
    (file,) = traces.iterdir()
    assert f"please report it with the traceback in {file} [internal]" in line
    assert "ValueError: no number" in file.read_text()


@NEEDS_GIT
@pytest.mark.parametrize(
    "command",
    [
        *(["build"], ["build", "--check"], ["build", "--dry-run"], ["status"], ["diff"]),
        *(["resolve", "--all", "--take"], ["record", "arm.urdf"], ["init", "--config", "new.toml", "arm.urdf"]),
        *(["hook", "check"], ["hook", "build"]),
    ],
    ids=" ".join,
)
@pytest.mark.parametrize(
    "error", [MemoryError(), pytest.param(RecursionError("too deep"), marks=pytest.mark.slow)], ids=repr
)
def test_a_source_that_is_too_much_for_the_machine_ends_in_2(
    execute: Execute,
    tmp_path: Path,
    traces: Path,
    capsys: Capture,
    monkeypatch: pytest.MonkeyPatch,
    command: list[str],
    error: Exception,
) -> None:
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    Path("arm.urdf").write_text(URDF)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert cli.main(["build", "--quiet"]) == 0
    Path("arm.urdf").write_text(URDF.replace("1 1 1", "1 1 2"))
    repository.commit()
    before = contents(repository.folder)
    capsys.readouterr()
    monkeypatch.setattr(UrdfDomain, "read", mock.Mock(side_effect=error))
    said = execute(*command, code=2).err
    assert len([line for line in said.splitlines() if "[internal]" in line]) == 1, said
    assert "there is not enough memory; " in said or "RecursionError in " in said
    assert "Traceback" not in said
    changed = changes(before, contents(repository.folder))
    assert [
        name
        for name in changed
        if not name.startswith((".urdfsync/lock", ".urdfsync/deps/", ".git/index", ".git/urdfsync"))
    ] == []


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_a_build_with_130(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(URDF)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    Path(".urdfsync").mkdir()
    environment = os.environ | {"PYTHONPATH": str(REPOSITORY)}
    with Lock(tmp_path / ".urdfsync/lock", 0) as lock:
        lock.acquire()
        # Python may lose a signal that arrives during an import, so all modules for the lock are imported
        code = "import sys; from urdfsync.commands import cli; from urdfsync.project.state.lock import Lock"
        code += "\nacquire = Lock.acquire"
        code += "\ndef tell(*a, **k): print('waits', flush=True); return acquire(*a, **k)"
        code += "\nLock.acquire = tell; sys.exit(cli.main(['build']))"
        command = [sys.executable, "-c", code]
        with subprocess.Popen(
            command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as build:
            assert build.stdout
            assert build.stdout.readline() == "waits\n"
            build.send_signal(number)
            _, errors = build.communicate(timeout=30)
    assert build.returncode == 130
    assert errors == "error: interrupted; run the command again to finish the work [interrupted]\n"
    assert not (tmp_path / "modelica").exists()


def test_what_fails_while_an_interruption_is_cleared_away_is_that_interruption(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    def run(*_: object) -> None:
        try:
            raise KeyboardInterrupt
        finally:
            raise OSError("a pipe is closed")

    monkeypatch.setattr("urdfsync.commands.status.run", run)
    assert execute("status", code=130).err.startswith("error: interrupted; ")


@NEEDS_GIT
@pytest.mark.parametrize("command", [
    "build --format=json", "build --check --format=json", "status --format=json", "diff --format=json",
    "diff --against HEAD --format=json", "diff --edits", "check --format=json --jobs 1", "hook check", "hook build",
])  # fmt: skip
def test_a_mistake_that_one_robot_meets_leaves_the_others_alone(
    execute: Execute, tmp_path: Path, traces: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    robots = ("one", "other")
    tables = [f'[robots.{name}]\nsource = "{name}.urdf"\npackage = "{name.title()}"\n' for name in robots]
    # without a library `check` compiles nothing
    Path("urdfsync.toml").write_text("".join(tables) + '[check]\nlibrary = "nothing"\n')
    for name in robots:
        Path(f"{name}.urdf").write_text(URDF)
    execute("build", "--quiet")
    repository.commit()
    for name in robots:
        Path(f"{name}.urdf").write_text(URDF.replace("1 1 1", f"1 1 {len(name)}"))
    repository.git("add", ".")
    read = UrdfDomain.read

    def fail(self: UrdfDomain, content: bytes, file: str, options: Any) -> Reading:
        if file.endswith("one.urdf"):
            raise RecursionError("too deep")
        return read(self, content, file, options)

    monkeypatch.setattr(UrdfDomain, "read", fail)
    if command.startswith("check"):
        monkeypatch.setattr(
            "urdfsync.common.processes.workers.workers", lambda _: contextlib.nullcontext((Inline(), SimpleQueue()))
        )
    said = execute(*command.split(), code=2)
    if "--format=json" not in command:
        assert "[internal]" in said.err
        assert "other" in said.words
        return
    assert [json.dumps(result).count('"internal"') for result in said.json["results"]] == [1, 0]
    assert [file.read_text().endswith("RecursionError: too deep\n") for file in traces.glob("*.txt")] == [True]


class Inline:
    """Workers that do each job at once, in this process."""

    def submit(self, job: Callable[..., Any], *arguments: Any) -> Future[Any]:
        done = Future[Any]()
        done.set_result(job(*arguments))
        return done
