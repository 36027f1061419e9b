"""The build lock: one writer at a time, and nobody waits for the dead."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest
from support.files import unchanged
from support.networks import ROBOT, configure, rename, run_all

import urdfsync
from urdfsync.commands import cli
from urdfsync.common.diagnostics import OutputError
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.project import config
from urdfsync.project.state.lock import LockedError, build_lock

HOLD = """
import sys
from pathlib import Path
from urdfsync.project.state.lock import build_lock
with build_lock(Path(sys.argv[1]) / ".urdfsync", 0) as lock:
    lock.acquire()
    print("held", flush=True)
    sys.stdin.read()
"""


@contextmanager
def holder(project: Path) -> Iterator[subprocess.Popen[str]]:
    """Another process that holds the lock of the builds below a folder."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", HOLD, str(project)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, env=environment) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        try:
            yield process
        finally:
            process.kill()


def run(project: Path, **request: object) -> Result:
    (result,) = run_all(wait=0.1, **request)
    return result


def test_waiting_ends_when_the_holder_does(tmp_path: Path) -> None:
    with holder(tmp_path) as process, build_lock(tmp_path / ".urdfsync", 60) as lock:
        lock.acquire(waiting=process.kill)


@pytest.mark.slow
def test_waiting_ends_once_for_all(tmp_path: Path) -> None:
    """The robots of one command wait together: the second one hardly waits any more."""
    waits = []
    with holder(tmp_path):
        lock = build_lock(tmp_path / ".urdfsync", 2)
        for _ in range(2):
            calls: list[None] = []
            with pytest.raises(LockedError):
                lock.acquire(waiting=partial(calls.append, None))
            waits.append(len(calls))
    assert waits[1] < waits[0] / 2


@pytest.mark.posix("a file that is open can be deleted")
def test_a_lock_whose_file_is_deleted_is_taken_again(tmp_path: Path) -> None:
    with build_lock(tmp_path / ".urdfsync", 0) as one, build_lock(tmp_path / ".urdfsync", 0) as other:
        one.acquire()
        (tmp_path / ".urdfsync/lock").unlink()
        one.acquire()
        with pytest.raises(LockedError, match=f"process {os.getpid()} is building here"):
            other.acquire()


def test_a_file_that_is_deleted_while_it_is_locked_is_held_by_nobody(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Somebody deletes the state folder of a daemon, which must not end because another one had the lock."""
    file = tmp_path / ".urdfsync/lock"
    with build_lock(file.parent, 0) as lock:
        lock.acquire()
    file.touch()
    opened: list[str] = []
    real = os.open

    def open_deleted(path: str, flags: int, *arguments: int, **names: int) -> int:
        if Path(path) == file and not flags & os.O_EXCL and not opened:
            opened.append(path)
            file.unlink()
        return real(path, flags, *arguments, **names)

    monkeypatch.setattr(os, "open", open_deleted)
    with build_lock(file.parent, 0) as lock:
        lock.acquire()
        assert file.exists()
    assert opened


def test_who_takes_a_lock_after_another_process_is_named_alone(tmp_path: Path) -> None:
    file = tmp_path / ".urdfsync/lock"
    file.parent.mkdir()
    file.write_text("123456789012\n")
    with build_lock(file.parent, 0) as lock:
        lock.acquire()
        assert file.read_text() == f"{os.getpid()}\n"


def test_a_build_with_something_to_write_waits_and_then_gives_up(project: Path) -> None:
    with holder(project) as process:
        with unchanged(project):
            result = run(project)
            assert [found.code for found in result.diagnostics] == ["locked"]
            assert f"process {process.pid}" in result.diagnostics[0].message
            assert exit_code([result]) is Exit.LOCKED
        assert not run(project, dry=True).failed
    assert not run(project).failed
    with holder(project):
        assert run(project).in_step, "to find that nothing is to be done takes no lock"


@pytest.mark.parametrize("arguments", [["status"], ["build", "--check"], ["build", "--dry-run"]])
def test_a_dry_run_waits_for_a_build_that_is_writing(
    project: Path, arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["build"]) == Exit.IN_STEP
    left = project / f"modelica/Ladder/.package.mo.none-{'0' * 12}.abcdef.urdfsync-tmp"
    left.write_text("half")
    if arguments[0] == "build":
        with holder(project):
            assert cli.main([*arguments, "--wait", "0"]) == Exit.LOCKED
            assert "is building here" in capsys.readouterr().err
    assert cli.main(arguments) == Exit.IN_STEP, "it was killed"
    assert left.exists()


@pytest.mark.slow
def test_the_lock_belongs_to_the_whole_command(project: Path) -> None:
    configure(ROBOT.format("other", "Other"))
    told: list[tuple[str, int, int]] = []
    with holder(project):
        results = run_all(wait=0, progress=lambda *step: told.append(step))
    assert [result.locked for result in results] == [True, True]
    assert any(what.startswith("waiting for process ") for what, _, _ in told)
    results, loaded = [], config.load(project / "urdfsync.toml")
    for result in build(loaded, loaded.robots, BuildOptions()):
        results.append(result)
        with pytest.raises(LockedError):
            build_lock(project / ".urdfsync", 0).acquire()
    assert exit_code(results) is Exit.IN_STEP
    build_lock(project / ".urdfsync", 0).acquire()


@pytest.mark.skipif(sys.platform == "win32", reason="no links, no pipes")
@pytest.mark.parametrize("kind", ["link", "hard link", "pipe", "folder", "linked state"])
def test_what_stands_in_the_place_of_the_lock_file_is_left_alone(project: Path, tmp_path: Path, kind: str) -> None:
    outside, place = tmp_path / "outside", project / ".urdfsync/lock"
    outside.mkdir()
    (outside / "file").write_text("precious")
    if kind == "linked state":
        (project / ".urdfsync").symlink_to(outside)
    else:
        place.parent.mkdir()
        actions: dict[str, Callable[[], None]] = {
            "link": lambda: place.symlink_to(outside / "lock"),
            "hard link": lambda: place.hardlink_to(outside / "file"),
            "pipe": lambda: os.mkfifo(place),
        }
        actions.get(kind, place.mkdir)()
    with build_lock(project / ".urdfsync", 0) as one, build_lock(project / ".urdfsync", 0) as other:
        if kind in ("hard link", "pipe"):
            one.acquire()
            with pytest.raises(LockedError, match="another process"):
                other.acquire()
        else:
            with pytest.raises(OutputError):
                one.acquire()
    assert {path.name: path.read_text() for path in outside.iterdir()} == {"file": "precious"}


def test_three_builds_at_once_equal_one(project: Path, rc_site: Path) -> None:
    run(project)
    rc_folder = Path(sys.modules["rc_domain"].__file__ or "").parent
    folders = (Path(urdfsync.__file__).parents[1], rc_site, rc_folder)
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, folders))}
    rename("R2", "R3")
    command = [sys.executable, "-m", "urdfsync", "build", "--format=json"]
    pipe = subprocess.PIPE
    processes = [subprocess.Popen(command, cwd=project, env=environment, stdout=pipe, stderr=pipe) for _ in range(3)]
    outputs = [process.communicate() for process in processes]
    assert [process.returncode for process in processes] == [0, 0, 0], outputs
    assert sum(b'"reason": "create"' in out for out, _ in outputs) == 1
    assert run(project).in_step
    assert run(project, full=True).in_step
    assert not list(project.rglob("*.urdfsync-tmp"))
