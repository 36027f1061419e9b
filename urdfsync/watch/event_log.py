"""The lines of `urdfsync watch` that scroll: one per build with what changed, errors and conflicts as `build` has them.

Conflicts, warnings, and files that are kept although they are no longer generated are told once, and not again with
the next build.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Hashable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import ChangeKind, Role
from urdfsync.engine.actions import CONFLICTS, Actions, Kind
from urdfsync.outcome import Checked, Result
from urdfsync.output.conflicts import Extent, conflict_lines
from urdfsync.output.console import findings, text
from urdfsync.output.outline import OutlineEntry, OutlineRow, outline
from urdfsync.output.phrases import action_counts, check_result, counted, generator_change, summary
from urdfsync.output.results import result_lines
from urdfsync.watch import events

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

    from urdfsync.diff.changes import Changes

NAME_WIDTH = 24
"""Columns of the robots' names at most."""
_PLAIN: dict[type[events.Event], str] = {
    events.Settling: "changed, settling",
    events.Waiting: "{0.reason}",
    events.Unchanged: "as before",
    events.Building: "building",
    events.Checking: "checking",
    events.Ran: "command ended with {0.code}",
    events.Paused: "paused: {0.reason}",
    events.Resumed: "building again",
    events.Recovered: "{0.what}",
    events.Stopping: "stopped by {0.signal}",
}
"""Texts of events that are one line."""
_ALWAYS = (events.Recovered, events.Stopping)
"""Those of them that are told without `--verbose`."""
_LEFT = frozenset({Kind.ORPHAN, Kind.NEEDED})
"""Files that are no longer generated, but kept."""
_MAX_ROWS = 2
"""Rows of an outline that are spelled out."""
_MAX_LENGTH = 100
"""Characters of changes that are spelled out."""
_MAX_NAMES = 3
"""Names of one kind that are listed; more are counted."""
_NAMED = {
    Kind.RESTORE: "{1} restored because you deleted it",
    Kind.MERGE: "{1} merged with your edits",
    Kind.MOVE: "your edits moved from {0} to {1}",
}
"""Actions of which the files are named."""
_NOT_COUNTED = frozenset({Kind.CREATE, Kind.UPDATE, Kind.KEEP, *_LEFT, *CONFLICTS})
"""Actions that have words of their own, or that the user knows of."""
_PLAIN_NUMBER = re.compile(r"-?[\d.]+(e[-+]?\d+)?|-?inf")


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
            case events.Started(file, robots, again):
                self._column = min(max(map(len, robots), default=0), NAME_WIDTH)
                said = f"watching {counted(len(robots), 'robot')} of {shown(file)}"
                if not self._quiet:
                    yield self._line(clock, "", f"{'configuration read again, ' if again else ''}{said}")
            case events.Built():
                yield from self._built(event, clock)
            case events.Failed(result, again):
                if self._verbose or not again:
                    yield self._line(clock, result.robot, summary(result), "bold red", error=True)
                    yield from self._findings(result.diagnostics)
            case events.CheckDone():
                yield from self._checked(event, clock)
            case events.Noted(diagnostics):
                yield from self._findings(diagnostics, clock)
            case _ if self._verbose or (isinstance(event, _ALWAYS) and not self._quiet):
                style = "" if isinstance(event, _ALWAYS) else "dim"
                yield self._line(clock, getattr(event, "robot", ""), _PLAIN[type(event)].format(event), style)
                yield from self._findings(getattr(event, "diagnostics", ()))
            case _:
                pass

    def _built(self, event: events.Built, clock: str) -> Iterator[Line]:
        """Yield the line of a build that did or found anything, below its new findings and above its new conflicts."""
        result = event.result
        # a build with nothing to do reads no source and so has other findings: it is compared with the last such one
        topic = "findings" if event.files or result.changes else "findings of nothing to do"
        before = self._told.get((result.robot, topic), ())
        keys = self._told[result.robot, topic] = [(one.code, one.message, one.file) for one in result.diagnostics]
        new = [one for one, key in zip(result.diagnostics, keys, strict=True) if self._verbose or key not in before]
        yield from self._findings(new)
        had = self._told.get((result.robot, "conflicts"))
        known = not self._is_new(result.robot, "conflicts", {(a.path, a.mine, a.generated) for a in result.conflicts})
        left = self._is_new(result.robot, "left", {a.path for a in result.actions.decided if a.kind in _LEFT})
        if self._quiet and (known or not result.conflicts):
            return
        did = []
        if event.files or event.recovered or result.changes or not known:
            did = build_summary(result, known=known)
        if not result.conflicts and (event.recovered or had):
            did.append("in step again")
        if not did and (self._verbose or left):
            did = [summary(result)]
        if not did:
            return
        yield self._line(clock, result.robot, ", ".join(did), "yellow" if result.conflicts else "")
        seen = result
        if not self._verbose:
            hidden = (CONFLICTS if known else frozenset()) | (frozenset() if left else _LEFT)
            actions = Actions(action for action in result.actions if action.kind not in hidden)
            seen = msgspec.structs.replace(result, actions=actions, changes=None)
        lines = result_lines(seen, quiet=self._quiet, verbose=self._verbose)
        yield from (Line(line.__rich__()) for line in itertools.islice(lines, 1, None))  # without the headline
        if seen.conflicts:
            yield from map(Line, conflict_lines(seen, self._console, self._extent))

    def _checked(self, event: events.CheckDone, clock: str) -> Iterator[Line]:
        """Yield the line of a check, and its findings unless they are those of the last one."""
        wrong = event.checked is Checked.WRONG
        keys = frozenset((one.code, one.message, one.file) for one in event.diagnostics)
        before = self._told.get((event.robot, "check"))
        known = not self._is_new(event.robot, "check", keys if wrong else ())
        said = check_result(event.checked, event.diagnostics)
        took = f" ({event.seconds:.1f} s)" if event.seconds else ""
        if self._quiet and (known or not wrong):
            pass
        elif wrong:
            yield self._line(clock, event.robot, said + (" as before" if known else took), "bold red", error=True)
        else:
            yield self._line(clock, event.robot, f"{said}{' again' if before else ''}{took}")
        if self._verbose or not (wrong and known):
            yield from self._findings(event.diagnostics)

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

    def _line(self, clock: str, robot: str, said: str, style: str = "", *, error: bool = False) -> Line:
        name = f"{robot:<{self._column}}  " if robot else ""
        return Line(text((f"{clock}  ", "dim"), (name, "bold"), (said, style)), error)


