"""A build of the daemon in one line: what changed in the model, and what was done to the files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from urdfsync.domain import ChangeKind, Role
from urdfsync.engine.actions import CONFLICTS, Action, Kind
from urdfsync.outcome import Result
from urdfsync.output.outline import OutlineEntry, OutlineRow, outline
from urdfsync.output.phrases import action_counts, counted, generator_change

if TYPE_CHECKING:
    from urdfsync.diff.changes import Changes

_MAX_ROWS = 2
"""Rows of an outline that are spelled out."""
_MAX_LENGTH = 100
"""Characters of changes that are spelled out."""
_MAX_NAMES = 3
"""Names of one kind that are listed; more are counted."""
_NOUNS = {Role.RECORD: "record", Role.MODEL: "model"}
_NAMED = (Kind.RESTORE, Kind.MERGE, Kind.MOVE)
"""Actions of which the files are named."""
_NOT_COUNTED = frozenset({Kind.CREATE, Kind.UPDATE, Kind.KEEP, Kind.ORPHAN, Kind.NEEDED, *CONFLICTS})
"""Actions that have words of their own, or that the user knows of."""
_PLAIN_NUMBER = re.compile(r"-?[\d.]+(e[-+]?\d+)?|-?inf")
_INDEX = re.compile(r"\d")


def build_summary(result: Result, *, known: bool = False) -> str:
    """Return what a build did, as the rest of a line that names the robot; empty if it did nothing.

    `known` says that the conflicts are those of the last build.
    """
    changed = _changes(result.changes) if result.changes else ""
    parts = [*_written(result.actions.decided), *_other_actions(result), *_conflicts(result, known=known)]
    if not changed:
        return ", ".join(parts)
    return ", ".join([changed, *(parts or ["nothing to write"])])


def _written(actions: Sequence[Action]) -> list[str]:
    """Return such as `2 records written`."""
    written = [action for action in actions if action.kind in (Kind.CREATE, Kind.UPDATE) and not action.held]
    if not written:
        return []
    roles = {action.role for action in written}
    noun = _NOUNS.get(roles.pop(), "file") if len(roles) == 1 else "file"
    return [f"{counted(len(written), noun)} written"]


def _other_actions(result: Result) -> Iterator[str]:
    """Yield the other actions, with the names of their files if these are few."""
    silent = set(_NOT_COUNTED)
    for kind in _NAMED:
        found = [action for action in result.actions.decided if action.kind is kind and not action.held]
        if 0 < len(found) <= _MAX_NAMES:
            silent.add(kind)
            yield from map(_action, found)
    yield from action_counts(result, silent)


def _action(action: Action) -> str:
    name = action.path.rpartition("/")[2]
    match action.kind:
        case Kind.RESTORE:
            return f"{name} restored because you deleted it"
        case Kind.MERGE:
            return f"{name} merged with your edits"
        case _:
            old = (action.origin or action.path).rpartition("/")[2]
            return f"your edits moved from {old} to {name}"


def _conflicts(result: Result, *, known: bool) -> Iterator[str]:
    if result.conflicts:
        yield counted(len(result.conflicts), "conflict") + (" as before" if known else "")
        if held := sum(action.held for action in result.actions.decided):
            yield f"{counted(held, 'change')} waiting for that"


def _changes(found: Changes) -> str:
    """Return what changed in the model. Of many changes, only elements that come, go or are renamed are named."""
    if found.generator:
        return generator_change(found)
    entries = outline(found).entries
    if sum(len(entry.rows) for entry in entries) <= _MAX_ROWS:
        words = "; ".join(map(_entry, entries))
        if len(words) <= _MAX_LENGTH:
            return words
    whole = [change for change in found.changes if len(change.path) == 1]
    named = [entry for entry in entries if _is_whole(entry.rows[0])]
    few = len(named) <= _MAX_NAMES and all(len(_entry(entry)) <= _MAX_LENGTH for entry in named)
    rest = [change for change in found.changes if not (few and change in whole)]
    parts = [_element(entry) for entry in named] if few else []
    if rest:
        elements = len({change.element for change in rest})
        count = counted(len(rest), "more change" if parts else "change")
        parts.append(f"{count} in {counted(elements, 'element')}")
    return ", ".join(parts)


def _entry(entry: OutlineEntry) -> str:
    """Return such as `link elbow: mass 1.2 → 1.35 kg (+12.5 %)`, `link tool added`."""
    if _is_whole(entry.rows[0]):
        more = ", ".join(map(_row, entry.rows[1:]))
        return f"{_element(entry)}{': ' if more else ''}{more}"
    return f"{entry.title}: {', '.join(map(_row, entry.rows))}"


def _is_whole(row: OutlineRow) -> bool:
    """Whether a whole element comes, goes or is renamed."""
    return row.kind is not ChangeKind.CHANGED and not row.is_quiet and not row.label


def _element(entry: OutlineEntry) -> str:
    """Return an element that comes, goes or is renamed, without its values."""
    return f"{entry.title} {entry.rows[0].new.partition(':')[0]}"


def _row(row: OutlineRow) -> str:
    relation = f" ({row.relation})" if row.relation else ""
    value = f"{row.old} → {row.new}" if row.old else row.new
    return f"{_label(row)} {value}{relation}".strip()


def _label(row: OutlineRow) -> str:
    """Return where a value is. The group of a number is left out if the name says enough, as in `mass`."""
    words = row.label.split(" / ")
    if len(words) == 2 and _PLAIN_NUMBER.fullmatch(row.old) and not _INDEX.search(row.label):
        return words[1]
    return " ".join(words)
