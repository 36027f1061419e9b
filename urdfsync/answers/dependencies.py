"""Lists all files and folders that a command reads, with facts about each, to find changes later.

A saved answer holds while the files in its list are unchanged. The daemon watches the list of each robot, and the hook
requires that these files are staged. Code that decides about work reads only through this module. If other code reads
files, the caller calls `depend_on` or `mark_incomplete`.
"""

from __future__ import annotations

import os
import stat
import sys
import time
from collections.abc import Iterable, Iterator, Mapping
from contextvars import ContextVar, Token

from urdfsync.answers.facts import (
    CONTENTS,
    LSTAT,
    LSTAT_TYPE,
    MODELICA,
    NAMES,
    STAT,
    STAT_TYPE,
    VARIABLE,
    Entry,
    check_path,
    checksum,
    facts_of,
    failed,
    hash_content,
    is_young,
    names_in,
    read_unrecorded,
    stat_of,
)
from urdfsync.answers.places import is_clone, place

PARENTS = "urdfsync-parents"
"""A file in the `.git` of the hook's clone: the parents of its commit."""


class Dependencies:
    """The list of all that this thread reads through this module inside a `with` block, and inside nested blocks.

    With `is_program`, the files count as part of the program.
    """

    def __init__(self, *, is_program: bool = False) -> None:
        self._is_program = is_program
        self._token: Token[Dependencies | None] | None = None
        self.entries: dict[Entry, tuple[int, ...]] = {}
        """The facts about each path: a `Stat`, the file type, a checksum of names, `NOTHING`, or a negative error
        number."""
        self.hashes: dict[Entry, str] = {}
        """Hash of the content of each file that was young when it was read; empty if unknown."""
        self.modules: dict[Entry, tuple[int, ...]] = {}
        """The facts about files of the program itself; these files are no inputs of a robot."""
        self.complete = True
        """Whether the list has all reads, and no path changed between two reads."""

    def __enter__(self) -> Dependencies:
        self._token = _current.set(self)
        return self

    def __exit__(self, *_: object) -> None:
        if self._token is not None:
            _current.reset(self._token)
        self._token = None  # a worker sends its list, and a token can't be pickled
        if self._is_program:
            self.modules, self.entries = self.modules | self.entries, {}
        include(self)

    def add(self, check: str, path: str | os.PathLike[str], facts: tuple[int, ...]) -> None:
        """Record the facts about a path, before its content is read."""
        entry = check, os.fspath(path)
        if self.entries.setdefault(entry, facts) != facts:
            self.complete = False  # the path changed between two reads
        elif check in CONTENTS and is_young(facts, time.time_ns()):
            self.hashes.setdefault(entry, "")

    def add_hash(self, entry: Entry, sha256: str) -> None:
        """Record the hash of a young file."""
        if self.hashes.get(entry) and self.hashes[entry] != sha256:
            self.complete = False  # the file changed between two reads, and its stat values did not
        self.hashes[entry] = self.hashes.get(entry) or sha256

    def renew(self, written: Mapping[str, bytes | None]) -> None:
        """Renew the entries of written files (None for a deleted file), and of the folders around them."""
        changed = set(written)
        for path in written:
            while (path := os.path.dirname(path)) not in changed:
                changed.add(path)
        for entry in {(LSTAT, path) for path in written} | {entry for entry in self.entries if entry[1] in changed}:
            self.entries[entry], content = check_path(*entry), written.get(entry[1])
            self.hashes.pop(entry, None)
            if content is not None and entry[0] in CONTENTS:
                self.hashes[entry] = hash_content(content)

    def add_modules(self) -> None:
        """Record the program's own files, which a developer may change, and Python's version."""
        for name, module in list(sys.modules.items()):
            file = getattr(module, "__file__", None)
            if file and name.partition(".")[0] not in sys.stdlib_module_names and os.path.isfile(file):
                entry, facts = (STAT, os.path.abspath(file)), stat_of(os.stat(file))
                self.modules[entry] = facts
                if is_young(facts, time.time_ns()):
                    self.hashes.setdefault(entry, "")


_current: ContextVar[Dependencies | None] = ContextVar("dependencies", default=None)


def mark_incomplete() -> None:
    """Mark the list as incomplete: the command's answer is not saved."""
    if (dependencies := _current.get()) is not None:
        dependencies.complete = False


