"""Where the versions of a file in conflict differ: side by side on wide terminals, else one below the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby, zip_longest
from typing import TYPE_CHECKING, NamedTuple

from urdfsync.engine.conflicts import Conflict
from urdfsync.merge import Merge, split_lines
from urdfsync.merge.sequence import compare
from urdfsync.output.console import has_marks, text, visible

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

CONTEXT = 2
"""So many unchanged lines are shown around changed ones."""
LINES = 30
"""So many lines of a conflict are shown without --verbose."""
_WIDE = 100
"""Columns from which a terminal has room for two versions side by side."""
_ROWS = 3
"""A changed line may take so many rows, others one; of a longer one, what surrounds its change is shown."""
_NARROW = 20
"""Columns that a line gets on the narrowest terminal."""
_LEAD = 12
"""Characters shown before the change of a line that is too long."""
_PIPE = 240
"""Characters of one line in a file or pipe; of a longer one, see `_ROWS`."""
_COLOURS = {"base": "red", "mine": "cyan", "generated": "green", "both": "magenta", "": "dim"}


class Line(NamedTuple):
    """One line of a version: as it was (` `), removed (`-`), added (`+`), or in this version alone (`*`)."""

    mark: str
    number: int
    """In the version that has it, from 1; 0 for none."""
    text: str
    changed: range = range(0)
    """Its characters that differ from those of the line in its place."""


class Row(NamedTuple):
    """What stands side by side."""

    mine: Line | None
    generated: Line | None

    @property
    def is_context(self) -> bool:
        """Whether neither side changed the line."""
        return all(line is not None and line.mark == " " for line in self)


class Hunk(NamedTuple):
    """A run of lines with changes in it."""

    rows: list[Row]
    clash: bool
    """The sides contradict each other."""


class _Version(NamedTuple):
    """One side, compared with the version that both come from; lines by their index in that one."""

    lines: dict[int, Line]
    added: dict[int, list[Line]]
    """By the line before which they stand."""
    changes: list[tuple[int, int]]


def find_hunks(base: str | None, mine: str, generated: str, merge: Merge | None) -> list[Hunk]:
    """Where base, mine and generated differ; without a base, where the other two do."""
    texts = [split_lines(one.replace("\r\n", "\n")) for one in (mine if base is None else base, mine, generated)]
    size, versions = len(texts[0]), [_compare(texts[0], lines) for lines in texts[1:]]
    hunks: list[range] = []
    for start, stop in sorted(change for version in versions for change in version.changes):
        if hunks and start - hunks[-1].stop <= 2 * CONTEXT:
            hunks[-1] = range(hunks[-1].start, max(hunks[-1].stop, stop))
        else:
            hunks.append(range(start, stop))
    clashes = [conflict.base for conflict in merge.conflicts] if merge else []
    found = []
    for hunk in hunks:
        place = range(max(0, hunk.start - CONTEXT), min(size, hunk.stop + CONTEXT))
        rows = list(_rows(versions, place, hunk.stop == size))
        clash = any(hunk.start < lines.start <= lines.stop <= hunk.stop + 1 for lines in clashes)
        found.append(Hunk(rows if base is not None else list(map(_without_base, rows)), clash))
    return found


def _rows(versions: Sequence[_Version], place: range, is_last: bool) -> Iterator[Row]:
    """The lines of base with what each side did to them; what is added follows what it replaces."""
    for index in range(place.start, place.stop + is_last):
        yield from (Row(*pair) for pair in zip_longest(*(version.added.get(index, ()) for version in versions)))
        if index in place:
            yield Row(*(version.lines[index] for version in versions))


def _without_base(row: Row) -> Row:
    """The same where mine stands for a base: nothing tells which side changed something."""
    mine, generated = row
    if mine is not None and generated is not None:
        return row if row.is_context else Row(generated._replace(mark="*"), None)
    return Row(None, generated and generated._replace(mark="*"))


def _compare(old: Sequence[str], new: Sequence[str]) -> _Version:
    lines: dict[int, Line] = {}
    added: dict[int, list[Line]] = {}
    position = shift = 0
    changes = compare(old, new)
    for start, stop, new_start, new_stop in changes:
        lines |= {index: _line(" ", index + shift, old[index]) for index in range(position, start)}
        before, after = old[start:stop], new[new_start:new_stop]
        parts = [(range(0), range(0))] * max(len(before), len(after))
        if len(before) == len(after):
            parts = [_changed(*pair) for pair in zip(before, after, strict=True)]
        for index, line in enumerate(before):
            lines[start + index] = _line("-", start + index, line, parts[index][0])
        added[stop] = [_line("+", new_start + index, line, parts[index][1]) for index, line in enumerate(after)]
        position, shift = stop, new_stop - stop
    lines |= {index: _line(" ", index + shift, old[index]) for index in range(position, len(old))}
    return _Version(lines, added, [(change.start, change.stop) for change in changes])


def _changed(old: str, new: str) -> tuple[range, range]:
    """What is between the beginning and the end that two lines share."""
    start = _shared(old, new)
    end = _shared(old[start:][::-1], new[start:][::-1])
    return range(start, len(old) - end), range(start, len(new) - end)


def _shared(one: str, two: str) -> int:
    """So many characters at their beginning are the same."""
    pairs = enumerate(zip(one, two, strict=False))
    return next((index for index, (a, b) in pairs if a != b), min(len(one), len(two)))


def _line(mark: str, index: int, line: str, changed: range = range(0)) -> Line:
    return Line(mark, index + 1, line[:-1] if line.endswith("\n") else f"{line}  (no end of line)", changed)


def stack(rows: Sequence[Row]) -> Iterator[tuple[str, Line]]:
    """Lines one below the other, each with the version that has it: base, mine, generated, both; empty for all."""
    for is_context, run in groupby(rows, lambda row: row.is_context):
        group = list(run)
        if is_context:
            yield from (("", row.mine) for row in group if row.mine)
            continue
        cells = [[line for row in group if (line := row[side])] for side in (0, 1)]
        gone = [line for row in group if (line := next((one for one in row if one and one.mark == "-"), None))]
        yield from (("base", line) for line in gone)
        new = {
            name: [line for line in side if line.mark != "-"]
            for name, side in zip(("mine", "generated"), cells, strict=True)
            if any(line.mark != " " for line in side)
        }
        if len(new) == 2 and [line.text for line in new["mine"]] == [line.text for line in new["generated"]]:
            new = {"both": new["mine"]}
        for name, found in new.items():
            yield from ((name, line) for line in found or [Line("-", 0, "(removed)")])


# --- lines for people ---------------------------------------------------------------------------------------------


def difference_lines(conflict: Conflict, console: Console, verbose: bool) -> tuple[list[Text], int]:
    """The versions of a file where they differ, and the number of lines that were left out for want of room.

    Contradictions come first if there is no room for all.
    """
    hunks = find_hunks(conflict.base, conflict.mine, conflict.generated, conflict.merge)
    digits = len(str(max((line.number for hunk in hunks for row in hunk.rows for line in row if line), default=1)))
    is_wide = console.is_terminal and console.width >= _WIDE
    show = _side_by_side if is_wide else _stacked
    painted = [[_title(hunk, conflict, console), *show(hunk, console, digits)] for hunk in hunks]
    kept: list[int] = []
    for index in sorted(range(len(hunks)), key=lambda index: not hunks[index].clash):
        if kept and not verbose and sum(len(painted[other]) for other in (*kept, index)) > LINES:
            break
        kept.append(index)
    lines = [line for index in sorted(kept) for line in painted[index][: None if verbose else LINES]]
    left_out = sum(map(len, painted)) - len(lines)
    if is_wide:
        bar = "│" if has_marks(console.file) else "|"
        lines.insert(0, text((f"    {'mine':<{(console.width - 7) // 2}} {bar} generated", "bold")))
    return lines, left_out


def _title(hunk: Hunk, conflict: Conflict, console: Console) -> Text:
    numbers = [row.mine.number for row in hunk.rows if row.mine and row.mine.mark != "-"]
    first, last = min(numbers, default=0), max(numbers, default=0)
    where = f"lines {first} to {last}" if last > first else f"line {first}" if first else "empty"
    sides = [any(line and line.mark != " " for line in column) for column in zip(*hunk.rows, strict=True)]
    what = "your edit and what is new" if all(sides) else "your edit" if sides[0] else "new"
    if hunk.clash or conflict.base is None:
        what = "the sides contradict each other" if hunk.clash else "not the same"
    rule = "──" if has_marks(console.file) else "--"
    return text((f"    {rule} {where}: ", "dim"), (what, "bold red" if hunk.clash else ""))


def _side_by_side(hunk: Hunk, console: Console, digits: int) -> Iterator[Text]:
    """Mine and generated in two columns; long lines go on below."""
    from rich.text import Text

    bar, half = "│" if has_marks(console.file) else "|", (console.width - 7) // 2
    for row in hunk.rows:
        halves: list[list[Text]] = [[], []]
        for side, line, colour in zip(halves, row, ("cyan", "green"), strict=True):
            if line:
                style = {"-": "red", " ": "dim"}.get(line.mark, colour)
                gutter = f"{line.number:>{digits}} {line.mark} "
                side += _wrapped(line, gutter, style, half, console, rows=1 if line.mark == " " else _ROWS)
        for mine, generated in zip_longest(*halves):
            left = mine or Text()
            left.pad_right(half - left.cell_len)
            yield Text.assemble("    ", left, (f" {bar} ", "dim"), generated or "")


def _stacked(hunk: Hunk, console: Console, digits: int) -> Iterator[Text]:
    """The versions one below the other, each line with the name of its version."""
    for name, line in stack(hunk.rows):
        gutter = f"    {name:<9}  {line.number or '':>{digits}}  "
        room = max(_NARROW + len(gutter), console.width) if console.is_terminal else _PIPE + len(gutter)
        rows = _ROWS if name and console.is_terminal else 1
        yield from _wrapped(line, gutter, _COLOURS[name], room, console, rows=rows)


def _wrapped(line: Line, gutter: str, style: str, width: int, console: Console, *, rows: int) -> list[Text]:
    """A line in so many columns and rows, its change set off; cut around that if it is longer."""
    from rich.text import Text

    room = width - len(gutter)
    start, stop = 0, len(line.text)
    if stop > room * rows:
        start = max(0, min(line.changed.start - _LEAD, stop - room * rows + 2))
        stop = min(stop, start + room * rows - 2)
    first, last = (min(max(end, start), stop) for end in (line.changed.start, line.changed.stop))
    pieces = [
        ("…" if start else "", "dim"),
        (line.text[start:first], style),
        (line.text[first:last], f"bold underline {style}"),
        (line.text[last:stop], style),
        ("…" if stop < len(line.text) else "", "dim"),
    ]
    painted = Text.assemble(*((visible(piece.replace("\t", "    ")), look) for piece, look in pieces))
    parts = list(painted.wrap(console, room, overflow="fold")) or [painted]
    found = [Text.assemble((" " * len(gutter) if number else gutter, style), part) for number, part in enumerate(parts)]
    for row in found:
        row.rstrip()
    return found
