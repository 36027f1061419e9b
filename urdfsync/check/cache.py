"""The user's cache folder: copies of libraries, what the compiler remembers, templates, results.

Everything in it can be made again. What was used longest ago goes first.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import time
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import platformdirs

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.files import put

T = TypeVar("T")

LIMIT = 2**30
"""Bytes on disk that the cache never grows past: 1 GiB."""
_FULL, _AFTER = 0.75, 0.5  # parts of the limit: from the first on something is deleted, until the second is left
_IN_USE = 3600.0
"""Seconds since its last use in which a check may work with a copy of a library."""

_ACCESS = ".rumoca-access"  # suffix of the file beside another by which the compiler notes its last use


class CacheError(UrdfsyncError):
    """There is no cache that can be used; the code of the one diagnostic is `cache-not-writable`."""


def digest(*facts: object) -> str:
    """Return the SHA-256 (hex) over facts whose `repr` says all of them."""
    return hashlib.sha256(repr(facts).encode(errors="surrogateescape")).hexdigest()


class UserCache:
    """The cache in a folder, which need not exist; `UserCache.default` is the one of this user."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.libraries = folder, folder / "libraries"
        self.compiler, self.results = folder / "rumoca", folder / "results"

    @classmethod
    def default(cls) -> UserCache:
        """Return the cache where this system keeps such: on Linux `~/.cache/urdfsync`, or below XDG_CACHE_HOME."""
        return cls(platformdirs.user_cache_path("urdfsync", appauthor=False))

    def prepare(self) -> None:
        """Make the folder. Raises CacheError if that can't be."""
        with cache_errors(self.folder):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)

    def load(self, key: str, kind: type[T]) -> T | None:
        """Return what was saved with this key; None if nothing was, or if it can't be read."""
        file = self.results / key
        try:
            os.utime(file)  # its last use is noted
            return msgspec.msgpack.decode(file.read_bytes(), type=kind)
        except (OSError, ValueError):
            return None

    def save(self, key: str, value: Any) -> None:
        """Keep a result, or forget the last one for None. If the cache can't be written, it is not used."""
        with contextlib.suppress(OSError):
            if value is None:
                (self.results / key).unlink(missing_ok=True)
                return
            self.results.mkdir(mode=0o700, parents=True, exist_ok=True)
            put(self.results / key, msgspec.msgpack.encode(value))  # JSON has no infinite numbers

    def trim(self, limit: int = LIMIT) -> int:
        """Delete what was used longest ago, if the cache comes near the limit; returns the bytes that came free.

        Copies of libraries that a check may work with stay, and what can't be deleted now.
        """
        entries = sorted(self._entries())
        total, freed, now = sum(size for _, _, size in entries), 0, time.time()
        for used, path, size in entries if total > _FULL * limit else ():
            in_use = path.parent == self.libraries and now - used < _IN_USE
            if total - freed <= _AFTER * limit or in_use:
                continue
            with contextlib.suppress(OSError):  # links themselves, and not what they lead to
                if path.is_symlink() or not path.is_dir():
                    path.unlink()
                else:
                    aside = path.with_name(f"old-{uuid.uuid4().hex}")  # nobody shall find half of it
                    path.rename(aside)
                    shutil.rmtree(aside, ignore_errors=True)
                freed += size
        return freed

    def _entries(self) -> Iterator[tuple[float, Path, int]]:
        """Yield what is deleted as a whole, with the time of its last use, and bytes on disk.

        That is what is in folders of ours, and each file of the compiler but for its locks.
        """
        for folder in (self.libraries, self.results, self.compiler):
            if folder.is_symlink():
                continue
            for current, folders, files in os.walk(folder):  # which passes over what is gone: others trim, too
                if folder == self.compiler:
                    names = [name for name in files if not name.startswith(".")]
                else:
                    names, folders[:] = [*files, *folders], []
                for path in (Path(current, name) for name in names):
                    yield from _entry(path)


@contextlib.contextmanager
def cache_errors(folder: Path) -> Iterator[None]:
    """Raise a CacheError about `folder` for whatever the system refuses inside."""
    try:
        yield
    except OSError as error:
        message = f"the cache can't be written to: {error.strerror or error}"
        hint = "make room, or name another folder with XDG_CACHE_HOME"
        raise CacheError(Diagnostic(Severity.ERROR, "cache-not-writable", message, str(folder), hint=hint)) from error


def _entry(path: Path) -> Iterator[tuple[float, Path, int]]:
    """Yield when a file or folder was used last, itself, and its bytes on disk; nothing if it is gone."""
    with contextlib.suppress(OSError):
        used, note = path.lstat().st_mtime, path.with_name(path.name.removesuffix(_ACCESS) + _ACCESS)
        with contextlib.suppress(OSError):  # nobody noted when it was used
            used = max(used, note.lstat().st_mtime)
        is_folder = path.is_dir() and not path.is_symlink()
        inside = [status.lstat() for status in (path, *(path.rglob("*") if is_folder else ()))]
        sizes = (max(status.st_size, getattr(status, "st_blocks", 0) * 512) for status in inside)
        yield used, path, sum(sizes)
