"""What `urdfsync watch` shows: to people lines above a status line per robot, to programs a line of JSON per event."""

from __future__ import annotations

import datetime
import json
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol, Self

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.actions import Kind
from urdfsync.outcome import Result
from urdfsync.output.console import JSON_VERSION, has_marks, text
from urdfsync.output.json_values import finding_values, result_values
from urdfsync.views.area import Area
from urdfsync.views.chronicle import NAME, Chronicle
from urdfsync.views.diversion import Diversion
from urdfsync.watching import events
from urdfsync.watching.standing import Board, Mood

if TYPE_CHECKING:
    from rich.text import Text

Clock = Callable[[], datetime.datetime]

_PATIENCE = 0.5
"""Seconds of a build before its progress is shown."""
_PACE = 0.2
"""Seconds between two looks at progress."""
_MOODS = {
    Mood.ERROR: ("✗", "bold red"),
    Mood.CONFLICT: ("!", "yellow"),
    Mood.WAITING: ("…", "yellow"),
    Mood.BUILDING: ("…", "cyan"),
    Mood.CHECKING: ("…", "cyan"),
    Mood.SETTLING: ("…", "cyan"),
    Mood.STARTING: ("…", "dim"),
    Mood.IN_STEP: ("✓", "green"),
}
_AIRY = 4
"""Rows of the status from which an empty one sets it off."""


class Watching(events.Listener, Protocol):
    """A listener that has the streams from `with` to its end."""

    def __enter__(self) -> Self:
        """Begin to show what happens."""
        ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave the terminal in order, whatever happened."""
        ...


def event_values(found: events.Event, time: datetime.datetime) -> dict[str, Any]:
    """An event of the daemon as plain data: its values under their own names, a result as `result_values` has it.

    Of a result's files those that are just unchanged are left out; what a check said is an event of its own.
    """
    values: dict[str, Any] = {"version": JSON_VERSION, "event": type(found).__name__.lower(), "time": time.isoformat()}
    for name, value in msgspec.structs.asdict(found).items():
        if isinstance(value, Result):
            inside = {key: part for key, part in result_values(value).items() if key != "checked"}
            actions = [action for action in inside["actions"] if action["action"] != Kind.UNCHANGED]
            values |= {"robot": inside.pop("name"), **inside, "actions": actions}
        else:
            values[name] = _plain(value)
    return values


def _plain(value: object) -> Any:
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    if isinstance(value, Diagnostic):
        return finding_values(value)
    return str(value) if isinstance(value, Path) else value


def now() -> datetime.datetime:
    """The time, with the local offset."""
    return datetime.datetime.now().astimezone()


def watching(*, as_json: bool = False, quiet: bool = False, verbose: bool = False, config: str = "") -> Watching:
    """What shows events in the way that the options ask for; `config` is the configuration as the user named it."""
    return ForPrograms() if as_json else ForPeople(quiet=quiet, verbose=verbose, config=config)


class ForPrograms:
    """One JSON object per line, passed on at once."""

    def __init__(self, clock: Clock = now) -> None:
        self._clock = clock

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Nothing: each line was complete."""

    def __call__(self, event: events.Event) -> None:
        """Print an event."""
        sys.stdout.write(json.dumps(event_values(event, self._clock())) + "\n")
        sys.stdout.flush()

    def progress(self, what: str, done: int, total: int) -> None:
        """Nothing: that a build begins and ends is enough."""


class ForPeople:
    """Lines that scroll and, on a terminal, the status of each robot below them."""

    def __init__(self, *, quiet: bool = False, verbose: bool = False, config: str = "", clock: Clock = now) -> None:
        self._clock = clock
        self._board = Board()
        self._out = Area(sys.stdout, status=not quiet)
        self._errors = self._out if self._out.has_status and sys.stderr.isatty() else Area(sys.stderr, status=False)
        self._chronicle = Chronicle(self._out.console, quiet=quiet, verbose=verbose, config=config)
        self._diversion = Diversion(self._overhear)
        self._begin = self._shown = 0.0

    def __enter__(self) -> Self:
        self._out.start()
        if self._out.has_status:
            self._diversion.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Take the status away; what scrolled stays."""
        self._diversion.close()
        self._out.close()

    def __call__(self, event: events.Event) -> None:
        """Show an event."""
        clock = self._clock().strftime("%H:%M:%S")
        if isinstance(event, events.Building):
            self._begin = time.monotonic()
        self._board.take(event, clock)
        lines = list(self._chronicle.lines(event, clock))
        if self._errors is not self._out:
            self._errors.write([line.text for line in lines if line.error])
            lines = [line for line in lines if not line.error]
        last = isinstance(event, events.Stopping)
        self._out.write([line.text for line in lines], () if last else self._status())

    def progress(self, what: str, done: int, total: int) -> None:
        """Show how far a build is that takes some time."""
        moment = time.monotonic()
        if self._out.has_status and moment - self._begin >= _PATIENCE and moment - self._shown >= _PACE:
            self._shown = moment
            self._board.step(what, done, total)
            self._out.write((), self._status())

    def _overhear(self, lines: Sequence[str]) -> None:
        """Show what the command of `--exec` prints; colours are all that it may do with the terminal."""
        from rich.text import Text

        self._out.write([Text.from_ansi(line) for line in lines])

    def _status(self) -> Sequence[Text]:
        return status(self._board, self._out.room, marks=has_marks(sys.stdout)) if self._out.has_status else ()


def status(board: Board, room: int, *, marks: bool) -> Sequence[Text]:
    """A line for each robot for which there is room, and one for all others; `marks` says whether ✓ can be shown."""
    if not board.standings:
        return ()
    lines = [text(("", ""))] if room >= _AIRY else []
    if board.paused:
        lines.append(text((f"paused: {board.paused}", "yellow")))
    standings, rest = board.shown(room - len(lines))
    column = min(max((len(standing.robot) for standing in standings), default=0), NAME)
    for standing in standings:
        mark, style = _MOODS[standing.mood]
        name = text((standing.robot, "bold"))
        name.truncate(column, overflow="ellipsis", pad=True)
        line = text((f"{mark} " if marks else "", style)).append_text(name)
        lines.append(line.append_text(text((f"  {standing.words}", "" if standing.mood is Mood.IN_STEP else style))))
    return [*lines, text((rest, "dim"))] if rest else lines
