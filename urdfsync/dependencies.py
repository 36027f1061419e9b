"""The list of all that is read: files and folders, each with what was seen there, so that it is known what has changed.

A saved answer holds while all of its list is as it was, the daemon watches that of each robot, and the hook wants it
staged. Code that decides whether there is anything to do reads through these functions alone. What is read by other
means is named by `depend_on`, or makes the list incomplete (`mark_incomplete`).
"""

from __future__ import annotations

import errno
import os
import stat
import sys
import time
from collections.abc import Iterable, Iterator, Mapping
from contextvars import ContextVar, Token

Stat = tuple[int, int, int, int, int, int]
"""Mode, inode, device, size in bytes, and the times of change of content and of status in ns. Only ever compared."""

YOUNG = 2_000_000_000
"""Nanoseconds after a change in which a file is read again, whatever its stat values are."""
MAX_FILE = 100_000_000
"""Bytes of a file that is read. More is no source, mesh or output, but may be a stranger's, to fill the memory."""
_ABSENT = (errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.EBADF)
"""Errors that say that nothing is at a path; the same as for pathlib."""
_NONBLOCK = getattr(os, "O_NONBLOCK", 0)

LSTAT, STAT = "lstat", "stat"
"""How the content of a file is checked: by its `Stat`, and by its hash if that is known; with `LSTAT` links themselves,
with `STAT` what they lead to. Files that builds write are read by `LSTAT`, all others by `STAT`."""
CONTENTS = (LSTAT, STAT)
LSTAT_TYPE, STAT_TYPE = "lstat type", "stat type"
"""How a path is checked by its file type alone."""
NAMES, MODELICA = "names", "modelica"
"""How a folder is checked: by all names in it, or by those that matter to Modelica."""
LISTINGS = (NAMES, MODELICA)
VARIABLE = "variable"
"""How an environment variable is checked, whose name stands in the place of a path: by its value."""
NOTHING = (0,)
"""The facts about a path without a file."""
Entry = tuple[str, str]
"""A check, and the path or variable that it is of."""


class Dependencies:
    """All that this thread reads through this module inside a `with` block. A block around it has that, too.

    With `is_program`, what is read is part of the program, and the block around counts it as such.
    """

    def __init__(self, *, is_program: bool = False) -> None:
        self._is_program = is_program
        self._token: Token[Dependencies | None] | None = None
        self.entries: dict[Entry, tuple[int, ...]] = {}
        """The facts about each path: a `Stat`, a tuple of the file type, a checksum of names, `NOTHING`, or a negative
        error number."""
        self.hashes: dict[Entry, str] = {}
        """Hash of the content of each file that was young when it was read; empty where that is not known."""
        self.modules: dict[Entry, tuple[int, ...]] = {}
        """The facts about files of the program itself, which are no inputs of a robot."""
        self.complete = True
        """Whether the answer depends on nothing else, and no path changed or failed while it was read."""

    def __enter__(self) -> Dependencies:
        self._token = _current.set(self)
        return self

    def __exit__(self, *_: object) -> None:
        if self._token is not None:
            _current.reset(self._token)
        self._token = None  # a worker sends its list to the process that prints the answer
        if self._is_program:
            self.modules, self.entries = self.modules | self.entries, {}
        include(self)

    def add(self, check: str, path: str | os.PathLike[str], facts: tuple[int, ...]) -> None:
        """Record the facts about a path, before its content is read."""
        entry = check, os.fspath(path)
        if self.entries.setdefault(entry, facts) != facts:
            self.complete = False  # it changed between two reads
        elif check in CONTENTS and is_young(facts, time.time_ns()):
            self.hashes.setdefault(entry, "")

    def add_hash(self, entry: Entry, sha256: str) -> None:
        """Record the hash of a young file."""
        if self.hashes.get(entry) and self.hashes[entry] != sha256:
            self.complete = False  # it changed between two reads, and its stat values did not
        self.hashes[entry] = self.hashes.get(entry) or sha256

    def renew(self, written: Mapping[str, bytes | None]) -> None:
        """Record the files that a build has written in the place of what it read there; None for a deleted one.

        The folders around them are looked at again.
        """
        changed = set(written)
        for path in written:
            while (path := os.path.dirname(path)) not in changed:
                changed.add(path)
        for entry in {(LSTAT, path) for path in written} | {entry for entry in self.entries if entry[1] in changed}:
            self.entries[entry], content = check_path(*entry), written.get(entry[1])
            self.hashes.pop(entry, None)
            if content is not None and entry[0] in CONTENTS:
                self.hashes[entry] = _hash(content)

    def add_modules(self) -> None:
        """Record the program itself, which a developer may change; Python goes by its version."""
        for name, module in list(sys.modules.items()):
            file = getattr(module, "__file__", None)
            if file and name.partition(".")[0] not in sys.stdlib_module_names and os.path.isfile(file):
                entry, facts = (STAT, os.path.abspath(file)), stat_of(os.stat(file))
                self.modules[entry] = facts
                if is_young(facts, time.time_ns()):
                    self.hashes.setdefault(entry, "")


