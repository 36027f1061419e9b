"""Files that only this machine believes: a copy of such a file, such as a committed one, counts as no file.

The first line states the file's own inode and time. A clone, an unpacked archive or a copy has others.
"""

from __future__ import annotations

import os
import stat

from urdfsync.common.dependencies.facts import MAX_FILE, stat_of

_READ = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
_CREATE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)

_AGE = 10_000_000_000
"""Nanoseconds by which a file is dated back: then its last change of status (`st_ctime`) is later, unless the file
system lets users set this time, too, as FAT and sshfs."""


_COARSEST = 2_000_000_000
"""The steps (ns) of the coarsest clock, that of FAT."""


def _first_line(inode: int, time: int) -> bytes:
    return f"urdfsync {inode} {time}\n".encode()


def read(path: str | os.PathLike[str]) -> bytes | None:
    """Return the content below the first line; None for a missing or unreadable file, a link, or a copy."""
    try:
        descriptor = os.open(path, _READ)  # without O_NONBLOCK, opening a pipe would wait for a writer
        with open(descriptor, "rb", buffering=0) as file:
            status = os.fstat(descriptor)
            if not stat.S_ISREG(status.st_mode) or status.st_size > MAX_FILE:
                return None
            first = _first_line(status.st_ino, status.st_mtime_ns)
            return file.read() if file.read(len(first)) == first else None
    except OSError:
        return None


def write(path: str | os.PathLike[str], content: bytes) -> None:
    """Write a new file. Raises OSError, also if there is a file."""
    descriptor = os.open(path, _CREATE, 0o666)
    try:
        status = os.fstat(descriptor)
        time = status.st_mtime_ns - _AGE
        time -= time % _COARSEST  # the time that is read later is that of the first line
        content = _first_line(status.st_ino, time) + content
        while content:
            content = content[os.write(descriptor, content) :]
    finally:
        os.close(descriptor)
    follows = os.utime not in os.supports_follow_symlinks  # some systems always follow symbolic links
    os.utime(path, ns=(time, time), follow_symlinks=follows)


def replace(path: str, content: bytes, *, needs_times: bool = False) -> None:
    """Write a file that is safe to lose, in the place of an older one; if that fails, there is no new file.

    The folder may be missing; its parent must exist. No link is followed: a repository may have committed one.
    With `needs_times`, nothing is written where users can set all times of files: there, stat values prove nothing.
    """
    folder, name = os.path.split(path)
    temporary = os.path.join(folder, f".{name}.urdfsync-tmp")
    try:
        if os.path.islink(folder) or os.path.islink(os.path.dirname(folder)):
            return
        if not os.path.isdir(folder):
            os.mkdir(folder)
        if os.path.lexists(temporary):
            os.unlink(temporary)  # a killed process left this file
        write(temporary, content)
        *_, written, changed = stat_of(os.lstat(temporary), temporary)
        if needs_times and changed <= written:
            os.unlink(temporary)
        else:
            os.replace(temporary, path)
    except (OSError, ValueError):
        return  # the next command does the work again
