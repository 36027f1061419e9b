"""States of the files that robots are built from, of which a file is hashed only if its stat values differ."""

from __future__ import annotations

import errno
import os
import stat
import time
from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias

from urdfsync.dependencies import NO_STAT, read_unrecorded, stat_of
from urdfsync.engine.package_files import FileState, state_of

InputStates: TypeAlias = Mapping[str, FileState]
"""By absolute path. A path without a readable file has a word for its hashes, such as `missing`."""

_COARSE_TICK = 2_000_000_000
"""No clock of a file system is coarser (ns): that of FAT."""
MISSING = FileState(NO_STAT, "missing", "missing")


class InputFiles:
    """Reads states, and keeps those that are not racy."""

    def __init__(self) -> None:
        self._known: dict[str, FileState] = {}

    def read(self, path: str) -> FileState:
        """Return the state of a path. Links are followed, and an error is a state, too."""
        state = _state_without_content(path)
        if state.stat == NO_STAT:
            self._known.pop(path, None)
            return state
        known = self._known.get(path)
        if known is not None and known.stat == state.stat:
            return known
        try:
            state = state_of(state.stat, read_unrecorded(path))
        except OSError as error:
            return _unreadable(error)
        # a file that changed just now may change again and keep its stat values, so it is hashed again next time;
        # by the clock of this machine, since the daemon writes no files where sources are
        is_racy = max(state.stat[-2:]) > time.time_ns() - _COARSE_TICK
        self._known[path] = state._replace(stat=NO_STAT) if is_racy else state
        return state

    def read_all(self, paths: Iterable[str]) -> InputStates:
        """Return the states of some paths."""
        return {path: self.read(path) for path in paths}

    def may_differ(self, path: str, before: FileState) -> bool:
        """Return whether a path is not as before. A file with other stat values is not read: it may still grow."""
        state = _state_without_content(path)
        if state.stat == NO_STAT:
            return state != before
        return state.stat != before.stat or self.read(path) != before

    def forget_others(self, paths: Iterable[str]) -> None:
        """Drop the states of all other paths."""
        self._known = {path: self._known[path] for path in paths if path in self._known}

    def rehash_all(self) -> None:
        """Hash all files again, whatever their stat values."""
        self._known.clear()


def same_content(old: InputStates, new: InputStates) -> bool:
    """Return whether two samples have the same paths with the same content, whenever that was written."""
    return old.keys() == new.keys() and not has_changes(old, new)


def has_changes(old: InputStates, new: InputStates) -> bool:
    """Return whether the content of any path differs that both samples have."""
    return any(old[path].sha256 != new[path].sha256 for path in old.keys() & new.keys())


def all_files_below(folder: str) -> Iterator[str]:
    """Yield all files below a folder, without following links; none if the folder can't be read."""
    for current, _, names in os.walk(folder):
        yield from (os.path.join(current, name) for name in names)  # noqa: PTH118 - many, and often


def _state_without_content(path: str) -> FileState:
    try:
        status = os.stat(path)  # noqa: PTH116 - many, and often
    except OSError as error:
        return _unreadable(error)
    if stat.S_ISREG(status.st_mode):
        return FileState(stat_of(status), "", "")
    word = "folder" if stat.S_ISDIR(status.st_mode) else "other"
    return FileState(NO_STAT, word, word)


def _unreadable(error: OSError) -> FileState:
    word = f"error {error.errno}"
    return MISSING if error.errno in (errno.ENOENT, errno.ENOTDIR) else FileState(NO_STAT, word, word)
