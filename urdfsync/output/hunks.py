"""Where the versions of a text differ, as rows to show: side by side, or one below the other. Knows no terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple

import msgspec

from urdfsync.merge import Merge, split_lines
from urdfsync.merge.sequence import Replacement, compare
from urdfsync.merge.tokens import NEWLINE, tokens

CONTEXT = 2
"""So many unchanged lines are shown around changed ones."""
_REWRITTEN = 0.6
"""Of lines that changed more than this share of their characters, no part is singled out."""
_REMOVED = "(removed)"
_NO_END = "  (no end of line)"


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


class Labelled(NamedTuple):
    """A line of a stack: the versions that have it (`base`, `mine`, `generated`, `both`), or empty for all."""

    label: str
    line: Line
    clash: bool = False


class Hunk(NamedTuple):
    """A run of lines with changes in it."""

    lines: range
    """Of the user's file, from 1."""
    sides: frozenset[str]
    """Who changed something: `mine`, `generated`."""
    clash: bool
    """The sides contradict each other."""
    rows: tuple[Row, ...]
    stack: tuple[Labelled, ...]


def hunks(base: str | None, mine: str, generated: str, merge: Merge | None) -> list[Hunk]:
    """Where base, mine and generated differ; without a base, where the other two do."""
    if base is None:
        return _TwoWay(_lines(mine), _lines(generated)).hunks()
    clashes = [conflict.base for conflict in merge.conflicts] if merge else []
    return _ThreeWay(_lines(base), _lines(mine), _lines(generated), clashes).hunks()


class _Group(NamedTuple):
    """Changes that no common line keeps apart: lines of base, what they are in both versions, and whose changes."""

    base: range
    mine: range
    generated: range
    sides: frozenset[str]
    clash: bool = False


class _TwoWay:
    """Two versions that no third one explains."""

    def __init__(self, mine: Sequence[str], generated: Sequence[str]) -> None:
        self._mine, self._generated = mine, generated
        changes = compare(mine, generated)
        self._parts = _Parts(mine, generated, changes)
        both = frozenset({"mine", "generated"})
        self._groups = [
            _Group(range(c.start, c.stop), range(c.start, c.stop), range(c.new_start, c.new_stop), both)
            for c in changes
        ]

    def hunks(self) -> list[Hunk]:
        """Runs of differences that are near each other."""
        return [self._hunk(run, place) for run, place in _runs(self._groups, len(self._mine))]

    def _hunk(self, groups: Sequence[_Group], place: range) -> Hunk:
        rows: list[Row] = []
        stack: list[Labelled] = []
        position, shift = place.start, groups[0].generated.start - groups[0].mine.start
        for group in [*groups, None]:
            for index in range(position, group.mine.start if group else place.stop):
                line = Line(index + 1, self._mine[index].rstrip(NEWLINE))
                rows.append(Row(Cell(" ", line), Cell(" ", line._replace(number=index + shift + 1))))
                stack.append(Labelled("", line))
            if group:
                ours = [self._parts.old_line(index) for index in group.mine]
                theirs = [self._parts.new_line(index) for index in group.generated]
                rows += [
                    Row(left and Cell("*", left), right and Cell("*", right))
                    for left, right in zip_longest(ours, theirs)
                ]
                stack += [Labelled("mine", line) for line in ours] + [Labelled("generated", line) for line in theirs]
                position, shift = group.mine.stop, group.generated.stop - group.mine.stop
        return Hunk(
            range(place.start + 1, place.stop + 1), groups[0].sides, clash=False, rows=tuple(rows), stack=tuple(stack)
        )


