"""Facts that show a change: of a path, of a content, of the names in a folder, of an environment variable.

A no-op build looks at each recorded fact through this module, so it imports hardly anything. The hook lets it look at a
clone (see `places`).
"""

from __future__ import annotations

import errno
import os
import stat

from urdfsync.common.dependencies.places import place

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

Facts = tuple[int, ...]
"""Integers that differ after a change; a negative number is that of an error of the system."""
Entry = tuple[str, str]
"""A kind of fact, and the path or the variable's name."""
Dependencies = dict[Entry, int]
"""All that a piece of work has read: the hash of the facts of each entry. Python gives tuples of integers the same hash
in each process."""
Stat = tuple[int, int, int, int, int, int]
"""Mode, inode, device, size in bytes, and the times (ns) of the last changes of content and of status."""

YOUNG = 2_000_000_000
"""Nanoseconds after a change during which a file counts as young: its content is compared, not only its stat values."""
MAX_FILE = 100_000_000
"""The size limit of a readable file, in bytes. A larger file is no source, mesh or output, but perhaps an attack."""
_ABSENT = (errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.EBADF)
"""Errors of the system for a path without a file; pathlib has the same list."""
_NONBLOCK = getattr(os, "O_NONBLOCK", 0)

PATH = "path"
"""The fact of a path: the `Stat` of a regular file, the type of anything else; for a link, both of link and target."""
CONTENT = "content"
"""The fact of a file that was young when it was read: the hash of its content."""
NAMES, MODELICA = "names", "modelica"
"""The fact of a folder: all names in it, or the names of visible folders and Modelica files. After `MODELICA` and a
slash, a kind may have the names of folders that do not count, with a slash between two of them."""
LISTINGS = (NAMES, MODELICA)
VARIABLE = "variable"
"""The fact of an environment variable: its value."""
UNMERGED = "unmerged"
"""The fact of git's index: its unmerged files. Other changes of the index change no result."""
NOTHING = (0,)
"""The facts of a path without a file."""


def look(kind: str, path: str | os.PathLike[str]) -> Facts:
    """Return the facts now, or the negative number of the system's error."""
    try:
        if kind == PATH:
            return _path_facts(path)
        if kind == CONTENT:
            return content_facts(read_unrecorded(path))
        if kind == VARIABLE:
            value = os.environ.get(os.fspath(path))
            return () if value is None else (len(value), *value.encode(errors="surrogateescape"))
        if kind == UNMERGED:
            return checksum(unmerged_paths(path))
        return scan(kind, path)[1]
    except OSError as error:
        return NOTHING if kind == PATH and error.errno in _ABSENT else (-(error.errno or 1),)


def _path_facts(path: str | os.PathLike[str]) -> Facts:
    status = os.lstat(place(path))
    if stat.S_ISREG(status.st_mode):
        return stat_of(status, place(path))
    if not stat.S_ISLNK(status.st_mode):
        return (stat.S_IFMT(status.st_mode),)  # the times of a folder change with each file in it
    try:
        target = os.stat(place(path))
    except OSError as error:
        if error.errno in _ABSENT:
            return (*stat_of(status, place(path)), 0)
        raise
    is_file = stat.S_ISREG(target.st_mode)
    facts = stat_of(target, place(path), follow=True) if is_file else (stat.S_IFMT(target.st_mode),)
    return (*stat_of(status, place(path)), *facts)


def is_young(facts: Facts, now: int) -> bool:
    """Whether a file, its link or its target changed less than two seconds before `now` (ns), or later.

    The next change of a young file may leave its stat values equal. FAT has the coarsest clock: two seconds.
    """
    return max(facts[4:6] + facts[10:12], default=0) > now - YOUNG


def changes(known: Dependencies, seen: dict[Entry, Facts]) -> Iterator[Entry]:
    """Yield the entries that have other facts now.

    `seen` has listings that were looked at just now, and gets the others: robots of one package read the same folders,
    and a fleet of 1,000 would list 1,000 names 1,000 times.
    """
    for entry, fact in known.items():
        kind, path = entry
        if kind == PATH:
            facts = look(kind, path)
        else:
            facts = seen[entry] = seen.get(entry) or look(kind, path)
        if hash(facts) != fact:
            yield entry


