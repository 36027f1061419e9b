"""Results in words: what `report` shows to people, without saying how it looks."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Container, Sequence
from typing import TYPE_CHECKING

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, ChangeKind
from urdfsync.engine.actions import DELETES, Kind
from urdfsync.outcome import Checked, Result
from urdfsync.status import FileStatus, RobotState

if TYPE_CHECKING:
    from urdfsync.diff.changes import Change, Changes

_WIDTH = 40
GENERATOR = "a template, an option or urdfsync itself changed"
FEW = 5
"""So many warnings of one kind are shown; of more, only the first ones and their number."""


def summary(result: Result) -> str:
    """What happened to a robot's package (in a dry run: what would), as the rest of a line that names the robot."""
    if result.failed:
        errors = sum(found.severity is Severity.ERROR for found in result.diagnostics)
        end = "the next build finishes or undoes what was begun" if result.unfinished else "nothing was changed"
        return f"{counted(errors, 'error')}, {end}"
    parts = deeds(result)
    waiting = sum(action.held for action in result.actions.decided)
    if waiting:
        parts.append(f"{counted(waiting, 'change')} waiting for that")
    if result.in_step:
        fine = (Kind.UNCHANGED, Kind.KEEP, Kind.INCLUDED)
        total = sum(action.kind in fine for action in result.actions)
        parts.insert(0, f"in step, {counted(total, 'file')}")
    return "; ".join([", ".join(parts), *([checked(result.checked, result.diagnostics)] if result.checked else [])])


def checked(what: Checked, diagnostics: Sequence[Diagnostic]) -> str:
    """What the check after a build said, as the rest of a line that names the robot."""
    match what:
        case Checked.RIGHT:
            return "checked: compiles"
        case Checked.INCOMPLETE:
            return "not checked completely"
        case Checked.UNCHECKED:
            return "not checked"
        case Checked.WRONG:
            return f"checked: {counted(sum(found.severity is Severity.ERROR for found in diagnostics), 'error')}"


def deeds(result: Result, silent: Container[Kind] = ()) -> list[str]:
    """What happened to a robot's files, a phrase for each kind of action that is not `silent`."""
    counts = [(kind, number) for kind, number in _counts(result) if number and kind not in silent]
    return [_phrase(kind, number, result.dry) for kind, number in counts]


def _counts(result: Result) -> list[tuple[Kind, int]]:
    kinds = Counter(action.kind for action in result.actions.decided if not action.held)
    written = kinds.pop(Kind.CREATE, 0) + kinds.pop(Kind.UPDATE, 0)
    conflicts = kinds.pop(Kind.CONFLICT, 0) + kinds.pop(Kind.UNOWNED, 0)
    yours = (Kind.MERGE, Kind.MOVE, Kind.INCLUDED, Kind.KEEP, Kind.ORPHAN, Kind.NEEDED)
    order = (Kind.RESTORE, Kind.DELETE, Kind.ADOPT, *yours)
    return [(Kind.UPDATE, written), *((kind, kinds[kind]) for kind in order), (Kind.CONFLICT, conflicts)]


def _phrase(kind: Kind, number: int, dry: bool) -> str:
    files, them = counted(number, "file"), "them" if number > 1 else "it"
    return {
        Kind.UPDATE: f"{files} to write" if dry else f"{files} written",
        Kind.RESTORE: f"{number} to restore" if dry else f"{number} restored because you deleted {them}",
        Kind.DELETE: f"{number} to delete" if dry else f"{number} deleted",
        Kind.ADOPT: f"{number} already as wanted",
        Kind.MERGE: f"{number} to merge with your edits" if dry else f"{number} merged with your edits",
        Kind.MOVE: f"{number} to move with your edits" if dry else f"{number} moved with your edits",
        Kind.INCLUDED: f"{number} that you edited already {'have' if number > 1 else 'has'} what is new",
        Kind.KEEP: f"{number} kept because you edited {them}",
        Kind.ORPHAN: f"{number} no longer generated but kept because you edited {them}",
        Kind.NEEDED: f"{number} no longer generated but kept because your files need {them}",
        Kind.CONFLICT: counted(number, "conflict"),
    }[kind]