class _ThreeWay:
    """Two versions, and the one that both come from."""

    def __init__(
        self, base: Sequence[str], mine: Sequence[str], generated: Sequence[str], clashes: Sequence[range]
    ) -> None:
        """`clashes` are the lines of base, from 1, over which the sides are in conflict."""
        self._base, self._texts = base, {"mine": mine, "generated": generated}
        self._changes = {side: compare(base, text) for side, text in self._texts.items()}
        self._parts = {side: _Parts(base, text, self._changes[side]) for side, text in self._texts.items()}
        self._halves = {side: list(self._half(side)) for side in self._texts}
        self._groups = list(_groups(self._changes["mine"], self._changes["generated"], clashes))

    def hunks(self) -> list[Hunk]:
        """Runs of changes that are near each other."""
        return [self._hunk(run, place) for run, place in _runs(self._groups, len(self._base))]

    def _hunk(self, groups: Sequence[_Group], place: range) -> Hunk:
        first, last = groups[0], groups[-1]
        start, stop = (
            first.mine.start - (first.base.start - place.start),
            last.mine.stop + (place.stop - last.base.stop),
        )
        sides = frozenset[str]().union(*(group.sides for group in groups))
        clash = any(group.clash for group in groups)
        lines = range(start + 1, stop + 1)
        return Hunk(lines, sides, clash, tuple(self._rows(groups, place)), tuple(self._stack(groups, place, start)))

    def _rows(self, groups: Sequence[_Group], place: range) -> Iterator[Row]:
        """The lines of base with what each side did to them; what is added follows what it replaces."""
        for index in range(place.start, place.stop + 1):
            clash = any(group.clash and group.base.start <= index <= group.base.stop for group in groups)
            (added, kept), (others, other) = (self._halves[side][index] for side in ("mine", "generated"))
            yield from (Row(left, right, clash) for left, right in zip_longest(added, others))
            if kept and other and index < place.stop:
                inside = any(group.clash and index in group.base for group in groups)
                yield Row(kept, other, inside)

    def _half(self, side: str) -> Iterator[tuple[list[Cell], Cell | None]]:
        """For each line of base, and for its end: what the side added before it, and what became of it."""
        parts, shift = self._parts[side], 0
        changes = iter(self._changes[side])
        change = next(changes, None)
        for index in range(len(self._base) + 1):
            added: list[Cell] = []
            if change and index == change.stop:
                added = [Cell("+", parts.new_line(new)) for new in range(change.new_start, change.new_stop)]
                shift = change.new_stop - change.stop
                change = next(changes, None)
            if index == len(self._base):
                yield added, None
            elif change is not None and index >= change.start:
                yield added, Cell("-", parts.old_line(index))
            else:
                yield added, Cell(" ", Line(index + shift + 1, self._base[index].rstrip(NEWLINE)))

    def _stack(self, groups: Sequence[_Group], place: range, start: int) -> Iterator[Labelled]:
        """The versions one below the other; lines that nobody changed have the user's numbers."""
        position, shift = place.start, start - place.start
        for group in [*groups, None]:
            for index in range(position, group.base.start if group else place.stop):
                yield Labelled("", Line(index + shift + 1, self._base[index].rstrip(NEWLINE)))
            if group:
                yield from self._versions(group)
                position, shift = group.base.stop, group.mine.stop - group.base.stop

    def _versions(self, group: _Group) -> Iterator[Labelled]:
        for index in group.base:
            versions = [self._parts[side].old_line(index) for side in sorted(group.sides, reverse=True)]
            yield Labelled("base", next((line for line in versions if line.parts), versions[0]), group.clash)
        ranges = {"mine": group.mine, "generated": group.generated}
        texts = [[self._texts[side][index] for index in ranges[side]] for side in ranges]
        alike = len(group.sides) == len(ranges) and texts[0] == texts[1]
        for side in ("mine",) if alike else sorted(group.sides, reverse=True):
            label = "both" if alike else side
            for index in ranges[side]:
                yield Labelled(label, self._parts[side].new_line(index), group.clash)
            if not ranges[side]:
                yield Labelled(label, Line(0, _REMOVED), group.clash)


def _groups(
    mine: Sequence[Replacement], generated: Sequence[Replacement], clashes: Sequence[range]
) -> Iterator[_Group]:
    """The changes of both sides, those together that overlap or touch, as the merge sees them."""
    shifts = {"mine": 0, "generated": 0}
    waiting = sorted(
        [(c.start, c.stop, "mine", c) for c in mine] + [(c.start, c.stop, "generated", c) for c in generated]
    )
    while waiting:
        start, stop, side, change = waiting.pop(0)
        before, sides = dict(shifts), {side}
        shifts[side] = change.new_stop - change.stop
        while waiting and waiting[0][0] <= stop:
            _, end, side, change = waiting.pop(0)
            sides.add(side)
            stop, shifts[side] = max(stop, end), change.new_stop - change.stop
        ours, theirs = (range(start + before[side], stop + shifts[side]) for side in ("mine", "generated"))
        clash = any(start <= lines.start - 1 and lines.stop - 1 <= stop for lines in clashes)
        yield _Group(range(start, stop), ours, theirs, frozenset(sides), clash)


