"""Events of the file system, by way of watchdog: which paths may have changed, and whether events were lost."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import threading
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from watchdog.events import (
    DirCreatedEvent,
    DirDeletedEvent,
    DirMovedEvent,
    FileAttribEvent,
    FileClosedEvent,
    FileCreatedEvent,
    FileDeletedEvent,
    FileModifiedEvent,
    FileMovedEvent,
    FileSystemEvent,
    FileSystemEventHandler,
)
from watchdog.observers import Observer as Backend

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity

if TYPE_CHECKING:
    from watchdog.observers.api import BaseObserver, ObservedWatch

_EVENTS: list[type[FileSystemEvent]] = [
    *(FileAttribEvent, FileClosedEvent, FileCreatedEvent, FileDeletedEvent, FileModifiedEvent, FileMovedEvent),
    *(DirCreatedEvent, DirDeletedEvent, DirMovedEvent),
]
"""Neither opening nor reading: what the daemon does itself must not wake it."""

_HINTS = {
    errno.ENOSPC: "raise the limit with `sysctl fs.inotify.max_user_watches=524288`",
    errno.EMFILE: "raise the limit with `sysctl fs.inotify.max_user_instances=512`",
    errno.EACCES: "check the permissions of the folder",
}
_COVERED = "it is looked at every now and then"


class Observer:
    """Watches folders as long as it is open; folders that are replaced are watched again when `arm` is called."""

    def __init__(self, notice: Callable[[str], None], lost: Callable[[], None]) -> None:
        """`notice` gets each path that may have changed, `lost` is called when events were lost; from any thread."""
        self._handler = _Handler(notice)
        self._lost = lost
        self._backend: BaseObserver | None = None
        self._watches: dict[tuple[str, bool], tuple[ObservedWatch, tuple[int, int]]] = {}

    @contextlib.contextmanager
    def open(self) -> Iterator[None]:
        """Watch within this context."""
        log, warnings = logging.getLogger("watchdog"), _Warnings(self._lost)
        before, hook = log.propagate, threading.excepthook
        log.addHandler(warnings)
        log.propagate, threading.excepthook = False, self._on_crash
        try:
            yield
        finally:
            self._close()
            log.removeHandler(warnings)
            log.propagate, threading.excepthook = before, hook

    def arm(self, folders: Mapping[str, bool]) -> tuple[Diagnostic, ...]:
        """Watch exactly these folders, each with all folders in it if its value says so.

        Returns what can't be watched and why, one finding for each reason.
        """
        try:
            backend = self._start()
        except OSError as error:
            return (_trouble(error, "the files can't be watched", ""),)
        wanted = {(folder, recursive): facts for folder, recursive in folders.items() if (facts := _identity(folder))}
        alive = {emitter.watch for emitter in backend.emitters if emitter.is_alive()}
        for key, (watch, facts) in list(self._watches.items()):
            if wanted.get(key) != facts or watch not in alive:
                backend.unschedule(watch)
                del self._watches[key]
        found: dict[int | None, Diagnostic] = {}
        for key in wanted.keys() - self._watches.keys():
            try:
                self._watch(backend, *key)
            except OSError as error:
                if error.errno not in (errno.ENOENT, errno.ENOTDIR):  # gone again: its parent is watched
                    what = f"the folder {shown(Path(key[0]))} can't be watched"
                    found.setdefault(error.errno, _trouble(error, what, shown(Path(key[0]))))
        return tuple(found.values())

    def _start(self) -> BaseObserver:
        """The backend, running. Raises OSError if the system gives none."""
        if self._backend is not None and not self._backend.is_alive():
            self._close()
        if self._backend is None:
            self._backend = Backend()
            try:
                self._backend.start()
            except RuntimeError as error:  # there are no more threads
                self._backend = None
                raise OSError(errno.EAGAIN, str(error)) from None
        return self._backend

    def _watch(self, backend: BaseObserver, folder: str, recursive: bool) -> None:
        if not os.access(folder, os.R_OK):  # watchdog says nothing then
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        identity = _identity(folder)
        try:
            watch = backend.schedule(self._handler, folder, recursive=recursive, event_filter=_EVENTS)
        except RuntimeError as error:  # there are no more threads
            raise OSError(errno.EAGAIN, str(error)) from None
        if identity is not None:
            self._watches[folder, recursive] = watch, identity

    def _close(self) -> None:
        self._watches.clear()
        if self._backend is not None:
            self._backend.stop()
            self._backend.join()
            self._backend = None

    def _on_crash(self, arguments: Any) -> None:  # noqa: ARG002 - as threading calls it
        """A thread of watchdog has ended with an exception: what it watched is watched again by the next `arm`."""
        self._lost()


class _Handler(FileSystemEventHandler):
    def __init__(self, notice: Callable[[str], None]) -> None:
        self._notice = notice

    def dispatch(self, event: FileSystemEvent) -> None:
        """Pass on both paths of an event."""
        for path in (event.src_path, event.dest_path):
            if path:
                self._notice(os.fsdecode(path))


class _Warnings(logging.Handler):
    """Takes what watchdog logs: a warning means that events were lost, and is said in no other way."""

    def __init__(self, lost: Callable[[], None]) -> None:
        super().__init__()
        self._lost = lost

    def emit(self, record: logging.LogRecord) -> None:
        """Take note of a message."""
        if record.levelno == logging.WARNING:
            self._lost()


def _identity(folder: str) -> tuple[int, int] | None:
    try:
        found = os.stat(folder)  # noqa: PTH116 - many, and often
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _trouble(error: OSError, what: str, place: str) -> Diagnostic:
    reason = error.strerror or str(error)
    hint = _HINTS.get(error.errno or 0, "use --poll")
    return Diagnostic(Severity.WARNING, "not-watched", f"{what}, so {_COVERED}: {reason}", place, hint=hint)
