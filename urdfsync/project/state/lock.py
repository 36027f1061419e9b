"""A lock that one process holds. The operating system releases it when the process ends."""

from __future__ import annotations

import contextlib
import os
import stat
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Self

from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.common.files import Tree, failure, shown

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_FLAGS = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
_LEAST_WAIT = 0.2
"""The least seconds to try: another program may delete the lock file during the first attempt."""
_PAUSE = 0.05
"""Seconds between two attempts."""
_LOCKED_BYTE = 1_000_000
"""The place that Windows locks: behind the number of the process, which everybody may read."""


class LockedError(UrdfsyncError):
    """Another process kept the lock for too long."""

    is_locked = True


class Lock:
    """A lock file in a state folder. The file stays, and contains the process number of the last holder."""

    def __init__(self, file: Path, wait: float) -> None:
        """`wait` is in seconds; at least 0.2."""
        self._file, self._wait = file, wait
        self._descriptor: int | None = None

    def acquire(self, waiting: Callable[[], object] = lambda: None) -> None:
        """Take the lock, unless this object already holds it and the file still exists.

        Calls `waiting` repeatedly. Raises LockedError after `wait` seconds; each further call then waits only 0.2
        seconds. Raises OutputError if the file can't be locked.
        """
        if self._descriptor is not None and self._file.exists():
            return
        self.release()
        end = time.monotonic() + max(self._wait, _LEAST_WAIT)
        try:
            Tree(self._file.parent.parent).check_folder(self._file.parent)
            self._file.parent.mkdir(parents=True, exist_ok=True)
            while (descriptor := _lock(self._file)) is None:
                if time.monotonic() > end:
                    self._wait = 0
                    message = f"{self.holder()} is building here, and did not finish in time"
                    hint = "wait for this process or end it, then build again"
                    raise LockedError.of("locked", message, shown(self._file), hint=hint)
                waiting()
                time.sleep(_PAUSE)
        except OSError as error:
            raise failure(error, self._file, "it can't be locked") from None
        self._descriptor = descriptor
        self._sign()

    def release(self) -> None:
        """Release the lock, if it is held."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def holder(self) -> str:
        """A description of the process that holds the lock, or held it last."""
        number = ""
        with contextlib.suppress(OSError), os.fdopen(os.open(self._file, os.O_RDONLY | _FLAGS), "rb") as file:
            number = (file.read(20) or b"").decode(errors="replace").strip()
        return f"process {number}" if number.isdecimal() else "another process"

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def _sign(self) -> None:
        """Write the number of this process into the lock file; never write into a hard link of a user's file."""
        number = b"%d\n" % os.getpid()
        with contextlib.suppress(OSError), os.fdopen(os.open(self._file, os.O_RDWR | _FLAGS), "r+b") as file:
            status = os.fstat(file.fileno())
            if stat.S_ISREG(status.st_mode) and status.st_nlink == 1 and file.read() != number:
                file.seek(0)
                file.truncate()
                file.write(number)


def _lock(file: Path) -> int | None:
    """Lock a file; returns its descriptor, None if another process has locked it. Raises OSError.

    filelock does the same, but importing it takes 20 of the 90 ms of a build with one changed mass.
    """
    descriptor = os.open(file, os.O_RDWR | os.O_CREAT | _FLAGS, 0o666)
    with contextlib.ExitStack() as stack:
        stack.callback(os.close, descriptor)
        with contextlib.suppress(BlockingIOError, FileNotFoundError):
            if sys.platform == "win32":
                os.lseek(descriptor, _LOCKED_BYTE, os.SEEK_SET)
                try:
                    msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
                except OSError:  # its number has no meaning: it is that of a denied access, or of no error
                    return None
            else:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(os.fstat(descriptor), os.lstat(file)):  # otherwise the file was replaced meanwhile
                stack.pop_all()
                return descriptor
    return None


def build_lock(state_folder: Path, wait: float) -> Lock:
    """Return the lock for builds below the folder of a configuration."""
    return Lock(state_folder / "lock", wait)