def aged(known: Dependencies, now: int) -> Dependencies:
    """Return the dependencies without contents once all these files are old; else the same."""
    contents = [path for kind, path in known if kind == CONTENT]
    if not contents or any(is_young(look(PATH, path), now) for path in contents):
        return known
    return {entry: fact for entry, fact in known.items() if entry[0] != CONTENT}


def stat_of(status: os.stat_result, path: str, *, follow: bool = False) -> Stat:
    """Return the stat values of a path that differ after a change; with `follow` those of a link's target."""
    changed = status.st_ctime_ns
    if os.name == "nt":
        from urdfsync.common.system import change_time  # a no-op build on other systems saves this import

        changed = change_time(path, status, follow=follow)
    return status.st_mode, status.st_ino, status.st_dev, status.st_size, status.st_mtime_ns, changed


def scan(kind: str, folder: str | os.PathLike[str]) -> tuple[list[os.DirEntry[str]], Facts]:
    """Return the entries of a folder, and their facts for a kind of listing. Raises OSError."""
    with os.scandir(place(folder)) as scanned:
        entries = {entry.name: entry for entry in scanned}
    names = counting(kind, entries, lambda name: entries[name].is_dir(follow_symlinks=False))
    return [*entries.values()], checksum(names)


def counting(kind: str, names: Iterable[str], is_folder: Callable[[str], bool]) -> set[str]:
    """Return the names that count for a kind of listing."""
    if kind == NAMES:
        return set(names)
    left_out, visible = set(kind.split("/")[1:]), (name for name in names if not name.startswith("."))
    return {name for name in visible if name.endswith(".mo") or (name not in left_out and is_folder(name))}


def unmerged_paths(index: str | os.PathLike[str]) -> set[str]:
    """Return the files in an index that git could not merge, from the top of the repository (`man gitformat-index`).

    There are none without an index, or if it is damaged: then git refuses each command.
    """
    try:
        content = read_unrecorded(index)
    except OSError:
        return set()
    if content not in _unmerged:  # a command asks some times, and an index has all files of the repository
        _unmerged.clear()
        _unmerged[content] = frozenset(_find_unmerged(content))
    return set(_unmerged[content])


_unmerged: dict[bytes, frozenset[str]] = {}
"""The last index, and what git could not merge in it."""


def _find_unmerged(content: bytes) -> Iterator[str]:
    version, place, name = int.from_bytes(content[4:8]), 12, b""
    for _ in range(int.from_bytes(content[8:12])):
        if place + 62 > len(content):
            return
        flags = content[place + 60] << 8 | content[place + 61]  # behind the stat values and the hash of the content
        start, size = place + (64 if flags & 0x4000 else 62), flags & 0xFFF
        is_packed = version == 4
        end = start + size if not is_packed and size < 0xFFF else content.find(b"\0", start)
        if end < 0:
            return
        if is_packed:  # after a number of seven bits a byte: so many bytes of the name before are dropped
            dropped = content[start] & 127
            while content[start] & 128:
                start += 1
                dropped = (dropped + 1 << 7) | content[start] & 127
            start += 1
            end = content.find(b"\0", start)
            name = name[: len(name) - dropped] + content[start:end]
        if flags & 0x3000:  # the stage
            yield os.fsdecode(name if is_packed else content[start:end])
        place = end + 1 if is_packed else end + 8 - (end - place) % 8


def checksum(names: Iterable[str]) -> Facts:
    """Return the number of names, and a checksum that ignores their order."""
    ordered = sorted(names)
    # the hash of an integer is the same in each process
    return len(ordered), hash(int.from_bytes("/".join(ordered).encode(errors="surrogateescape")))


def content_facts(content: bytes) -> Facts:
    """Return the facts of a content: its SHA-256."""
    from hashlib import sha256  # takes 3 ms; a record of old files needs no hash

    return (int.from_bytes(sha256(content).digest()),)


def read_unrecorded(path: str | os.PathLike[str]) -> bytes:
    """Read a regular file without recording it, after `read_stat` or for no record; otherwise like `read_file`."""
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
        if os.name == "nt":
            from urdfsync.common.system import open_file  # likewise

            return open_file(place(path), flags)
        return os.open(place(path), flags | _NONBLOCK)
    except OSError as error:
        error.filename = path
        raise