def depend_on_commits(top: str | os.PathLike[str] | None) -> None:
    """Record that commits of the repository at `top` are read.

    They may change the result without changing a file, so the list is incomplete. In the hook's clone, a file has the
    parents of its commit.
    """
    if top and is_clone():
        depend_on(os.path.join(top, ".git", PARENTS))
    else:
        mark_incomplete()


def include(other: Dependencies) -> None:
    """Add another list, such as that of another process."""
    if (dependencies := _current.get()) is not None:
        dependencies.complete &= other.complete
        for facts_by_entry, others in ((dependencies.entries, other.entries), (dependencies.modules, other.modules)):
            for entry, facts in others.items():
                dependencies.complete &= facts_by_entry.setdefault(entry, facts) == facts
        for entry, sha256 in other.hashes.items():
            dependencies.add_hash(entry, sha256)


def _look(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now, and record them. Raises OSError if the path can't be accessed."""
    try:
        facts = facts_of(check, path)
    except OSError as error:
        _record(check, path, failed(error))
        mark_incomplete()
        raise
    _record(check, path, facts)
    return facts


def _record(check: str, path: str | os.PathLike[str], facts: tuple[int, ...]) -> None:
    if (dependencies := _current.get()) is not None:
        dependencies.add(check, path, facts)


def file_type(path: str | os.PathLike[str], *, follow: bool = True) -> int:
    """Return the file type (see `stat.S_IFMT`) at a path; 0 for none. Raises OSError if the path can't be accessed."""
    return _look(STAT_TYPE if follow else LSTAT_TYPE, path)[0]


def is_file(path: str | os.PathLike[str]) -> bool:
    """Whether a regular file, or a link to such a file, is at a path. Raises OSError if that is unknown."""
    return file_type(path) == stat.S_IFREG


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Whether a folder, or a link to a folder, is at a path. Raises OSError if that is unknown."""
    return file_type(path) == stat.S_IFDIR


def read_variable(name: str) -> str | None:
    """Return the value of an environment variable; None if it is not set."""
    _look(VARIABLE, name)
    return os.environ.get(name)


def read_file(path: str | os.PathLike[str]) -> bytes:
    """Read a regular file of at most `MAX_FILE` bytes. Raises OSError, also for any other kind of file."""
    depend_on(path)
    content = read_unrecorded(path)
    note_content(STAT, path, content)
    return content


def note_content(check: str, path: str | os.PathLike[str], content: bytes) -> None:
    """Record the hash of a young file: its stat values may not show the next change."""
    dependencies, entry = _current.get(), (check, os.fspath(path))
    if dependencies is not None and entry in dependencies.hashes:
        dependencies.add_hash(entry, hash_content(content))


def read_stat(path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the stat values of a path, links not followed; `(0,)` for none. Call it before reading. Raises OSError."""
    return _look(LSTAT, path)


def list_folder(folder: str | os.PathLike[str]) -> list[str]:
    """Return the names in a folder, in no order. Raises OSError."""
    return [entry.name for entry in scan_folder(folder)]


def scan_folder(folder: str | os.PathLike[str]) -> list[os.DirEntry[str]]:
    """Return the entries of a folder, as `scan_modelica`; record all names. Raises OSError."""
    return _scan(NAMES, folder)


def scan_modelica(folder: str | os.PathLike[str]) -> list[os.DirEntry[str]]:
    """Return the entries of a folder, in no order; record its folders and Modelica files. Raises OSError.

    Use the names of the entries: their paths may lead into a clone.
    """
    return _scan(MODELICA, folder)


def _scan(check: str, folder: str | os.PathLike[str]) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(place(folder)) as entries:
            found = list(entries)
    except OSError as error:
        _record(check, folder, failed(error))
        raise
    _record(check, folder, names_in(check, found))
    return found


def note_names(folder: str | os.PathLike[str], names: Iterable[str]) -> None:
    """Record the names in a folder that other code has listed."""
    _record(NAMES, folder, checksum(names))


def depend_on(path: str | os.PathLike[str]) -> None:
    """Record a file before other code reads it."""
    if _current.get() is not None:
        try:
            _look(STAT, path)
        except OSError:
            return  # the reader meets the same error, and reports it


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
            kind = file_type(path)
            if kind == stat.S_IFREG:
                yield path
            elif kind == stat.S_IFDIR and os.path.islink(place(path, follow=False)):
                file_type(path, follow=False)
            elif kind == stat.S_IFDIR:
                waiting.append(path)