_current: ContextVar[Dependencies | None] = ContextVar("dependencies", default=None)


def mark_incomplete() -> None:
    """Mark the list as incomplete: the answer depends on more, and can't be saved."""
    if (dependencies := _current.get()) is not None:
        dependencies.complete = False


def include(other: Dependencies) -> None:
    """Add another list, such as that of another process."""
    if (dependencies := _current.get()) is not None:
        dependencies.complete &= other.complete
        for facts_by_entry, others in ((dependencies.entries, other.entries), (dependencies.modules, other.modules)):
            for entry, facts in others.items():
                dependencies.complete &= facts_by_entry.setdefault(entry, facts) == facts
        for entry, sha256 in other.hashes.items():
            dependencies.add_hash(entry, sha256)


def is_young(facts: tuple[int, ...], now: int) -> bool:
    """Whether a file changed less than two seconds before `now` (ns), or later.

    The next change may show the same stat values, since no clock of a file system is coarser than that of FAT.
    """
    return max(facts[-2:]) > now - YOUNG


def stat_of(status: os.stat_result) -> Stat:
    """Return the values that differ once a file has changed."""
    return status.st_mode, status.st_ino, status.st_dev, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def check_path(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now, in the form of `Dependencies.entries`."""
    try:
        return _facts(check, path)
    except OSError as error:
        return _failed(error)


def _facts(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    if check == VARIABLE:
        value = os.environ.get(os.fspath(path))
        return (-1,) if value is None else tuple(value.encode(errors="surrogateescape"))
    if check in LISTINGS:
        with os.scandir(path) as entries:
            return _names(check, entries)
    try:
        status = os.stat(path, follow_symlinks=check in (STAT, STAT_TYPE))
    except OSError as error:
        if error.errno in _ABSENT:
            return NOTHING
        raise
    return stat_of(status) if check in CONTENTS else (stat.S_IFMT(status.st_mode),)


def _look(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now, and record them. Raises OSError if the system does not tell."""
    try:
        facts = _facts(check, path)
    except OSError as error:
        _record(check, path, _failed(error))
        mark_incomplete()
        raise
    _record(check, path, facts)
    return facts


def _record(check: str, path: str | os.PathLike[str], facts: tuple[int, ...]) -> None:
    if (dependencies := _current.get()) is not None:
        dependencies.add(check, path, facts)


def _failed(error: OSError) -> tuple[int, ...]:
    return (-(error.errno or 1),)


def file_type(path: str | os.PathLike[str], *, follow: bool = True) -> int:
    """Return the file type (see `stat.S_IFMT`) at a path; 0 for none. Raises OSError if the system does not tell."""
    return _look(STAT_TYPE if follow else LSTAT_TYPE, path)[0]


def is_file(path: str | os.PathLike[str]) -> bool:
    """Whether a regular file, or a link to one, is at a path. Raises OSError if the system does not tell."""
    return file_type(path) == stat.S_IFREG


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Whether a folder, or a link to one, is at a path. Raises OSError if the system does not tell."""
    return file_type(path) == stat.S_IFDIR


def read_variable(name: str) -> str | None:
    """Return the value of an environment variable; None if it is not set."""
    _look(VARIABLE, name)
    return os.environ.get(name)


def read_file(path: str | os.PathLike[str]) -> bytes:
    """Read a regular file of at most `MAX_FILE` bytes. Raises OSError, for anything else as well."""
    depend_on(path)
    content = read_unrecorded(path)
    note_content(STAT, path, content)
    return content


def note_content(check: str, path: str | os.PathLike[str], content: bytes) -> None:
    """Record what was read of a file, if it is so young that its stat values may not tell the next change."""
    dependencies, entry = _current.get(), (check, os.fspath(path))
    if dependencies is not None and entry in dependencies.hashes:
        dependencies.add_hash(entry, _hash(content))


def hash_file(path: str) -> str:
    """Return the hash of a file's content now. Raises OSError."""
    return _hash(read_unrecorded(path))


def _hash(content: bytes) -> str:
    from hashlib import sha256  # 3 ms, and saved answers of old files do without

    return sha256(content).hexdigest()


def read_unrecorded(path: str | os.PathLike[str]) -> bytes:
    """Read a file as `read_file` does, without recording it: where `read_stat` has, or no answer depends on it."""
    # a pipe would wait for somebody who writes to it
    with open(path, "rb", buffering=0, opener=lambda path, flags: os.open(path, flags | _NONBLOCK)) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "it is no regular file", os.fspath(path))
        if status.st_size > MAX_FILE:
            raise OSError(errno.EFBIG, f"it has more than {MAX_FILE:,} bytes", os.fspath(path))
        if status.st_size:
            return file.read()
        # a file of the system may say that it is empty, and never end
        return file.read(MAX_FILE) or b""