def build_summary(result: Result, *, known: bool = False) -> list[str]:
    """Return what a build did: the changes in the model, and what was done to the files.

    `known` says that the conflicts are those of the last build.
    """
    decided, parts, silent = result.actions.decided, [], set(_NOT_COUNTED)
    written = [action for action in decided if action.kind in (Kind.CREATE, Kind.UPDATE) and not action.held]
    if written:
        roles = {action.role for action in written}
        noun = "record" if roles == {Role.RECORD} else "model" if roles == {Role.MODEL} else "file"
        parts.append(f"{counted(len(written), noun)} written")
    for kind, words in _NAMED.items():
        named = [action for action in decided if action.kind is kind and not action.held]
        if 0 < len(named) <= _MAX_NAMES:
            silent.add(kind)
            places = ((action.origin or action.path, action.path) for action in named)
            parts += [words.format(*(place.rpartition("/")[2] for place in both)) for both in places]
    parts += action_counts(result, silent)
    if result.conflicts:
        parts.append(counted(len(result.conflicts), "conflict") + (" as before" if known else ""))
        if held := sum(action.held for action in decided):
            parts.append(f"{counted(held, 'change')} waiting for that")
    changed = _changes(result.changes) if result.changes else ""
    return [changed, *(parts or ["nothing to write"])] if changed else parts


def _changes(found: Changes) -> str:
    """Return what changed in the model. Of many changes, only elements that come, go or are renamed are named."""
    if found.generator:
        return generator_change(found)
    entries = outline(found).entries
    if sum(len(entry.rows) for entry in entries) <= _MAX_ROWS:
        words = "; ".join(map(_entry, entries))
        if len(words) <= _MAX_LENGTH:
            return words
    named = [entry for entry in entries if _is_element(entry)]
    few = len(named) <= _MAX_NAMES and all(len(_entry(entry)) <= _MAX_LENGTH for entry in named)
    rest = [change for change in found.changes if not (few and len(change.path) == 1)]
    parts = [_element(entry) for entry in named] if few else []
    if rest:
        elements = len({change.element for change in rest})
        count = counted(len(rest), "more change" if parts else "change")
        parts.append(f"{count} in {counted(elements, 'element')}")
    return ", ".join(parts)


def _entry(entry: OutlineEntry) -> str:
    """Return such as `link elbow: mass 1.2 → 1.35 kg (+12.5 %)`, `link tool added`."""
    begin, rows = (_element(entry), entry.rows[1:]) if _is_element(entry) else (entry.title, entry.rows)
    words = ", ".join(map(_row, rows))
    return f"{begin}: {words}" if words else begin


def _is_element(entry: OutlineEntry) -> bool:
    """Return whether the element itself comes, goes or is renamed."""
    row = entry.rows[0]
    return row.kind is not ChangeKind.CHANGED and not row.is_quiet and not row.label


def _element(entry: OutlineEntry) -> str:
    """Return an element that comes, goes or is renamed, without its values."""
    return f"{entry.title} {entry.rows[0].new.partition(':')[0]}"


def _row(row: OutlineRow) -> str:
    """Return where a value is, and the value. The group of a number is left out if its name says enough: `mass`."""
    words = row.label.split(" / ")
    if len(words) == 2 and _PLAIN_NUMBER.fullmatch(row.old) and not re.search(r"\d", row.label):
        words = words[1:]
    relation = f" ({row.relation})" if row.relation else ""
    value = f"{row.old} → {row.new}" if row.old else row.new
    return f"{' '.join(words)} {value}{relation}".strip()
