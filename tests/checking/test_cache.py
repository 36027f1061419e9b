"""The user's cache: a limit, trimming what was used longest ago, clearing."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.checking.cache import AFTER, FULL, GRACE, LOCK, Cache, CacheError, Entry, surplus
from urdfsync.state.lock import Lock

NOW = 1e9
BLOCK = 4096
RECORDS = "rumoca/source-roots/parsed-files"


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    found = Cache(tmp_path / "cache")
    found.prepare()
    return found


def put(cache: Cache, name: str, age: float, blocks: int = 1) -> Path:
    """A file that was used `age` s ago."""
    path = cache.folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"x" * BLOCK * blocks)
    os.utime(path, (time.time() - age,) * 2)
    return path


def put_folder(cache: Cache, name: str, age: float, blocks: int = 1) -> Path:
    """A folder with a file, used `age` s ago."""
    folder = put(cache, f"{name}/some/file", age, blocks).parents[1]
    os.utime(folder, (time.time() - age,) * 2)
    return folder


def test_a_cache_that_is_not_there_is_empty(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "absent")
    assert (cache.size(), cache.trim(), cache.clear()) == (0, 0, 0)
    assert not cache.folder.exists()


def test_backup_programs_are_told(cache: Cache) -> None:
    assert (cache.folder / "CACHEDIR.TAG").read_text().startswith("Signature: 8a477f597d28d172789f06886806bc55")


def test_the_users_cache_is_where_the_system_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name, appauthor: tmp_path / name)
    assert Cache.of_user().folder == tmp_path / "urdfsync"


def test_what_was_used_longest_ago_goes_first(cache: Cache) -> None:
    old, middle, new = (put(cache, f"{RECORDS}/{age}.bin", age, 10) for age in (300, 200, 100))
    freed = cache.trim(limit=30 * BLOCK)
    assert [path.exists() for path in (old, middle, new)] == [False, False, True]
    assert freed >= 20 * BLOCK
    assert cache.size() <= 15 * BLOCK


def test_well_below_the_limit_nothing_goes(cache: Cache) -> None:
    kept = put(cache, f"{RECORDS}/a.bin", 1e6, 10)
    assert cache.trim(limit=20 * BLOCK) == 0
    assert kept.exists()


def test_a_record_goes_with_the_note_of_its_last_use(cache: Cache) -> None:
    used = put(cache, f"{RECORDS}/a.bin", 1000)
    note = put(cache, f"{RECORDS}/a.bin.rumoca-access", 10)
    unused = put(cache, f"{RECORDS}/b.bin", 500)
    lonely = put(cache, f"{RECORDS}/c.bin.rumoca-access", 600)
    cache.trim(limit=4 * BLOCK)
    assert used.exists()
    assert note.exists()
    assert not unused.exists()
    assert not lonely.exists()


def test_locks_of_the_compiler_stay(cache: Cache) -> None:
    lock = put(cache, "rumoca/.rumoca-prune.lock", 1e6, 10)
    cache.trim(limit=BLOCK)
    assert lock.exists()


def test_folders_go_as_a_whole_but_not_while_somebody_may_work_in_them(cache: Cache) -> None:
    old, recent = put_folder(cache, "libraries/old", GRACE + 60), put_folder(cache, "libraries/recent", 60)
    idle, busy = put_folder(cache, "work/idle", GRACE + 60), put_folder(cache, "work/busy", 60)
    cache.trim(limit=BLOCK)
    assert [path.exists() for path in (old, recent, idle, busy)] == [False, True, False, True]
    assert sorted(path.name for path in cache.libraries.iterdir()) == ["recent"], "no half of the other is left"


def test_a_folder_that_is_used_again_stays(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = put_folder(cache, "work/old", GRACE + 60)
    entries = list(cache._entries())
    monkeypatch.setattr(Cache, "_entries", lambda self: iter(entries))
    assert cache.workspace("old") == folder
    assert cache.trim(limit=BLOCK) == 0
    assert (folder / "some" / "file").exists()


def test_clearing_empties_it_and_says_how_much_that_was(cache: Cache) -> None:
    put(cache, f"{RECORDS}/a.bin", 0, 10)
    put(cache, "rumoca/.rumoca-prune-checked", 0)
    put_folder(cache, "libraries/one", 0, 10)
    put_folder(cache, "work/one", 0, 10)
    assert cache.clear() >= 30 * BLOCK
    assert cache.size() == 0
    assert [path.name for path in cache.folder.iterdir()] == ["CACHEDIR.TAG"]


def test_what_a_check_works_with_is_not_cleared(cache: Cache) -> None:
    record = put(cache, f"{RECORDS}/a.bin", 0)
    idle, busy = put_folder(cache, "work/idle", 0), put_folder(cache, "work/busy", 0)
    copied = put_folder(cache, "libraries/one", 0)
    (idle / LOCK).touch()
    with Lock(busy / LOCK, wait=0) as lock:
        lock.acquire()
        cache.clear()
        assert [path.exists() for path in (record, idle, busy, copied)] == [False, False, True, True]
        assert (busy / "some" / "file").exists()
    cache.clear()
    assert not busy.exists()
    assert not copied.exists()


def test_a_workspace_that_is_used_for_hours_is_not_trimmed(cache: Cache) -> None:
    busy = put_folder(cache, "work/busy", GRACE + 60)
    with Lock(busy / LOCK, wait=0) as lock:
        lock.acquire()
        os.utime(busy, (time.time() - GRACE - 60,) * 2)
        cache.trim(limit=1)
        assert (busy / "some" / "file").exists()
    cache.trim(limit=1)
    assert not busy.exists()


def test_without_the_library_that_knows_its_place_there_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "platformdirs", None)
    with pytest.raises(CacheError, match="platformdirs is not installed; pip install"):
        Cache.of_user()


def test_what_is_not_ours_stays(cache: Cache, tmp_path: Path) -> None:
    strange = put(cache, "photographs/one.jpg", 1e6, 10)
    put(cache, f"{RECORDS}/a.bin", 0)
    cache.trim(limit=BLOCK)
    cache.clear()
    assert strange.exists()


@pytest.mark.parametrize("place", ["work", "work/one", RECORDS, f"{RECORDS}/a.bin", "work/one/inside"])
def test_links_are_not_followed(place: str, cache: Cache, tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "precious").write_bytes(b"x" * 10 * BLOCK)
    link = cache.folder / place
    link.parent.mkdir(parents=True, exist_ok=True)
    link.symlink_to(outside, target_is_directory=True)
    assert cache.size() <= 2 * BLOCK
    cache.trim(limit=1)
    cache.clear()
    assert (outside / "precious").exists()


def test_a_workspace_is_found_again(cache: Cache) -> None:
    (cache.workspace("robot") / "file").touch()
    assert (cache.workspace("robot") / "file").exists()


def test_a_cache_that_can_not_be_made_is_a_clear_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(CacheError) as caught:
        Cache(tmp_path / "file" / "cache").workspace("robot")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.file) == ("cache-not-writable", str(tmp_path / "file" / "cache"))


entries = st.lists(
    st.builds(
        Entry,
        paths=st.uuids().map(lambda number: (str(number),)),
        used=st.floats(NOW - 3 * GRACE, NOW),
        size=st.integers(0, 1000),
        spared=st.booleans(),
    ),
    max_size=20,
)


@given(entries, st.integers(0, 10_000))
def test_trimming_deletes_neither_more_nor_less_than_it_should(found: list[Entry], limit: int) -> None:
    chosen = surplus(found, limit, NOW)
    total, left = sum(entry.size for entry in found), [entry for entry in found if entry not in chosen]
    if total <= FULL * limit:
        assert chosen == []
        return
    assert not any(entry.spared and entry.used > NOW - GRACE for entry in chosen)
    free = [entry for entry in left if not (entry.spared and entry.used > NOW - GRACE)]
    assert all(gone.used <= kept.used for gone in chosen for kept in free), "the longest unused first"
    if free:
        assert sum(entry.size for entry in left) <= AFTER * limit, "enough"
    if chosen:
        assert sum(entry.size for entry in (*left, chosen[-1])) > AFTER * limit, "and not one too many"
