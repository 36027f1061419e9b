"""Events of the file system, by way of watchdog."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from watchdog import events, observers

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.watch.event_queue import EventQueue, EventsLost
from urdfsync.watch.paths import WatchedPaths

if TYPE_CHECKING:
    from watchdog.observers.api import BaseObserver, ObservedWatch

# neither opening nor reading: what the daemon does itself must not wake it
_EVENTS: list[type[events.FileSystemEvent]] = [
    events.FileAttribEvent,
    events.FileClosedEvent,
    events.FileCreatedEvent,
    events.FileDeletedEvent,
    events.FileModifiedEvent,
    events.FileMovedEvent,
    events.DirCreatedEvent,
    events.DirDeletedEvent,
    events.DirMovedEvent,
]
_HINTS = {
    errno.ENOSPC: "raise the limit with `sysctl fs.inotify.max_user_watches=524288`",
    errno.EMFILE: "raise the limit with `sysctl fs.inotify.max_user_instances=512`",
    errno.EACCES: "check the permissions of the folder",
}


class Observer:
    """Watches folders while it is open, and puts what may have changed into the queue."""

    def __init__(self, queue: EventQueue) -> None:
        self._queue = queue
        self._handler = _Handler(queue)
        self._backend: BaseObserver | None = None
        self._watches: dict[tuple[str, bool], tuple[ObservedWatch, tuple[int, int]]] = {}

    @contextlib.contextmanager
    def open(self) -> Iterator[None]:
        """Watch within this context."""
        log, warnings = logging.getLogger("watchdog"), _Warnings(self._queue)
        before = log.propagate
        log.addHandler(warnings)
        log.propagate = False
        try:
            yield
        finally:
            self._close()
            log.removeHandler(warnings)
            log.propagate = before

    def watch_folders(self, paths: WatchedPaths) -> tuple[Diagnostic, ...]:
        """Watch exactly these folders; one that was replaced since the last call is watched anew.

        Returns one finding for each reason for which folders can't be watched.
        """
        try:
            backend = self._start()
        except OSError as error:
            return (_not_watched(error, "the files can't be watched", ""),)
        folders = dict.fromkeys(paths.folders, False) | dict.fromkeys(paths.trees, True)
        wanted = {(folder, deep): identity for folder, deep in folders.items() if (identity := _identity(folder))}
        alive = {emitter.watch for emitter in backend.emitters if emitter.is_alive()}
        for key, (watch, identity) in list(self._watches.items()):
            if wanted.get(key) != identity or watch not in alive:
                backend.unschedule(watch)
                del self._watches[key]
        found: dict[int | None, Diagnostic] = {}
        for key in wanted.keys() - self._watches.keys():
            try:
                self._watch(backend, *key)
            except OSError as error:
                if error.errno not in (errno.ENOENT, errno.ENOTDIR):  # gone again: its parent is watched
                    name = shown(Path(key[0]))
                    found.setdefault(error.errno, _not_watched(error, f"the folder {name} can't be watched", name))
        return tuple(found.values())

    def _start(self) -> BaseObserver:
        """Return the running backend. Raises OSError if the system gives none."""
        if self._backend is not None and not self._backend.is_alive():
            self._close()
        if self._backend is None:
            backend = observers.Observer()
            with _threads_as_os_error():
                backend.start()
            self._backend = backend
        return self._backend

    def _watch(self, backend: BaseObserver, folder: str, deep: bool) -> None:
        if not os.access(folder, os.R_OK):  # watchdog says nothing then
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        identity = _identity(folder)
        with _threads_as_os_error():
            watch = backend.schedule(self._handler, folder, recursive=deep, event_filter=_EVENTS)
        if identity is not None:
            self._watches[folder, deep] = watch, identity

    def _close(self) -> None:
        self._watches.clear()
        if self._backend is not None:
            self._backend.stop()
            self._backend.join()
            self._backend = None


class _Handler(events.FileSystemEventHandler):
    def __init__(self, queue: EventQueue) -> None:
        self._queue = queue

    def dispatch(self, event: events.FileSystemEvent) -> None:
        """Pass on both paths of an event."""
        for path in (event.src_path, event.dest_path):
            if path:
                self._queue.put_path(os.fsdecode(path))


class _Warnings(logging.Handler):
    """Takes what watchdog warns of: that events were lost is told in no other way, so any warning counts as that."""

    def __init__(self, queue: EventQueue) -> None:
        super().__init__(logging.WARNING)
        self._queue = queue

    def emit(self, record: logging.LogRecord) -> None:  # noqa: ARG002 - as logging calls it
        """Have everything looked at."""
        self._queue.put(EventsLost())


@contextlib.contextmanager
def _threads_as_os_error() -> Iterator[None]:
    """Turn what threading says when there are no more threads into an OSError."""
    try:
        yield
    except RuntimeError as error:
        raise OSError(errno.EAGAIN, str(error)) from None


def _identity(folder: str) -> tuple[int, int] | None:
    try:
        found = os.stat(folder)  # noqa: PTH116
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _not_watched(error: OSError, message: str, place: str) -> Diagnostic:
    hint = _HINTS.get(error.errno or 0, "use --poll")
    message = f"{message}, so it is looked at every now and then: {error.strerror or error}"
    return Diagnostic(Severity.WARNING, "not-watched", message, place, hint=hint)