def _runs(groups: Sequence[_Group], length: int) -> Iterator[tuple[list[_Group], range]]:
    """Groups whose context meets, and the lines of base that they and their context take."""
    run: list[_Group] = []
    for group in groups:
        if run and group.base.start - run[-1].base.stop > 2 * CONTEXT:
            yield run, _with_context(run, length)
            run = []
        run.append(group)
    if run:
        yield run, _with_context(run, length)


def _with_context(run: Sequence[_Group], length: int) -> range:
    return range(max(0, run[0].base.start - CONTEXT), min(length, run[-1].base.stop + CONTEXT))


class _Highlights(msgspec.Struct, frozen=True):
    """The changed parts of lines, by the lines' indices; `blank` are lines of which only the white space changed."""

    parts: dict[int, tuple[range, ...]] = msgspec.field(default_factory=dict)
    blank: set[int] = msgspec.field(default_factory=set)

    def line(self, index: int, text: str) -> Line:
        shown = text.rstrip(NEWLINE)
        if index in self.blank:
            shown = shown.replace(" ", "·").replace("\t", "→")
        parts = tuple(trimmed for part in self.parts.get(index, ()) if (trimmed := _trimmed(part, text)))
        return Line(index + 1, shown if text.endswith(NEWLINE) else shown + _NO_END, parts)


class _Parts:
    """Which parts of the lines changed from one version to another."""

    def __init__(self, old: Sequence[str], new: Sequence[str], changes: Sequence[Replacement]) -> None:
        self._old, self._new = old, new
        self._gone, self._added = _Highlights(), _Highlights()
        for change in changes:
            self._compare(change)

    def old_line(self, index: int) -> Line:
        """A line of the old version that the new one has not."""
        return self._gone.line(index, self._old[index])

    def new_line(self, index: int) -> Line:
        """A line of the new version that the old one has not, or that stands between such lines."""
        return self._added.line(index, self._new[index])

    def _compare(self, change: Replacement) -> None:
        before, after = self._old[change.start : change.stop], self._new[change.new_start : change.new_stop]
        if not before or not after:
            return
        if "".join("".join(before).split()) == "".join("".join(after).split()):
            self._gone.blank.update(range(change.start, change.stop))
            self._added.blank.update(range(change.new_start, change.new_stop))
            return
        old, new = tokens("".join(before)), tokens("".join(after))
        found = compare(old, new, minimal=True)
        gone, added = [range(c.start, c.stop) for c in found], [range(c.new_start, c.new_stop) for c in found]
        if min(_share(old, gone), _share(new, added)) <= _REWRITTEN:
            self._gone.parts.update(_spread(old, gone, change.start))
            self._added.parts.update(_spread(new, added, change.new_start))


def _trimmed(part: range, text: str) -> range:
    """A part of a line without the white space at its ends."""
    changed = text[part.start : part.stop]
    return range(part.stop - len(changed.lstrip()), part.start + len(changed.rstrip()))


def _share(run: Sequence[str], changed: Sequence[range]) -> float:
    """How much of the text is in the changed tokens, white space apart; 1 if there is none."""
    total = sum(len(token.strip()) for token in run)
    return sum(len(run[index].strip()) for part in changed for index in part) / total if total else 1


def _spread(run: Sequence[str], changed: Sequence[range], first: int) -> Iterator[tuple[int, tuple[range, ...]]]:
    """The changed tokens as columns of each line that they touch; lines count from `first`."""
    indices = {index for part in changed for index in part}
    indices |= {index for index, token in enumerate(run) if token.isspace() and {index - 1, index + 1} <= indices}
    line, column = first, 0
    parts: dict[int, list[range]] = {}
    for index, token in enumerate(run):
        for number, piece in enumerate(token.split(NEWLINE)):
            line, column = (line + 1, 0) if number else (line, column)
            if index in indices and piece:
                here = parts.setdefault(line, [])
                joined = here.pop().start if here and here[-1].stop == column else column
                here.append(range(joined, column + len(piece)))
            column += len(piece)
    return ((line, tuple(ranges)) for line, ranges in parts.items())


def _lines(text: str) -> list[str]:
    return split_lines(text.replace("\r\n", NEWLINE))
