"""Stat values and hashes of files, and which of them are trusted."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from urdfsync.watching import samples
from urdfsync.watching.samples import Sampler, alike, all_files_below, changed

SECOND = 1_000_000_000
OLD = 1000 * SECOND
"""A time of change that the tests set; that of a change of status is always now."""


def later() -> int:
    """A clock by which all files are old."""
    return time.time_ns() + 10 * SECOND


def write(path: Path, content: str, moment: int = OLD) -> str:
    path.write_text(content)
    os.utime(path, ns=(moment, moment))
    return str(path)


@pytest.fixture
def hashed(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Grows by every path that is hashed."""
    paths: list[str] = []
    real = samples._hash

    def count(path: str) -> str:
        paths.append(path)
        return real(path)

    monkeypatch.setattr(samples, "_hash", count)
    return paths


def test_only_what_differs_is_hashed(tmp_path: Path, hashed: list[str]) -> None:
    one, two = write(tmp_path / "one", "1"), write(tmp_path / "two", "2")
    sampler = Sampler(later)
    before = sampler.sample([one, two])
    assert sampler.sample([one, two]) == before
    assert hashed == [one, two]
    write(tmp_path / "two", "3", OLD + 1)
    after = sampler.sample([one, two])
    assert hashed == [one, two, two]
    assert list(changed(before, after)) == [two]


def test_what_is_forgotten_is_hashed_again(tmp_path: Path, hashed: list[str]) -> None:
    path = write(tmp_path / "one", "1")
    sampler = Sampler(later)
    sampler.sample([path])
    sampler.forget()
    sampler.sample([path])
    sampler.keep([])
    sampler.sample([path])
    assert len(hashed) == 3


@pytest.mark.parametrize("age", [0, 1, -3600, None])
def test_what_is_young_or_from_the_future_is_hashed_each_time(
    tmp_path: Path, age: int | None, hashed: list[str]
) -> None:
    path = write(tmp_path / "one", "1")
    sampler = Sampler(later if age is None else lambda: Path(path).stat().st_ctime_ns + age * SECOND)
    before = sampler.sample([path])
    assert not sampler.may_differ(path, before[path])
    assert hashed == [path] * (1 if age is None else 2)


def test_a_file_that_was_changed_back_in_time_differs(tmp_path: Path) -> None:
    path = write(tmp_path / "one", "1")
    sampler = Sampler(later)
    before = sampler.sample([path])
    time.sleep(0.01)  # a tick of the clock
    write(tmp_path / "one", "2")
    assert sampler.may_differ(path, before[path])
    assert not alike(before, sampler.sample([path]))


def test_the_same_content_at_another_time_is_alike_but_not_equal(tmp_path: Path) -> None:
    sampler = Sampler()
    path = write(tmp_path / "one", "1")
    before = sampler.sample([path])
    write(tmp_path / "one", "1", OLD + 5)
    after = sampler.sample([path])
    assert before != after
    assert alike(before, after)


def test_a_file_that_was_replaced_by_an_equal_one_is_not_equal(tmp_path: Path) -> None:
    sampler = Sampler()
    path = write(tmp_path / "one", "1")
    before = sampler.sample([path])
    write(tmp_path / "two", "1")
    (tmp_path / "two").rename(path)
    assert sampler.sample([path]) != before


def test_everything_has_an_entry(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "loop").symlink_to("loop")
    paths = [str(tmp_path / name) for name in ("nothing", "folder", "pipe", "loop", "nothing/at/all")]
    found = Sampler().sample(paths)
    assert [found[path].content for path in paths] == ["missing", "folder", "other", "error 40", "missing"]


def test_a_link_is_its_target_and_what_is_there(tmp_path: Path) -> None:
    one, two = write(tmp_path / "one", "same"), write(tmp_path / "two", "same")
    link = tmp_path / "link"
    link.symlink_to(one)
    sampler = Sampler()
    before = sampler.sample([str(link)])
    link.unlink()
    link.symlink_to(two)
    after = sampler.sample([str(link)])
    assert before != after
    assert alike(before, after)


def test_a_file_that_is_read_while_it_grows_may_differ_without_being_read(tmp_path: Path, hashed: list[str]) -> None:
    sampler = Sampler()
    path = write(tmp_path / "one", "1")
    before = sampler.sample([path])
    write(tmp_path / "one", "12", OLD + 1)
    assert sampler.may_differ(path, before[path])
    assert len(hashed) == 1


def test_files_below_a_folder(tmp_path: Path) -> None:
    (tmp_path / "a/b").mkdir(parents=True)
    (tmp_path / "a/b/c").write_text("")
    (tmp_path / "a/d").write_text("")
    assert sorted(all_files_below(str(tmp_path))) == [str(tmp_path / "a/b/c"), str(tmp_path / "a/d")]
    assert list(all_files_below(str(tmp_path / "nothing"))) == []
