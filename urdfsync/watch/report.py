"""The output of `urdfsync watch`: lines for people, a line of JSON per event for programs.

Each build has a line, with changes, errors and conflicts as `build` shows them. The next build of a robot
does not repeat the conflicts, warnings and orphans of its last build.
"""

from __future__ import annotations

import datetime
import json
import sys
from collections.abc import Hashable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import counted
from urdfsync.engine.actions import CONFLICTS, ORPHANS, Actions, Reason
from urdfsync.engine.result import Checked, Result, check_result
from urdfsync.output.build_section import build_section
from urdfsync.output.conflicts import conflict_lines
from urdfsync.output.console import Console, StyledLine, findings, line, write_lines
from urdfsync.output.documents import JSON_VERSION, plain
from urdfsync.output.outline import outline
from urdfsync.output.phrases import change_counts, generator_change
from urdfsync.output.repeated import findings_told, note, untold
from urdfsync.output.terminal import details
from urdfsync.watch import events

_NAME_WIDTH = 24
"""The greatest number of columns of the robots' names."""
_FEW = 2
"""Limits of a model's changes in words: their number, and the characters of the text. Further changes are counted."""
_MAX_LENGTH = 100


_STEPS: dict[type[events.Event], str] = {
    events.Settling: "settling: {0.file}",
    events.Building: "building",
    events.Waiting: "{0.reason}",
    events.Unchanged: "as before",
    events.Checking: "checking",
    events.Running: "command started",
    events.Ran: "command ended with {0.code}",
    events.Stopping: "stopped by {0.signal}",
}
"""Events with one line; without `--verbose`, only `Waiting` and `Stopping` are shown."""


class LogLine(NamedTuple):
    """One line, and whether this line belongs on the error stream."""

    text: StyledLine
    error: bool = False


def now() -> datetime.datetime:
    """Return the time, with the local offset."""
    return datetime.datetime.now().astimezone()


def event_values(event: events.Event, time: datetime.datetime) -> dict[str, Any]:
    """Return an event as JSON values, without unchanged files of a result."""
    head = {"version": JSON_VERSION, "event": event.__struct_config__.tag, "time": time.isoformat()}
    values: dict[str, Any] = head | plain(event)
    if isinstance(event, events.Built | events.Failed):
        actions = values["result"]["actions"]
        values["result"]["actions"] = [
            one for one in actions if one["reason"] not in (Reason.UNCHANGED, Reason.UNKNOWN)
        ]
    return values


def show_json(event: events.Event) -> None:
    """Print an event as one line of JSON, without buffering."""
    sys.stdout.write(json.dumps(event_values(event, now())) + "\n")
    sys.stdout.flush()


