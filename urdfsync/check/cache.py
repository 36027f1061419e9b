"""The user's cache folder: copies of libraries, what the compiler remembers, workspaces, templates, results.

Everything in it can be made again. What was used longest ago goes first; what a check works with stays.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
import time
import uuid
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import platformdirs

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

LIMIT = 2**30
"""Bytes on disk that the cache never grows past: 1 GiB."""
_FULL, _AFTER = 0.75, 0.5  # parts of the limit: from the first on something is deleted, until the second is left
_GRACE = 3600.0  # s: a copy of a library that was used since then stays, since checks may work with it

_LOCK = "lock"  # the file in a workspace that whoever works there keeps locked
_ACCESS = ".rumoca-access"  # suffix of the file beside another by which the compiler notes its last use
_TAG = "Signature: 8a477f597d28d172789f06886806bc55\n# Made by urdfsync; may be deleted at any time.\n"


class CacheError(UrdfsyncError):
    """There is no cache that can be used; the code of the one diagnostic is `cache-not-writable`."""


class CacheEntry(NamedTuple):
    """What is deleted together."""

    paths: tuple[Path, ...]
    used: float
    """When it was used last, in seconds of the system's clock."""
    size: int
    """Bytes on disk."""
    is_in_use: bool = False


class UserCache:
    """The cache in a folder, which need not exist; `UserCache.default` is the one of this user."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.libraries = folder / "libraries"
        self.compiler = folder / "rumoca"
        self.workspaces = folder / "work"
        self.templates = folder / "templates"
        self.results = folder / "results"

    @classmethod
    def default(cls) -> UserCache:
        """The cache where this system keeps such: on Linux `~/.cache/urdfsync`, or below XDG_CACHE_HOME."""
        return cls(platformdirs.user_cache_path("urdfsync", appauthor=False))

    def prepare(self) -> None:
        """Make the folder; raises CacheError if that can't be."""
        with cache_errors(self.folder):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)  # `template_cache` takes no other
            tag = self.folder / "CACHEDIR.TAG"  # backup programs leave such a folder out
            if not tag.is_file():
                tag.write_text(_TAG, encoding="utf-8")

    @contextlib.contextmanager
    def workspace(self, name: str) -> Iterator[Path]:
        """A folder to work in: always the same, so that what the compiler remembers of it stays good.

        While somebody else works in it, it is one that is deleted in the end. Raises CacheError if it can't be made.
        """
        import filelock  # an optional extra

        self.prepare()
        with contextlib.ExitStack() as stack:
            with cache_errors(self.folder):
                folder = self.workspaces / name
                folder.mkdir(parents=True, exist_ok=True)
                os.utime(folder)
                try:
                    stack.enter_context(filelock.FileLock(folder / _LOCK, timeout=0))
                except filelock.Timeout:
                    folder = Path(stack.enter_context(tempfile.TemporaryDirectory(dir=self.workspaces)))
                    stack.enter_context(filelock.FileLock(folder / _LOCK, timeout=0))
            yield folder / "packages"

    def size(self) -> int:
        """Bytes on disk."""
        return sum(entry.size for entry in self._entries())

    def trim(self, limit: int = LIMIT) -> None:
        """Delete what was used longest ago, if the cache comes near the limit. What can't be deleted now stays."""
        for entry in entries_to_delete(self._entries(), limit):
            _delete(entry)

    def clear(self) -> int:
        """Delete everything that is ours, but for what running checks work with; the bytes that came free.

        What the compiler remembers goes in any case: it makes again what it misses.
        """
        entries = list(self._entries())
        busy = {entry.paths for entry in entries if entry.is_in_use and entry.paths[0].parent == self.workspaces}
        if busy:
            busy |= {entry.paths for entry in entries if entry.paths[0].parent == self.libraries}
        freed = sum(_delete(entry) for entry in entries if entry.paths not in busy)
        ours = (self.libraries, self.compiler, self.workspaces, self.templates, self.results)
        for folder in ours if not busy else ():
            if _is_folder(folder):
                shutil.rmtree(folder, ignore_errors=True)  # empty folders are left, and what is being made
        return freed

    def _entries(self) -> Iterator[CacheEntry]:
        if _is_folder(self.compiler):
            yield from _records(self.compiler)
        recent = time.time() - _GRACE
        for parent in (self.libraries, self.workspaces, self.templates, self.results):
            for path in list(parent.iterdir()) if _is_folder(parent) else []:
                found = [path, *(path.rglob("*") if _is_folder(path) else ())]
                used = max((status.st_mtime for status in _statuses([path])), default=0.0)
                is_in_use = (
                    _is_locked(path) if parent == self.workspaces else used > recent and parent == self.libraries
                )
                size = sum(map(_size, _statuses(found)))
                yield CacheEntry((path,), used, size, is_in_use)


def entries_to_delete(entries: Iterable[CacheEntry], limit: int) -> list[CacheEntry]:
    """What to delete of the entries, the longest unused first; nothing well below the limit."""
    waiting = sorted(entries, key=lambda entry: (entry.used, entry.paths))
    total = sum(entry.size for entry in waiting)
    if total <= _FULL * limit:
        return []
    chosen = []
    for entry in waiting:
        if total <= _AFTER * limit:
            break
        if not entry.is_in_use:
            chosen.append(entry)
            total -= entry.size
    return chosen


@contextlib.contextmanager
def cache_errors(folder: Path) -> Iterator[None]:
    """Whatever the system refuses inside becomes a CacheError about `folder`."""
    try:
        yield
    except OSError as error:
        message = f"the cache can't be written to: {error.strerror or error}"
        hint = "make room, or name another folder with XDG_CACHE_HOME"
        raise CacheError(Diagnostic(Severity.ERROR, "cache-not-writable", message, str(folder), hint=hint)) from error


def _records(folder: Path) -> Iterator[CacheEntry]:
    """What the compiler remembers, file by file, each with the file that notes its last use."""
    groups: dict[Path, list[Path]] = {}
    for path in folder.rglob("*"):
        if not _is_folder(path) and not path.name.startswith("."):  # its locks
            groups.setdefault(path.with_name(path.name.removesuffix(_ACCESS)), []).append(path)
    for paths in groups.values():
        if statuses := _statuses(paths):
            used = max(status.st_mtime for status in statuses)
            yield CacheEntry(tuple(paths), used, sum(map(_size, statuses)))


def _statuses(paths: Iterable[Path]) -> list[os.stat_result]:
    found = []
    for path in paths:
        with contextlib.suppress(OSError):  # it is gone: others trim too
            found.append(path.lstat())
    return found


def _size(status: os.stat_result) -> int:
    return max(status.st_size, getattr(status, "st_blocks", 0) * 512)


def _is_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _is_locked(workspace: Path) -> bool:
    """Whether somebody works in a workspace."""
    import filelock

    if workspace.is_symlink() or not (workspace / _LOCK).is_file():
        return False
    try:
        with filelock.FileLock(workspace / _LOCK, timeout=0):
            return False
    except filelock.Timeout:
        return True


def _delete(entry: CacheEntry) -> int:
    """Delete what belongs together, links themselves and not what they lead to; the bytes that came free."""
    for path in entry.paths:
        with contextlib.suppress(OSError):
            if not _is_folder(path):
                path.unlink()
            elif path.stat().st_mtime <= entry.used and not _is_locked(path):  # else somebody has begun to use it
                aside = path.with_name(f"old-{uuid.uuid4().hex}")  # nobody shall find half of it
                path.rename(aside)
                shutil.rmtree(aside, ignore_errors=True)
    return 0 if any(os.path.lexists(path) for path in entry.paths) else entry.size
