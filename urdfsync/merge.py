"""Three-way merge of generated text with hand edits: the same on every machine, and never a guess.

Whole lines are merged first, with the result that `git merge-file` has: what only one side changed is taken
from it, what both changed alike is taken once, and changes that overlap or touch are a conflict. Each conflict
is then tried again by tokens (see `urdfsync.merging.rules`), so that a comment and a new value on one line survive
together. Two texts that have very little in common are compared coarsely (see `urdfsync.merging.myers`): then there
may be a conflict where git finds none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import NamedTuple

import msgspec

from urdfsync.merging.myers import Change, diff
from urdfsync.merging.rules import Lines, Piece, merge_tokens
from urdfsync.merging.tokens import NEWLINE, inner_lines

_MAX_LINES = 200
"""Length of a conflict above which it is a rewrite rather than an edit, and not tried again by tokens."""


class Conflict(msgspec.Struct, frozen=True):
    """Where the sides disagree: line numbers, from 1, in the three texts; an empty range is the place before a line."""

    base: range
    mine: range
    generated: range


class Merge(msgspec.Struct, frozen=True):
    """What a merge gave."""

    text: str | None
    """The result; None if there is a conflict."""
    proposal: str
    """The result, with all three versions of a conflict between markers: for people to read, never for a `.mo` file."""
    conflicts: tuple[Conflict, ...]


class Hunk(NamedTuple):
    """Where the merged text is not that of `mine`."""

    lines: Lines
    clash: bool
    """Both sides changed something here; else only `generated` did."""


def merge(base: str, mine: str, generated: str) -> Merge:
    """Bring what changed from `base` to `generated` into `mine`.

    Kinds of line endings are no difference. Lines of `mine` keep theirs, others get the one that prevails in
    `mine`. Whether the last line has an ending is content, and merged like everything else.
    """
    old, own, new = (split_lines(text.replace("\r\n", NEWLINE)) for text in (base, mine, generated))
    ending = "\r\n" if 2 * mine.count("\r\n") > mine.count(NEWLINE) else NEWLINE
    written, place = split_lines(mine), 0
    result: list[str] = []
    conflicts: list[Conflict] = []
    for piece in _resolved(list(merge_lines(old, own, new)), old, own, new):
        text, (_, ours, _) = piece.text, piece.lines
        if text is None:
            conflicts.append(Conflict(*(range(lines.start + 1, lines.stop + 1) for lines in piece.lines)))
            text = _marked(*map(_cut, (old, own, new), piece.lines))
        if text != _cut(own, ours):
            result += [*written[place : ours.start], text.replace(NEWLINE, ending)]
            place = ours.stop
    merged = "".join([*result, *written[place:]])
    return Merge(None if conflicts else merged, merged, tuple(conflicts))


def split_lines(text: str) -> list[str]:
    r"""The lines of a text with their endings; nothing but `\n` ends a line, as in git."""
    *lines, rest = text.split(NEWLINE)
    return [*(line + NEWLINE for line in lines), *([rest] if rest else [])]


def merge_lines(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> Iterator[Hunk]:
    """Where `mine` needs changing, in order: git's three-way merge of whole lines."""
    shifts = (0, 0)
    for ours, theirs in _touching(diff(base, mine), diff(base, generated)):
        changes = [*ours, *theirs]
        start, stop = min(change.start for change in changes), max(change.stop for change in changes)
        after = _shift(ours, shifts[0]), _shift(theirs, shifts[1])
        in_mine, in_generated = (range(start + shifts[side], stop + after[side]) for side in (0, 1))
        if theirs and _cut(mine, in_mine) != _cut(generated, in_generated):
            yield Hunk((range(start, stop), in_mine, in_generated), clash=bool(ours))
        shifts = after


def _shift(changes: Sequence[Change], before: int) -> int:
    """How far lines have moved after some changes, from how far they had before."""
    return changes[-1].new_stop - changes[-1].stop if changes else before


def _touching(mine: Sequence[Change], generated: Sequence[Change]) -> Iterator[tuple[list[Change], list[Change]]]:
    """The changes of both sides, those together that no unchanged line keeps apart."""
    group: tuple[list[Change], list[Change]] = ([], [])
    stop = -1
    changes = [(change.start, change.stop, side, change) for side in (0, 1) for change in (mine, generated)[side]]
    for start, end, side, change in sorted(changes):
        if start > stop >= 0:
            yield group
            group = ([], [])
        group[side].append(change)
        stop = max(stop, end)
    if stop >= 0:
        yield group


def _resolved(
    hunks: Sequence[Hunk], base: Sequence[str], mine: Sequence[str], generated: Sequence[str]
) -> Iterator[Piece]:
    """The text for each hunk, conflicts tried again by tokens."""
    texts = (base, mine, generated)
    clash = any(hunk.clash for hunk in hunks)
    inner = [inner_lines("".join(text)) if clash else frozenset() for text in texts]
    for lines, clash in hunks:
        if not clash:
            yield Piece(lines, _cut(generated, lines[2]))
        elif any(_opaque(part, within) for part, within in zip(lines, inner, strict=True)):
            yield Piece(lines, None)
        else:
            for piece in merge_tokens(*map(_cut, texts, lines)):
                yield Piece(_moved(piece.lines, lines), piece.text)


def _opaque(lines: range, inner: Set[int]) -> bool:
    """Whether lines can't be merged by tokens: there are too many, or a string or comment goes beyond them."""
    return len(lines) > _MAX_LINES or lines.start in inner or lines.stop in inner


def _moved(lines: Lines, place: Lines) -> Lines:
    base, mine, generated = (
        range(start.start + part.start, start.start + part.stop) for part, start in zip(lines, place, strict=True)
    )
    return base, mine, generated


def _cut(lines: Sequence[str], part: range) -> str:
    return "".join(lines[part.start : part.stop])


def _marked(base: str, mine: str, generated: str) -> str:
    """All three versions of some lines between markers."""
    parts = [("<<<<<<< mine", mine), ("||||||| base", base), ("=======", generated), (">>>>>>> generated", "")]
    return "".join(f"{marker}\n{text.removesuffix(NEWLINE)}\n" if text else f"{marker}\n" for marker, text in parts)
