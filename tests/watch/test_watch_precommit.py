"""Whether pre-commit has stashed changes away, from the files that it makes."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from urdfsync.watch.precommit import PrecommitStash, store_folder

linux = pytest.mark.skipif(not Path("/proc/self/cwd").exists(), reason="no /proc on this system")


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    folder = tmp_path / "repository"
    (folder / "robots").mkdir(parents=True)
    return folder


@pytest.fixture
def process(repository: Path) -> Iterator[subprocess.Popen[bytes]]:
    """A process that works at the top of the repository, as pre-commit does."""
    with subprocess.Popen([sys.executable, "-c", "input()"], cwd=repository, stdin=subprocess.PIPE) as running:
        yield running


def patch(tmp_path: Path, pid: int, moment: float | None = None) -> Path:
    store = tmp_path / "store"
    store.mkdir(exist_ok=True)
    (store / f"patch{int(moment or time.time())}-{pid}").write_text("")
    return store


@linux
def test_a_patch_counts_in_its_repository_only(
    tmp_path: Path, repository: Path, process: subprocess.Popen[bytes]
) -> None:
    store = patch(tmp_path, process.pid)
    assert PrecommitStash(store).holder(repository) == process.pid
    assert PrecommitStash(store).holder(repository / "robots") == process.pid
    assert PrecommitStash(store).holder(tmp_path) is None
    link = tmp_path / "link"
    link.symlink_to(repository)
    assert PrecommitStash(store).holder(link / "robots") == process.pid


@linux
def test_a_process_that_is_younger_than_the_patch_has_only_its_number(
    tmp_path: Path, repository: Path, process: subprocess.Popen[bytes]
) -> None:
    store = patch(tmp_path, process.pid, time.time() - 3600)
    assert PrecommitStash(store).holder(repository) is None


@linux
def test_other_files_and_ended_processes_are_nothing(tmp_path: Path, repository: Path) -> None:
    store = patch(tmp_path, 2**22 + 1)
    for name in ("patch", "patch-1", f"patch1-{os.getpid()}.txt", "db.db"):
        (store / name).write_text("")
    assert PrecommitStash(store).holder(repository) is None
    assert PrecommitStash(tmp_path / "nothing").holder(repository) is None


def test_a_patch_of_a_process_that_has_ended_is_not_asked_about_again(
    tmp_path: Path, repository: Path, process: subprocess.Popen[bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    stashed = PrecommitStash(patch(tmp_path, process.pid))
    assert stashed.holder(repository) == stashed.holder(repository) == process.pid
    process.kill()
    process.wait()
    assert stashed.holder(repository) is None
    monkeypatch.setattr(psutil, "Process", lambda pid: pytest.fail(f"{pid} has ended"))
    assert stashed.holder(repository) is None


def test_where_pre_commit_keeps_its_files(tmp_path: Path) -> None:
    assert store_folder({}, tmp_path) == tmp_path / ".cache/pre-commit"
    assert store_folder({"XDG_CACHE_HOME": "/x"}, tmp_path) == Path("/x/pre-commit")
    assert store_folder({"XDG_CACHE_HOME": "/x", "PRE_COMMIT_HOME": "/y"}, tmp_path) == Path("/y")
