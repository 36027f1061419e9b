"""Where the versions of a file in conflict differ: side by side on wide terminals, else one below the other."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, NamedTuple

from urdfsync.engine.conflicts import Conflict
from urdfsync.merge import Merge, split_lines
from urdfsync.merge.sequence import Replacement, compare
from urdfsync.merge.tokens import NEWLINE, tokens
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
_REWRITTEN = 0.6
"""Of lines that changed more than this share of their characters, no part is singled out."""
_ROWS = 3
"""A changed line may take so many rows, others one; of a longer one, what surrounds its first change is shown."""
_NARROW = 20
"""Columns that a line gets on the narrowest terminal."""
_LEAD = 12
"""Characters shown before the first change of a line that is too long."""
_PIPE = 240
"""Characters of one line in a file or pipe; of a longer one, see `_ROWS`."""
_COLOURS = {"base": "red", "mine": "cyan", "generated": "green", "both": "magenta", "": ""}
_SIDES = ("mine", "generated")


class Line(NamedTuple):
    """One line, its number in the version that it belongs to (from 1; 0: none), and what of it is new or gone."""

    number: int
    text: str
    parts: tuple[range, ...] = ()


class Cell(NamedTuple):
    """One side's half of a row: a line as it was (` `), one that the side removed (`-`), added (`+`), or has (`*`)."""

    mark: str
    line: Line


class Row(NamedTuple):
    """What stands side by side."""

    mine: Cell | None
    generated: Cell | None
    clash: bool = False


class Hunk(NamedTuple):
    """A run of lines with changes in it."""

    lines: range
    """Of the user's file, from 1."""
    sides: frozenset[str]
    """Who changed something: `mine`, `generated`."""
    clash: bool
    """The sides contradict each other."""
    rows: list[Row]
    """For two columns."""
    stack: list[tuple[str, Line]]
    """For one column: which version has a line (`base`, `mine`, `generated`, `both`, empty for all), and the line."""


class _Version(NamedTuple):
    """One side, compared with the version that both come from."""

    changes: list[Replacement]
    lines: list[Line]
    gone: dict[int, Line]
    """Lines of the old version that this one has not, by their index."""


class _Group(NamedTuple):
    """Changes that no common line keeps apart: lines of the old version, what they are in both others, and whose."""

    old: range
    new: Mapping[str, range]
    sides: frozenset[str]
    clash: bool


def find_hunks(base: str | None, mine: str, generated: str, merge: Merge | None) -> list[Hunk]:
    """Where base, mine and generated differ; without a base, where the other two do."""
    texts = [split_lines(one.replace("\r\n", NEWLINE)) for one in (mine if base is None else base, mine, generated)]
    old = texts[0]
    versions = {side: _compare(old, lines) for side, lines in zip(_SIDES, texts[1:], strict=True)}
    runs: list[list[_Group]] = []
    for group in _groups(versions, [conflict.base for conflict in merge.conflicts] if merge else []):
        if not runs or group.old.start - runs[-1][-1].old.stop > 2 * CONTEXT:
            runs.append([])
        runs[-1].append(group)
    return [_hunk(run, old, versions, has_base=base is not None) for run in runs]


def _groups(versions: Mapping[str, _Version], clashes: Sequence[range]) -> Iterator[_Group]:
    """The changes of both sides, those together that overlap or touch, as the merge sees them.

    `clashes` are the lines of base, from 1, over which the sides are in conflict.
    """
    waiting = sorted((change, side) for side, version in versions.items() for change in version.changes)
    shifts = dict.fromkeys(versions, 0)  # how far a line of the old version has moved
    while waiting:
        start = stop = waiting[0][0].start
        before, sides = dict(shifts), set()
        while waiting and waiting[0][0].start <= stop:
            change, side = waiting.pop(0)
            sides.add(side)
            stop, shifts[side] = max(stop, change.stop), change.new_stop - change.stop
        new = {side: range(start + before[side], stop + shifts[side]) for side in versions}
        clash = any(start <= lines.start - 1 and lines.stop - 1 <= stop for lines in clashes)
        yield _Group(range(start, stop), new, frozenset(sides), clash)


