"""Results in words: what `report` shows to people, without saying how it looks."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

from urdfsync import difference
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Result
from urdfsync.plan import Kind

if TYPE_CHECKING:
    from urdfsync.changes import Change, Changes

_WIDTH = 40
FEW = 5
"""So many warnings of one kind are shown; of more, only the first ones and their number."""


def summary(result: Result) -> str:
    """What happened to a robot's package (in a dry run: what would), as the rest of a line that names the robot."""
    if result.failed:
        errors = sum(found.severity is Severity.ERROR for found in result.diagnostics)
        end = "the next build finishes or undoes what was begun" if result.unfinished else "nothing was changed"
        return f"{_number(errors, 'error')}, {end}"
    parts = [_phrase(kind, number, result.dry) for kind, number in _counts(result) if number]
    waiting = sum(action.held for action in result.actions)
    if waiting:
        parts.append(f"{_number(waiting, 'change')} waiting for that")
    if result.in_step:
        total = sum(action.kind in (Kind.UNCHANGED, Kind.KEEP) for action in result.actions)
        parts.insert(0, f"in step, {_number(total, 'file')}")
    return ", ".join(parts)


def _counts(result: Result) -> list[tuple[Kind, int]]:
    kinds = Counter(action.kind for action in result.actions if not action.held)
    written = kinds.pop(Kind.CREATE, 0) + kinds.pop(Kind.UPDATE, 0)
    conflicts = kinds.pop(Kind.CONFLICT, 0) + kinds.pop(Kind.UNOWNED, 0)
    order = (Kind.RESTORE, Kind.DELETE, Kind.ADOPT, Kind.KEEP, Kind.ORPHAN, Kind.NEEDED)
    return [(Kind.UPDATE, written), *((kind, kinds[kind]) for kind in order), (Kind.CONFLICT, conflicts)]


def _phrase(kind: Kind, number: int, dry: bool) -> str:
    files, them = _number(number, "file"), "them" if number > 1 else "it"
    return {
        Kind.UPDATE: f"{files} to write" if dry else f"{files} written",
        Kind.RESTORE: f"{number} to restore" if dry else f"{number} restored because you deleted {them}",
        Kind.DELETE: f"{number} to delete" if dry else f"{number} deleted",
        Kind.ADOPT: f"{number} already as wanted",
        Kind.KEEP: f"{number} kept because you edited {them}",
        Kind.ORPHAN: f"{number} no longer generated but kept because you edited {them}",
        Kind.NEEDED: f"{number} no longer generated but kept because your files need {them}",
        Kind.CONFLICT: _number(number, "conflict"),
    }[kind]


def _number(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


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
    lines = ["a template, an option or urdfsync itself changed"] if found.generator else []
    return lines + [_change(change) for change in found.changes]


def _change(change: Change) -> str:
    match change.kind:
        case difference.Kind.CHANGED:
            what = f"{_value(change.old)} → {_value(change.new)} {change.unit}".rstrip() + _relation(change)
        case difference.Kind.RENAMED:
            what = f"renamed to {change.new}"
        case kind:
            what = str(kind)
    unmodelled = " (not modelled)" if change.change_class is difference.ChangeClass.UNMODELLED else ""
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
