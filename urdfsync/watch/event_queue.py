"""Where everything arrives that the daemon reacts to, from any thread or signal handler."""

from __future__ import annotations

import queue
from collections.abc import Iterator
from typing import TypeAlias

import msgspec

from urdfsync.check.afterbuild import BuildCheck
from urdfsync.config import RobotConfig
from urdfsync.watch.paths import WatchedPaths


class EventsLost(msgspec.Struct, frozen=True):
    """The system dropped events, so everything has to be looked at."""


class CommandEnded(msgspec.Struct, frozen=True):
    """A command of `--exec` has ended with this exit code, or with minus the number of a signal."""

    robot: str
    code: int


class CheckJob(msgspec.Struct, eq=False):
    """One check of a package."""

    robot: RobotConfig
    key: str | None
    """Of all that the check rests on; None if some of it can't be read."""
    is_cancelled: bool = False


class CheckEnded(msgspec.Struct, frozen=True):
    """A check has ended; without findings if it was cancelled."""

    job: CheckJob
    found: BuildCheck | None


class Stop(msgspec.Struct, frozen=True):
    """The daemon is told to end."""


Message: TypeAlias = str | EventsLost | CommandEnded | CheckEnded | Stop
"""A path that may have changed, or one of the above."""


class EventQueue:
    """Messages to the daemon; paths that matter to no robot do not get in."""

    def __init__(self) -> None:
        self._queue: queue.SimpleQueue[Message] = queue.SimpleQueue()
        self.watched = WatchedPaths()

    def put_path(self, path: str) -> None:
        """Say that a path may have changed."""
        if self.watched.robots_for(path):
            self._queue.put(path)

    def put(self, message: Message) -> None:
        """Add a message; safe in a signal handler."""
        self._queue.put(message)

    def wait(self, timeout: float) -> Iterator[Message]:
        """Wait for a message, at most so many seconds, and yield all that have come."""
        try:
            yield self._queue.get(timeout=max(timeout, 0))
            while True:
                yield self._queue.get_nowait()
        except queue.Empty:
            return
