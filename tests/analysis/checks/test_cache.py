"""The user's cache folder: what is deleted when, and what never."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from urdfsync.analysis.checks.cache import CacheError, UserCache
from urdfsync.analysis.checks.results import CheckResult

BLOCK = 4096
RECORDS = "rumoca/semantic"
HOUR = 3600


@pytest.fixture
def cache(tmp_path: Path) -> UserCache:
    found = UserCache(tmp_path / "cache")
    found.prepare()
    return found


def put(cache: UserCache, name: str, age: float, blocks: int = 1) -> Path:
    """A file that was used `age` seconds ago."""
    file = cache.folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(b"x" * blocks * BLOCK)
    os.utime(file, (time.time() - age,) * 2)
    return file


def put_folder(cache: UserCache, name: str, age: float, blocks: int = 10) -> Path:
    """A folder that was used `age` seconds ago."""
    file = put(cache, f"{name}/some/file", age, blocks)
    os.utime(cache.folder / name, (time.time() - age,) * 2)
    return file.parents[1]


def test_only_the_user_may_write_to_it(cache: UserCache) -> None:
    assert os.name == "nt" or cache.folder.stat().st_mode & 0o777 == 0o700


def test_what_was_used_longest_ago_goes_first_and_no_more_than_needed(cache: UserCache) -> None:
    files = [put(cache, f"{RECORDS}/{age}.bin", age, 10) for age in (300, 200, 100)]
    cache.trim(limit=40 * BLOCK)
    assert all(file.exists() for file in files), "three quarters of the limit"
    cache.trim(limit=30 * BLOCK)
    assert [path.exists() for path in files] == [False, False, True]


def test_locks_stay(cache: UserCache) -> None:
    record, lock = put(cache, f"{RECORDS}/a.bin", 500), put(cache, "rumoca/.rumoca-prune.lock", 1e6, 10)
    cache.trim(limit=0)
    assert [path.exists() for path in (record, lock)] == [False, True]


def test_folders_go_as_a_whole(cache: UserCache) -> None:
    put_folder(cache, "libraries/old", 2 * HOUR)
    put_folder(cache, "libraries/recent", 60, 2)
    cache.trim(limit=8 * BLOCK)
    assert [path.name for path in cache.libraries.iterdir()] == ["recent"], "no half of the other is left"


def test_a_library_that_a_check_may_work_with_is_not_trimmed(cache: UserCache) -> None:
    record = put(cache, f"{RECORDS}/a.bin", 0)
    busy, idle = put_folder(cache, "libraries/busy", HOUR / 2), put_folder(cache, "libraries/idle", 2 * HOUR)
    cache.trim(limit=1)
    assert [path.exists() for path in (busy, idle, record)] == [True, False, False]


def test_results_go_as_well(cache: UserCache) -> None:
    cache.save("a", {"right": True})
    assert cache.load("a", dict[str, bool]) == {"right": True}
    cache.trim(0)
    assert cache.load("a", dict[str, bool]) is None


@pytest.mark.parametrize("place", ["libraries", "libraries/one", RECORDS, f"{RECORDS}/a.bin", "libraries/one/inside"])
def test_links_are_not_followed_and_what_is_not_ours_stays(place: str, cache: UserCache, tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "precious").write_bytes(b"x" * 10 * BLOCK)
    strange = put(cache, "photographs/one.jpg", 1e6, 10)
    link = cache.folder / place
    link.parent.mkdir(parents=True, exist_ok=True)
    link.symlink_to(outside, target_is_directory=True)
    cache.trim(limit=1)
    assert (outside / "precious").exists()
    assert strange.exists()


def test_a_cache_that_can_not_be_made_is_a_clear_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(CacheError) as caught:
        UserCache(tmp_path / "file" / "cache").prepare()
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.file) == ("cache-not-writable", str(tmp_path / "file" / "cache"))


def test_what_others_delete_meanwhile_is_passed_over(cache: UserCache, monkeypatch: pytest.MonkeyPatch) -> None:
    cache.results.mkdir(parents=True)
    monkeypatch.setattr(os, "walk", lambda folder: [(str(folder), [], ["gone.json"])])
    cache.trim(0)


@pytest.mark.parametrize("content", [b"", b"\xff", b"[]", b'{"key": "0"}'])
def test_a_result_may_be_lost(cache: UserCache, content: bytes) -> None:
    result = CheckResult("arm", "Arm", seconds=float("inf"))
    cache.save("a", result)
    assert cache.load("a", CheckResult) == result
    (cache.results / "a").write_bytes(content)
    assert cache.load("a", CheckResult) is None
