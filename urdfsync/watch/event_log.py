"""The lines of `urdfsync watch` that scroll: one per build with what changed, errors and conflicts as `build` has them.

Conflicts, warnings, and files that are kept although they are no longer generated are told once, and not again with
the next build.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Hashable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.actions import CONFLICTS, Actions, Kind
from urdfsync.outcome import Checked, Result
from urdfsync.output.conflicts import Extent, conflict_lines
from urdfsync.output.console import findings, text
from urdfsync.output.phrases import check_result, counted, summary
from urdfsync.output.results import result_lines
from urdfsync.watch import events
from urdfsync.watch.summary import build_summary

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

NAME_WIDTH = 24
"""Columns of the robots' names at most."""
_LEFT = frozenset({Kind.ORPHAN, Kind.NEEDED})
"""Files that are no longer generated, but kept."""


class Line(NamedTuple):
    """One line, and whether it belongs on the error stream."""

    text: Text
    error: bool = False


class EventLog:
    """Events as lines; what was told of a robot is not repeated while it holds."""

    def __init__(self, console: Console, *, quiet: bool = False, verbose: bool = False, config: str = "") -> None:
        """`console` is where conflicts are going to be shown; `config` the configuration as the user named it."""
        self._console, self._quiet, self._verbose = console, quiet, verbose
        self._extent = Extent(verbose, quiet, 0, config)
        self._told: dict[tuple[str, str], Collection[Hashable]] = {}
        self._column = 0

    def lines(self, event: events.Event, clock: str) -> Iterator[Line]:
        """Yield the lines of an event that happened at this time of day."""
        match event:
            case events.Built():
                yield from self._built(event, clock)
            case events.Failed(result, again) if self._verbose or not again:
                yield Line(self._line(clock, result.robot, summary(result), "bold red"), error=True)
                yield from self._findings(result.diagnostics)
            case events.CheckDone():
                yield from self._checked(event, clock)
            case events.Noted(diagnostics):
                yield from self._findings(diagnostics, clock)
            case events.Waiting(robot, reason, diagnostics) if self._verbose:
                yield Line(self._line(clock, robot, reason, "dim"))
                yield from self._findings(diagnostics)
            case events.Failed() | events.Waiting():
                pass
            case _:
                robot, said, always = _plain(event)
                if isinstance(event, events.Started):
                    self._column = min(max(map(len, event.robots), default=0), NAME_WIDTH)
                if self._verbose or (always and not self._quiet):
                    yield Line(self._line(clock, robot, said, "" if always else "dim"))

    def _built(self, event: events.Built, clock: str) -> Iterator[Line]:
        """Yield the line of a build that did or found anything, below its new findings and above its new conflicts."""
        result = event.result
        yield from self._findings(self._fresh(event))
        had = self._told.get((result.robot, "conflicts"))
        known = not self._is_new(result.robot, "conflicts", {(a.path, a.mine, a.generated) for a in result.conflicts})
        left = self._is_new(result.robot, "left", {a.path for a in result.actions.decided if a.kind in _LEFT})
        if self._quiet and (known or not result.conflicts):
            return
        again = "in step again" if not result.conflicts and (event.recovered or had) else ""
        speaks = event.files or event.recovered or result.changes or not known
        did = [build_summary(result, known=known)] if speaks else []
        did = list(filter(None, did)) + ([again] if again else [])
        if not did and (self._verbose or left):
            did = [summary(result)]
        if did:
            yield Line(self._line(clock, result.robot, ", ".join(did), "yellow" if result.conflicts else ""))
            yield from self._details(result, known=known, left=left)

    def _checked(self, event: events.CheckDone, clock: str) -> Iterator[Line]:
        """Yield the line of a check, and its findings unless they are those of the last one."""
        wrong = event.checked is Checked.WRONG
        keys = frozenset((one.code, one.message, one.file) for one in event.diagnostics)
        before = self._told.get((event.robot, "check"))
        known = not self._is_new(event.robot, "check", keys if wrong else ())
        said = check_result(event.checked, event.diagnostics)
        took = f" ({event.seconds:.1f} s)" if event.seconds else ""
        if wrong and known and self._quiet:
            return
        if wrong:
            said += " as before" if known else took
            yield Line(self._line(clock, event.robot, said, "bold red"), error=True)
        elif not self._quiet:
            said += f"{' again' if before else ''}{took}"
            yield Line(self._line(clock, event.robot, said, ""))
        if self._verbose or not (wrong and known):
            yield from self._findings(event.diagnostics)

    def _details(self, result: Result, *, known: bool, left: bool) -> Iterator[Line]:
        """Yield what `build` has below its headline; without what was told before, unless the log is verbose."""
        if not self._verbose:
            hidden = (CONFLICTS if known else frozenset()) | (frozenset() if left else _LEFT)
            seen = [action for action in result.actions if action.kind not in hidden]
            result = msgspec.structs.replace(result, actions=Actions(seen), changes=None)
        lines = result_lines(result, quiet=self._quiet, verbose=self._verbose)
        yield from (Line(line.__rich__()) for line in itertools.islice(lines, 1, None))
        if result.conflicts:
            yield from map(Line, conflict_lines(result, self._console, self._extent))

    def _fresh(self, event: events.Built) -> Sequence[Diagnostic]:
        """Return the findings that the robot's last build did not have, wherever their lines are now.

        A build with nothing to do reads no source and so has other findings: it is compared with the last such one.
        """
        found = event.result.diagnostics
        topic = "findings" if event.files or event.result.changes else "findings of nothing to do"
        before = self._told.get((event.result.robot, topic), ())
        keys = [(one.code, one.message, one.file) for one in found]
        self._told[event.result.robot, topic] = frozenset(keys)
        return found if self._verbose else [one for one, key in zip(found, keys, strict=True) if key not in before]

    def _is_new(self, robot: str, topic: str, found: Collection[Hashable]) -> bool:
        """Return whether anything was found, and not the same in the robot's last build; remember it."""
        before = self._told.get((robot, topic))
        self._told[robot, topic] = found
        return bool(found) and found != before

    def _findings(self, diagnostics: Sequence[Diagnostic], clock: str = "") -> Iterator[Line]:
        """Yield findings as all commands show them; with a time of day if there is no line of a build above them."""
        for found in findings(diagnostics, quiet=self._quiet, verbose=self._verbose):
            time = text((f"{clock}  " if clock else "", "dim"))
            yield Line(time.append_text(found.__rich__()), error=True)

    def _line(self, clock: str, robot: str, said: str, style: str) -> Text:
        name = f"{robot:<{self._column}}  " if robot else ""
        return text((f"{clock}  ", "dim"), (name, "bold"), (said, style))


def _plain(event: events.Event) -> tuple[str, str, bool]:
    """Return the robot of an event, its text, and whether it is told without `--verbose`, too."""
    match event:
        case events.Started(config, robots, again):
            what = "configuration read again, " if again else ""
            return "", f"{what}watching {counted(len(robots), 'robot')} of {shown(config)}", True
        case events.Settling(robot):
            return robot, "changed, settling", False
        case events.Unchanged(robot):
            return robot, "as before", False
        case events.Building(robot):
            return robot, "building", False
        case events.Checking(robot):
            return robot, "checking", False
        case events.Recovered(what):
            return "", what, True
        case events.Paused(reason):
            return "", f"paused: {reason}", False
        case events.Resumed():
            return "", "building again", False
        case events.Ran(robot, code):
            return robot, f"command ended with {code}", False
        case events.Stopping(signal):
            return "", f"stopped by {signal}", True
        case _:
            raise ValueError(event)
