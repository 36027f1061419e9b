"""A lock that the operating system holds for a process, and lets go when the process ends, however it ends."""

from __future__ import annotations

import errno
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Self

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.files import failure

_PAUSE = 0.05
"""Seconds between two attempts."""
_BUSY = {errno.EACCES, errno.EAGAIN, errno.EWOULDBLOCK, errno.EDEADLK}

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


def _sign(descriptor: int) -> None:
    """Leave the number of this process in the file, unless it is there: a daemon locks again and again."""
    number = f"{os.getpid()}\n".encode()
    os.lseek(descriptor, 0, os.SEEK_SET)
    if os.read(descriptor, len(number) + 1) != number:
        os.lseek(descriptor, 0, os.SEEK_SET)
        os.ftruncate(descriptor, 0)
        os.write(descriptor, number)


class LockedError(UrdfsyncError):
    """Another process holds the lock for too long."""


class Lock:
    """A lock file, which stays where it is and holds the number of the process that had the lock last."""

    def __init__(self, path: Path, wait: float, shown: Callable[[Path], str] = str) -> None:
        self._path, self._wait, self._shown = path, wait, shown
        self._descriptor: int | None = None
        self._expired = False

    @property
    def held(self) -> bool:
        """Whether this process has the lock by way of this object."""
        return self._descriptor is not None

    def acquire(self, shared: bool = False, waiting: Callable[[], None] = lambda: None) -> None:
        """Take the lock, unless it is held already; `shared` waits for writers only. Calls `waiting` on and on.

        Where no lock file is, no writer holds it, so that `shared` takes nothing.

        Raises LockedError after `wait` seconds, and at once if that has happened before; OutputError if
        the file can't be used.
        """
        if self.held:
            return
        try:
            descriptor = self._open(shared)
        except OSError as error:
            if shared and isinstance(error, FileNotFoundError):
                return
            raise failure(error, self._shown(self._path)) from None
        try:
            self._wait_for(descriptor, shared, waiting)
        except BaseException:
            os.close(descriptor)
            raise
        self._descriptor = descriptor

    def release(self) -> None:
        """Let the lock go, if it is held."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()

    def _open(self, shared: bool) -> int:
        if shared:
            return os.open(self._path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        self._path.parent.mkdir(exist_ok=True)
        return os.open(self._path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)

    def _wait_for(self, descriptor: int, shared: bool, waiting: Callable[[], None]) -> None:
        end = time.monotonic() + (0 if self._expired else self._wait)
        while True:
            try:
                _try(descriptor, shared)
            except OSError as error:
                if error.errno not in _BUSY:
                    raise failure(error, self._shown(self._path), "it can't be locked") from None
            else:
                break
            if time.monotonic() >= end:
                self._expired = True
                raise self._locked(descriptor)
            waiting()
            time.sleep(_PAUSE)
        if not shared:
            _sign(descriptor)

    def _locked(self, descriptor: int) -> LockedError:
        os.lseek(descriptor, 0, os.SEEK_SET)
        holder = os.read(descriptor, 20).decode(errors="replace").strip()
        who = f"process {holder}" if holder.isdecimal() else "another process"
        message = f"{who} is building here, and did not finish within {self._wait:g} s"
        hint = "wait for it or end it, then build again"
        return LockedError(Diagnostic(Severity.ERROR, "locked", message, self._shown(self._path), hint=hint))
