"""The events of `urdfsync watch` as values; `--format json` writes them with the tag as the event's name.

Events of one robot come in this order: `Settling` when one of its files changed, `Building` when it has settled,
`Waiting` if its source is invalid, then `Built` or `Failed`. If its files have their former content, only `Unchanged`
follows `Settling`.
Checks have their own events: `Checking`, and `CheckDone` for the last of several checks.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.engine.result import Checked, Result


class Event(msgspec.Struct, frozen=True, tag=str.lower):
    """One event."""


class RobotEvent(Event, frozen=True):
    """One event of one robot."""

    robot: str


class Started(Event, frozen=True):
    """The configuration was read, and these robots are watched from now on."""

    config: Path
    robots: tuple[str, ...]
    again: bool = False
    """Whether the daemon read the configuration before: it has changed, or is valid again."""


class Viewing(Event, frozen=True):
    """The daemon serves pages of the robots at this address. This is the first event."""

    address: str


class Settling(RobotEvent, frozen=True):
    """A file of the robot changed; the robot is built once its files have settled."""

    file: str = ""
    """A changed file, for people; empty if unknown."""


class Unchanged(RobotEvent, frozen=True, tag="calm"):
    """The files of the robot are the same as before `Settling`: nothing to build."""


class Waiting(RobotEvent, frozen=True):
    """The build of the robot waits.

    Another process builds, or an exporter may be writing the invalid source (see `diagnostics`). If the source stays
    invalid, `Failed` follows.
    """

    reason: str
    """In words that follow the robot's name, for example `waiting for the exporter of arm.urdf`."""
    diagnostics: tuple[Diagnostic, ...] = ()


class Building(RobotEvent, frozen=True):
    """The build of the robot begins."""


class Built(Event, frozen=True):
    """The robot was built, perhaps with conflicts, perhaps with nothing to write."""

    result: Result
    files: tuple[Path, ...] = ()
    """Files that were written or deleted, absolute."""
    recovered: bool = False
    """Whether the robot's last build failed."""


class Failed(Event, frozen=True):
    """The robot can't be built. The daemon tries again at each rescan, and `Built` follows a success."""

    result: Result
    again: bool = False
    """Whether the last build failed for the same reason, although a file changed since."""


class Checking(RobotEvent, frozen=True):
    """The check of the robot's package begins; an unfinished earlier check is cancelled."""


class CheckDone(RobotEvent, frozen=True, tag="checked"):
    """The check of the robot's package has ended."""

    checked: Checked
    seconds: float = 0.0
    """Duration of the check; 0 for a remembered result."""
    diagnostics: tuple[Diagnostic, ...] = ()
    """Faults of the package, and reasons why it could not be checked."""


class Noted(Event, frozen=True):
    """Findings that concern no robot. Each finding is reported once, and again if it ends and comes back."""

    diagnostics: tuple[Diagnostic, ...]


class Running(RobotEvent, frozen=True):
    """The command of `--exec` begins after a build of the robot."""


class Ran(RobotEvent, frozen=True):
    """The command of `--exec` has ended after a build of the robot; if it failed, `Noted` follows."""

    code: int
    """The command's exit code; negative if a signal ended the command."""


class Stopping(Event, frozen=True):
    """The daemon was told to end. This is the last event."""

    signal: str
    """Name of the signal, for example `SIGINT`."""


Listener: TypeAlias = Callable[[Event], None]
"""Shows an event to people or programs; the daemon waits meanwhile. Called from one thread only."""
