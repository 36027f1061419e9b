"""The user's cache folder: libraries, what the compiler remembers, workspaces, templates; kept below a limit.

Everything in it can be made again. What was used longest ago goes first; a check that runs meanwhile loses nothing
but time, since the compiler makes again what it misses, and what else is in use or was within the last hour stays.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import time
import uuid
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec

from urdfsync.diagnostics import Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.state.lock import Lock, LockedError

LIMIT = 2**30
"""Bytes on disk that the cache never grows past: 1 GiB."""
FULL = 0.75
"""The part of the limit from which on something is deleted, so that compilers at work have room meanwhile."""
AFTER = 0.5
"""The part of the limit that is left then, so that it is not every time."""
GRACE = 3600.0
"""Seconds for which folders that checks may work in are spared after their last use."""

LOCK = "lock"
"""The file in a workspace that whoever works there keeps locked."""

_TAG = "Signature: 8a477f597d28d172789f06886806bc55\n# Made by urdfsync; may be deleted at any time.\n"
_ACCESS = ".rumoca-access"
"""Suffix of the file beside another by which the compiler notes its last use."""


class CacheError(UrdfsyncError):
    """There is no cache that can be used; the code of the one diagnostic says why.

    `cache-not-writable`: its folder can't be written to; `no-cache`: nobody says where it is;
    `cache-emptied`: what was in it vanished again and again while it was used.
    """


class Entry(msgspec.Struct, frozen=True):
    """What is deleted together."""

    paths: tuple[str, ...]
    used: float
    """When it was used last, in seconds of the system's clock."""
    size: int
    """Bytes on disk."""
    spared: bool = False
    """Whether a check may work in it."""


class Cache:
    """The cache in a folder, which need not exist; `Cache.of_user` is the one of this user."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @classmethod
    def of_user(cls) -> Cache:
        """The cache where this system keeps such: on Linux `~/.cache/urdfsync`, or below XDG_CACHE_HOME.

        Raises CacheError if the library that knows the place is not installed.
        """
        try:
            import platformdirs
        except ImportError:
            message = "there is no cache: platformdirs is not installed"
            hint = "pip install 'urdfsync[check]'"
            raise CacheError(Diagnostic(Severity.ERROR, "no-cache", message, hint=hint)) from None
        return cls(platformdirs.user_cache_path("urdfsync", appauthor=False))

    def prepare(self) -> None:
        """Make the folder; raises CacheError if that can't be."""
        with writing(self.folder):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)  # `template_cache` takes no other
            tag = self.folder / "CACHEDIR.TAG"  # backup programs leave such a folder out
            if not tag.is_file():
                tag.write_text(_TAG, encoding="utf-8")

    @property
    def libraries(self) -> Path:
        """Where copies of libraries are, a folder each."""
        return self.folder / "libraries"

    @property
    def compiler(self) -> Path:
        """The cache of the embedded compiler."""
        return self.folder / "rumoca"

    @property
    def workspaces(self) -> Path:
        """Where checks work, each in a folder of its own."""
        return self.folder / "work"

    @property
    def templates(self) -> Path:
        """Compiled templates, see `template_cache`."""
        return self.folder / "templates"

    def workspace(self, name: str) -> Path:
        """The folder for work called `name`, which stays until it is trimmed; raises CacheError if it can't be made."""
        self.prepare()
        place = self.workspaces / name
        with writing(self.folder):
            place.mkdir(parents=True, exist_ok=True)
            os.utime(place)
        return place

    def size(self) -> int:
        """Bytes on disk."""
        return sum(entry.size for entry in self._entries())

    def trim(self, limit: int = LIMIT) -> int:
        """Delete what was used longest ago if the cache comes near the limit; the bytes that came free.

        What can't be deleted now stays for the next time.
        """
        return sum(_delete(entry) for entry in surplus(list(self._entries()), limit, time.time()))

    def clear(self) -> int:
        """Delete everything that is ours, but for workspaces and libraries while checks run; the bytes that came free.

        What the compiler remembers goes in any case: it makes again what it misses.
        """
        places = [Path(entry.path) for entry in _scan(self.workspaces)] if _is_folder(self.workspaces) else []
        spared = self.libraries if any(map(_is_locked, places)) else None
        freed = sum(_delete(entry) for entry in self._entries() if Path(entry.paths[0]).parent != spared)
        for folder in (self.libraries, self.compiler, self.workspaces, self.templates) if spared is None else ():
            if _is_folder(folder):
                shutil.rmtree(folder, ignore_errors=True)  # what is left are empty folders, and what is being made
        return freed

    def _entries(self) -> Iterator[Entry]:
        if _is_folder(self.compiler):
            yield from _records(self.compiler)
        for parent in (self.libraries, self.workspaces, self.templates):
            if _is_folder(parent):
                yield from (_whole(entry) for entry in _scan(parent))