def _hunk(run: Sequence[_Group], old: Sequence[str], versions: Mapping[str, _Version], *, has_base: bool) -> Hunk:
    first, last = run[0], run[-1]
    place = range(max(0, first.old.start - CONTEXT), min(len(old), last.old.stop + CONTEXT))
    rows: list[Row] = []
    stack: list[tuple[str, Line]] = []
    position = place.start
    shifts = {side: first.new[side].start - first.old.start for side in versions}
    for group in [*run, None]:
        for index in range(position, group.old.start if group else place.stop):
            shown = old[index].rstrip(NEWLINE)
            left, right = (Line(index + shift + 1, shown) for shift in shifts.values())
            rows.append(Row(Cell(" ", left), Cell(" ", right)))
            stack.append(("", left))
        if group:
            rows += _group_rows(group, old, versions, shifts) if has_base else _two_way_rows(group, versions)
            stack += _group_stack(group, versions, has_base=has_base)
            position = group.old.stop
            shifts = {side: lines.stop - group.old.stop for side, lines in group.new.items()}
    start = first.new["mine"].start - (first.old.start - place.start)
    stop = last.new["mine"].stop + (place.stop - last.old.stop)
    sides = frozenset[str]().union(*(group.sides for group in run))
    return Hunk(range(start + 1, stop + 1), sides, any(group.clash for group in run), rows, stack)


def _group_rows(
    group: _Group, old: Sequence[str], versions: Mapping[str, _Version], shifts: Mapping[str, int]
) -> Iterator[Row]:
    """The lines of base with what each side did to them; what is added follows what it replaces."""
    columns = []
    for side, version in versions.items():
        kept: list[Cell | None] = []
        added: dict[int, list[Cell]] = {}
        shift = shifts[side]
        changes = [one for one in version.changes if group.old.start <= one.start and one.stop <= group.old.stop]
        for index in range(group.old.start, group.old.stop + 1):
            for change in changes:
                if change.stop == index:
                    new = version.lines[change.new_start : change.new_stop]
                    added[index] = [Cell("+", line) for line in new]
                    shift = change.new_stop - change.stop
            if index == group.old.stop:
                kept.append(None)
            elif index in version.gone:
                kept.append(Cell("-", version.gone[index]))
            else:
                kept.append(Cell(" ", Line(index + shift + 1, old[index].rstrip(NEWLINE))))
        columns.append((kept, added))
    (ours, our_added), (theirs, their_added) = columns
    for index, left, right in zip(itertools.count(group.old.start), ours, theirs, strict=False):
        new_lines = zip_longest(our_added.get(index, ()), their_added.get(index, ()))
        yield from (Row(one, two, group.clash) for one, two in new_lines)
        if left:
            yield Row(left, right, group.clash)


def _two_way_rows(group: _Group, versions: Mapping[str, _Version]) -> Iterator[Row]:
    """The lines of both sides; nothing tells which of them changed."""
    ours = [Cell("*", versions["generated"].gone[index]) for index in group.old]
    theirs = [Cell("*", versions["generated"].lines[index]) for index in group.new["generated"]]
    return (Row(left, right) for left, right in zip_longest(ours, theirs))


def _group_stack(group: _Group, versions: Mapping[str, _Version], *, has_base: bool) -> Iterator[tuple[str, Line]]:
    """The versions of some lines one below the other."""
    sides = [side for side in _SIDES if side in group.sides]
    for index in group.old:
        found = [versions[side].gone[index] for side in sides if index in versions[side].gone]
        yield "base" if has_base else "mine", next((line for line in found if line.parts), found[0])
    new = {side: [versions[side].lines[index] for index in group.new[side]] for side in sides}
    if len(sides) == 2 and [line.text for line in new["mine"]] == [line.text for line in new["generated"]]:
        new = {"both": new["mine"]}
    for label, lines in new.items():
        yield from ((label, line) for line in lines or ([Line(0, "(removed)")] if has_base else []))


