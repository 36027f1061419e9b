"""The lock that a daemon holds for its life: one daemon per configuration."""

from __future__ import annotations

import contextlib
import os

from urdfsync.config import STATE_FOLDER, Config, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.state.lock import Lock, LockedError


class AlreadyWatchedError(UrdfsyncError):
    """Another daemon watches this configuration."""

    is_locked = True


class InstanceLock(Lock):
    """Released at the end of its context."""

    def __init__(self, config: Config) -> None:
        super().__init__(config.root / STATE_FOLDER / "watch.lock", 0)
        self._config_file = config.file

    def hold(self) -> None:
        """Take the lock; also when it was taken, but its file was deleted: another daemon could not see it.

        Raises AlreadyWatchedError, or OutputError if the file can't be used.
        """
        with contextlib.suppress(OSError):
            if self._descriptor is not None and os.path.samestat(os.fstat(self._descriptor), self._path.stat()):
                return
        self.release()
        try:
            self.acquire()
        except LockedError:
            holder = self._path.read_text(errors="replace").strip()
            who = f"process {holder}" if holder.isdecimal() else "another process"
            message, hint = f"{who} watches this configuration already", "leave the work to it, or end it first"
            found = Diagnostic(Severity.ERROR, "watched", message, shown(self._config_file), hint=hint)
            raise AlreadyWatchedError(found) from None
