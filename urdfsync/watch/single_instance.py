"""The lock that a daemon holds for its life: one daemon per configuration."""

from __future__ import annotations

from types import TracebackType
from typing import Self

from urdfsync.config import STATE_FOLDER, Config, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.state.lock import Lock, LockedError


class AlreadyWatchedError(UrdfsyncError):
    """Another daemon watches this configuration."""

    is_locked = True


class SingleInstance:
    """Holds the lock within its context."""

    def __init__(self, config: Config) -> None:
        self._file = config.file
        self._path = config.root / STATE_FOLDER / "watch.lock"
        self._lock = Lock(self._path, 0, shown)
        self._inode = 0

    def __enter__(self) -> Self:
        """Take the lock. Raises AlreadyWatchedError, or OutputError if the file can't be used."""
        try:
            self._lock.acquire()
        except LockedError:
            holder = self._path.read_text(errors="replace").strip()
            who = f"process {holder}" if holder.isdecimal() else "another process"
            message, hint = f"{who} watches this configuration already", "leave the work to it, or end it first"
            found = Diagnostic(Severity.ERROR, "watched", message, shown(self._file), hint=hint)
            raise AlreadyWatchedError(found) from None
        self._inode = self._path.stat().st_ino
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._lock.release()

    def renew(self) -> None:
        """Take the lock again if its file was deleted: another daemon could not see it. Raises as `__enter__`."""
        if not self._path.exists() or self._path.stat().st_ino != self._inode:
            self._lock.release()
            self.__enter__()
