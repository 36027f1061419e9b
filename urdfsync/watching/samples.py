"""What files are at one moment: their stat values and hashes. Hashed is only what differs from the last sample.

A file that was written just before it was sampled can change again without any difference in its stat values, as
clocks of file systems are coarse. So its stat values are not trusted until it is some time old; nor are those of a
file from the future, which a clock leaves behind that goes backwards.
"""

from __future__ import annotations

import errno
import hashlib
import os
import stat
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

_RACY = 2_000_000_000
"""Nanoseconds after which a time of change can be told from a later one, on every file system in use."""


class Entry(NamedTuple):
    """One path at one moment."""

    facts: tuple[int | str, ...]
    """Target of the symbolic link, size (bytes), time of change (ns), inode and device; of files only."""
    content: str
    """SHA-256 (hex) of a file; else a word that no hash is: `missing`, `folder`, `other`, or the number of an error."""


Sample: TypeAlias = Mapping[str, Entry]
"""Paths at one moment."""

MISSING = Entry((), "missing")


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

    def may_differ(self, path: str, from_: Entry | None) -> bool:
        """Whether a path is not what it was, as far as can be told at little cost: a file that changes is not read."""
        facts = _facts(path)
        if isinstance(facts, Entry) or from_ is None:
            return facts != from_
        return facts != from_.facts or self._look(path, self._now()) != from_

    def keep(self, paths: Iterable[str]) -> None:
        """Forget all other paths."""
        self._seen = {path: self._seen[path] for path in paths if path in self._seen}

    def forget(self) -> None:
        """Hash everything again."""
        self._seen.clear()

    def _look(self, path: str, now: int) -> Entry:
        facts = _facts(path)
        if isinstance(facts, Entry):
            self._seen.pop(path, None)
            return facts
        old, racy = self._seen.get(path, (None, True))
        if old is not None and not racy and old.facts == facts:
            return old
        try:
            entry = Entry(facts, _hash(path))
        except OSError as error:
            entry = _error(error)
        if entry == old:
            entry = old  # one value for all samples
        self._seen[path] = entry, int(facts[2]) > now - _RACY
        return entry


def changed(old: Sample, new: Sample) -> Iterator[str]:
    """The paths of which the content differs, as far as both samples have them."""
    return (path for path in old.keys() & new.keys() if old[path].content != new[path].content)


def alike(old: Sample, new: Sample) -> bool:
    """Whether two samples have the same paths with the same content, whenever that was written."""
    return old.keys() == new.keys() and not any(changed(old, new))


def files_below(folder: str) -> Iterator[str]:
    """All files in a folder and the folders in it; none if it can't be read."""
    for current, _, names in os.walk(folder):
        yield from (os.path.join(current, name) for name in names)  # noqa: PTH118 - many, and often


def _facts(path: str) -> tuple[int | str, ...] | Entry:
    """The stat values of a file; for everything else all that there is to say of it."""
    try:
        found, link = os.lstat(path), ""
        if stat.S_ISLNK(found.st_mode):
            link, found = os.readlink(path), os.stat(path)  # noqa: PTH115, PTH116 - many, and often
    except OSError as error:
        return _error(error)
    if stat.S_ISREG(found.st_mode):
        return link, found.st_size, found.st_mtime_ns, found.st_ino, found.st_dev
    return Entry((), "folder" if stat.S_ISDIR(found.st_mode) else "other")


def _error(error: OSError) -> Entry:
    gone = error.errno in (errno.ENOENT, errno.ENOTDIR)
    return MISSING if gone else Entry((), f"error {error.errno}")


def _hash(path: str) -> str:
    with open(path, "rb", opener=_open) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _open(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))  # a pipe in the place of a file must not hold it up
