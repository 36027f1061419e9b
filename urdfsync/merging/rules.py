"""Three-way merge of a few lines of Modelica by tokens, for where merging whole lines finds a conflict.

The rules are stricter than those for lines, since tokens that stand side by side mostly mean something together.

- What both sides did alike is done once.
- Edits of the two sides that overlap are a conflict; so are those that could be told apart only by guessing which of
  several equal tokens was meant.
- Otherwise something must stand between them that neither touched and that is more than an operator, a bracket
  or a comma: a name, a number, a string.
- A comma is enough between items that have names, such as modifiers, and a semicolon at the end of a line; two
  arguments or two elements side by side are a conflict.
- An item that is added or removed with its comma, a declaration with its semicolon, may stand right next to an
  edit of another one. But next to what is added nothing may be removed: its reason may be gone.
- Comments and white space may stand right next to a value that changes, but not to one that goes.
- Edits with which both sides bring in the same name, string or comment, but not alike, are a conflict: one side
  may have taken over by hand what the other one does, and it must not be there twice.
- Edits of one side that leave less between them than they change count as one: what they have in common
  with the text before is chance.
- The result must read as just these tokens: nothing runs together, no comment swallows what follows it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, groupby, pairwise
from typing import NamedTuple, TypeAlias

from urdfsync.merging.edits import Edit, edits_between
from urdfsync.merging.tokens import NEWLINE, SEPARATORS, is_telling, is_trivia, is_word, tokens

_OPENING, _CLOSING = frozenset("([{"), frozenset(")]}")
_BOUNDS = _OPENING | _CLOSING | SEPARATORS

Lines: TypeAlias = tuple[range, range, range]
"""Whole lines of base, mine and generated, by their numbers from 0."""


class Piece(NamedTuple):
    """Lines that belong together, and the merged text for them: None if there is a conflict."""

    lines: Lines
    text: str | None


class _Chunk(NamedTuple):
    """Edits of one side that stand or fall together."""

    side: int
    edits: tuple[Edit, ...]

    @property
    def start(self) -> int:
        return self.edits[0].start

    @property
    def stop(self) -> int:
        return self.edits[-1].stop

    @property
    def low(self) -> int:
        return self.edits[0].low

    @property
    def high(self) -> int:
        return self.edits[-1].high

    @property
    def trivia(self) -> bool:
        return self.edits[0].trivia


def merge_tokens(base: str, mine: str, generated: str) -> list[Piece]:
    """Merge three versions of some whole lines, none of which begins inside a string or comment.

    The pieces follow each other and cover all three texts; they are as small as the conflicts allow.
    """
    old = tokens(base)
    edits = [edits_between(old, tokens(text)) for text in (mine, generated)]
    agreed = {edit.effect for edit in edits[0]} & {edit.effect for edit in edits[1]}
    words = [0, *accumulate(map(is_word, old))]
    chunks = [
        _Chunk(side, group)
        for side in (0, 1)
        for group in _grouped([edit for edit in edits[side] if edit.effect not in agreed], words)
    ]
    clashes = [*_clashes(chunks, old, words), *_twice(chunks)]
    return [
        _joined(list(group)) for _, group in groupby(_pieces(old, edits, clashes), lambda piece: piece.text is None)
    ]


def _joined(pieces: Sequence[Piece]) -> Piece:
    """Pieces that follow each other, all with a conflict or all without, as one."""
    base, mine, generated = (
        range(first.start, last.stop) for first, last in zip(pieces[0].lines, pieces[-1].lines, strict=True)
    )
    texts = [piece.text for piece in pieces if piece.text is not None]
    return Piece((base, mine, generated), "".join(texts) if texts else None)


def _grouped(edits: Iterable[Edit], words: Sequence[int]) -> Iterator[tuple[Edit, ...]]:
    """Edits of one side, those together that leave fewer words between them than they change; not trivia and lines."""
    groups: list[tuple[Edit, ...]] = []
    for edit in edits:
        if edit.trivia:
            yield (edit,)
            continue
        groups.append((edit,))
        while len(groups) > 1 and _belong(groups[-2], groups[-1], words):
            last = groups.pop()
            groups[-1] += last
    yield from groups


def _belong(first: tuple[Edit, ...], second: tuple[Edit, ...], words: Sequence[int]) -> bool:
    between = words[second[0].start] - words[first[-1].stop]
    weights = (sum(edit.weight for edit in group) for group in (first, second))
    return between < min(weights) and not (first[-1].lines or second[0].lines)


def _clashes(chunks: Iterable[_Chunk], old: Sequence[str], words: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Ranges of base tokens over which the sides are in conflict."""
    ordered = sorted(chunks, key=lambda chunk: (chunk.low, chunk.high))
    for index, first in enumerate(ordered):
        for second in ordered[index + 1 :]:
            if second.low > first.high and words[second.low] > words[first.high]:
                break
            if second.side != first.side and not _apart(first, second, old):
                yield first.low, max(first.high, second.high)


