"""The output of `urdfsync watch`: lines and a status for people, a line of JSON per event for programs.

Lines scroll: each build has a line, with changes, errors and conflicts as `build` shows them. The next build of a robot
does not repeat the conflicts, warnings and orphans of its last build.
"""

from __future__ import annotations

import datetime
import enum
import json
import sys
from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Self

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import counted
from urdfsync.common.streams import has_marks
from urdfsync.engine.actions import CONFLICTS, ORPHANS, Actions, Reason
from urdfsync.engine.result import Checked, Result, check_result
from urdfsync.output.build_section import build_section
from urdfsync.output.conflicts import conflict_lines
from urdfsync.output.console import Console, StyledLine, findings, line, rich_console, write_lines
from urdfsync.output.documents import JSON_VERSION, plain
from urdfsync.output.outline import outline
from urdfsync.output.phrases import change_counts, generator_change
from urdfsync.output.repeated import findings_told, note, untold
from urdfsync.output.terminal import details
from urdfsync.watch import events
from urdfsync.watch.terminal import StatusArea

_NAME_WIDTH = 24
"""The greatest number of columns of the robots' names."""
_FEW = 2
"""Limits of a model's changes in words: their number, and the characters of the text. Further changes are counted."""
_MAX_LENGTH = 100
_SPACED = 4
"""With fewer rows, a terminal has no empty row above the status."""


class Activity(enum.StrEnum):
    """The activity of a robot in words; the most urgent ones come first."""

    ERROR = "error"
    CONFLICT = "conflict"
    WAITING = "waiting"
    BUILDING = "building"
    CHECKING = "checking"
    SETTLING = "settling"
    STARTING = "not looked at yet"
    IN_STEP = "in step"


_RANKS = list(Activity)
_SIGNS = {
    Activity.ERROR: ("✗", "bold red"),
    Activity.CONFLICT: ("!", "yellow"),
    Activity.WAITING: ("…", "yellow"),
    Activity.BUILDING: ("…", "cyan"),
    Activity.CHECKING: ("…", "cyan"),
    Activity.SETTLING: ("…", "cyan"),
    Activity.STARTING: ("…", "dim"),
    Activity.IN_STEP: ("✓", "green"),
}
"""Mark and style."""
_STEPS: dict[type[events.Event], tuple[str, Activity | None]] = {
    events.Settling: ("settling: {0.file}", Activity.SETTLING),
    events.Building: ("building", Activity.BUILDING),
    events.Waiting: ("{0.reason}", Activity.WAITING),
    events.Unchanged: ("as before", None),
    events.Checking: ("checking", Activity.CHECKING),
    events.Running: ("command started", None),
    events.Ran: ("command ended with {0.code}", None),
    events.Paused: ("paused: {0.reason}", None),
    events.Resumed: ("building again", None),
    events.Stopping: ("stopped by {0.signal}", None),
}
"""Events with one line, and the activity that begins with each; without `--verbose` only `Stopping` is shown."""


