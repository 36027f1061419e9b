"""What happens while `urdfsync watch` runs, as values: how they look is for the listener to decide.

Events of one robot come in this order: `Settling` when one of its files changed, `Waiting` if what is there is no
model (yet), `Building` when it has settled, and `Built` or `Failed`; or `Calm` if it turned out that nothing changed.
Checks go on beside that: `Checking`, and `Checked` for the last one of several that begin while a robot changes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Protocol, TypeAlias

import msgspec

from urdfsync import outcome
from urdfsync.diagnostics import Diagnostic
from urdfsync.outcome import Result


class Started(msgspec.Struct, frozen=True):
    """The configuration was read, for the first time or again, and these robots are watched from now on."""

    config: Path
    robots: tuple[str, ...]
    again: bool = False
    """Whether it was read before: then it has changed, or works again."""


class Settling(msgspec.Struct, frozen=True):
    """A file of the robot changed; it is left alone until nothing happens any more."""

    robot: str


class Calm(msgspec.Struct, frozen=True):
    """The files of the robot are what they were before `Settling`: nothing to build."""

    robot: str


class Waiting(msgspec.Struct, frozen=True):
    """The robot is not built for now, although its files keep still.

    Either its source is no model, which an exporter may be about to change: then `diagnostics` say what is
    wrong with it, and `Failed` follows if that lasts. Or it lost so much that it is looked at a little longer:
    then `diagnostics` are empty.
    """

    robot: str
    reason: str
    """In words that follow the robot's name, for example `waiting for the exporter`."""
    diagnostics: tuple[Diagnostic, ...] = ()


class Building(msgspec.Struct, frozen=True):
    """The build of the robot begins."""

    robot: str


class Built(msgspec.Struct, frozen=True):
    """The robot was built, perhaps with conflicts, perhaps with nothing to write."""

    result: Result
    files: tuple[Path, ...] = ()
    """The files that were written or deleted, absolute; empty if there was nothing to do."""
    recovered: bool = False
    """Whether the robot's last build failed."""


class Failed(msgspec.Struct, frozen=True):
    """The robot can't be built. It is tried again every now and then, and `Built` follows when that works."""

    result: Result
    again: bool = False
    """Whether the same was said before, and only a change that did not help came in between."""


class Checking(msgspec.Struct, frozen=True):
    """The check of the robot's package begins; one that was begun before is given up."""

    robot: str


class Checked(msgspec.Struct, frozen=True):
    """The robot's package was checked as the last build left it."""

    robot: str
    checked: outcome.Checked
    seconds: float = 0.0
    """How long that took; 0 if it was known from an earlier check."""
    diagnostics: tuple[Diagnostic, ...] = ()
    """What is wrong with it, and what could not be checked."""


class Noted(msgspec.Struct, frozen=True):
    """Something that concerns no robot in particular; said once, until it is over and happens again.

    A configuration that can't be used (the last good one stays in force), files that can't be watched (they are
    looked at every now and then), a command of `--exec` that failed.
    """

    diagnostics: tuple[Diagnostic, ...]


class Recovered(msgspec.Struct, frozen=True):
    """What `Noted` said of the daemon itself is over: files are watched again."""

    what: str
    """In words, for example `all folders are watched again`."""


class Paused(msgspec.Struct, frozen=True):
    """Nothing is built for now, for example because pre-commit has stashed changes away."""

    reason: str


class Resumed(msgspec.Struct, frozen=True):
    """Robots are built again."""


class Ran(msgspec.Struct, frozen=True):
    """The command of `--exec` has ended after a build of the robot; if it failed, `Noted` says so as well."""

    robot: str
    code: int
    """Its exit code; negative if a signal ended it."""


class Stopping(msgspec.Struct, frozen=True):
    """The daemon was told to end; the last event."""

    signal: str
    """Name of the signal, for example `SIGINT`."""


Event: TypeAlias = (
    Started
    | Settling
    | Calm
    | Waiting
    | Building
    | Built
    | Failed
    | Checking
    | Checked
    | Noted
    | Recovered
    | Paused
    | Resumed
    | Ran
    | Stopping
)


class Listener(Protocol):
    """Shows events to people or programs. Called from one thread only, never while another call runs."""

    def __call__(self, event: Event) -> None:
        """Take note of an event at once; what takes long holds up the daemon."""
        ...

    def progress(self, what: str, done: int, total: int) -> None:
        """A step of the build under way, see `situation.Progress`; may be called often."""
        ...
