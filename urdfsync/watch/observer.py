"""Events of the file system, from watchdog."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import sys
import warnings
from pathlib import Path
from queue import SimpleQueue
from typing import TYPE_CHECKING, NamedTuple

from watchdog import events, observers

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.watch.paths import WatchedFolders

if TYPE_CHECKING:
    from watchdog.observers.api import BaseObserver, ObservedWatch

# no events of opening or reading: the daemon's own reads would wake it
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
_HINTS = {errno.EACCES: "check the permissions of the folder"}
if sys.platform == "linux":
    _HINTS[errno.ENOSPC] = "raise the limit with `sysctl fs.inotify.max_user_watches=524288`"
    _HINTS[errno.EMFILE] = "raise the limit with `sysctl fs.inotify.max_user_instances=512`"


# watchdog warns of lost events, but the next rescan finds all changes
logging.getLogger("watchdog").addHandler(logging.NullHandler())
# watchdog also warns of a folder that was deleted and made again: the new watch replaces the old one
warnings.filterwarnings("ignore", category=RuntimeWarning, module="watchdog")


class FileEvent(NamedTuple):
    """An event about a file or folder."""

    paths: tuple[str, ...]
    is_place: bool
    """Whether a folder or a link may have been replaced."""


class Observer(events.FileSystemEventHandler):
    """Puts a message into a queue for each event in a watched folder, until `close` is called."""

    def __init__(self, queue: SimpleQueue[object]) -> None:
        self._queue = queue
        self._backend: BaseObserver | None = None
        self._watches: dict[tuple[str, bool, int, int], ObservedWatch] = {}
        """Watches by folder, by whether folders below are watched, by device number and by inode."""

    def dispatch(self, event: events.FileSystemEvent) -> None:
        """Put an event into the queue."""
        paths = tuple(os.fsdecode(path) for path in (event.src_path, event.dest_path) if path)
        self._queue.put(FileEvent(paths, event.is_directory or any(map(os.path.islink, paths))))

    def watch_folders(self, folders: WatchedFolders) -> tuple[Diagnostic, ...]:
        """Watch exactly these folders; a folder that was replaced since the last call is watched anew.

        Returns one finding for each reason why folders can't be watched.
        """
        problems: dict[int | None, Diagnostic] = {}
        try:
            if self._backend is None:
                backend = observers.Observer()
                backend.start()
                self._backend = backend
        except (OSError, RuntimeError) as error:  # threading raises RuntimeError if there are no more threads
            return (_not_watched(error, ""),)
        wanted = set()
        for folder, deep in {**dict.fromkeys(folders.singles, False), **dict.fromkeys(folders.trees, True)}.items():
            with contextlib.suppress(OSError):  # gone again
                status = os.stat(folder)  # noqa: PTH116
                wanted.add((folder, deep, status.st_dev, status.st_ino))
        alive = {emitter.watch for emitter in self._backend.emitters if emitter.is_alive()}
        for key, watch in list(self._watches.items()):
            if key not in wanted or watch not in alive:
                self._backend.unschedule(self._watches.pop(key))
        for key in wanted - self._watches.keys():
            folder, deep, *_ = key
            try:
                if not os.access(folder, os.R_OK):  # watchdog does not report missing permissions
                    raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
                self._watches[key] = self._backend.schedule(self, folder, recursive=deep, event_filter=_EVENTS)
            except (OSError, RuntimeError) as error:
                number = getattr(error, "errno", None)
                if number not in (errno.ENOENT, errno.ENOTDIR):  # the folder was deleted; its parent is watched
                    problems.setdefault(number, _not_watched(error, shown(Path(folder))))
        return tuple(problems.values())

    def close(self) -> None:
        """Stop watching."""
        if self._backend is not None:
            self._backend.stop()
            self._backend.join()


def _not_watched(error: Exception, folder: str) -> Diagnostic:
    hint = _HINTS.get(getattr(error, "errno", None) or 0, "use a shorter --rescan")
    reason = getattr(error, "strerror", None) or error
    name = f"the folder {folder}" if folder else "the files"
    message = f"{name} can't be watched, so its files are read every --rescan seconds: {reason}"
    return Diagnostic(Severity.WARNING, "not-watched", message, folder, hint=hint)
