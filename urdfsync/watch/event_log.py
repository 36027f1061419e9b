"""The lines of `urdfsync watch` that scroll: one per build with what changed, errors and conflicts as `build` has them.

Conflicts, warnings, and files that are kept although they are no longer generated are told once, and not again with
the next build.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import Actions, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.files import shown
from urdfsync.output.conflicts import conflict_lines
from urdfsync.output.console import Console, StyledLine, findings, line
from urdfsync.output.phrases import action_counts, change_counts, change_lines, check_result, counted, summary
from urdfsync.output.results import result_lines
from urdfsync.watch import events

if TYPE_CHECKING:
    import rich.console

NAME_WIDTH = 24
"""Columns of the robots' names at most."""
_PLAIN: dict[type[events.Event], str] = {
    events.Settling: "{0.file} changed, settling",
    events.Waiting: "{0.reason}",
    events.Unchanged: "as before",
    events.Building: "building",
    events.Checking: "checking",
    events.Running: "command started",
    events.Ran: "command ended with {0.code}",
    events.Paused: "paused: {0.reason}",
    events.Resumed: "building again",
    events.Stopping: "stopped by {0.signal}",
}
"""Texts of events that are one line."""
_KEPT = frozenset({Reason.ORPHAN, Reason.NEEDED})
"""Files that are no longer generated, but kept."""
_CONFLICTS = frozenset({Reason.CONFLICT, Reason.UNOWNED})
_FEW = 2
"""So many changes of a model are spelled out, in at most so many characters; more are counted."""
_MAX_LENGTH = 100


class LogLine(NamedTuple):
    """One line, and whether it belongs on the error stream."""

    text: StyledLine
    error: bool = False


