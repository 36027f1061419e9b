"""What files are at one moment: what the system says of them, and their hashes.

Hashed is only what differs from the last sample, and what is too young to be trusted, see `_is_racy`.
"""

from __future__ import annotations

import errno
import hashlib
import os
import stat
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from urdfsync.dependencies import NO_STAT, Stat, stat_of


class Entry(NamedTuple):
    """One path at one moment."""

    facts: Stat
    """What the system says of a file."""
    link: str
    """Where it is, if the path is a symbolic link."""
    content: str
    """SHA-256 (hex) of a file; else a word that no hash is: `missing`, `folder`, `other`, or the number of an error."""


Sample: TypeAlias = Mapping[str, Entry]
"""Paths at one moment."""

_COARSE_TICK = 2_000_000_000
"""No clock of a file system is coarser (ns): that of FAT."""
MISSING = Entry(NO_STAT, "", "missing")


class Sampler:
    """Takes samples, and remembers hashes as long as nothing speaks against them."""

    def __init__(self, now: Callable[[], int] = lambda: time.time_ns()) -> None:
        """`now` is the clock that times of change come from, in nanoseconds; it may jump."""
        self._now = now
        self._seen: dict[str, tuple[Entry, bool]] = {}

    def sample(self, paths: Iterable[str]) -> Sample:
        """The paths as they are now. Links are followed; whatever can't be read has an entry that says so."""
        now = self._now()
        return {path: self._look(path, now) for path in paths}

    def may_differ(self, path: str, from_: Entry) -> bool:
        """Whether a path is not what it was, as far as can be told at little cost: a file that changes is not read."""
        found = _facts(path)
        if isinstance(found, Entry):
            return found != from_
        return found != from_[:2] or self._look(path, self._now()) != from_

    def keep(self, paths: Iterable[str]) -> None:
        """Forget all other paths."""
        self._seen = {path: self._seen[path] for path in paths if path in self._seen}

    def forget(self) -> None:
        """Hash everything again."""
        self._seen.clear()

    def _look(self, path: str, now: int) -> Entry:
        found = _facts(path)
        if isinstance(found, Entry):
            self._seen.pop(path, None)
            return found
        old, young = self._seen.get(path, (None, True))
        if old is not None and not young and old[:2] == found:
            return old
        try:
            entry = Entry(*found, _hash(path))
        except OSError as error:
            entry = _error(error)
        if entry == old:
            entry = old  # one value for all samples
        self._seen[path] = entry, _is_racy(found[0], now)
        return entry


def changed(old: Sample, new: Sample) -> Iterator[str]:
    """The paths of which the content differs, as far as both samples have them."""
    return (path for path in old.keys() & new.keys() if old[path].content != new[path].content)


def alike(old: Sample, new: Sample) -> bool:
    """Whether two samples have the same paths with the same content, whenever that was written."""
    return old.keys() == new.keys() and not any(changed(old, new))


def all_files_below(folder: str) -> Iterator[str]:
    """All files in a folder and the folders in it; none if it can't be read.

    Links to folders are not followed, and whatever stands there counts, not only what a build would read.
    """
    for current, _, names in os.walk(folder):
        yield from (os.path.join(current, name) for name in names)  # noqa: PTH118 - many, and often


def _is_racy(found: Stat, now: int) -> bool:
    """Whether a file may change again and show the same stat values, since it changed just before `now` (ns).

    By the clock of this machine: sources are on any file systems, and the daemon makes no files there to read theirs.
    """
    return max(found[-2:]) > now - _COARSE_TICK


def _facts(path: str) -> tuple[Stat, str] | Entry:
    """What the system says of a file, and where a link leads; for everything else all that there is to say of it."""
    try:
        found, link = os.lstat(path), ""
        if stat.S_ISLNK(found.st_mode):
            link, found = os.readlink(path), os.stat(path)  # noqa: PTH115, PTH116 - many, and often
    except OSError as error:
        return _error(error)
    if stat.S_ISREG(found.st_mode):
        return stat_of(found), link
    return Entry(NO_STAT, "", "folder" if stat.S_ISDIR(found.st_mode) else "other")


def _error(error: OSError) -> Entry:
    gone = error.errno in (errno.ENOENT, errno.ENOTDIR)
    return MISSING if gone else Entry(NO_STAT, "", f"error {error.errno}")


def _hash(path: str) -> str:
    with open(path, "rb", opener=_open) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _open(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))  # a pipe in the place of a file must not hold it up
