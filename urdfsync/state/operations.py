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
import sys
from collections.abc import Callable, Sequence

from urdfsync import profiling
from urdfsync.files import TEMPORARY

AnyPath = str | os.PathLike[str]
"""A path; a string takes less time where there are thousands."""

FEW = 32
"""Up to so many files are synced each by itself, more with one call for the whole machine."""
_AT_ONCE = 3
"""So many of the few at the same time; more threads wait for each other more than for the disk."""

_NO_LINKS = {errno.EXDEV, errno.EPERM, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK}
"""What the system says where there are no hard links, or not from one folder to the other."""
_NOFOLLOW = {"follow_symlinks": False} if os.link in os.supports_follow_symlinks else {}


_FROM_HERE, _KEEP, _SWAP = -100, 1, 2
"""AT_FDCWD, RENAME_NOREPLACE and RENAME_EXCHANGE of Linux."""
_NO_RENAMES = {errno.EINVAL, errno.ENOSYS, errno.ENOTSUP, errno.EXDEV}
"""What the system says where it can't do that, or not from one file system to the other."""

_START = 2
"""SYNC_FILE_RANGE_WRITE of Linux."""
_NO_START = {errno.EINVAL, errno.ENOSYS, errno.ENOTSUP, errno.EPERM, errno.ESPIPE}
"""What the system says where it can't do that, or not for such a file: then the sync alone has to do."""


def make_folder(path: AnyPath) -> None:
    """Make one folder, unless it is there."""
    try:
        os.mkdir(path)
    except FileExistsError:
        if not os.path.isdir(path):
            raise


def remove_folder(path: AnyPath) -> None:
    """Remove a folder if it is empty."""
    with contextlib.suppress(OSError):  # it is not empty, gone already, or not ours to remove: all fine
        os.rmdir(path)


def makes_alike(folder: AnyPath, other: AnyPath) -> bool:
    """Whether a file made in one folder is what it would be if it were made in the other: by a move it gets there.

    That is so if they are on one file system and hand on the same: a group, an access control list, a security label.
    False where that can't be told.
    """
    try:
        return sys.platform == "linux" and _handed_on(folder) == _handed_on(other)
    except OSError:
        return False


def read(path: AnyPath) -> bytes:
    """The content of a file."""
    with open(path, "rb", buffering=0) as file:  # a buffer would take as long again
        return file.read()


def write(path: AnyPath, content: bytes, like: AnyPath | None = None) -> None:
    """Write a new file, in place of what a killed run left under its name, with the permissions of `like`."""
    try:
        file = open(path, "xb", buffering=0)  # noqa: SIM115 - a buffer would take as long again
    except FileExistsError:
        os.unlink(path)
        file = open(path, "xb", buffering=0)  # noqa: SIM115
    with file:
        written = file.write(content)
        while written < len(content):
            written += file.write(content[written:])
        made = os.fstat(file.fileno()).st_mode
    if like is not None:
        with contextlib.suppress(FileNotFoundError):
            wanted = os.stat(like).st_mode
            if stat.S_IMODE(wanted) != stat.S_IMODE(made):
                os.chmod(path, stat.S_IMODE(wanted))


def keep(path: AnyPath, copy: AnyPath) -> bool:
    """Give a file a second name, so that it outlives the first; where that can't be, copy it.

    Returns False where no file can be moved from the one folder to the other either.
    """
    try:
        _link(path, copy)
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        write(copy, read(path), path)
        return error.errno != errno.EXDEV
    return True


def exchange(path: AnyPath, target: AnyPath) -> bool:
    """Swap two files at one stroke. Returns False, and does nothing, where the system can't do that."""
    return _rename(path, target, _SWAP)


def replace(path: AnyPath, target: AnyPath) -> None:
    """Move a file over another one, or to a free name; from one file system to another by a copy."""
    try:
        os.replace(path, target)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        beside = os.path.join(os.path.dirname(target), f".{os.getpid()}-{os.path.basename(path)}{TEMPORARY}")
        write(beside, read(path), path)
        os.replace(beside, target)
        os.unlink(path)


