"""The file operations of a transaction.

A crash can interrupt only `write`, which writes files under temporary names. Tests put kills, errors
and saves between any two operations. All operations raise OSError. They follow no symbolic link: they create only new
files, and they rename a link itself.
"""

from __future__ import annotations

import contextlib
import errno
import functools
import os
import stat
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from urdfsync.common import system

_CREATE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
_FEW = 32
"""The greatest number of files that are synced one by one. With 400 files, syncing the machine is ten times faster."""

SPARE = "~"
"""The end of the third name for a swap by three renames."""
_HERE, _NOREPLACE, _EXCHANGE = -100, 1, 2
"""AT_FDCWD, RENAME_NOREPLACE and RENAME_EXCHANGE of Linux."""
_NO_RENAMES = {errno.EINVAL, errno.ENOSYS, errno.ENOTSUP}
"""Errors of a file system without these two flags."""
_NO_LINKS = {errno.EPERM, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK}
"""Errors of a file system without hard links."""


def make_folder(path: Path) -> None:
    """Make one folder, unless it exists."""
    try:
        path.mkdir()
    except FileExistsError:
        if not stat.S_ISDIR(path.lstat().st_mode):
            raise


def remove_folder(path: Path) -> None:
    """Remove a folder if it is empty."""
    with contextlib.suppress(OSError):  # it may be in use, deleted, or another user's
        path.rmdir()


def read(path: str | Path) -> bytes | None:
    """The content of a regular file; None for a missing file. Raises IsADirectoryError for a folder, link or device."""
    try:
        if not stat.S_ISREG(os.lstat(path).st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        with open(path, "rb", opener=system.open_file) as file:
            return file.read()
    except (FileNotFoundError, NotADirectoryError):
        return None


def write(path: str | Path, content: bytes, like: str | Path | None) -> None:
    """Write a new file, with the permissions of the file `like` if there is one."""
    descriptor = os.open(path, _CREATE, 0o666)
    try:
        while content:
            content = content[os.write(descriptor, content) :]
        if like:
            with contextlib.suppress(FileNotFoundError):
                mode = stat.S_IMODE(os.lstat(like).st_mode)
                os.chmod(descriptor if os.chmod in os.supports_fd else path, mode)
        if system.IS_WINDOWS:  # which has no `os.sync`, and opens no read-only file to sync it
            os.fsync(descriptor)
    finally:
        os.close(descriptor)


def exchange(path: str | Path, target: str | Path, third: str = "") -> None:
    """Swap two files, or finish an interrupted swap.

    If the system can't swap files, three renames do, by the name `third` or `spare(path)`, and the target is missing
    for some microseconds. A plain replacement would lose a save after the last check of the target. Raises
    FileNotFoundError or FileExistsError if another program created or deleted one of the files meanwhile.
    """
    third = third or spare(path)
    if not os.path.lexists(third):
        if rename(path, target, _EXCHANGE):
            return
        replace(target, third)
    if os.path.lexists(path):
        place(path, target)
    replace(third, path)


def spare(path: str | Path) -> str:
    """The third name for a swap of `path` by three renames."""
    return f"{path}{SPARE}"


def replace(path: str | Path, target: str | Path) -> None:
    """Move a file to another name in its folder; replace a file of this name."""
    system.replace(path, target)


def place(path: str | Path, target: str | Path) -> None:
    """Move a file to a free name of its folder. Raises FileExistsError if the name is not free."""
    if system.IS_WINDOWS:
        system.patiently(lambda: os.rename(path, target))  # replaces nothing there
        return
    if rename(path, target, _NOREPLACE):
        return
    try:
        os.link(path, target)  # unlike a rename, `link` fails if the name exists
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        if os.path.lexists(target):
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target)) from None
        replace(path, target)
    else:
        os.unlink(path)


def remove(path: str | Path) -> None:
    """Remove a file, if it exists."""
    with contextlib.suppress(FileNotFoundError, NotADirectoryError):
        system.unlink(path)


def sync(paths: Sequence[str | Path]) -> None:
    """Write files and folders from the system's cache to the disk, so that they survive a power failure."""
    if sys.platform == "win32":  # `write` has synced the files, and Windows writes the entries of folders without this
        return
    if len(paths) > _FEW:
        os.sync()
        return
    for path in paths:
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def rename(path: str | Path, target: str | Path, flag: int) -> bool:
    """Rename by `renameat2`. Returns False, and does nothing, if system or file system do not support it."""
    number = _renameat2()(os.fsencode(path), os.fsencode(target), flag)
    if number and number not in _NO_RENAMES:
        raise OSError(number, os.strerror(number), str(target))
    return not number


@functools.cache
def _renameat2() -> Callable[[bytes, bytes, int], int]:
    """A function that renames with a flag, and returns the error number; 0 for success."""
    if sys.platform != "linux":
        return lambda *_: errno.ENOSYS
    import ctypes  # imported here: takes 2 ms, only in builds that write

    rename = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    if rename is None:  # a C library from before 2018
        return lambda *_: errno.ENOSYS
    return lambda path, target, flag: ctypes.get_errno() if rename(_HERE, path, _HERE, target, flag) else 0
