"""Differences of a file's versions as lines: side by side on wide terminals, else one below the other."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from urdfsync.engine.conflicts import Conflict
from urdfsync.output import hunks
from urdfsync.output.console import has_marks, text, visible

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

WIDE = 100
"""Columns from which a terminal has room for two versions side by side."""
LINES = 30
"""So many lines of a conflict are shown without --verbose."""
_ROWS = 3
"""A changed line may take so many rows, others one; of a longer one, what surrounds its first change is shown."""
_NARROW = 20
"""Columns that a line gets on the narrowest terminal."""
_LEAD = 12
"""Characters shown before the first change of a line that is too long."""
_PIPE = 240
"""Characters of one line in a file or pipe; of a longer one, see `_ROWS`."""
_COLOURS = {"base": "red", "mine": "cyan", "generated": "green", "both": "magenta", "": ""}


def difference_lines(standoff: Conflict, console: Console, verbose: bool) -> tuple[list[Text], int]:
    """The versions of a file where they differ, and the number of lines that were left out for want of room."""
    found = hunks.hunks(standoff.base, standoff.mine, standoff.generated, standoff.merge)
    cells = (cell for hunk in found for row in hunk.rows for cell in (row.mine, row.generated) if cell)
    widest = len(str(max((cell.line.number for cell in cells), default=1)))
    is_wide = console.is_terminal and console.width >= WIDE
    painter = (_Columns if is_wide else _Stack)(console, widest)
    sizes = [1 + len(hunk.rows if is_wide else hunk.stack) for hunk in found]
    fitting = range(len(found)) if verbose else _fitting(sizes, [hunk.clash for hunk in found], LINES)
    left_out = sum(sizes) - sum(sizes[index] for index in fitting)
    lines = list(painter.head())
    for index in fitting:
        rows = [_title(found[index], standoff, console), *painter.lines(found[index])]
        room = len(rows) if verbose else LINES
        lines += rows[:room]
        left_out += len(rows[room:])
    return lines, left_out


def _title(hunk: hunks.Hunk, standoff: Conflict, console: Console) -> Text:
    first, last = hunk.lines.start, hunk.lines.stop - 1
    where = f"lines {first} to {last}" if last > first else f"line {first}" if last == first else "empty"
    style = "bold red" if hunk.clash else ""
    if hunk.clash:
        what = "the sides contradict each other"
    elif standoff.base is None:
        what = "not the same"
    else:
        what = {"mine": "your edit", "generated": "new"}.get("".join(hunk.sides), "your edit and what is new")
    rule = "──" if has_marks(console.file) else "--"
    return text((f"    {rule} {where}: ", "dim"), (what, style))


class _Columns:
    """Mine and generated side by side."""

    def __init__(self, console: Console, widest: int) -> None:
        self._console, self._widest = console, widest
        self._bar, self._clash = ("│", "┃") if has_marks(console.file) else ("|", "!")
        self._half = (console.width - 4 - 3) // 2
        self._room = self._half - widest - 3

    def head(self) -> Iterator[Text]:
        """The names of the columns."""
        title = f"{'mine':<{self._half}} {self._bar} generated"
        yield text((f"    {title}", "bold"))

    def lines(self, hunk: hunks.Hunk) -> Iterator[Text]:
        """The rows of a hunk; long lines go on below."""
        from rich.text import Text

        for row in hunk.rows:
            halves = [self._cell(row.mine, "mine"), self._cell(row.generated, "generated")]
            for mine, generated in itertools.zip_longest(*halves):
                left = mine or Text()
                left.pad_right(self._half - left.cell_len)
                bar = (self._clash, "bold red") if row.clash else (self._bar, "dim")
                yield Text.assemble("    ", left, " ", bar, *([" ", generated] if generated else []))

    def _cell(self, cell: hunks.Cell | None, side: str) -> list[Text]:
        from rich.text import Text

        if cell is None:
            return []
        style = {"-": "red", " ": "dim"}.get(cell.mark, _COLOURS[side])
        gutter = Text(f"{cell.line.number:>{self._widest}} {cell.mark} ", "dim" if cell.mark == " " else style)
        rows = 1 if cell.mark == " " else _ROWS
        parts = _wrapped(_painted(cell.line, style, self._room * rows), self._room, self._console)
        blank = Text(" " * gutter.cell_len)
        return [Text.assemble(blank if number else gutter, part) for number, part in enumerate(parts)]


class _Stack:
    """The versions one below the other, each line with the name of its version."""

    def __init__(self, console: Console, widest: int) -> None:
        self._console, self._widest = console, widest
        self._room = max(_NARROW, console.width - widest - 17) if console.is_terminal else _PIPE

    def head(self) -> Iterator[Text]:
        """Nothing: each line says what it is."""
        return iter(())

    def lines(self, hunk: hunks.Hunk) -> Iterator[Text]:
        """The lines of a hunk."""
        from rich.text import Text

        for label, line, _ in hunk.stack:
            style = _COLOURS[label]
            number = line.number or ""
            gutter = Text(f"    {label:<9}  {number:>{self._widest}}  ", style or "dim")
            blank = Text(" " * gutter.cell_len)
            for part in self._rows(line, style or "dim", _ROWS if label else 1):
                row = Text.assemble(gutter, part)
                row.rstrip()
                yield row
                gutter = blank

    def _rows(self, line: hunks.Line, style: str, rows: int) -> list[Text]:
        if not self._console.is_terminal:
            return [_painted(line, style, self._room)]
        return _wrapped(_painted(line, style, self._room * rows), self._room, self._console)


def _painted(line: hunks.Line, style: str, room: int) -> Text:
    """A line with its changed parts set off; cut around the first of them if it is longer than `room` characters."""
    from rich.text import Text

    start, stop = 0, len(line.text)
    if stop > room:
        first = line.parts[0].start if line.parts else 0
        start = max(0, min(first - _LEAD, stop - room + 2))
        stop = min(stop, start + room - 2)
    pieces, position = [("…", "dim")] if start else [], start
    for part in line.parts:
        part = range(max(part.start, start), min(part.stop, stop))
        if part:
            changed = line.text[part.start : part.stop]
            pieces += [(line.text[position : part.start], style), (changed, f"bold underline {style}")]
            position = part.stop
    pieces.append((line.text[position:stop], style))
    pieces += [("…", "dim")] if stop < len(line.text) else []
    return Text.assemble(*((visible(piece.replace("\t", "    ")), look) for piece, look in pieces))


def _wrapped(line: Text, room: int, console: Console) -> list[Text]:
    return list(line.wrap(console, room, overflow="fold", tab_size=4)) or [line]


def _fitting(sizes: Sequence[int], first: Sequence[bool], limit: int) -> Sequence[int]:
    """Which parts there is room for, at least one, in order; some come `first`."""
    kept: list[int] = []
    room = limit
    for index in sorted(range(len(sizes)), key=lambda index: not first[index]):
        room -= sizes[index]
        if kept and room < 0:
            break
        kept.append(index)
    return sorted(kept)
