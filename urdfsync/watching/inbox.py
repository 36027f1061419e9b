"""Where everything arrives that the daemon reacts to, from whatever thread or signal handler."""

from __future__ import annotations

import queue
from collections.abc import Callable, Iterator
from typing import TypeAlias

import msgspec

from urdfsync.check.afterbuild import BuildCheck
from urdfsync.watching.checks import Errand


class Lost(msgspec.Struct, frozen=True):
    """Events were lost, so everything has to be looked at."""


class Ended(msgspec.Struct, frozen=True):
    """A command of `--exec` has ended."""

    robot: str
    code: int


class Examined(msgspec.Struct, frozen=True):
    """A check has ended."""

    errand: Errand
    found: BuildCheck | None
    """None if it was given up."""


class Stop(msgspec.Struct, frozen=True):
    """The daemon is told to end, by this signal."""

    signal: str


Message: TypeAlias = str | Lost | Ended | Examined | Stop
"""A path that may have changed, or one of the above."""


class Inbox:
    """A queue of messages; paths that matter to nobody do not get in."""

    def __init__(self) -> None:
        self._queue: queue.SimpleQueue[Message] = queue.SimpleQueue()
        self.matters: Callable[[str], object] = lambda path: False  # noqa: ARG005 - nothing is watched yet

    def notice(self, path: str) -> None:
        """A path may have changed."""
        if self.matters(path):
            self._queue.put(path)

    def put(self, message: Message) -> None:
        """Take a message; safe in a signal handler."""
        self._queue.put(message)

    def wait(self, timeout: float) -> Iterator[Message]:
        """Wait for a message, at most so many seconds; then all that are there."""
        try:
            yield self._queue.get(timeout=max(timeout, 0))
            while True:
                yield self._queue.get_nowait()
        except queue.Empty:
            return
