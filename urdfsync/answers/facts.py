"""Facts that show a change of a path: stat values, file types, names in a folder, an environment variable.

The up-to-date check looks at each path of its list through this module, so it imports hardly anything. The hook lets it
look at a clone (see `places`).
"""

from __future__ import annotations

import errno
import os
import stat

from urdfsync.answers.places import place

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of the check
if TYPE_CHECKING:
    from collections.abc import Iterable

Stat = tuple[int, int, int, int, int, int]
"""Mode, inode, device, size in bytes, and the times (ns) of the last changes of content and of status."""

YOUNG = 2_000_000_000
"""Nanoseconds after a change during which a file counts as young: its content is compared, not only its stat values."""
MAX_FILE = 100_000_000
"""The size limit of a readable file, in bytes. A larger file is no source, mesh or output, but perhaps an attack."""
_ABSENT = (errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.EBADF)
"""Errors of the system for a path without a file; pathlib has the same list."""
_NONBLOCK = getattr(os, "O_NONBLOCK", 0)

LSTAT, STAT = "lstat", "stat"
"""How the content of a file is checked: by its `Stat`, and by its hash if the hash is known. `LSTAT` checks links
themselves, `STAT` their targets. Builds use `LSTAT` for the files that they write, `STAT` for all others.
"""
CONTENTS = (LSTAT, STAT)
LSTAT_TYPE, STAT_TYPE = "lstat type", "stat type"
"""How a path is checked by its file type alone."""
NAMES, MODELICA = "names", "modelica"
"""How a folder is checked: by all names in it, or by the names of visible folders and Modelica files."""
LISTINGS = (NAMES, MODELICA)
VARIABLE = "variable"
"""How an environment variable is checked: by its value. The entry has its name in place of a path."""
Entry = tuple[str, str]
"""A check, and its path or variable."""
NOTHING = (0,)
"""The facts about a path without a file."""


def is_young(facts: tuple[int, ...], now: int) -> bool:
    """Whether a file changed less than two seconds before `now` (ns), or later.

    The next change of a young file may leave its stat values equal. FAT has the coarsest clock: two seconds.
    """
    return max(facts[-2:]) > now - YOUNG


def failed(error: OSError) -> tuple[int, ...]:
    """Return the facts about a path that the system can't read."""
    return (-(error.errno or 1),)


def stat_of(status: os.stat_result) -> Stat:
    """Return the stat values that differ after a change."""
    return status.st_mode, status.st_ino, status.st_dev, status.st_size, status.st_mtime_ns, status.st_ctime_ns


def check_path(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now, in the form of `Dependencies.entries`."""
    try:
        return facts_of(check, path)
    except OSError as error:
        return failed(error)


def facts_of(check: str, path: str | os.PathLike[str]) -> tuple[int, ...]:
    """Return the facts about a path now. Raises OSError if the path can't be accessed."""
    if check == VARIABLE:
        value = os.environ.get(os.fspath(path))
        return (-1,) if value is None else tuple(value.encode(errors="surrogateescape"))
    if check in LISTINGS:
        with os.scandir(place(path)) as entries:
            return names_in(check, entries)
    follow = check in (STAT, STAT_TYPE)
    try:
        status = os.stat(place(path, follow=follow), follow_symlinks=follow)
    except OSError as error:
        if error.errno in _ABSENT:
            return NOTHING
        error.filename = os.fspath(path)
        raise
    return stat_of(status) if check in CONTENTS else (stat.S_IFMT(status.st_mode),)


def names_in(check: str, entries: Iterable[os.DirEntry[str]]) -> tuple[int, ...]:
    """Return number and checksum of a folder's names; for `MODELICA`, only of Modelica files and visible folders."""
    return checksum(
        entry.name
        for entry in entries
        if check == NAMES
        or (not entry.name.startswith(".") and (entry.name.endswith(".mo") or entry.is_dir(follow_symlinks=False)))
    )


def checksum(names: Iterable[str]) -> tuple[int, ...]:
    """Return the number of names, and a checksum that ignores their order."""
    ordered = sorted(names)
    # the hash of an integer is the same in each process
    return len(ordered), hash(int.from_bytes("/".join(ordered).encode(errors="surrogateescape")))


def hash_file(path: str) -> str:
    """Return the hash of a file's content now. Raises OSError."""
    return hash_content(read_unrecorded(path))


def hash_content(content: bytes) -> str:
    """Return the hash of a content."""
    from hashlib import sha256  # takes 3 ms; a saved answer about old files needs no hash

    return sha256(content).hexdigest()


def read_unrecorded(path: str | os.PathLike[str]) -> bytes:
    """Read a file without recording it, after `read_stat` or for no answer; otherwise like `read_file`."""
    with open(path, "rb", buffering=0, opener=_open) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file", os.fspath(path))
        if status.st_size > MAX_FILE:
            raise OSError(errno.EFBIG, f"it has more than {MAX_FILE:,} bytes", os.fspath(path))
        if status.st_size:
            return file.read()
        # a file of the system may have size 0 and never end
        return file.read(MAX_FILE) or b""


def _open(path: str, flags: int) -> int:
    """Open a file; opening a pipe waits for no writer. Raises OSError."""
    try:
        return os.open(place(path), flags | _NONBLOCK)
    except OSError as error:
        error.filename = path
        raise