def surplus(entries: Iterable[Entry], limit: int, now: float) -> list[Entry]:
    """What to delete of the entries at the time `now`, the longest unused first; nothing well below the limit."""
    waiting = sorted(entries, key=lambda entry: (entry.used, entry.paths))
    total = sum(entry.size for entry in waiting)
    if total <= FULL * limit:
        return []
    chosen = []
    for entry in waiting:
        if total <= AFTER * limit:
            break
        if not (entry.spared and entry.used > now - GRACE):
            chosen.append(entry)
            total -= entry.size
    return chosen


@contextlib.contextmanager
def writing(folder: Path) -> Iterator[None]:
    """Whatever the system refuses inside becomes a CacheError about `folder`."""
    try:
        yield
    except OSError as error:
        message = f"the cache can't be written to: {error.strerror or error}"
        hint = "make room, or name another folder with XDG_CACHE_HOME"
        raise CacheError(Diagnostic(Severity.ERROR, "cache-not-writable", message, str(folder), hint=hint)) from error


def _records(folder: Path) -> Iterator[Entry]:
    """What the compiler remembers, file by file, each with the file that notes its last use."""
    waiting = [folder]
    while waiting:
        files: dict[str, list[os.DirEntry[str]]] = {}
        for entry in _scan(waiting.pop()):
            if entry.is_dir(follow_symlinks=False):
                waiting.append(Path(entry.path))
            elif not entry.name.startswith("."):  # its locks
                files.setdefault(entry.name.removesuffix(_ACCESS), []).append(entry)
        for group in files.values():
            states = [state for entry in group if (state := _state(entry))]
            if states:
                used = max(state.st_mtime for state in states)
                yield Entry(tuple(entry.path for entry in group), used, sum(map(_size, states)))


def _whole(entry: os.DirEntry[str]) -> Entry:
    """A folder, or whatever stands in its place, as one thing."""
    state = _state(entry)
    used = state.st_mtime if state else 0.0
    total, waiting = _size(state) if state else 0, [entry]
    while waiting:
        one = waiting.pop()
        if one.is_dir(follow_symlinks=False):
            inside = _scan(one.path)
            waiting += inside
            total += sum(_size(found) for other in inside if (found := _state(other)))
    return Entry((entry.path,), used, total, spared=True)


def _scan(folder: str | Path) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            return list(entries)
    except OSError:
        return []  # it is gone: others trim too


def _state(entry: os.DirEntry[str]) -> os.stat_result | None:
    try:
        return entry.stat(follow_symlinks=False)
    except OSError:
        return None


def _size(state: os.stat_result) -> int:
    return max(state.st_size, getattr(state, "st_blocks", 0) * 512)


def _is_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _is_locked(folder: Path) -> bool:
    """Whether somebody works in a workspace."""
    if not (folder / LOCK).is_file():
        return False
    with Lock(folder / LOCK, wait=0) as lock, contextlib.suppress(OutputError):  # a lock that can't be used is none
        try:
            lock.acquire()
        except LockedError:
            return True
    return False


def _delete(entry: Entry) -> int:
    """Delete what belongs together, links themselves and not what they lead to; the bytes that came free."""
    for path in map(Path, entry.paths):
        with contextlib.suppress(OSError):
            if not _is_folder(path):
                path.unlink()
            elif path.stat().st_mtime <= entry.used and not _is_locked(path):  # else somebody has begun to use it
                aside = path.with_name(f"old-{uuid.uuid4().hex}")  # nobody shall find half of it
                path.rename(aside)
                shutil.rmtree(aside, ignore_errors=True)
    return 0 if any(os.path.lexists(name) for name in entry.paths) else entry.size
