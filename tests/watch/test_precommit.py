"""Whether pre-commit has stashed changes away, from the files that it makes."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from urdfsync.watch.precommit import find_stash

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


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "store"
    folder.mkdir()
    monkeypatch.setenv("PRE_COMMIT_HOME", str(folder))
    return folder


@linux
def test_a_patch_counts_in_its_repository_only(
    tmp_path: Path, repository: Path, store: Path, process: subprocess.Popen[bytes]
) -> None:
    patch = store / f"patch{int(time.time())}-{process.pid}"
    patch.write_text("")
    for name in (f"patch{int(time.time())}-{2**22 + 1}", "patch", "patch-1", f"patch1-{os.getpid()}.txt", "db.db"):
        (store / name).write_text("of others, or of a process that has ended")
    link = tmp_path / "link"
    link.symlink_to(repository)
    for place in (repository, repository / "robots", link / "robots"):
        assert find_stash(place) == (patch, process.pid)
    assert find_stash(tmp_path) is None
    process.kill()
    process.wait()
    assert find_stash(repository) is None


@linux
def test_a_process_that_is_younger_than_the_patch_has_only_its_number(
    repository: Path, store: Path, process: subprocess.Popen[bytes]
) -> None:
    (store / f"patch{int(time.time() - 3600)}-{process.pid}").write_text("")
    assert find_stash(repository) is None


@linux
def test_where_pre_commit_keeps_its_files(
    repository: Path, process: subprocess.Popen[bytes], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in ("PRE_COMMIT_HOME", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    for name, store in (("HOME", ".cache/pre-commit"), ("XDG_CACHE_HOME", "pre-commit"), ("PRE_COMMIT_HOME", ".")):
        monkeypatch.setenv(name, str(tmp_path / name))
        assert find_stash(repository) is None, "there is no such folder"
        patch = tmp_path / name / store / f"patch{int(time.time())}-{process.pid}"
        patch.parent.mkdir(parents=True)
        patch.touch()
        assert find_stash(repository) == (patch, process.pid)
