"""Read files and folders, and record each path read, so that the up-to-date check knows the dependencies of an answer.

Code that decides whether there is anything to do reads through these functions alone. What is read by other means is
named by `depend_on`, or makes the record incomplete (`mark_incomplete`).
"""

from __future__ import annotations

import errno
import os
import stat
import sys
import time
from collections.abc import Iterable, Iterator
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

LSTAT, STAT, LSTAT_TYPE, STAT_TYPE = "lstat", "stat", "lstat type", "stat type"
"""How a path is checked: by all of its `Stat`, or by its file type alone; links themselves with `os.lstat`, what they
lead to with `os.stat`."""
MODELICA = "modelica"
"""How a folder is checked by the names in it that matter to Modelica, in the form of `modelica_names`."""
VARIABLE = "variable"
"""How an environment variable is checked, whose name stands in the place of a path: by its value."""
_NOTHING = (0,)
"""The facts about a path without a file."""
Entries = dict[tuple[str, str], tuple[int, ...]]
"""Checks and paths with their facts: a `Stat`, a tuple of the file type, `_NOTHING`."""


class Dependencies:
    """The paths that this thread reads through this module inside a `with` block."""

    def __init__(self) -> None:
        self._token: Token[Dependencies | None] | None = None
        self.started = time.time_ns()
        self.entries: Entries = {}
        self.complete = True
        """Whether the answer depends on nothing else, and no path changed or failed while it was read."""

    def __enter__(self) -> Dependencies:
        self._token = _current.set(self)
        return self

    def __exit__(self, *_: object) -> None:
        if self._token is not None:
            _current.reset(self._token)
        self._token = None  # a worker sends its record to the process that prints the answer

    def add(self, check: str, path: str | os.PathLike[str], facts: tuple[int, ...]) -> None:
        """Record the facts about a path, before its content is read."""
        if self.entries.setdefault((check, os.fspath(path)), facts) != facts:
            self.complete = False  # it changed between two reads

    def add_modules(self) -> None:
        """Record the program itself, which a developer may change; Python goes by its version."""
        for name, module in list(sys.modules.items()):
            file = getattr(module, "__file__", None)
            if file and name.partition(".")[0] not in sys.stdlib_module_names and os.path.isfile(file):
                self.entries[STAT, os.path.abspath(file)] = stat_of(os.stat(file))


_current: ContextVar[Dependencies | None] = ContextVar("dependencies", default=None)


def mark_incomplete() -> None:
    """Mark the record as incomplete: the answer depends on more, and can't be saved."""
    if (dependencies := _current.get()) is not None:
        dependencies.complete = False


def include(other: Dependencies) -> None:
    """Add the record of another process to that of this one."""
    if (dependencies := _current.get()) is not None:
        for (check, path), value in other.entries.items():
            dependencies.add(check, path, value)
        dependencies.complete &= other.complete


def is_young(facts: tuple[int, ...], now: int) -> bool:
    """Whether a file changed less than two seconds before `now` (ns), or later.

    The next change may show the same stat values, since no clock of a file system is coarser than that of FAT.
    """
    return max(facts[-2:]) > now - YOUNG


def stat_of(status: os.stat_result) -> Stat:
    """Return the values that differ once a file has changed."""
    return status.st_mode, status.st_ino, status.st_dev, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def check_path(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now, in the form of `Entries`. Raises OSError if the system does not tell."""
    if check == VARIABLE:
        value = os.environ.get(os.fspath(path))
        return (-1,) if value is None else tuple(value.encode(errors="surrogateescape"))
    if check == MODELICA:
        with os.scandir(path) as entries:
            return modelica_names(entries)
    try:
        status = os.stat(path, follow_symlinks=check in (STAT, STAT_TYPE))
    except OSError as error:
        if error.errno in _ABSENT:
            return _NOTHING
        raise
    return stat_of(status) if check in (LSTAT, STAT) else (stat.S_IFMT(status.st_mode),)


def _look(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now, and record them. Raises OSError if the system does not tell."""
    try:
        facts = check_path(check, path)
    except OSError:
        mark_incomplete()
        raise
    if (dependencies := _current.get()) is not None:
        dependencies.add(check, path, facts)
    return facts


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
    return read_unrecorded(path)


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
    depend_on(folder)
    return os.listdir(folder)


def scan_modelica(folder: str | os.PathLike[str]) -> list[os.DirEntry[str]]:
    """Return the entries of a folder, in no order; its folders and Modelica files are recorded. Raises OSError."""
    if _current.get() is not None:
        _look(MODELICA, folder)
    with os.scandir(folder) as entries:
        return list(entries)


def modelica_names(entries: Iterable[os.DirEntry[str]]) -> tuple[int, ...]:
    """Return the number of folders and files of Modelica, and a checksum of their names, without hidden ones."""
    names = sorted(
        entry.name
        for entry in entries
        if not entry.name.startswith(".") and (entry.name.endswith(".mo") or entry.is_dir(follow_symlinks=False))
    )
    # the hash of an integer is the same in each process
    return len(names), hash(int.from_bytes("/".join(names).encode(errors="surrogateescape")))


def depend_on(path: str | os.PathLike[str]) -> None:
    """Record a file that is about to be read by other means, or a folder that is about to be listed."""
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
                depend_on(path)
            elif kind == stat.S_IFDIR:
                waiting.append(path)