def place(path: AnyPath, target: AnyPath) -> None:
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
        os.unlink(path)


def remove(path: AnyPath) -> None:
    """Remove a file, if it is there."""
    with contextlib.suppress(FileNotFoundError, NotADirectoryError):
        os.unlink(path)


@profiling.stage("syncing")
def sync(paths: Sequence[AnyPath]) -> None:
    """Bring files and folders to the disk, so that they outlive a power failure.

    A few are synced each by itself, since the one call for all waits for everything that any program has
    written; for a whole package that call is the faster one: with one each, 405 files take up to 0.6 s.
    """
    if len(paths) > FEW and hasattr(os, "sync"):
        os.sync()
        return
    if os.name == "nt":
        paths = [path for path in paths if not os.path.isdir(path)]  # can't be opened there, and need no sync
    with contextlib.ExitStack() as stack:
        descriptors = []
        for path in paths:
            descriptors.append(os.open(path, os.O_RDWR if os.name == "nt" else os.O_RDONLY))
            stack.callback(os.close, descriptors[-1])
        if len(descriptors) > 1:
            begin = _beginning()
            for descriptor in descriptors:
                begin(descriptor)
        _sync_all(descriptors)


def _sync_all(descriptors: Sequence[int]) -> None:
    """Sync open files, some at the same time, so that the disk does not have to be waited for once for each.

    Nobody waits until a thread has begun, as `threading` would: that takes longer than all else.
    """
    failed: list[OSError] = []
    waiting = []
    for first in range(1, min(_AT_ONCE, len(descriptors))):
        done = _thread.allocate_lock()
        done.acquire()
        try:
            _thread.start_new_thread(_sync_some, (descriptors[first::_AT_ONCE], failed, done.release))
        except RuntimeError:  # the system has no thread left
            _sync_some(descriptors[first::_AT_ONCE], failed)
        else:
            waiting.append(done)
    _sync_some(descriptors[::_AT_ONCE], failed)
    for done in waiting:
        done.acquire()
    if failed:
        raise failed[0]


def _sync_some(descriptors: Sequence[int], failed: list[OSError], done: Callable[[], None] = lambda: None) -> None:
    """Sync open files one after the other, or say why that can't be."""
    try:
        for descriptor in descriptors:
            os.fsync(descriptor)
    except OSError as error:
        failed.append(error)
    finally:
        done()


def _link(path: AnyPath, copy: AnyPath) -> None:
    """Give a file a second name, in place of what a killed run left there."""
    try:
        os.link(path, copy, **_NOFOLLOW)
    except FileExistsError:
        os.unlink(copy)
        os.link(path, copy, **_NOFOLLOW)


def _handed_on(folder: AnyPath) -> tuple[object, ...]:
    """What the files that are made in a folder get from it."""
    status = os.stat(folder)
    attributes: dict[str, bytes] = {}
    if sys.platform == "linux":
        try:
            attributes = {name: os.getxattr(folder, name) for name in os.listxattr(folder)}
        except OSError as error:
            if error.errno != errno.ENOTSUP:  # a file system without attributes has nothing to hand on
                raise
    return status.st_dev, status.st_gid, status.st_mode & stat.S_ISGID, attributes


def _rename(path: AnyPath, target: AnyPath, flag: int) -> bool:
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


@functools.cache
def _beginning() -> Callable[[int], None]:
    """A function that has what was written to an open file begin its way to the disk; it does nothing for a folder.

    It raises OSError if that fails, and does nothing where the system has no such call.
    """
    import ctypes

    try:
        start = ctypes.CDLL(None, use_errno=True).sync_file_range
    except (AttributeError, OSError, TypeError):
        return lambda _: None
    start.argtypes = (ctypes.c_int, ctypes.c_int64, ctypes.c_int64, ctypes.c_uint)

    def call(descriptor: int) -> None:
        if start(descriptor, 0, 0, _START) and (number := ctypes.get_errno()) not in _NO_START:
            raise OSError(number, os.strerror(number))

    return call