class Report:
    """Lines that scroll: what builds and checks have done and found."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._column = 0
        self._told: dict[tuple[str, str], set[Hashable]] = {}
        """The shown findings of a robot's last build, by robot and topic."""

    def show(self, event: events.Event) -> None:
        """Show an event."""
        for text, error in self.take(event, now().strftime("%H:%M:%S")):
            write_lines([text], sys.stderr if error else sys.stdout)

    def take(self, event: events.Event, clock: str) -> Iterator[LogLine]:
        """Note what an event shows; yield the lines about it, at this time of day."""
        match event:
            case events.Started(file, robots, again):
                self._column = min(max(map(len, robots), default=0), _NAME_WIDTH)
                if not self._console.quiet:
                    words = f"watching {counted(len(robots), 'robot')} of {shown(file)}"
                    yield self._line(clock, "", f"configuration read again, {words}" if again else words)
            case events.Viewing(address):
                if not self._console.quiet:
                    yield self._line(clock, "", f"pages at {address}")
            case events.Built():
                yield from self._built(event, clock)
            case events.Failed(result, again):
                if self._console.verbose or not again:
                    yield self._line(clock, result.robot, result.summary, "bold red", error=True)
                    yield from self._findings(result.diagnostics)
            case events.CheckDone():
                yield from self._checked(event, clock)
            case events.Noted(diagnostics):
                yield from self._findings(diagnostics, clock)
            case _:
                yield from self._step(event, clock)

    def _step(self, event: events.Event, clock: str) -> Iterator[LogLine]:
        """Yield the line of an event between two results."""
        robot, quiet, verbose = getattr(event, "robot", ""), self._console.quiet, self._console.verbose
        is_shown = isinstance(event, events.Stopping)
        if isinstance(event, events.Waiting):  # robots that wait for one process have one line
            is_shown = not any({event.reason} == told for (_, topic), told in self._told.items() if topic == "waiting")
            self._told[robot, "waiting"] = {event.reason} if is_shown else set()
        if verbose or (is_shown and not quiet):
            words = _STEPS[type(event)].format(event).removesuffix(": ")
            yield self._line(clock, robot, words, "" if is_shown else "dim")
        if verbose:
            yield from self._findings(getattr(event, "diagnostics", ()))

    def _built(self, event: events.Built, clock: str) -> Iterator[LogLine]:
        """Yield the new findings of a build, a line if it wrote or found anything, and the new conflicts."""
        result, robot, verbose = event.result, event.result.robot, self._console.verbose
        was_in_step = not any(self._told.get((robot, topic)) for topic in ("broken", "conflicts", "waiting"))
        self._told.pop((robot, "waiting"), None)
        errors = [finding for finding in result.diagnostics if finding.severity is Severity.ERROR]
        new = self._new(robot, "findings", map(_key, result.diagnostics))
        new_errors = self._new(robot, "broken", map(_key, errors))
        conflicts = self._new(robot, "conflicts", ((each.action.path, each.action.sides) for each in result.conflicts))
        orphans = self._new(robot, "kept", (each.path for each in result.actions.decided if each.reason in ORPHANS))
        shown = [
            finding for finding in result.diagnostics if verbose or (_key(finding) in new and finding not in errors)
        ]
        before = findings_told(result)
        yield from self._findings(untold(before, shown, verbose=verbose))
        if not self._console.quiet:
            note(result, before, result.diagnostics)
        if new_errors:
            more = f", and {len(errors) - 1} more" if len(errors) > 1 else ""
            yield self._line(clock, robot, f"{_with_error('broken', errors)}{more}", "bold red", error=True)
        if self._console.quiet and not conflicts:
            return
        settled = frozenset() if orphans else ORPHANS
        words = []
        if event.files or event.recovered or result.effective_changes or conflicts or orphans:
            words = [*_changes(result), *result.counts({Reason.KEEP} | settled)]
        if not (result.conflicts or result.is_broken or result.is_unmerged) and (event.recovered or not was_in_step):
            words.append("in step again")
        if not words and (verbose or result.effective_changes):
            words = [result.summary]
        if not words:
            return
        yield self._line(clock, robot, ", ".join(words), "yellow" if result.conflicts else "")
        if not self._console.quiet:
            hidden = frozenset() if verbose else CONFLICTS | settled
            actions = Actions(action for action in result.actions if action.reason not in hidden)
            seen = msgspec.structs.replace(result, actions=actions, changes=result.changes if verbose else None)
            yield from map(LogLine, details(build_section(seen, verbose=verbose), verbose=verbose))
        if conflicts or (verbose and result.conflicts):
            yield from map(LogLine, conflict_lines(result, self._console))

    def _checked(self, event: events.CheckDone, clock: str) -> Iterator[LogLine]:
        """Yield the line of a check, and its findings unless they equal the last ones."""
        is_wrong = event.checked is Checked.WRONG
        new = self._new(event.robot, "check", map(_key, event.diagnostics))
        if is_wrong or not self._console.quiet:
            duration = f" ({event.seconds:.1f} s)" if event.seconds else ""
            words = f"{check_result(event.checked, event.diagnostics)}{duration}"
            yield self._line(clock, event.robot, words, "bold red" if is_wrong else "", error=is_wrong)
        yield from self._findings(event.diagnostics if new or self._console.verbose else ())

    def _new(self, robot: str, topic: str, keys: Iterable[Hashable]) -> set[Hashable]:
        """Return the findings that the robot's last build did not show, and remember the present ones."""
        before = self._told.get((robot, topic), set())
        self._told[robot, topic] = set(keys)
        return self._told[robot, topic] - before

    def _findings(self, diagnostics: Sequence[Diagnostic], clock: str = "") -> Iterator[LogLine]:
        """Yield findings as all commands show them, with the time if they do not follow a line of a build."""
        for finding in findings(diagnostics, quiet=self._console.quiet, verbose=self._console.verbose):
            yield LogLine(StyledLine(((f"{clock}  " if clock else "", "dim"), *finding.parts)), error=True)

    def _line(self, clock: str, robot: str, words: str, style: str = "", *, error: bool = False) -> LogLine:
        name = f"{robot:<{self._column}}  " if robot else ""
        return LogLine(line((f"{clock}  ", "dim"), (name, "bold"), (words, style)), error)


def _key(finding: Diagnostic) -> Hashable:
    """Return the identity of a finding, without the line number, which edits above the place change."""
    return finding.code, finding.statement, finding.file


def _changes(result: Result) -> list[str]:
    """Return the changes of the model: a few changes in words, else the number of changes."""
    if result.effective_changes is None:
        return []
    changes = result.effective_changes
    if changes.generator:
        return [generator_change(changes)]
    rows = [f"{title}: {row}" for title, rows in outline(changes) for row in rows]
    words = "; ".join(rows)
    return [words if len(rows) <= _FEW and len(words) <= _MAX_LENGTH else change_counts(changes)]


def _with_error(words: str, diagnostics: Sequence[Diagnostic]) -> str:
    """Return words with place and message of the first error, or else of the first finding, if there is any."""
    error = next(
        (finding for finding in diagnostics if finding.severity is Severity.ERROR), next(iter(diagnostics), None)
    )
    if error is None:
        return words
    place = f"{error.file}:{error.line}: " if error.line else f"{error.file}: " if error.file else ""
    return " ".join(f"{words}: {place}{error.message}".split())