def _compare(old: Sequence[str], new: Sequence[str]) -> _Version:
    """Compare two versions, and find out which parts of their lines changed."""
    changes = compare(old, new)
    lines = [Line(number, line.rstrip(NEWLINE)) for number, line in enumerate(new, start=1)]
    gone: dict[int, Line] = {}
    for change in changes:
        before, after = "".join(old[change.start : change.stop]), "".join(new[change.new_start : change.new_stop])
        is_blank = bool(before and after) and "".join(before.split()) == "".join(after.split())
        parts: list[list[range]] = [[], []]
        if before and after and not is_blank:
            words = tokens(before), tokens(after)
            found = compare(*words, minimal=True)
            spans = [(one.start, one.stop) for one in found], [(one.new_start, one.new_stop) for one in found]
            joined = [_character_ranges(*pair) for pair in zip(words, spans, strict=True)]
            shares = [
                sum(len("".join(side[part.start : part.stop].split())) for part in ranges) / len("".join(side.split()))
                for side, ranges in zip((before, after), joined, strict=True)
                if side.strip()
            ]
            parts = joined if min(shares, default=1) <= _REWRITTEN else parts
        gone |= {line.number - 1: line for line in _lines(before, change.start, parts[0], is_blank)}
        lines[change.new_start : change.new_stop] = _lines(after, change.new_start, parts[1], is_blank)
    return _Version(changes, lines, gone)


def _character_ranges(words: Sequence[str], spans: Sequence[tuple[int, int]]) -> list[range]:
    """Ranges of words as ranges of characters; those with nothing but white space between them are one."""
    offsets = [0, *itertools.accumulate(map(len, words))]
    ranges: list[range] = []
    for start, stop in spans:
        if ranges and all(word.isspace() for word in words[offsets.index(ranges[-1].stop) : start]):
            ranges[-1] = range(ranges[-1].start, offsets[stop])
        else:
            ranges.append(range(offsets[start], offsets[stop]))
    return ranges


def _lines(joined: str, first: int, parts: Sequence[range], is_blank: bool) -> Iterator[Line]:
    """Cut a text into lines, the first of which has the index `first`, and its changed parts with it."""
    begin = 0
    for number, line in enumerate(split_lines(joined), start=first + 1):
        shown = line.rstrip(NEWLINE)
        own = []
        for part in parts:
            start, stop = max(part.start - begin, 0), min(part.stop - begin, len(shown))
            changed = shown[start:stop]
            if changed.strip():
                own.append(range(stop - len(changed.lstrip()), start + len(changed.rstrip())))
        if is_blank:
            shown = shown.replace(" ", "·").replace("\t", "→")
        yield Line(number, shown if line.endswith(NEWLINE) else f"{shown}  (no end of line)", tuple(own))
        begin += len(line)


# --- lines for people ---------------------------------------------------------------------------------------------


def difference_lines(conflict: Conflict, console: Console, verbose: bool) -> tuple[list[Text], int]:
    """The versions of a file where they differ, and the number of lines that were left out for want of room."""
    hunks = find_hunks(conflict.base, conflict.mine, conflict.generated, conflict.merge)
    numbers = (cell.line.number for hunk in hunks for row in hunk.rows for cell in row[:2] if cell)
    digits = len(str(max(numbers, default=1)))
    lines: list[Text] = []
    if is_wide := console.is_terminal and console.width >= _WIDE:
        bar = "│" if has_marks(console.file) else "|"
        lines.append(text((f"    {'mine':<{(console.width - 7) // 2}} {bar} generated", "bold")))
    sizes = [1 + len(hunk.rows if is_wide else hunk.stack) for hunk in hunks]
    kept: list[int] = []
    for index in sorted(range(len(hunks)), key=lambda index: not hunks[index].clash):
        if kept and not verbose and sum(sizes[other] for other in (*kept, index)) > LINES:
            break
        kept.append(index)
    left_out = sum(sizes) - sum(sizes[index] for index in kept)
    for index in sorted(kept):
        hunk = hunks[index]
        painted = _side_by_side(hunk, console, digits) if is_wide else _stacked(hunk, console, digits)
        rows = [_title(hunk, conflict, console), *painted]
        room = len(rows) if verbose else LINES
        lines += rows[:room]
        left_out += len(rows[room:])
    return lines, left_out