class RobotStatus(NamedTuple):
    """The state of one robot at one moment."""

    activity: Activity
    text: str
    """The words after the robot's name."""


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
    """Lines that scroll and, on a terminal, the status of each robot below them."""

    def __init__(self, console: Console) -> None:
        self._console, self._screen = console, rich_console(sys.stdout)
        has_status = not console.quiet and sys.stdout.isatty() and not self._screen.is_dumb_terminal
        self._area = StatusArea(sys.stdout) if has_status else None
        self._column = 0
        self._told: dict[tuple[str, str], set[Hashable]] = {}
        """The shown findings of a robot's last build, by robot and topic."""
        self._results: dict[str, RobotStatus] = {}
        """Results of the last builds by robots, in the order of the configuration."""
        self._builds: dict[str, RobotStatus] = {}
        """Robots between the first event and the end of a build."""
        self._checks: dict[str, RobotStatus] = {}
        self._commands: set[str] = set()
        """Robots for which a command of `--exec` runs."""
        self._pause = ""
        """Why builds pause; empty while they run."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Remove the status; the lines above stay."""
        if self._area:
            self._area.write((), ())

    def show(self, event: events.Event) -> None:
        """Show an event."""
        lines = list(self.take(event, now().strftime("%H:%M:%S")))
        # on one terminal, both streams stand in order above the status; otherwise each gets its own lines
        if self._area is None or not sys.stderr.isatty():
            write_lines([line.text for line in lines if line.error], sys.stderr)
            lines = [line for line in lines if not line.error]
        if self._area is None:
            write_lines([line.text for line in lines], sys.stdout)
        else:
            # the output of a command would overwrite the status
            is_shown = not (self._commands or isinstance(event, events.Stopping))
            rows = self.status_lines(self._area.room, marks=has_marks(sys.stdout)) if is_shown else ()
            self._area.write([line.text.__rich__() for line in lines], [row.__rich__() for row in rows])

    def take(self, event: events.Event, clock: str) -> Iterator[LogLine]:
        """Record an event at this time of day; yield the lines about it."""
        match event:
            case events.Started(file, robots, again):
                starting = RobotStatus(Activity.STARTING, Activity.STARTING)
                self._results = {name: self._results.get(name, starting) for name in robots}
                self._builds = {name: status for name, status in self._builds.items() if name in robots}
                self._checks = {}
                self._column = min(max(map(len, robots), default=0), _NAME_WIDTH)
                if not self._console.quiet:
                    words = f"watching {counted(len(robots), 'robot')} of {shown(file)}"
                    yield self._line(clock, "", f"configuration read again, {words}" if again else words)
            case events.Viewing(address):
                if not self._console.quiet:
                    yield self._line(clock, "", f"pages at {address}")
            case events.Built(result):
                self._finish(result, clock)
                yield from self._built(event, clock)
            case events.Failed(result, again):
                self._finish(result, clock)
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
        """Record an event between two results."""
        words, activity = _STEPS[type(event)]
        words = words.format(event).removesuffix(": ")
        robot: str = getattr(event, "robot", "")
        diagnostics: tuple[Diagnostic, ...] = getattr(event, "diagnostics", ())
        match event:
            case events.Checking():
                self._checks[robot] = RobotStatus(Activity.CHECKING, words)
            case events.Unchanged():
                self._builds.pop(robot, None)
            case events.Running():
                self._commands.add(robot)
            case events.Ran():
                self._commands.discard(robot)
            case events.Paused() | events.Resumed():
                self._pause = words if isinstance(event, events.Paused) else ""
            case _ if activity is not None:
                self._builds[robot] = RobotStatus(activity, _with_error(words, diagnostics))
        is_last = isinstance(event, events.Stopping)
        if self._console.verbose or (is_last and not self._console.quiet):
            yield self._line(clock, robot, words, "" if is_last else "dim")
            yield from self._findings(diagnostics)

    def _built(self, event: events.Built, clock: str) -> Iterator[LogLine]:
        """Yield the new findings of a build, a line if it wrote or found anything, and the new conflicts."""
        result, robot, verbose = event.result, event.result.robot, self._console.verbose
        was_in_step = not (self._told.get((robot, "broken")) or self._told.get((robot, "conflicts")))
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
        self._checks.pop(event.robot, None)
        if is_wrong:
            text = _with_error("checked with errors", event.diagnostics)
            self._checks[event.robot] = RobotStatus(Activity.ERROR, text)
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

    # The status of each robot

    def _finish(self, result: Result, clock: str) -> None:
        """Record the result of a build."""
        self._builds.pop(result.robot, None)
        before = self._results.get(result.robot)
        if result.failed or result.is_broken:
            words = Activity.ERROR if result.failed else "broken"
            status = RobotStatus(Activity.ERROR, _with_error(words, result.diagnostics))
        elif result.conflicts:
            files = [each.action.present.rpartition("/")[2] for each in result.conflicts]
            where = files[0] if len(files) == 1 else f"{len(files)} files"
            text = f"{Activity.CONFLICT} in {where}: run `urdfsync resolve`"
            status = RobotStatus(Activity.CONFLICT, text)
        elif not result.writes and before is not None and before.activity is Activity.IN_STEP:
            status = before  # keep the time of the last build that wrote a file
        else:
            status = RobotStatus(Activity.IN_STEP, f"in step, built at {clock}" if result.writes else "in step")
        self._results[result.robot] = status

    @property
    def rows(self) -> Mapping[str, RobotStatus]:
        """The status of each robot, in order: that of build or check, whichever is more urgent."""
        rows = {}
        for robot, result in self._results.items():
            at_rest = min(result, self._checks.get(robot, result), key=lambda status: _RANKS.index(status.activity))
            rows[robot] = self._builds.get(robot, at_rest)
        return rows

    def status_lines(self, room: int, *, marks: bool) -> Iterator[StyledLine]:
        """Yield lines for as many robots as the terminal has room for, and one line for all others.

        If there are too many robots, the most urgent ones are shown.
        """
        rows = self.rows
        if rows and room >= _SPACED:
            yield line(("", ""))
            room -= 1
        if self._pause:
            yield line((self._pause, "yellow"))
            room -= 1
        by_rank = sorted(rows, key=lambda robot: _RANKS.index(rows[robot].activity))
        number = len(rows) if len(rows) <= room else max(room - 1, 0)  # a line that counts the other robots needs room
        width = min(max(map(len, by_rank[:number]), default=0), _NAME_WIDTH)
        for robot in (robot for robot in rows if robot in by_rank[:number]):
            activity, text = rows[robot]
            mark, style = _SIGNS[activity]
            name = f"{robot:<{width}}" if len(robot) <= width else f"{robot[: width - 1]}…"
            words = f"  {text}", "" if activity is Activity.IN_STEP else style
            yield line((f"{mark} " if marks else "", style), (name, "bold"), words)
        if counts := Counter(rows[robot].activity for robot in by_rank[number:]):
            rest = ", ".join(f"{counts[activity]} {activity}" for activity in Activity if counts[activity])
            yield line((f"… and {counts.total()} more: {rest}", "dim"))


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
