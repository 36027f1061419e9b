"""What changed between two versions: lines for people, and plain data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from urdfsync.domain import Effect
from urdfsync.engine.actions import USERS, Kind, Reason
from urdfsync.engine.findings import CONNECTORS
from urdfsync.output.build_section import build_section, change_parts
from urdfsync.output.conflicts import settle_hint, shown_path
from urdfsync.output.console import StyledLine, first_lines, line
from urdfsync.output.documents import fill
from urdfsync.output.outline import effect_rows
from urdfsync.output.phrases import change_counts, change_lines, counted, error_count, generator_change
from urdfsync.output.phrases import summary as build_summary
from urdfsync.output.results import RobotDocument, action_word, change_line, file_line, headline, robot_document
from urdfsync.output.sections import Mark, Section, Table
from urdfsync.versions.comparison import Comparison

_CHANGES, _FILES, _EFFECTS = 60, 12, 8
"""So many lines of changes, files and effects are listed at most, without --verbose."""
_SILENT = frozenset({Reason.UNCHANGED, Reason.KEEP, Reason.FORGET})
_EDITED = USERS | {Reason.UNOWNED, Reason.MOVED_AWAY}
"""Actions on files that the user edited: these are always named."""


class ComparisonDocument(RobotDocument):
    """A source compared with an older version of it."""

    source: str
    against: str | None
    effects: Sequence[Effect]


def robot_lines(compared: Comparison, *, verbose: bool = False) -> Iterator[StyledLine]:
    """Yield what changed in a source, without findings."""
    yield headline(compared.result, _summary(compared), is_fine=compared.in_step)
    yield from _lines(compared, verbose)


def to_document(compared: Comparison) -> ComparisonDocument:
    """Return what changed in a source as a part of a document."""
    own = {name: getattr(compared, name) for name in ("source", "against", "in_step", "effects")}
    return fill(ComparisonDocument, robot_document(compared.result), summary=_summary(compared), **own)


def to_section(compared: Comparison) -> Section:
    """Return a comparison for a comment; only one with the last build judges the package."""
    result, section = compared.result, build_section(compared.result)
    points, tables = change_parts(result.changes)
    points = [point for point in points if point not in _summary(compared)]
    effects = Table("Effects", ("Property", "Change", "By"), effect_rows(compared.effects))
    tables += [effects, section.tables[-1]]
    told = [finding for finding in section.findings if finding.code != CONNECTORS]  # effects tell them
    texts = {"summary": _summary(compared), "points": points, "tables": tables, "findings": told}
    if compared.against is None or result.failed:
        return msgspec.structs.replace(section, **texts)
    return msgspec.structs.replace(section, **texts, mark=Mark.NONE, verdict=None)


def _summary(compared: Comparison) -> str:
    """Return what changed since the older version, as the rest of a line that names the robot."""
    if compared.result.failed:
        return f"{error_count(compared.result.diagnostics)}, so nothing can be compared"
    if compared.missing:
        return compared.missing
    since = f"since {'the last build' if compared.against is None else compared.against}"
    changes = compared.result.changes
    if changes is None:
        return f"nothing changed {since}{'' if compared.in_step else ', but files are out of step'}"
    return f"{change_counts(changes) if changes.changes else generator_change(changes)} {since}"


def _lines(compared: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the lines below the first one: changes by element, effects on the model, files; of many the first."""
    head, changes = _summary(compared), compared.result.changes
    told = [text for text in change_lines(changes, everything=verbose) if text not in head] if changes else []
    yield from first_lines(list(map(change_line, told)), _CHANGES, "line", verbose=verbose)
    if effects := [line((f"  {text}", "")) for text in effect_rows(compared.effects)]:
        yield from (line(("", "")), line(("Effects", "bold")))
        yield from first_lines(effects, _EFFECTS, "effect", verbose=verbose)
    yield from _files(compared, verbose)


def _files(compared: Comparison, verbose: bool) -> Iterator[StyledLine]:
    """Yield the files that are concerned, and why if it is one that the user edited; these come first."""
    result = compared.result
    actions = [action for action in result.actions if action.reason not in _SILENT]
    if compared.in_step or not actions:
        return
    heading = f"Next build: {build_summary(result)}"
    if compared.against is not None:
        heading = f"{counted(len(actions), 'file')} of the package differ{'s' if len(actions) == 1 else ''}"
    yield from (line(("", "")), line((heading, "bold")))
    actions.sort(key=lambda action: (action.reason not in _EDITED, action.path.rpartition("/")))
    lines = [
        file_line(
            shown_path(result, action.path),
            *action_word(action),
            action.reason.text if action.reason in _EDITED else "",  # the word says already that it waits
        )
        for action in actions
    ]
    edited = sum(action.reason in _EDITED for action in actions)
    yield from first_lines(lines, max(_FILES, edited + 1), "file", verbose=verbose)
    if any(action.kind is Kind.CONFLICT for action in actions):
        yield line((settle_hint(result), "dim"))
