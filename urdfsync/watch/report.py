"""What `urdfsync watch` shows: to people lines above the status of each robot, to programs a line of JSON per event."""

from __future__ import annotations

import datetime
import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol, Self

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.actions import Kind
from urdfsync.outcome import Result
from urdfsync.output.console import JSON_VERSION, has_marks, text
from urdfsync.output.json_values import finding_values, result_values
from urdfsync.watch import events
from urdfsync.watch.event_log import NAME_WIDTH, EventLog
from urdfsync.watch.status import Activity, StatusTable
from urdfsync.watch.status_area import StatusArea
from urdfsync.watch.stderr_capture import StderrCapture

if TYPE_CHECKING:
    from rich.text import Text

_PATIENCE = 0.5
"""Seconds of a build before its progress is shown."""
_PACE = 0.2
"""Seconds between two lines of progress."""
_STYLES = {
    Activity.ERROR: ("✗", "bold red"),
    Activity.CONFLICT: ("!", "yellow"),
    Activity.WAITING: ("…", "yellow"),
    Activity.BUILDING: ("…", "cyan"),
    Activity.CHECKING: ("…", "cyan"),
    Activity.SETTLING: ("…", "cyan"),
    Activity.STARTING: ("…", "dim"),
    Activity.IN_STEP: ("✓", "green"),
}
_SPACED = 4
"""Rows of the status from which an empty one stands above it."""


class WatchReport(events.Listener, Protocol):
    """A listener that uses the streams from `with` to its end, and leaves the terminal in order."""

    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...


def watch_report(*, as_json: bool = False, quiet: bool = False, verbose: bool = False, config: str = "") -> WatchReport:
    """Return the report that the options ask for; `config` is the configuration as the user named it."""
    return JsonReport() if as_json else TextReport(quiet=quiet, verbose=verbose, config=config)


def now() -> datetime.datetime:
    """Return the time, with the local offset."""
    return datetime.datetime.now().astimezone()


def event_values(event: events.Event, time: datetime.datetime) -> dict[str, Any]:
    """Return an event as JSON values: its fields under their names, a result as `result_values` has it.

    Of a result's files those are left out that are just unchanged, and its check is an event of its own.
    """
    tag = event.__struct_config__.tag
    values: dict[str, Any] = {"version": JSON_VERSION, "event": tag, "time": time.isoformat()}
    for name, value in msgspec.structs.asdict(event).items():
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


class JsonReport:
    """One JSON object per line, passed on at once."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Do nothing: each line was complete."""

    def show(self, event: events.Event) -> None:
        """Print an event."""
        sys.stdout.write(json.dumps(event_values(event, now())) + "\n")
        sys.stdout.flush()

    def progress(self, what: str, done: int, total: int) -> None:
        """Do nothing: begin and end of a build are enough."""


class TextReport:
    """Lines that scroll and, on a terminal, the status of each robot below them."""

    def __init__(self, *, quiet: bool = False, verbose: bool = False, config: str = "") -> None:
        self._table = StatusTable()
        self._out = StatusArea(sys.stdout, status=not quiet)
        has_both = self._out.has_status and sys.stderr.isatty()
        self._errors = self._out if has_both else StatusArea(sys.stderr, status=False)
        self._log = EventLog(self._out.console, quiet=quiet, verbose=verbose, config=config)
        self._capture = StderrCapture(self._out)
        self._build_began = self._progress_shown = 0.0

    def __enter__(self) -> Self:
        self._out.start()
        if self._out.has_status:
            self._capture.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Take the status away; what scrolled stays."""
        self._capture.close()
        self._out.close()

    def show(self, event: events.Event) -> None:
        """Show an event."""
        clock = now().strftime("%H:%M:%S")
        if isinstance(event, events.Building):
            self._build_began = time.monotonic()
        self._table.take(event, clock)
        lines = list(self._log.lines(event, clock))
        if self._errors is not self._out:
            self._errors.write([line.text for line in lines if line.error])
            lines = [line for line in lines if not line.error]
        is_last = isinstance(event, events.Stopping)
        self._out.write([line.text for line in lines], () if is_last else self._status_lines())

    def progress(self, what: str, done: int, total: int) -> None:
        """Show how far a build is that takes some time."""
        moment = time.monotonic()
        if self._out.has_status and moment - self._build_began >= _PATIENCE and moment - self._progress_shown >= _PACE:
            self._progress_shown = moment
            self._table.progress(what, done, total)
            self._out.write((), self._status_lines())

    def _status_lines(self) -> Sequence[Text]:
        """Return a line for each robot for which there is room, and one for all others."""
        if not self._out.has_status or not self._table.rows:
            return ()
        room, marks = self._out.room, has_marks(sys.stdout)
        lines = [text(("", ""))] if room >= _SPACED else []
        if self._table.pause_reason:
            lines.append(text((f"paused: {self._table.pause_reason}", "yellow")))
        shown, rest = self._table.visible(room - len(lines))
        width = min(max((len(status.robot) for status in shown), default=0), NAME_WIDTH)
        for status in shown:
            mark, style = _STYLES[status.activity]
            name = text((status.robot, "bold"))
            name.truncate(width, overflow="ellipsis", pad=True)
            said = text((f"  {status.text}", "" if status.activity is Activity.IN_STEP else style))
            lines.append(text((f"{mark} " if marks else "", style)).append_text(name).append_text(said))
        return [*lines, text((rest, "dim"))] if rest else lines
