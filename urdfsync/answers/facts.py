"""Facts that show a change of a path: stat values, file types, names in a folder, an environment variable.

The up-to-date check looks at each path of its list through this module, so it imports nothing.
"""

from __future__ import annotations

import errno
import os
import stat

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
UNMERGED = "unmerged"
"""How git's index is checked: by its unmerged files. All other changes of the index change no answer."""
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
    if check == UNMERGED:
        return checksum(unmerged_paths(path))
    if check in LISTINGS:
        with os.scandir(path) as entries:
            return names_in(check, entries)
    try:
        status = os.stat(path, follow_symlinks=check in (STAT, STAT_TYPE))
    except OSError as error:
        if error.errno in _ABSENT:
            return NOTHING
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


def unmerged_paths(index: str | os.PathLike[str]) -> set[str]:
    """Return the files in an index that git could not merge, from the top of the repository (`man gitformat-index`).

    There are none without an index, or if it is damaged: then git refuses each command.
    """
    try:
        content = read_unrecorded(index)
    except OSError:
        return set()
    number = int.from_bytes
    version, found, place, name = number(content[4:8]), set(), 12, b""
    for _ in range(number(content[8:12])):
        flags = number(content[place + 60 : place + 62])  # behind the stat values and the hash of the content
        start = place + (64 if flags & 0x4000 else 62)
        end = content.find(b"\0", start)
        if end < 0:
            break
        if version == 4:  # after a number of seven bits a byte: so many bytes of the name before are dropped
            dropped = content[start] & 127
            while content[start] & 128:
                start += 1
                dropped = (dropped + 1 << 7) | content[start] & 127
            start += 1
            end = content.find(b"\0", start)
            name, place = name[: len(name) - dropped] + content[start:end], end + 1
        else:
            name, place = content[start:end], end + 8 - (end - place) % 8
        if flags & 0x3000:  # the stage
            found.add(os.fsdecode(name))
    return found


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
    # opening a pipe would wait for a writer
    with open(path, "rb", buffering=0, opener=lambda path, flags: os.open(path, flags | _NONBLOCK)) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file", os.fspath(path))
        if status.st_size > MAX_FILE:
            raise OSError(errno.EFBIG, f"it has more than {MAX_FILE:,} bytes", os.fspath(path))
        if status.st_size:
            return file.read()
        # a file of the system may have size 0 and never end
        return file.read(MAX_FILE) or b""