def read_stat(path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the stat values of a path before its content is read, links not followed; `(0,)` for none.

    Raises OSError.
    """
    return _look(LSTAT, path)


def list_folder(folder: str | os.PathLike[str]) -> list[str]:
    """Return the names in a folder, in no order. Raises OSError."""
    return [entry.name for entry in _scan(NAMES, folder)]


def scan_modelica(folder: str | os.PathLike[str]) -> list[os.DirEntry[str]]:
    """Return the entries of a folder, in no order; its folders and Modelica files are recorded. Raises OSError."""
    return _scan(MODELICA, folder)


def _scan(check: str, folder: str | os.PathLike[str]) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            found = list(entries)
    except OSError as error:
        _record(check, folder, _failed(error))
        raise
    _record(check, folder, _names(check, found))
    return found


def note_names(folder: str | os.PathLike[str], names: Iterable[str]) -> None:
    """Record the names in a folder that was listed by other means."""
    _record(NAMES, folder, _checksum(names))


def _names(check: str, entries: Iterable[os.DirEntry[str]]) -> tuple[int, ...]:
    """Return number and checksum of the names that count: to Modelica, those of its files and of visible folders."""
    return _checksum(
        entry.name
        for entry in entries
        if check == NAMES
        or (not entry.name.startswith(".") and (entry.name.endswith(".mo") or entry.is_dir(follow_symlinks=False)))
    )


def _checksum(names: Iterable[str]) -> tuple[int, ...]:
    """Return the number of names and a checksum, for which their order does not matter."""
    ordered = sorted(names)
    # the hash of an integer is the same in each process
    return len(ordered), hash(int.from_bytes("/".join(ordered).encode(errors="surrogateescape")))


def depend_on(path: str | os.PathLike[str]) -> None:
    """Record a file that is about to be read by other means."""
    if _current.get() is not None:
        try:
            _look(STAT, path)
        except OSError:
            return  # the reader meets the same error, and reports it


def walk_files(folder: str | os.PathLike[str]) -> Iterator[str]:
    """Yield the paths of all regular files below a folder, and of links to such; links to folders are not followed."""
    waiting = [os.fspath(folder)]
    while waiting:
        current = waiting.pop()
        try:
            names = list_folder(current)
        except OSError:
            continue  # the folder is missing, or can't be read
        for path in [f"{current}{os.sep}{name}" for name in names]:
            kind = file_type(path)
            if kind == stat.S_IFREG:
                yield path
            elif kind == stat.S_IFDIR and os.path.islink(path):
                file_type(path, follow=False)
            elif kind == stat.S_IFDIR:
                waiting.append(path)
