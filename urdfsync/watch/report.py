"""What `urdfsync watch` shows: to people lines above the status of each robot, to programs a line of JSON per event."""

from __future__ import annotations

import datetime
import json
import sys
from typing import Any, Self

import msgspec

from urdfsync.engine.actions import Reason
from urdfsync.engine.result import Result
from urdfsync.output.console import JSON_VERSION, Console, has_marks, rich_console, write_lines
from urdfsync.output.results import result_values
from urdfsync.watch import events
from urdfsync.watch.event_log import EventLog
from urdfsync.watch.status import StatusTable
from urdfsync.watch.terminal import StatusArea


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
            actions = [action for action in inside["actions"] if action["action"] != Reason.UNCHANGED]
            values |= {"robot": inside.pop("name"), **inside, "actions": actions}
        else:
            values[name] = msgspec.to_builtins(value, enc_hook=str)
    return values


def show_json(event: events.Event) -> None:
    """Print an event as one line of JSON, which is passed on at once."""
    sys.stdout.write(json.dumps(event_values(event, now())) + "\n")
    sys.stdout.flush()


class TextReport:
    """Lines that scroll and, on a terminal, the status of each robot below them."""

    def __init__(self, console: Console) -> None:
        self._table = StatusTable()
        screen = rich_console(sys.stdout)
        self._log = EventLog(console, screen)
        has_status = not console.quiet and sys.stdout.isatty() and not screen.is_dumb_terminal
        self._area = StatusArea(sys.stdout) if has_status else None
        self._commands: set[str] = set()
        """Robots for which a command of `--exec` runs."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Take the status away; what scrolled stays."""
        if self._area:
            self._area.write((), ())

    def show(self, event: events.Event) -> None:
        """Show an event."""
        clock = now().strftime("%H:%M:%S")
        self._table.take(event, clock)
        match event:
            case events.Running(robot):
                self._commands.add(robot)
            case events.Ran(robot):
                self._commands.discard(robot)
        lines = list(self._log.lines(event, clock))
        # one terminal has both streams in their order, above the status; elsewhere each stream gets its own
        if self._area is None or not sys.stderr.isatty():
            write_lines([line.text for line in lines if line.error], sys.stderr)
            lines = [line for line in lines if not line.error]
        if self._area is None:
            write_lines([line.text for line in lines], sys.stdout)
        else:
            # a command knows nothing of the status, and would write into it
            is_shown = not (self._commands or isinstance(event, events.Stopping))
            rows = self._table.lines(self._area.room, marks=has_marks(sys.stdout)) if is_shown else ()
            self._area.write([line.text.__rich__() for line in lines], [row.__rich__() for row in rows])
