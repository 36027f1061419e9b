"""How a comparison of two versions looks: a tree of changes by element, what follows from them, and the files."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.comparing import outline
from urdfsync.comparing.comparison import Comparison
from urdfsync.comparing.outline import Entry, Row, Tone
from urdfsync.config import shown
from urdfsync.engine.actions import CONFLICTS, Action, Kind
from urdfsync.output.console import has_marks, text
from urdfsync.output.phrases import GENERATOR, change_classes, counted, error_count
from urdfsync.output.phrases import summary as build_summary

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.text import Text

_ADVICE = "  settle a conflict with `urdfsync resolve FILE --keep` (or --take, --merge)"
_TONES = {Tone.ADDED: "green", Tone.REMOVED: "red", Tone.RENAMED: "cyan", Tone.QUIET: "dim"}
_WIDEST = 44
"""Columns for labels at most; the values of longer ones go to the next line."""
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
    return text(*marks, (comparison.result.robot, "bold"), (f": {summary(comparison)}", ""))


def _tree(comparison: Comparison, console: Console, verbose: bool) -> RenderableType:
    from rich.tree import Tree

    tree = Tree(headline(comparison, console), guide_style="dim")
    if comparison.changes is None:
        return tree
    if comparison.changes.generator:
        tree.add(text(("urdfsync", "bold"), ("  a template, an option or the program itself changed", "")))
    found = outline.outline(comparison.changes, everything=verbose)
    columns = _Columns.of([row for entry in found.entries for row in entry.rows], console)
    titles = _Columns.of([_titled(entry) for entry in found.entries if entry.rows[0].label == ""], console, guides=4)
    for entry in found.entries:
        beside = entry.rows[0].label == ""
        style = "dim" if all(row.tone is Tone.QUIET for row in entry.rows) else "bold"
        branch = tree.add(titles.line(_titled(entry), style=style) if beside else text((entry.title, style)))
        for row in entry.rows[beside:]:
            branch.add(columns.line(row))
    if found.condensed:
        tree.add(text(("numbers are counted; --verbose shows each", "dim")))
    return tree


def _titled(entry: Entry) -> Row:
    """What happened to elements as a whole, beside their names."""
    return msgspec.structs.replace(entry.rows[0], label=entry.title)


class _Columns:
    """Rows below each other: labels, values, and how new values stand to old ones."""

    def __init__(self, label: int, value: int, total: int) -> None:
        self._label, self._value, self._total = label, value, total

    @classmethod
    def of(cls, rows: Sequence[Row], console: Console, guides: int = 8) -> _Columns:
        """Columns that suit these rows; `guides` is what stands before them."""
        total = console.width - guides
        widest = min(_WIDEST, total // 3)
        label = max((len(row.label) for row in rows if len(row.label) <= widest), default=widest if rows else 0)
        value = max((_value(row).cell_len for row in rows if row.relation), default=0)
        return cls(label, min(value, _VALUES, max(total - label - 18, 12)), total)

    def line(self, row: Row, margin: str = "", style: str = "") -> Text:
        """The row; what does not fit goes to further lines, below the values; `margin` stands before them."""
        line = text((f"{row.label:<{self._label}}  ", style or ("dim" if row.tone is Tone.QUIET else "")))
        indent = "\n" + margin + " " * (self._label + 2)
        room = self._total - self._label - 2
        if len(row.label) > self._label:
            line.append(indent)
        pieces = _wrapped(row, room)
        for count, piece in enumerate(pieces):
            line.append(indent if count else "").append_text(piece)
        if row.relation:
            relation, last = text((row.relation, "dim")), pieces[-1].cell_len
            gap = max(self._value - last, 0) + 2
            line.append(" " * gap if last + gap + relation.cell_len <= room else indent).append_text(relation)
        return line


def _wrapped(row: Row, room: int) -> list[Text]:
    """The values of a row in lines of at most so many columns, broken at the arrow if they must be broken."""
    from rich.console import Console

    value = _value(row)
    if value.cell_len <= room:
        return [value]
    new = _value(msgspec.structs.replace(row, old=""))
    parts = [text((row.old, "dim")), text(("→ ", "dim")).append_text(new)] if row.old else [new]
    return [line for part in parts for line in part.wrap(Console(width=room), room)]


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
    yield from (text(("", "")), text((_file_heading(comparison), "bold")))
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
        told = msgspec.structs.replace(action, held=False).reason  # the word says already that it waits
        reason = text(("you edited it" if comparison.against else told, "yellow"))
        fits = line.cell_len + 2 + reason.cell_len <= console.width
        line.append("  " if fits else "\n" + " " * (_WORD + 3)).append_text(reason)
    return line


def summary(found: Comparison) -> str:
    """What changed since the older version, as the rest of a line that names the robot."""
    if found.result.failed:
        return f"{error_count(found.result.diagnostics)}, so nothing can be compared"
    if found.missing:
        return found.missing
    since = f"since {'the last build' if found.against is None else found.against}"
    if found.changes is None:
        return f"nothing changed {since}{'' if found.in_step else ', but files are not as they should be'}"
    what = change_classes(found.changes) if found.changes.changes else GENERATOR
    return f"{what} {since}{', only by rounding' if found.changes.noise else ''}"


def _file_heading(found: Comparison) -> str:
    """What happens to the files of a package, as a heading."""
    if found.against is None:
        return f"A build: {build_summary(found.result)}"
    number, kinds = len(found.result.actions), Counter(action.kind for action in found.result.actions)
    parts = ", ".join(f"{kinds[kind]} to {kind}" for kind in (Kind.UPDATE, Kind.CREATE, Kind.DELETE) if kinds[kind])
    head = f"{counted(number, 'file')} of the package {'differs' if number == 1 else 'differ'}"
    return f"{head}: {parts}" if len(kinds) > 1 else head


def _more(count: int, noun: str) -> Text:
    return text((f"  … and {count} more {noun}{'s' if count > 1 else ''}; --verbose shows them", "dim"))
