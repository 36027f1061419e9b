"""A lock that one process holds. The operating system lets it go when the process ends, however it ends."""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Self

from urdfsync.diagnostics import UrdfsyncError
from urdfsync.files import Tree, failure, shown

if TYPE_CHECKING:
    from filelock import BaseFileLock

_FLAGS = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
_LEAST_WAIT = 0.2
"""Seconds for some attempts: one alone takes a lock file that is deleted meanwhile for one that somebody holds."""


class LockedError(UrdfsyncError):
    """Another process holds the lock for too long."""

    is_locked = True


class Lock:
    """A lock file in a state folder. It stays there, and has the number of the process that held the lock last."""

    def __init__(self, file: Path, wait: float) -> None:
        """`wait` is in seconds; less than 0.2 is 0.2."""
        self._file, self._wait = file, wait
        self._lock: BaseFileLock | None = None

    def acquire(self, waiting: Callable[[], object] = lambda: None) -> None:
        """Take the lock, unless this object holds it already and the file is still there. Calls `waiting` on and on.

        Raises LockedError after `wait` seconds, and at once if that has happened before; OutputError if the file can't
        be locked.
        """
        if self._lock is not None and self._file.exists():
            return
        self.release()
        from filelock import FileLock, Timeout  # 40 ms, for builds that write only

        lock = FileLock(self._file, thread_local=False)
        try:
            Tree(self._file.parent.parent).check_folder(self._file.parent)  # FileLock follows a link to a folder
            lock.acquire(max(self._wait, _LEAST_WAIT), cancel_check=lambda: bool(waiting()))
        except Timeout:
            self._wait = 0
            message = f"{self.holder()} is building here, and did not finish in time"
            hint = "wait for it or end it, then build again"
            raise LockedError.of("locked", message, shown(self._file), hint=hint) from None
        except OSError as error:
            raise failure(error, self._file, "it can't be locked") from None
        self._lock = lock
        self._sign()

    def release(self) -> None:
        """Let the lock go, if it is held."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    def holder(self) -> str:
        """The process that has the lock, or had it last, in words."""
        number = ""
        with contextlib.suppress(OSError), os.fdopen(os.open(self._file, os.O_RDONLY | _FLAGS), "rb") as file:
            number = (file.read(20) or b"").decode(errors="replace").strip()
        return f"process {number}" if number.isdecimal() else "another process"

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def _sign(self) -> None:
        """Leave the number of this process in the file, for people; not in a hard link of a user's file."""
        number = b"%d\n" % os.getpid()
        with contextlib.suppress(OSError), os.fdopen(os.open(self._file, os.O_RDWR | _FLAGS), "r+b") as file:
            status = os.fstat(file.fileno())
            if stat.S_ISREG(status.st_mode) and status.st_nlink == 1 and file.read() != number:
                file.seek(0)
                file.truncate()
                file.write(number)


def build_lock(state_folder: Path, wait: float) -> Lock:
    """The lock of all who write below the folder of a configuration."""
    return Lock(state_folder / "lock", wait)
