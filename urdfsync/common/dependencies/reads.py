"""The one door for reading: lists each file and folder that a piece of work reads, with facts that show a change.

A robot's record holds while the facts in its list are unchanged, and the daemon watches the same list. Code that
decides about work reads only through this module. If other code reads files, the caller calls `depend_on` or
`cannot_record`.
"""

from __future__ import annotations

import contextlib
import os
import stat
import time
from collections.abc import Iterator, Mapping
from contextvars import ContextVar, Token

from urdfsync.common.dependencies.facts import (
    CONTENT,
    NAMES,
    PATH,
    UNMERGED,
    VARIABLE,
    Dependencies,
    Facts,
    checksum,
    is_young,
    look,
    read_unrecorded,
    scan,
    unmerged_paths,
)


class Reads:
    """The list of all that this thread reads through this module inside a `with` block, and inside nested blocks."""

    def __init__(self) -> None:
        self._token: Token[Reads | None] | None = None
        self.entries: Dependencies = {}
        self.complete = True
        """Whether the list has all reads, and no path changed between two reads. Otherwise nothing is remembered."""

    def __enter__(self) -> Reads:
        self._token = _current.set(self)
        return self

    def __exit__(self, *_: object) -> None:
        if self._token is not None:
            _current.reset(self._token)
        self._token = None  # a worker sends its list, and a token can't be pickled
        include(self)

    def add(self, kind: str, path: str | os.PathLike[str], facts: Facts) -> None:
        """Record the facts about a path, before its content is read. A young file also has the fact of its content."""
        path = os.fspath(path)
        if kind != VARIABLE and not os.path.isabs(path):
            path = os.path.join(os.getcwd(), path)
        fact = hash(facts)
        if self.entries.setdefault((kind, path), fact) != fact:
            self.complete = False  # the path changed between two reads
        elif kind == PATH and is_young(facts, time.time_ns()) and (CONTENT, path) not in self.entries:
            content = look(CONTENT, path)
            self.entries[CONTENT, path] = hash(content)
            self.complete &= content[0] >= 0

    def renew(self, written: Mapping[str, str | None]) -> None:
        """Take the present facts of files that the build has written, and of the folders around them.

        `written` has the SHA-256 (hex) of each file by path; None for a deleted file, or one that nobody else writes.
        """
        around = set[str]()
        for folder in written:
            while (folder := os.path.dirname(folder)) not in around:
                around.add(folder)
        for kind, path in [*((PATH, path) for path in written), *self.entries]:
            if path in written or path in around:
                self.entries[kind, path] = hash(look(kind, path))
        for path, sha256 in written.items():  # somebody may have saved the file meanwhile
            self.entries[CONTENT, path] = hash((int(sha256, 16),) if sha256 else look(CONTENT, path))


_current: ContextVar[Reads | None] = ContextVar("reads", default=None)


@contextlib.contextmanager
def unrecorded() -> Iterator[None]:
    """Record no reads inside a `with` block."""
    token = _current.set(None)
    try:
        yield
    finally:
        _current.reset(token)


def cannot_record() -> None:
    """Note that the present work reads what no entry shows: its result is not remembered."""
    if (reads := _current.get()) is not None:
        reads.complete = False


def include(other: Reads) -> None:
    """Add another list, such as that of another process."""
    if (reads := _current.get()) is not None:
        reads.complete &= other.complete
        for entry, fact in other.entries.items():
            reads.complete &= reads.entries.setdefault(entry, fact) == fact


def _record(kind: str, path: str | os.PathLike[str], facts: Facts) -> None:
    if (reads := _current.get()) is not None:
        reads.add(kind, path, facts)


def read_stat(path: str | os.PathLike[str]) -> Facts:
    """Return the facts of a path (see `facts.PATH`); `(0,)` for none. Call it before reading. Raises OSError."""
    facts = look(PATH, path)
    _record(PATH, path, facts)
    if facts[0] < 0:
        cannot_record()
        raise OSError(-facts[0], os.strerror(-facts[0]), os.fspath(path))
    return facts


def file_type(path: str | os.PathLike[str], *, follow: bool = True) -> int:
    """Return the file type (see `stat.S_IFMT`) at a path; 0 for none. Raises OSError if the path can't be accessed.

    The type of a link is that of its target, unless `follow` is false.
    """
    facts = read_stat(path)
    return stat.S_IFMT(facts[6] if follow and len(facts) > 6 else facts[0])


def is_file(path: str | os.PathLike[str]) -> bool:
    """Whether a regular file, or a link to such a file, is at a path. Raises OSError if that is unknown."""
    return file_type(path) == stat.S_IFREG


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Whether a folder, or a link to a folder, is at a path. Raises OSError if that is unknown."""
    return file_type(path) == stat.S_IFDIR


def read_variable(name: str) -> str | None:
    """Return the value of an environment variable; None if it is not set."""
    _record(VARIABLE, name, look(VARIABLE, name))
    return os.environ.get(name)


def read_file(path: str | os.PathLike[str]) -> bytes:
    """Read a regular file of at most `MAX_FILE` bytes. Raises OSError, also for any other kind of file."""
    depend_on(path)
    return read_unrecorded(path)


def find_unmerged(index: str | os.PathLike[str]) -> set[str]:
    """Return the files in git's index that git could not merge."""
    found = unmerged_paths(index)
    _record(UNMERGED, index, checksum(found))
    return found


def list_folder(folder: str | os.PathLike[str]) -> list[str]:
    """Return the names in a folder, in no order. Raises OSError."""
    return [entry.name for entry in scan_folder(folder)]


def scan_folder(folder: str | os.PathLike[str], kind: str = NAMES) -> list[os.DirEntry[str]]:
    """Return the entries of a folder, in no order; record those that count (see `facts.LISTINGS`). Raises OSError.

    Use the names of the entries: their paths may lead into a clone.
    """
    try:
        entries, facts = scan(kind, folder)
    except OSError as error:
        _record(kind, folder, (-(error.errno or 1),))
        raise
    _record(kind, folder, facts)
    return entries


def depend_on(path: str | os.PathLike[str]) -> None:
    """Record a file before other code reads it."""
    if _current.get() is not None:
        with contextlib.suppress(OSError):  # the reader meets the same error, and reports it
            read_stat(path)


def walk_files(folder: str | os.PathLike[str]) -> Iterator[str]:
    """Yield the paths of all regular files below a folder, and of links to regular files; skip links to folders."""
    waiting = [os.fspath(folder)]
    while waiting:
        current = waiting.pop()
        try:
            names = list_folder(current)
        except OSError:
            continue  # the folder is missing or unreadable
        for path in [f"{current}{os.sep}{name}" for name in names]:
            if is_file(path):
                yield path
            elif file_type(path, follow=False) == stat.S_IFDIR:
                waiting.append(path)
