"""The operations that files change by, on systems that can do much and on those that can't."""

from __future__ import annotations

import errno
import os
import sys
from pathlib import Path
from unittest import mock

import psutil
import pytest

from urdfsync.project.state import file_operations


@pytest.fixture(params=["renames", "links", "no links"])
def system(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    if request.param != "renames":
        monkeypatch.setattr(file_operations, "_renameat2", lambda: lambda *_: errno.ENOSYS)
    if request.param == "no links":
        monkeypatch.setattr(os, "link", mock.Mock(side_effect=OSError(errno.EPERM, os.strerror(errno.EPERM))))
    return str(request.param)


@pytest.fixture
def old(tmp_path: Path) -> Path:
    path = tmp_path / "old"
    path.write_bytes(b"old")
    path.chmod(0o640)
    return path


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def is_open(path: Path) -> bool:
    return str(path) in {file.path for file in psutil.Process().open_files()}


def test_a_written_file_is_new_and_has_the_permissions_of_another(tmp_path: Path, old: Path) -> None:
    file_operations.write(tmp_path / "new", b"new", old)
    assert (tmp_path / "new").stat().st_mode == old.stat().st_mode
    file_operations.write(tmp_path / "newer", b"", tmp_path / "none")
    assert contents(tmp_path) == {"old": b"old", "new": b"new", "newer": b""}
    assert not is_open(old)
    assert not is_open(tmp_path / "new")


@pytest.mark.parametrize("target", ["old", "none"])
def test_what_is_written_takes_no_place_and_follows_no_link(tmp_path: Path, old: Path, target: str) -> None:
    (tmp_path / "link").symlink_to(tmp_path / target)
    for path in (old, tmp_path / "link"):
        with pytest.raises(FileExistsError):
            file_operations.write(path, b"new", old)
    assert old.read_bytes() == b"old"
    assert not (tmp_path / "none").exists()


def test_a_place_must_be_free(system: str, old: Path, tmp_path: Path) -> None:
    file_operations.place(old, tmp_path / "target")
    assert contents(tmp_path) == {"target": b"old"}
    old.write_bytes(b"newer")
    with pytest.raises(FileExistsError):
        file_operations.place(old, tmp_path / "target")
    assert contents(tmp_path) == {"target": b"old", "old": b"newer"}


def test_two_files_are_swapped(system: str, old: Path, tmp_path: Path) -> None:
    (tmp_path / "other").write_bytes(b"other")
    file_operations.exchange(old, tmp_path / "other")
    assert contents(tmp_path) == {"old": b"other", "other": b"old"}
    with pytest.raises(FileNotFoundError):
        file_operations.exchange(old, tmp_path / "none")
    assert contents(tmp_path) == {"old": b"other", "other": b"old"}


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux swaps files")
def test_two_files_are_swapped_at_once(old: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The target is never missing, as it would be between renames."""
    (tmp_path / "other").write_bytes(b"other")
    monkeypatch.setattr(file_operations, "replace", mock.Mock(side_effect=AssertionError))
    file_operations.exchange(old, tmp_path / "other")
    assert contents(tmp_path) == {"old": b"other", "other": b"old"}


@pytest.mark.parametrize("done", range(3))
def test_an_exchange_that_was_cut_short_is_completed(tmp_path: Path, old: Path, done: int) -> None:
    target, spare = tmp_path / "target", Path(file_operations.spare(old))
    target.write_bytes(b"target")
    for source, to in ((target, spare), (old, target), (spare, old))[:done]:
        source.rename(to)
    file_operations.exchange(old, target)
    assert contents(tmp_path) == {"old": b"target", "target": b"old"}


def test_what_is_no_regular_file_is_not_read(old: Path, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(old)
    for path in (tmp_path, tmp_path / "link"):
        with pytest.raises(IsADirectoryError):
            file_operations.read(path)
    assert file_operations.read(tmp_path / "none") is file_operations.read(old / "below a file") is None


@pytest.mark.skipif(sys.platform == "win32", reason="folders need no sync there")
def test_a_few_files_are_synced_alone_and_many_together(
    old: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    synced: list[int] = []
    monkeypatch.setattr(os, "fsync", lambda descriptor: synced.append(os.fstat(descriptor).st_ino))
    monkeypatch.setattr(os, "sync", lambda: synced.append(0), raising=False)
    file_operations.sync([old, tmp_path])
    assert synced == [old.stat().st_ino, tmp_path.stat().st_ino]
    assert not is_open(old)
    file_operations.sync([old] * 40)
    assert synced[2:] == ([0] if hasattr(os, "sync") else [old.stat().st_ino] * 40)
    with pytest.raises(FileNotFoundError) as caught:
        file_operations.sync([old, tmp_path / "none"])
    assert caught.value.filename == str(tmp_path / "none")