class EventLog:
    """Events as lines; what was told of a robot is not repeated while it holds."""

    def __init__(self, console: Console, screen: rich.console.Console) -> None:
        """`console` has the options of the command, `screen` the width for conflicts."""
        self._console, self._screen = console, screen
        self._told: dict[tuple[str, str], Collection[Hashable]] = {}
        self._column = 0

    def lines(self, event: events.Event, clock: str) -> Iterator[LogLine]:
        """Yield the lines of an event that happened at this time of day."""
        match event:
            case events.Started(file, robots, again):
                self._column = min(max(map(len, robots), default=0), NAME_WIDTH)
                said = f"watching {counted(len(robots), 'robot')} of {shown(file)}"
                if not self._console.quiet:
                    yield self._line(clock, "", f"{'configuration read again, ' if again else ''}{said}")
            case events.Built():
                yield from self._built(event, clock)
            case events.Failed(result, again):
                if self._console.verbose or not again:
                    yield self._line(clock, result.robot, summary(result), "bold red", error=True)
                    yield from self._findings(result.diagnostics)
            case events.CheckDone():
                yield from self._checked(event, clock)
            case events.Noted(diagnostics):
                yield from self._findings(diagnostics, clock)
            case _ if self._console.verbose or (isinstance(event, events.Stopping) and not self._console.quiet):
                style = "" if isinstance(event, events.Stopping) else "dim"
                yield self._line(clock, getattr(event, "robot", ""), _PLAIN[type(event)].format(event).strip(), style)
                yield from self._findings(getattr(event, "diagnostics", ()))
            case _:
                pass

    def _built(self, event: events.Built, clock: str) -> Iterator[LogLine]:
        """Yield the line of a build that did or found anything, below its new findings and above its new conflicts."""
        result, robot, verbose = event.result, event.result.robot, self._console.verbose
        before = self._told.get((robot, "findings"), ())
        keys = self._told[robot, "findings"] = [(one.code, one.message, one.file) for one in result.diagnostics]
        new = [one for one, key in zip(result.diagnostics, keys, strict=True) if verbose or key not in before]
        errors = [one for one in result.diagnostics if one.severity is Severity.ERROR]
        yield from self._findings([one for one in new if verbose or one not in errors])
        was_broken = bool(self._told.get((robot, "broken")))
        if self._is_new(robot, "broken", {(one.code, one.message, one.file) for one in errors}):
            place = f"{errors[0].file}:{errors[0].line}" if errors[0].line else errors[0].file
            more = f", and {len(errors) - 1} more" if len(errors) > 1 else ""
            yield self._line(clock, robot, f"broken: {place}: {errors[0].message}{more}", "bold red", error=True)
        had_conflicts = bool(self._told.get((robot, "conflicts")))
        conflicts = self._is_new(robot, "conflicts", {(one.path, one.mine, one.generated) for one in result.conflicts})
        kept = self._is_new(robot, "kept", {one.path for one in result.actions.decided if one.reason in _KEPT})
        if self._console.quiet and not conflicts:
            return
        said = []
        if event.files or event.recovered or result.effective_changes or conflicts or kept:
            said = [*_changes(result), *action_counts(result, {Reason.KEEP} | (frozenset() if kept else _KEPT))]
        if not (result.conflicts or result.is_broken) and (event.recovered or had_conflicts or was_broken):
            said.append("in step again")
        if not said and (verbose or result.effective_changes):
            said = [summary(result)]
        if not said:
            return
        yield self._line(clock, robot, ", ".join(said), "yellow" if result.conflicts else "")
        if not self._console.quiet:
            hidden = frozenset() if verbose else _CONFLICTS | (frozenset() if kept else _KEPT)
            actions = Actions(one for one in result.actions if one.reason not in hidden)
            seen = msgspec.structs.replace(result, actions=actions, changes=result.changes if verbose else None)
            yield from map(LogLine, result_lines(seen, verbose=verbose))
        if conflicts or (verbose and result.conflicts):
            yield from map(LogLine, conflict_lines(result, self._console, self._screen))

    def _checked(self, event: events.CheckDone, clock: str) -> Iterator[LogLine]:
        """Yield the line of a check, and its findings unless they are those of the last one."""
        wrong = event.checked is Checked.WRONG
        keys = frozenset((one.code, one.message, one.file) for one in event.diagnostics)
        is_new = self._is_new(event.robot, "check", keys)
        if wrong or not self._console.quiet:
            took = f" ({event.seconds:.1f} s)" if event.seconds else ""
            said = f"{check_result(event.checked, event.diagnostics)}{took}"
            yield self._line(clock, event.robot, said, "bold red" if wrong else "", error=wrong)
        yield from self._findings(event.diagnostics if is_new or self._console.verbose else ())

    def _is_new(self, robot: str, topic: str, found: Collection[Hashable]) -> bool:
        """Return whether anything was found, and not the same in the robot's last build; remember it."""
        before = self._told.get((robot, topic))
        self._told[robot, topic] = found
        return bool(found) and found != before

    def _findings(self, diagnostics: Sequence[Diagnostic], clock: str = "") -> Iterator[LogLine]:
        """Yield findings as all commands show them; with a time of day if there is no line of a build above them."""
        for found in findings(diagnostics, quiet=self._console.quiet, verbose=self._console.verbose):
            yield LogLine(StyledLine(((f"{clock}  " if clock else "", "dim"), *found.parts)), error=True)

    def _line(self, clock: str, robot: str, said: str, style: str = "", *, error: bool = False) -> LogLine:
        name = f"{robot:<{self._column}}  " if robot else ""
        return LogLine(line((f"{clock}  ", "dim"), (name, "bold"), (said, style)), error)


def _changes(result: Result) -> list[str]:
    """Return what changed in the model: a few changes in words, else how many."""
    if result.effective_changes is None:
        return []
    changes, lines = result.effective_changes, change_lines(result.effective_changes)
    words = "; ".join(lines[-_FEW:])
    if changes.generator:
        return lines[:1]
    return [words if len(lines) <= _FEW + 1 and len(words) <= _MAX_LENGTH else change_counts(changes)]
