"""How a comparison of two versions looks: a tree of changes by element, what follows from them, and the files."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from urdfsync import outline, wording
from urdfsync.comparison import Comparison
from urdfsync.config import shown
from urdfsync.outline import Entry, Row, Tone
from urdfsync.plan import CONFLICTS, Action, Kind
from urdfsync.views.terminal import has_marks, text

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.text import Text

_ADVICE = "  settle a conflict with `urdfsync resolve FILE --keep` (or --take, --merge)"
_TONES = {Tone.ADDED: "green", Tone.REMOVED: "red", Tone.RENAMED: "cyan", Tone.QUIET: "dim"}
_WIDEST = 44
"""Columns for labels at most; longer ones push their values to the right."""
_TITLE = 40
"""Columns for the names of elements at most, where something stands beside them."""
_VALUES = 40
"""Columns for values at most; longer ones push what is said of them to the right."""
_FILES = 12
"""So many files are listed at most, unless somebody asks."""
_WORD = 9
"""Columns for what happens to a file."""
_EFFECTS = 8
"""So many effects are shown at most, unless somebody asks."""
_SILENT = frozenset({Kind.UNCHANGED, Kind.KEEP, Kind.FORGET})
_KINDS = {Kind.CREATE: "green", Kind.RESTORE: "green", Kind.UPDATE: "default", Kind.DELETE: "red", Kind.ADOPT: "green"}


def parts(comparison: Comparison, console: Console, verbose: bool) -> Iterator[RenderableType]:
    """Everything that there is to say about one source."""
    if not console.is_terminal:
        console.width = 10_000  # lines of a pipe are never broken
    yield _tree(comparison, console, verbose)
    yield from _effects(comparison, console, verbose)
    yield from _files(comparison, console, verbose)


def headline(comparison: Comparison, console: Console) -> Text:
    """The name, and the result in few words."""
    mark, style = ("✓", "green") if comparison.in_step else ("~", "yellow")
    marks = [(f"{mark} ", style)] if has_marks(console.file) else []
    return text(*marks, (comparison.result.robot, "bold"), (f": {wording.comparison(comparison)}", ""))


def _tree(comparison: Comparison, console: Console, verbose: bool) -> RenderableType:
    from rich.tree import Tree

    tree = Tree(headline(comparison, console), guide_style="dim")
    if comparison.changes is None:
        return tree
    if comparison.changes.generator:
        tree.add(text(("urdfsync", "bold"), ("  a template, an option or the program itself changed", "")))
    found = outline.outline(comparison.changes, everything=verbose)
    columns = _Columns.of([row for entry in found.entries for row in entry.rows], console)
    own = [len(entry.title) for entry in found.entries if any(not row.label for row in entry.rows)]
    width = max((length for length in own if length <= _TITLE), default=0)
    for entry in found.entries:
        branch = tree.add(_title(entry, width))
        for row in entry.rows:
            if row.label:
                branch.add(columns.line(row))
    if found.condensed:
        tree.add(text(("--verbose shows each number", "dim")))
    return tree


def _title(entry: Entry, width: int) -> Text:
    """The elements, with what happened to them as a whole; what is said begins after `width` columns."""
    own = [row for row in entry.rows if not row.label]
    said = [(f"  {row.new}", _TONES.get(row.tone, "")) for row in own]
    remarks = [(f"  {row.relation}", "dim") for row in own if row.relation]
    gap = max(width - len(entry.title), 0) if own else 0
    style = "dim" if all(row.tone is Tone.QUIET for row in entry.rows) else "bold"
    return text((entry.title, style), (" " * gap, ""), *said, *remarks)


class _Columns:
    """Rows below each other: labels, values, and how new values stand to old ones."""

    def __init__(self, label: int, value: int, total: int) -> None:
        self._label, self._value, self._total = label, value, total

    @classmethod
    def of(cls, rows: Sequence[Row], console: Console, guides: int = 8) -> _Columns:
        """Columns that suit these rows; `guides` is what stands before them."""
        total = console.width - guides
        label = min(max((len(row.label) for row in rows), default=0), _WIDEST, total // 2)
        value = max((_value(row).cell_len for row in rows if row.relation), default=0)
        return cls(label, min(value, _VALUES, max(total - label - 18, 12)), total)

    def line(self, row: Row, margin: str = "") -> Text:
        """The row; what does not fit goes to further lines, below the values; `margin` stands before them."""
        from rich.console import Console

        line = text((f"{row.label:<{self._label}}  ", "dim" if row.tone is Tone.QUIET else ""))
        indent = "\n" + margin + " " * (self._label + 2)
        room = self._total - self._label - 2
        if len(row.label) > self._label:
            line.append(indent)
        value, relation = _value(row), text((row.relation, "dim"))
        pieces = value.wrap(Console(width=room), room) if value.cell_len > room else [value]
        for count, piece in enumerate(pieces):
            line.append(indent if count else "").append_text(piece)
        if row.relation:
            last = pieces[-1].cell_len
            gap = max(self._value - last, 0) + 2
            line.append(" " * gap if last + gap + relation.cell_len <= room else indent).append_text(relation)
        return line


def _value(row: Row) -> Text:
    style = _TONES.get(row.tone, "")
    if not row.old:
        return text((row.new, style))
    return text((row.old, style or "dim"), (" → ", "dim"), (row.new, style))


def _effects(comparison: Comparison, console: Console, verbose: bool) -> Iterator[Text]:
    """What the changes do to the model as a whole; what stays the same is not worth a line."""
    found = outline.effects(comparison.effects)
    rows = found if verbose or len(found) <= _EFFECTS else found[: _EFFECTS - 1]
    columns = _Columns.of(rows, console, guides=2)
    if rows:
        yield from (text(("", "")), text(("Effects", "bold")))
    yield from (text(("  ", "")).append_text(columns.line(row, "  ")) for row in rows)
    if len(rows) < len(found):
        yield _more(len(found) - len(rows), "effect")


def _files(comparison: Comparison, console: Console, verbose: bool) -> Iterator[Text]:
    """The files that are concerned, those first that the user has a stake in."""
    actions = [a for a in comparison.result.actions if a.kind not in _SILENT]
    if comparison.in_step or not actions:
        return
    actions.sort(key=lambda action: (action.path not in comparison.edited, action.path.rpartition("/")))
    urgent = sum(action.path in comparison.edited for action in actions)
    few = actions if verbose or len(actions) <= _FILES else actions[: max(_FILES - 1, urgent)]
    yield from (text(("", "")), text((wording.files(comparison), "bold")))
    yield from (_file(comparison, action, console) for action in few)
    if len(few) < len(actions):
        yield _more(len(actions) - len(few), "file")
    if any(action.kind in CONFLICTS for action in actions):
        yield text((_ADVICE, "dim"))


def _file(comparison: Comparison, action: Action, console: Console) -> Text:
    """What happens to a file, and why if it is one that the user edited."""
    word = "waiting" if action.held else action.kind.value.removeprefix("unowned-")
    style = "bold red" if action.kind in CONFLICTS else "yellow" if action.held else _KINDS.get(action.kind, "yellow")
    path = shown(Path(os.path.normpath(comparison.result.root / action.path)))
    line = text((f"  {word:<{_WORD}} ", style), (path, ""))
    if action.path in comparison.edited:
        told = dataclasses.replace(action, held=False).reason  # the word says already that it waits
        reason = text(("you edited it" if comparison.against else told, "yellow"))
        fits = line.cell_len + 2 + reason.cell_len <= console.width
        line.append("  " if fits else "\n" + " " * (_WORD + 3)).append_text(reason)
    return line


def _more(count: int, noun: str) -> Text:
    return text((f"  … and {count} more {noun}{'s' if count > 1 else ''}; --verbose shows them", "dim"))
