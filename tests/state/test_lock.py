"""The build lock: one writer at a time, and nobody waits for the dead."""

from __future__ import annotations

import errno
import os
import shutil
import stat
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from support.files import unchanged
from support.networks import ROBOT, configure, rename, run_all

import urdfsync
from urdfsync import cli, config
from urdfsync.diagnostics import OutputError
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.state.lock import Lock, LockedError, _try, build_lock

HOLD = """
import sys
from pathlib import Path
from urdfsync.state.lock import Lock, build_lock
path = Path(sys.argv[1])
with build_lock(path, path / ".urdfsync", 0) if path.is_dir() else Lock(path, 0) as lock:
    lock.acquire()
    print("held", flush=True)
    sys.stdin.read()
"""


@contextmanager
def holder(path: Path) -> Iterator[subprocess.Popen[str]]:
    """Another process that holds the lock of a file, or of the builds below a folder."""
    environment = os.environ | {"PYTHONPATH": str(Path(urdfsync.__file__).parents[1])}
    command = [sys.executable, "-c", HOLD, str(path)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, env=environment) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        try:
            yield process
        finally:
            process.kill()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "state" / "lock"


def test_waiting_ends_when_the_holder_does(path: Path) -> None:
    waited = 0

    def wait() -> None:
        nonlocal waited
        waited += 1
        if waited == 2:
            process.kill()

    with holder(path) as process, Lock(path, 60) as lock:
        lock.acquire(waiting=wait)
        assert waited >= 2


@pytest.mark.skipif(sys.platform == "win32", reason="no shared locks on this system")
def test_readers_wait_for_writers_only(path: Path) -> None:
    with Lock(path, 0) as writer:
        writer.acquire()
        with pytest.raises(LockedError):
            Lock(path, 0).acquire(shared=True)
    with Lock(path, 0) as one, Lock(path, 0) as two:
        one.acquire(shared=True)
        two.acquire(shared=True)


def test_without_a_lock_file_there_is_no_writer_to_wait_for(path: Path) -> None:
    with Lock(path, 0) as reader:
        reader.acquire(shared=True)
    assert not path.exists(), "who only reads makes no file"


# Builds


def run(project: Path, **request: object) -> Result:
    (result,) = run_all(wait=0.1, **request)
    return result


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
    journal = project / ".urdfsync/journal/apply.json"
    journal.parent.mkdir(parents=True)
    journal.write_text("{}")
    assert cli.main(arguments) == Exit.ERROR, "without a lock file"
    if arguments[0] == "build":
        with holder(project):
            assert cli.main([*arguments, "--wait", "0"]) == Exit.LOCKED
    assert cli.main(arguments) == Exit.ERROR
    assert "the last build was interrupted; run `urdfsync build`, which finishes it" in capsys.readouterr().err


def test_the_lock_belongs_to_the_whole_command(project: Path) -> None:
    configure(ROBOT.format("other", "Other"))
    with holder(project):
        assert [result.locked for result in run_all(wait=0)] == [True, True]
    results, loaded = [], config.load(project / "urdfsync.toml")
    for result in build(loaded, loaded.robots, BuildOptions()):
        results.append(result)
        with pytest.raises(LockedError):
            build_lock(project, project / ".urdfsync", 0).acquire()
    assert exit_code(results) is Exit.IN_STEP
    build_lock(project, project / ".urdfsync", 0).acquire()


@pytest.mark.skipif(sys.platform == "win32", reason="an open file can't be deleted there")
def test_a_lock_whose_file_is_deleted_is_still_held(project: Path) -> None:
    """As by `git clean -fdX`."""
    with holder(project):
        shutil.rmtree(project / ".urdfsync")
        (found,) = run(project).diagnostics
        assert (found.code, found.message.split(" is ")[0]) == ("locked", "another process")


@pytest.mark.skipif(sys.platform == "win32", reason="no links, no pipes")
@pytest.mark.parametrize("kind", ["link", "hard link", "pipe", "folder", "linked state"])
def test_what_stands_in_the_place_of_the_lock_file_is_left_alone(project: Path, tmp_path: Path, kind: str) -> None:
    """It only says who builds."""
    outside, place = tmp_path / "outside", project / ".urdfsync/lock"
    outside.mkdir()
    if kind == "linked state":
        (project / ".urdfsync").symlink_to(outside)
    else:
        place.parent.mkdir()
        if kind == "hard link":
            (outside / "file").write_text("precious")
        actions: dict[str, Callable[[], None]] = {
            "link": lambda: place.symlink_to(outside / "lock"),
            "hard link": lambda: place.hardlink_to(outside / "file"),
            "pipe": lambda: os.mkfifo(place),
        }
        actions.get(kind, place.mkdir)()
    with build_lock(project, project / ".urdfsync", 0) as one, build_lock(project, project / ".urdfsync", 0) as other:
        one.acquire()
        with pytest.raises(LockedError, match="another process"):
            other.acquire()
    assert [path.read_text() for path in outside.iterdir()] == (["precious"] if kind == "hard link" else [])


@pytest.mark.skipif(sys.platform == "win32", reason="no locks of folders there anyway")
def test_where_no_folder_can_be_locked_a_file_is(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on NFS."""

    def refuse(descriptor: int, shared: bool) -> None:
        if stat.S_ISDIR(os.fstat(descriptor).st_mode):
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        _try(descriptor, shared)

    monkeypatch.setattr("urdfsync.state.lock._try", refuse)
    with build_lock(project, project / ".urdfsync", 0) as one, build_lock(project, project / ".urdfsync", 0) as other:
        one.acquire()
        with pytest.raises(LockedError, match=f"process {os.getpid()} is building"):
            other.acquire()
    assert not run(project).failed


def test_three_builds_at_once_equal_one(project: Path, rc_site: Path) -> None:
    run(project)
    rc_folder = Path(sys.modules["rc_domain"].__file__ or "").parent
    folders = (Path(urdfsync.__file__).parents[1], rc_site, rc_folder)
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, folders))}
    rename("R2", "R3")
    command = [sys.executable, "-m", "urdfsync", "build", "--json"]
    pipe = subprocess.PIPE
    processes = [subprocess.Popen(command, cwd=project, env=environment, stdout=pipe, stderr=pipe) for _ in range(3)]
    outputs = [process.communicate() for process in processes]
    assert [process.returncode for process in processes] == [0, 0, 0], outputs
    assert sum(b'"action": "delete"' in out for out, _ in outputs) == 1
    assert run(project).in_step
    assert run(project, full=True).in_step
    assert not list(project.rglob("*.urdfsync-tmp"))


def test_a_lock_file_that_cant_be_one(path: Path) -> None:
    path.mkdir(parents=True)
    with pytest.raises(OutputError, match="it can't be written"):
        Lock(path, 0).acquire()


def test_patience_ends_once_for_all(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pauses: list[float] = []
    monkeypatch.setattr(time, "sleep", pauses.append)
    with Lock(path, 0) as other:
        other.acquire()
        lock = Lock(path, 0.01)
        with pytest.raises(LockedError):
            lock.acquire()
        pauses.clear()
        with pytest.raises(LockedError):
            lock.acquire()
        assert pauses == []
