"""A lock that the operating system holds for a process, and lets go when the process ends, however it ends."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Self

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.files import failure, shown

_PAUSE = 0.05
"""Seconds between two attempts."""
_BUSY = {errno.EACCES, errno.EAGAIN, errno.EWOULDBLOCK, errno.EDEADLK}
_NO_FOLDER_LOCKS = {errno.EBADF, errno.EINVAL, errno.EISDIR, errno.ENOTSUP}
"""What NFS says: it locks bytes, for which a file must be open for writing, and no folder can be."""

if sys.platform == "win32":
    import msvcrt

    _FAR = 1 << 30  # past the text, which others must be able to read

    def _try(descriptor: int, shared: bool) -> None:  # noqa: ARG001 - there are no shared locks here
        os.lseek(descriptor, _FAR, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _try(descriptor: int, shared: bool) -> None:
        fcntl.flock(descriptor, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)


class LockedError(UrdfsyncError):
    """Another process holds the lock for too long."""

    is_locked = True


class Lock:
    """A lock on a file, which then holds the number of the process that had the lock last."""

    def __init__(self, path: Path, wait: float, folder: Path | None = None) -> None:
        """`wait` is in seconds. With a `folder`, that is locked, and the file only says by whom: see `build_lock`."""
        self._path, self._wait, self._folder = path, wait, folder
        self._descriptor: int | None = None
        self._expired = False

    def acquire(self, shared: bool = False, waiting: Callable[[], None] = lambda: None) -> None:
        """Take the lock, unless it is held already; `shared` waits for writers only. Calls `waiting` on and on.

        Where there is no file to lock, no writer holds it, so that `shared` takes nothing.

        Raises LockedError after `wait` seconds, and at once if that has happened before; OutputError if the file or
        folder can't be locked.
        """
        if self._descriptor is not None:
            return
        try:
            if self._folder is not None:
                descriptor = os.open(self._folder, os.O_RDONLY)
            elif shared:
                descriptor = self._open(os.O_RDONLY)
            else:
                self._path.parent.mkdir(exist_ok=True)
                descriptor = self._open(os.O_RDWR | os.O_CREAT)
        except OSError as error:
            if shared and isinstance(error, FileNotFoundError):
                return
            raise failure(error, self._path) from None
        try:
            self._wait_for(descriptor, shared, waiting)
        except OSError as error:
            os.close(descriptor)
            if self._folder is None or error.errno not in _NO_FOLDER_LOCKS:
                raise failure(error, self._folder or self._path, "it can't be locked") from None
            self._folder = None  # the same for all processes here
            self.acquire(shared, waiting)
        except BaseException:
            os.close(descriptor)
            raise
        else:
            self._descriptor = descriptor
            if not shared:
                self._sign()

    def release(self) -> None:
        """Let the lock go, if it is held."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def _wait_for(self, descriptor: int, shared: bool, waiting: Callable[[], None]) -> None:
        end = time.monotonic() + (0 if self._expired else self._wait)
        while True:
            try:
                _try(descriptor, shared)
            except OSError as error:
                if error.errno not in _BUSY:
                    raise
            else:
                return
            if time.monotonic() >= end:
                self._expired = True
                holder = ""
                with contextlib.suppress(OSError), os.fdopen(self._open(os.O_RDONLY), errors="replace") as file:
                    holder = file.read(20).strip()
                who = f"process {holder}" if holder.isdecimal() else "another process"
                message = f"{who} is building here, and did not finish within {self._wait:g} s"
                hint = "wait for it or end it, then build again"
                raise LockedError(Diagnostic(Severity.ERROR, "locked", message, shown(self._path), hint=hint))
            waiting()
            time.sleep(_PAUSE)

    def _sign(self) -> None:
        """Leave the number of this process in the file, unless it is there: a daemon locks again and again."""
        number = f"{os.getpid()}\n"
        with contextlib.suppress(OSError):  # the number is for people only
            self._path.parent.mkdir(exist_ok=True)
            with os.fdopen(self._open(os.O_RDWR | os.O_CREAT), "r+", errors="replace") as file:
                is_alone = os.fstat(file.fileno()).st_nlink < 2  # else it may be a file of the user
                if is_alone and file.read(len(number) + 1) != number:
                    file.seek(0)
                    file.truncate()
                    file.write(number)

    def _open(self, flags: int) -> int:
        """Open the file itself: a link is not followed, and a pipe in its place is not waited for."""
        if self._path.parent.is_symlink():
            raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(self._path.parent))
        return os.open(self._path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0), 0o666)


def build_lock(root: Path, folder: Path, wait: float) -> Lock:
    """The lock of all who write below a configuration's folder, `root`; `folder` is the state folder.

    The root itself is locked. A file in the state folder is lost to `git clean -fdX` while it is held, and the next
    process would lock a new one. Windows has no locks of folders, but does not delete a file that is open.
    """
    return Lock(folder / "lock", wait, None if sys.platform == "win32" else root)
