"""The user's cache folder: copies of libraries, the compiler's own cache, results; all can be made again."""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import stat
import time
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import platformdirs

from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.common.files import put

T = TypeVar("T")

LIMIT = 2**30
"""The greatest number of bytes on disk that the cache takes: 1 GiB."""
_FULL, _AFTER = 0.75, 0.5  # parts of the limit: a cache above 75 % is emptied to 50 %
_IN_USE = 3600.0
"""Seconds for which a used copy of a library is kept: a check may still read it."""


class CacheError(UrdfsyncError):
    """The cache can't be used; the code of the diagnostic is `cache-not-writable`."""


def digest(*facts: object) -> str:
    """Return the SHA-256 (hex) of the `repr` of facts."""
    return hashlib.sha256(repr(facts).encode(errors="surrogateescape")).hexdigest()


class UserCache:
    """The cache in a folder, which need not exist; `UserCache.default` returns the user's own."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.libraries = folder, folder / "libraries"
        self.compiler, self.results = folder / "rumoca", folder / "results"

    @classmethod
    def default(cls) -> UserCache:
        """Return the cache in the system's place for caches: on Linux `~/.cache/urdfsync`, or below XDG_CACHE_HOME."""
        return cls(platformdirs.user_cache_path("urdfsync", appauthor=False))

    def prepare(self) -> None:
        """Make the folder. Raises CacheError if the folder can't be made."""
        with cache_errors(self.folder):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)

    def load(self, key: str, kind: type[T]) -> T | None:
        """Return the value that was saved with this key; None without a readable one."""
        file = self.results / key
        try:
            os.utime(file)  # note the last use of the result
            return msgspec.msgpack.decode(file.read_bytes(), type=kind)
        except (OSError, ValueError):
            return None

    def save(self, key: str, value: Any) -> None:
        """Save a value; None deletes the saved one. If the cache can't be written, it is not used."""
        with contextlib.suppress(OSError):
            if value is None:
                (self.results / key).unlink(missing_ok=True)
                return
            self.results.mkdir(mode=0o700, parents=True, exist_ok=True)
            put(self.results / key, msgspec.msgpack.encode(value))  # JSON has no infinite numbers

    def trim(self, limit: int = LIMIT) -> None:
        """Delete the least recently used entries, if the cache comes near the limit.

        Keeps copies of libraries that a check may use, and entries that can't be deleted now.
        """
        entries = sorted(self._entries())
        total, freed, now = sum(size for _, _, size in entries), 0, time.time()
        for used, place, size in entries if total > _FULL * limit else ():
            path = Path(place)
            in_use = path.parent == self.libraries and now - used < _IN_USE
            if total - freed <= _AFTER * limit or in_use:
                continue
            with contextlib.suppress(OSError):  # deletes links, not their targets
                if path.is_symlink() or not path.is_dir():
                    path.unlink()
                else:
                    aside = path.with_name(f"old-{uuid.uuid4().hex}")  # no process may find half of the entry
                    path.rename(aside)
                    shutil.rmtree(aside, ignore_errors=True)
                freed += size

    def _entries(self) -> Iterator[tuple[float, str, int]]:
        """Yield the last use, the path and the bytes on disk of each entry, which can only be deleted as a whole.

        Entries are the files and folders in urdfsync's folders, and each file of the compiler except its locks. The
        compiler's files have no last use: they count as used when they were written.
        """
        for folder in (self.libraries, self.results, self.compiler):
            if folder.is_symlink():
                continue
            for current, folders, files in os.walk(folder):  # `walk` ignores deleted folders: other processes trim, too
                if folder == self.compiler:
                    names = [name for name in files if not name.startswith(".")]
                else:
                    names, folders[:] = [*files, *folders], []
                for path in (f"{current}/{name}" for name in names):
                    with contextlib.suppress(OSError):  # it was deleted
                        status = os.lstat(path)
                        yield status.st_mtime, path, _bytes_on_disk(path, status)


@contextlib.contextmanager
def cache_errors(folder: Path) -> Iterator[None]:
    """Turn an OSError inside the `with` block into a CacheError about `folder`."""
    try:
        yield
    except OSError as error:
        message = f"the cache can't be written: {error.strerror or error}"
        hint = "make room, or name another folder with XDG_CACHE_HOME"
        raise CacheError.of("cache-not-writable", message, str(folder), hint=hint) from error


def _bytes_on_disk(path: str, status: os.stat_result) -> int:
    """Return the bytes on disk of a file, or of a folder with all below it. Raises OSError after its deletion."""
    inside = [status]
    if stat.S_ISDIR(status.st_mode):
        inside += [below.lstat() for below in Path(path).rglob("*")]
    return sum(max(each.st_size, getattr(each, "st_blocks", 0) * 512) for each in inside)