def _title(hunk: Hunk, conflict: Conflict, console: Console) -> Text:
    first, last = hunk.lines.start, hunk.lines.stop - 1
    where = f"lines {first} to {last}" if last > first else f"line {first}" if last == first else "empty"
    if hunk.clash:
        what = "the sides contradict each other"
    elif conflict.base is None:
        what = "not the same"
    else:
        what = {"mine": "your edit", "generated": "new"}.get("".join(hunk.sides), "your edit and what is new")
    rule = "──" if has_marks(console.file) else "--"
    return text((f"    {rule} {where}: ", "dim"), (what, "bold red" if hunk.clash else ""))


def _side_by_side(hunk: Hunk, console: Console, digits: int) -> Iterator[Text]:
    """Mine and generated in two columns; long lines go on below."""
    from rich.text import Text

    bar, clash = ("│", "┃") if has_marks(console.file) else ("|", "!")
    half = (console.width - 7) // 2
    for row in hunk.rows:
        halves: list[list[Text]] = []
        for side, cell in zip(_SIDES, row[:2], strict=True):
            halves.append([])
            if cell:
                style = {"-": "red", " ": "dim"}.get(cell.mark, _COLOURS[side])
                gutter = Text(f"{cell.line.number:>{digits}} {cell.mark} ", style)
                wrapped = _wrapped(cell.line, style, half - digits - 3, console, rows=1 if cell.mark == " " else _ROWS)
                for part in wrapped:
                    halves[-1].append(Text.assemble(gutter, part))
                    gutter = Text(" " * gutter.cell_len)
        for left, right in zip_longest(*halves):
            mine = left or Text()
            mine.pad_right(half - mine.cell_len)
            middle = (clash, "bold red") if row.clash else (bar, "dim")
            yield Text.assemble("    ", mine, " ", middle, *([" ", right] if right else []))


def _stacked(hunk: Hunk, console: Console, digits: int) -> Iterator[Text]:
    """The versions one below the other, each line with the name of its version."""
    from rich.text import Text

    for label, line in hunk.stack:
        style = _COLOURS[label] or "dim"
        gutter = Text(f"    {label:<9}  {line.number or '':>{digits}}  ", style)
        if console.is_terminal:
            room = max(_NARROW, console.width - digits - 17)
            wrapped = _wrapped(line, style, room, console, rows=_ROWS if label else 1)
        else:
            wrapped = [_painted(line, style, _PIPE)]
        for part in wrapped:
            row = Text.assemble(gutter, part)
            row.rstrip()
            yield row
            gutter = Text(" " * gutter.cell_len)


def _wrapped(line: Line, style: str, room: int, console: Console, *, rows: int) -> list[Text]:
    painted = _painted(line, style, room * rows)
    return list(painted.wrap(console, room, overflow="fold", tab_size=4)) or [painted]


def _painted(line: Line, style: str, room: int) -> Text:
    """A line with its changed parts set off; cut around the first of them if it is longer than `room` characters."""
    from rich.text import Text

    start, stop = 0, len(line.text)
    if stop > room:
        first = line.parts[0].start if line.parts else 0
        start = max(0, min(first - _LEAD, stop - room + 2))
        stop = min(stop, start + room - 2)
    pieces, position = [("…", "dim")] if start else [], start
    for part in line.parts:
        inside = range(max(part.start, start), min(part.stop, stop))
        if inside:
            pieces.append((line.text[position : inside.start], style))
            pieces.append((line.text[inside.start : inside.stop], f"bold underline {style}"))
            position = inside.stop
    pieces.append((line.text[position:stop], style))
    pieces += [("…", "dim")] if stop < len(line.text) else []
    return Text.assemble(*((visible(piece.replace("\t", "    ")), look) for piece, look in pieces))