def counted(count: int, noun: str) -> str:
    """`1 file`, `2 files`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def size(number: int) -> str:
    """So many bytes, in the largest unit of which there is at least one: `812 kB`, `1.2 GB`."""
    for power, unit in ((3, "GB"), (2, "MB"), (1, "kB")):
        if number >= 1000**power:
            value = number / 1000**power
            return f"{value:.0f} {unit}" if value >= 10 else f"{value:.1f} {unit}"
    return counted(number, "byte")


def state(found: RobotState) -> str:
    """How a robot stands, as the rest of a line that names it."""
    counts = dict(found.counts)
    counts.pop(FileStatus.IN_STEP, None)
    if found.result.failed:
        errors = sum(finding.severity is Severity.ERROR for finding in found.result.diagnostics)
        return f"{counted(errors, 'error')}, so nothing can be said of its files"
    if found.built or found.in_step:
        head = f"{'in' if found.in_step else 'out of'} step, {counted(len(found.files), 'file')}"
    else:
        head = "not built yet"
        counts.pop(FileStatus.STALE, None)
    tally = ", ".join(_tally(status, number) for status, number in counts.items())
    return f"{head}{': ' if tally else ''}{tally}"


def _tally(status: FileStatus, number: int) -> str:
    return counted(number, status) if status in (FileStatus.CONFLICT, FileStatus.ORPHAN) else f"{number} {status}"


def outlook(found: RobotState) -> list[str]:
    """What a robot waits for and what the next build does about it, in a line or two; nothing if nothing is due."""
    changed = _change_classes(found.result.changes) if found.result.changes else ""
    moving = [action for action in found.result.actions.decided if action.writes]
    deleted = sum(action.kind in DELETES for action in moving)
    does = [f"writes {counted(len(moving) - deleted, 'file')}"] if len(moving) > deleted else []
    does += [f"deletes {deleted if does else counted(deleted, 'file')}"] if deleted else []
    build = f"`urdfsync build` {' and '.join(does)}" if does else ""
    held = sum(action.held for action in found.result.actions.decided)
    if not held:
        return ["; ".join(filter(None, [changed, build]))] if changed or build else []
    waits = f"{counted(held, 'file')} {'waits' if held == 1 else 'wait'} for the conflict"
    return [*([changed] if changed else []), "; ".join(filter(None, [build, waits]))]


def _change_classes(found: Changes) -> str:
    """`1 structural and 2 parameter changes in the source`."""
    if found.generator:
        return GENERATOR
    return f"{change_counts(found)} in the source{' (rounding)' if found.noise else ''}"


def change_counts(found: Changes) -> str:
    """`1 structural and 2 parameter changes`."""
    classes = Counter(change.change_class for change in found.changes)
    counts = [(classes[one], one) for one in reversed(ChangeClass) if classes[one]]
    words = " and ".join(f"{number} {one}" for number, one in counts)
    return f"{words} change{'' if counts[-1][0] == 1 else 's'}"


def folded(diagnostics: Sequence[Diagnostic]) -> tuple[list[Diagnostic], dict[str, int]]:
    """The findings to show, and how many more there are of each code. Errors are all shown."""
    seen: Counter[str] = Counter()
    shown, more = [], Counter[str]()
    total = Counter(found.code for found in diagnostics)
    for found in diagnostics:
        seen[found.code] += 1
        few = total[found.code] <= FEW or seen[found.code] < FEW
        if few or found.severity is Severity.ERROR:
            shown.append(found)
        else:
            more[found.code] += 1
    return shown, dict(more)


def changes(found: Changes) -> list[str]:
    """What changed in the model, one line each: `joint elbow / limit / effort: 54 → 60 N.m (+11 %)`."""
    lines = [GENERATOR] if found.generator else []
    return lines + [_change(change) for change in found.changes]


def _change(change: Change) -> str:
    match change.kind:
        case ChangeKind.CHANGED:
            what = f"{_value(change.old)} → {_value(change.new)} {change.unit}".rstrip() + _relation(change)
        case ChangeKind.RENAMED:
            what = f"renamed to {change.new}"
        case kind:
            what = str(kind)
    unmodelled = " (not modelled)" if change.change_class is ChangeClass.UNMODELLED else ""
    return f"{change}: {what}{unmodelled}"


def _value(value: object) -> str:
    """A value in few characters; numbers with all digits that they have, up to ten."""
    if isinstance(value, float):
        return f"{value:.10g}"
    text = value if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= _WIDTH else f"{text[: _WIDTH - 1]}…"


def _relation(change: Change) -> str:
    """How a number's new value stands to its old one."""
    if change.noise:
        return " (rounding)"
    if change.unit == "rad":
        return f" ({math.degrees(change.old):.4g}° → {math.degrees(change.new):.4g}°)"
    return "" if change.percent is None else f" ({change.percent:+.3g} %)"


def visible(text: str) -> str:
    """The text with everything escaped that a terminal would obey instead of showing it."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
