"""States of inputs, and when a file is hashed again."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfsync.engine.package_files import state_of
from urdfsync.watch import input_files
from urdfsync.watch.input_files import InputFiles, all_files_below, has_changes, same_content

SECOND = 1_000_000_000


def write(path: Path, content: str, mtime: int = 1000) -> str:
    path.write_text(content)
    os.utime(path, (mtime, mtime))
    return str(path)


@pytest.fixture
def hashed(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    """Grows by the content of every file that is hashed."""
    found: list[bytes] = []

    def count(stat: tuple[int, int, int, int, int, int], content: bytes) -> object:
        found.append(content)
        return state_of(stat, content)

    monkeypatch.setattr(input_files, "state_of", count)
    return found


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], None]:
    """A function that sets the clock to so many seconds from now: ctime can't be set."""
    real = time.time_ns

    def set_clock(seconds: int) -> None:
        monkeypatch.setattr(time, "time_ns", lambda: real() + seconds * SECOND)

    set_clock(10)
    return set_clock


def test_only_what_differs_is_hashed(tmp_path: Path, hashed: list[bytes], clock: Callable[[int], None]) -> None:
    one, two = write(tmp_path / "one", "1"), write(tmp_path / "two", "2")
    files = InputFiles()
    before = files.read_all([one, two])
    assert files.read_all([one, two]) == before
    assert hashed == [b"1", b"2"]
    write(tmp_path / "two", "3")
    after = files.read_all([one, two])
    assert hashed == [b"1", b"2", b"3"]
    assert has_changes(before, after)
    files.rehash_all()
    assert files.read_all([one, two]) == after
    files.forget_others([one])
    files.read_all([one, two])
    assert hashed == [b"1", b"2", b"3", b"1", b"3", b"3"]


@pytest.mark.parametrize("seconds", [0, 1, -3600])
def test_what_is_racy_or_from_the_future_is_hashed_each_time(
    tmp_path: Path, seconds: int, hashed: list[bytes], clock: Callable[[int], None]
) -> None:
    clock(seconds)
    path, files = write(tmp_path / "one", "1"), InputFiles()
    before = files.read(path)
    assert files.read(path) == before
    assert hashed == [b"1", b"1"]


def test_a_file_that_grows_differs_without_being_read(tmp_path: Path, hashed: list[bytes]) -> None:
    path, files = write(tmp_path / "one", "1"), InputFiles()
    before = files.read(path)
    assert not files.may_differ(path, before)
    hashed.clear()
    write(tmp_path / "one", "12")
    assert files.may_differ(path, before)
    assert hashed == []


def test_the_same_content_at_another_time_or_in_another_file_is_not_equal(tmp_path: Path) -> None:
    path, files = write(tmp_path / "one", "1"), InputFiles()
    before = files.read_all([path])
    write(tmp_path / "one", "1", 2000)
    later = files.read_all([path])
    write(tmp_path / "two", "1")
    (tmp_path / "two").rename(path)
    replaced = files.read_all([path])
    assert before != later != replaced
    assert same_content(before, later)
    assert same_content(later, replaced)


def test_every_path_has_a_state(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "link").symlink_to(write(tmp_path / "file", "1"))
    files = InputFiles()
    names = ("nothing", "folder", "pipe", "loop", "nothing/at/all", "link")
    found = [files.read(str(tmp_path / name)).sha256 for name in names]
    assert found == ["missing", "folder", "other", "error 40", "missing", files.read(str(tmp_path / "file")).sha256]


def test_files_below_a_folder(tmp_path: Path) -> None:
    (tmp_path / "a/b").mkdir(parents=True)
    write(tmp_path / "a/b/c", "")
    write(tmp_path / "a/d", "")
    assert sorted(all_files_below(str(tmp_path))) == [str(tmp_path / "a/b/c"), str(tmp_path / "a/d")]
    assert list(all_files_below(str(tmp_path / "nothing"))) == []
