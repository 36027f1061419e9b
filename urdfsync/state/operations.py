"""The operations on files that writing consists of: a crash comes before one of them or after it.

Only what writes content may be cut short, and that has a name that nobody reads yet.
Tests put crashes, errors and the user's saves between any two of them. All raise OSError.
"""

from __future__ import annotations

import _thread
import contextlib
import errno
import functools
import os
import stat
from collections.abc import Callable, Sequence
from pathlib import Path

from urdfsync import profiling
from urdfsync.files import TEMPORARY

FEW = 32
"""Up to so many files are synced each by itself, more with one call for the whole machine."""

_NO_LINKS = {errno.EXDEV, errno.EPERM, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK}
"""What the system says where there are no hard links, or not from one folder to the other."""
_NOFOLLOW = {"follow_symlinks": False} if os.link in os.supports_follow_symlinks else {}


_FROM_HERE, _KEEP, _SWAP = -100, 1, 2
"""AT_FDCWD, RENAME_NOREPLACE and RENAME_EXCHANGE of Linux."""
_NO_RENAMES = {errno.EINVAL, errno.ENOSYS, errno.ENOTSUP, errno.EXDEV}
"""What the system says where it can't do that, or not from one file system to the other."""


def make_folder(path: Path) -> None:
    """Make one folder, unless it is there."""
    path.mkdir(exist_ok=True)


def remove_folder(path: Path) -> None:
    """Remove a folder if it is empty."""
    with contextlib.suppress(OSError):  # it is not empty, gone already, or not ours to remove: all fine
        path.rmdir()


def write(path: Path, content: bytes, like: Path | None = None) -> None:
    """Write a new file, in place of what a killed run left under its name, with the permissions of `like`."""
    try:
        file = path.open("xb")
    except FileExistsError:
        path.unlink()
        file = path.open("xb")
    with file:
        file.write(content)
    if like is not None:
        with contextlib.suppress(FileNotFoundError):
            path.chmod(stat.S_IMODE(like.stat().st_mode))


def keep(path: Path, copy: Path) -> None:
    """Give a file a second name, so that it outlives the first; where that can't be, copy it."""
    copy.unlink(missing_ok=True)
    try:
        os.link(path, copy, **_NOFOLLOW)
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        write(copy, path.read_bytes(), path)


def exchange(path: Path, target: Path) -> bool:
    """Swap two files at one stroke. Returns False, and does nothing, where the system can't do that."""
    return _rename(path, target, _SWAP)


def replace(path: Path, target: Path) -> None:
    """Move a file over another one, or to a free name; from one file system to another by a copy."""
    try:
        path.replace(target)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        beside = target.with_name(f".{os.getpid()}-{path.name}{TEMPORARY}")
        write(beside, path.read_bytes(), path)
        beside.replace(target)
        path.unlink()


def place(path: Path, target: Path) -> None:
    """Move a file to a name that must be free. Raises FileExistsError if it is not."""
    if _rename(path, target, _KEEP):
        return
    try:
        os.link(path, target)
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        if os.path.lexists(target):
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target)) from None
        replace(path, target)
    else:
        path.unlink()


def remove(path: Path) -> None:
    """Remove a file, if it is there."""
    with contextlib.suppress(FileNotFoundError, NotADirectoryError):
        path.unlink()


@profiling.staged("syncing")
def sync(paths: Sequence[Path]) -> None:
    """Bring files and folders to the disk, so that they outlive a power failure.

    A few are synced each by itself, since the one call for all waits for everything that any program has
    written; for a whole package that call is the faster one: with one each, 405 files take up to 0.6 s. Nobody waits
    until a thread has begun, as `threading` would: that takes longer than all else.
    """
    if len(paths) > FEW and hasattr(os, "sync"):
        os.sync()
        return
    failed: list[OSError] = []
    waiting = []
    for path in paths[1:]:  # at the same time: the file system's journal takes them as one
        done = _thread.allocate_lock()
        done.acquire()
        try:
            _thread.start_new_thread(_sync_one, (path, failed, done.release))
        except RuntimeError:  # the system has no thread left
            _sync_one(path, failed)
        else:
            waiting.append(done)
    for path in paths[:1]:
        _sync_one(path, failed)
    for done in waiting:
        done.acquire()
    if failed:
        raise failed[0]


def _sync_one(path: Path, failed: list[OSError], done: Callable[[], None] = lambda: None) -> None:
    """Sync a file or folder, or say why that can't be."""
    try:
        if os.name == "nt" and path.is_dir():
            return  # can't be opened there, and needs no sync
        descriptor = os.open(path, os.O_RDWR if os.name == "nt" else os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as error:
        failed.append(error)
    finally:
        done()


def _rename(path: Path, target: Path, flag: int) -> bool:
    """Rename a file in this way, at one stroke. Returns False, and does nothing, where the system can't do that."""
    number = _renaming()(os.fsencode(path), os.fsencode(target), flag)
    if number and number not in _NO_RENAMES:
        raise OSError(number, os.strerror(number), str(target))
    return not number


@functools.cache
def _renaming() -> Callable[[bytes, bytes, int], int]:
    """A function that renames with a flag and returns the number of the error, 0 for none."""
    import ctypes  # only builds that write need it

    try:
        rename = ctypes.CDLL(None, use_errno=True).renameat2
    except (AttributeError, OSError, TypeError):  # another system, or an old library
        return lambda *_: errno.ENOSYS

    def call(path: bytes, target: bytes, flag: int) -> int:
        return ctypes.get_errno() if rename(_FROM_HERE, path, _FROM_HERE, target, flag) else 0

    return call