def _twice(chunks: Sequence[_Chunk]) -> Iterator[tuple[int, int]]:
    """Ranges of base tokens from one edit to another of the other side that brings in one of the same words."""
    ours, theirs = (
        [
            (chunk, {token for edit in chunk.edits for token in edit.inserted if is_telling(token)})
            for chunk in chunks
            if chunk.side == side
        ]
        for side in (0, 1)
    )
    for mine, words in ours:
        for generated, others in theirs:
            if words & others:
                yield min(mine.low, generated.low), max(mine.high, generated.high)


def _apart(first: _Chunk, second: _Chunk, old: Sequence[str]) -> bool:
    """Whether edits of the two sides, in order, have nothing to do with each other."""
    before, after = first.edits[-1], second.edits[0]
    gap = old[before.stop : after.start]
    if first.high > second.low or (not gap and not before.deleted and not after.deleted):
        return False
    if any(map(is_word, gap)):
        return True
    if before.trivia or after.trivia:
        return any(token == NEWLINE or not is_trivia(token) for token in gap) or _may_touch(before, after)
    return (";" in gap and NEWLINE in gap) or _are_items(before, after, old)


def _may_touch(before: Edit, after: Edit) -> bool:
    """Whether edits, one of them trivia, may stand side by side: if what they are about remains."""
    if before.trivia and after.trivia:
        return True
    note, code = (before, after) if before.trivia else (after, before)
    return bool(note.deleted and note.inserted) if code.adds else not code.removes


def _are_items(before: Edit, after: Edit, old: Sequence[str]) -> bool:
    """Whether a separator stands between edits, one of which is in an item with a name or adds or removes items."""
    if (before.adds and after.removes) or (before.removes and after.adds):
        return False
    gap = old[before.stop : after.start]
    if "," in gap and (_is_named(reversed(old[: before.start])) or _is_named(old[after.start :])):
        return True
    left, right = _item(before), _item(after)
    return bool(left or right) and not SEPARATORS.isdisjoint([*gap, *left[-1:], *right[:1]])


def _is_named(run: Iterable[str]) -> bool:
    """Whether there is an equals sign in the item whose tokens these are, from its other end or from inside it."""
    return next((mark == "=" for mark in run if mark == "=" or mark in _BOUNDS), False)


def _item(edit: Edit) -> list[str]:
    """The significant tokens of an edit that adds or removes whole list items or declarations; none for others."""
    if not (edit.adds or edit.removes):
        return []
    run = [token for token in edit.inserted + edit.deleted if not is_trivia(token)]
    named = "=" in run and "," in (run[0], run[-1])
    return run if named or run[-1] == ";" else []


def _pieces(old: Sequence[str], edits: Sequence[Sequence[Edit]], clashes: Sequence[tuple[int, int]]) -> Iterator[Piece]:
    """The three texts cut at the ends of line that neither side touches and no conflict includes."""
    taken = {index for side in edits for edit in side for index in range(edit.start, edit.stop)}
    taken |= {index for low, high in clashes for index in range(low, high)}
    cuts = [index + 1 for index, token in enumerate(old) if token == NEWLINE and index not in taken]
    base = mine = generated = range(0)
    for start, stop in pairwise([0, *cuts, len(old)]):
        at_end = stop == len(old) and (start == stop or stop not in cuts)
        inside = range(start, stop + at_end)
        ours, theirs = ([edit for edit in side if edit.start in inside] for side in edits)
        base = _next_lines(base, _applied(old, inside, ()))
        mine = _next_lines(mine, _applied(old, inside, ours))
        generated = _next_lines(generated, _applied(old, inside, theirs))
        merged = _applied(old, inside, {*ours, *theirs})
        text = "".join(merged)
        clash = any(low in inside for low, _ in clashes) or tokens(text) != merged
        if base or mine or generated:
            yield Piece((base, mine, generated), None if clash else text)


def _applied(old: Sequence[str], inside: range, edits: Iterable[Edit]) -> list[str]:
    """Some base tokens with the edits that belong to them done."""
    result: list[str] = []
    position = inside.start
    for edit in sorted(edits, key=lambda edit: (edit.start, edit.stop, edit.inserted)):
        result += [*old[position : edit.start], *edit.inserted]
        position = edit.stop
    return [*result, *old[position : inside.stop]]


def _next_lines(previous: range, run: Iterable[str]) -> range:
    """The numbers of the lines that some tokens make, after those of the previous ones."""
    text = "".join(run)
    unfinished = bool(text) and not text.endswith(NEWLINE)
    return range(previous.stop, previous.stop + text.count(NEWLINE) + unfinished)
