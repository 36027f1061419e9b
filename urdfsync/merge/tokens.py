r"""Three-way merge of a few lines of Modelica by tokens, for where merging whole lines finds a conflict.

What is only right as a whole is one token: numbers with sign and exponent, strings, dotted names with their
subscripts, and arrays of nothing but numbers (a vector of which each side changed one element is no value that
anybody asked for). Blanks, ends of line and comments are tokens too, so that the tokens are the text.

The rules are stricter than those for lines, since tokens that stand side by side mostly mean something together.

1. What both sides did alike is done once.
2. Edits of the two sides that overlap are a conflict; so are those that could be told apart only by guessing which
   of several equal tokens was meant.
3. Otherwise an unchanged name, number or string must stand between them; an operator or a bracket is not enough.
4. A comma is enough between items that have names, such as modifiers, and a semicolon at the end of a line; two
   arguments or two elements side by side are a conflict.
5. An item that is added or removed with its comma, a declaration with its semicolon, may stand right next to an edit
   of another one. But next to what is added nothing may be removed: its reason may be gone.
6. Comments and white space may stand right next to a value that changes, but not to one that goes.
7. Edits with which both sides bring in the same name, string or comment, but not alike, are a conflict: one side may
   have taken over by hand what the other one does, and it must not be there twice.
8. Edits of one side that leave less between them than they change count as one: what they have in common with the
   text before is chance.
9. The result must read as just these tokens: nothing runs together, no comment swallows what follows it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

import msgspec

from urdfsync.merge.sequence import compare
from urdfsync.modelica.names import KEYWORDS

NEWLINE = "\n"

_MAX_TOKENS = 4_000
"""Length of a text above which it is a rewrite rather than an edit: 200 lines of a package have some 2,000 tokens."""

_SEPARATORS = frozenset(",;")
_BOUNDS = frozenset("()[]{},;")

_STRING = r'"(?:[^"\\]|\\.)*(?:"|\Z)'
_QUOTED_NAME = r"'(?:[^'\\\n]|\\.)*'"
_COMMENT = r"//[^\n]*|/\*.*?(?:\*/|\Z)"
_NUMBER = r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?"
_ROW = rf"[{{\[][ \t]*{_NUMBER}(?:[ \t]*[,;][ \t]*{_NUMBER})*[ \t]*[}}\]]"
_ROWS = rf"[{{\[][ \t]*{_ROW}(?:[ \t]*[,;][ \t]*{_ROW})*[ \t]*[}}\]]"
_PART = r"[^\W\d]\w*(?:\[[\w ,:.+*-]*\])?"
_NAME = rf"\.?{_PART}(?:\.{_PART})*"

_TOKEN = re.compile(
    rf"""
    {_STRING} | {_QUOTED_NAME} | {_COMMENT} | \n | [^\S\n]+
    | {_ROWS} | {_ROW} | {_NAME}
    | (?<![\w.)\]}}'"]){_NUMBER}          # a sign right after an operand is an operator
    | \d+(?:\.\d*)?(?:[eE][-+]?\d+)?
    | :=|==|<=|>=|<> | .
    """,
    re.VERBOSE | re.DOTALL,
)
_LONG = re.compile(rf"{_STRING}|{_QUOTED_NAME}|{_COMMENT}", re.DOTALL)
_WORD = re.compile(r"""[\w"']|[^\x00-\x7f]""")


class Region(NamedTuple):
    """Lines of base, mine and generated that belong together, by numbers from 0, and their merged text."""

    parts: tuple[range, range, range]
    text: str | None
    """None if the sides are in conflict."""


class _Edit(msgspec.Struct, frozen=True):
    """Base tokens from `start` on that are replaced."""

    start: int
    deleted: tuple[str, ...]
    inserted: tuple[str, ...]
    low: int
    """From here up to `start` are equal places for the same edit."""
    is_lines: bool = False
    """Nothing but whole lines are inserted or deleted."""

    @property
    def stop(self) -> int:
        return self.start + len(self.deleted)

    @property
    def effect(self) -> tuple[int, tuple[str, ...], tuple[str, ...]]:
        return self.start, self.deleted, self.inserted

    @property
    def only_adds(self) -> bool:
        return all(map(is_trivia, self.deleted))

    @property
    def only_removes(self) -> bool:
        return all(map(is_trivia, self.inserted))

    @property
    def is_trivia(self) -> bool:
        return self.only_adds and self.only_removes


class _Unit(NamedTuple):
    """Edits of one side that stand or fall together (rule 8)."""

    side: int
    edits: tuple[_Edit, ...]

    @property
    def low(self) -> int:
        return self.edits[0].low

    @property
    def high(self) -> int:
        return self.edits[-1].stop


def tokens(text: str) -> list[str]:
    """Cut a text into tokens; joined they are the text again. It must not begin inside a string or comment."""
    return _TOKEN.findall(text)


def inner_lines(text: str) -> frozenset[int]:
    """Return the lines, counted from 0, that begin inside a string or comment, or after an unfinished one."""
    inner: set[int] = set()
    line = position = 0
    for match in _LONG.finditer(text):
        first = line + text.count(NEWLINE, position, match.start())
        line, position = first + match[0].count(NEWLINE), match.end()
        inner.update(range(first + 1, line + 1))
    return frozenset(inner)


def is_trivia(token: str) -> bool:
    """Whether a token means nothing to a compiler: blanks, ends of line, comments."""
    return token.isspace() or token.startswith(("//", "/*"))


def is_word(token: str) -> bool:
    """Whether a token is a name, a keyword, a number, a string or an array; not an operator."""
    return not is_trivia(token) and _WORD.search(token) is not None


def _is_name_or_note(token: str) -> bool:
    """Whether a token is a name, a string or a comment; no number, no keyword."""
    return (token.startswith(("//", "/*")) or token[0] in "\"'._" or token[0].isalpha()) and token not in KEYWORDS


def merge_tokens(base: str, mine: str, generated: str) -> list[Region]:
    """Merge three versions of some whole lines, none of which begins inside a string or comment.

    The regions follow each other and cover all three texts; they are as small as the conflicts allow.
    """
    old, own, new = map(tokens, (base, mine, generated))
    if max(map(len, (old, own, new))) > _MAX_TOKENS:
        one, two, three = (range(_line_count(text)) for text in (base, mine, generated))
        return [Region((one, two, three), None)]
    sides = _find_edits(old, own), _find_edits(old, new)
    conflicts = _find_conflicts(old, sides)
    # the texts are cut at the ends of line that neither side touches and no conflict includes
    touched = {index for edits in sides for edit in edits for index in range(edit.start, edit.stop)}
    touched.update(index for low, high in conflicts for index in range(low, high))
    cuts = [index + 1 for index, token in enumerate(old) if token == NEWLINE and index not in touched]
    regions: list[Region] = []
    ends = [0, 0, 0]
    for start, stop in pairwise([0, *cuts, len(old) + 1]):  # edits at the very end are in the last piece
        ours, theirs = ([edit for edit in edits if start <= edit.start < stop] for edits in sides)
        versions = [_apply(old, start, stop, edits) for edits in ((), ours, theirs)]
        merged = _apply(old, start, stop, {*ours, *theirs})
        text = "".join(merged)
        is_conflict = any(start <= low < stop for low, _ in conflicts) or tokens(text) != merged
        starts, ends = ends, [end + _line_count("".join(part)) for end, part in zip(ends, versions, strict=True)]
        if starts == ends:
            continue
        if regions and (regions[-1].text is None) == is_conflict:
            before = regions.pop()
            starts = [part.start for part in before.parts]
            text = (before.text or "") + text
        one, two, three = map(range, starts, ends)
        regions.append(Region((one, two, three), None if is_conflict else text))
    return regions


def _line_count(text: str) -> int:
    return text.count(NEWLINE) + (text[-1:] not in ("", NEWLINE))


def _apply(old: Sequence[str], start: int, stop: int, edits: Iterable[_Edit]) -> list[str]:
    """Return base tokens `start` to `stop` with the edits done."""
    result: list[str] = []
    for edit in sorted(edits, key=lambda edit: (edit.start, edit.stop, edit.inserted)):
        result += [*old[start : edit.start], *edit.inserted]
        start = edit.stop
    return [*result, *old[start:stop]]


# --- edits of one side --------------------------------------------------------------------------------------------


def _find_edits(old: Sequence[str], new: Sequence[str]) -> list[_Edit]:
    """Return the edits that make `new` of `old`, in order, each in the place where people would see it.

    A shortest script often leaves open where: an added line may as well begin before the last comma of the one
    above it. These edits keep to whole lines where they can, and keep apart the comments that come with a value.
    """
    changes = compare(old, new, minimal=True)
    floors = [0, *(change.stop for change in changes)]
    ceilings = [*(change.start for change in changes[1:]), len(old)]
    edits: list[_Edit] = []
    for (start, stop, new_start, new_stop), floor, ceiling in zip(changes, floors, ceilings, strict=False):
        deleted, inserted = tuple(old[start:stop]), tuple(new[new_start:new_stop])
        if not (deleted and inserted):
            edits.append(_at_whole_lines(start, deleted, inserted, old, floor, ceiling))
            continue
        # whole lines after a replacement that only one of the texts has are an edit of their own
        rest = tuple(old[stop:ceiling])
        ending = rest[: rest.index(NEWLINE) + 1] if NEWLINE in rest else ()
        added = _find_run(ending, inserted) if NEWLINE not in deleted else None
        removed = _find_run(ending, deleted) if NEWLINE not in inserted else None
        if added:
            edits += _without_comments(start, deleted, inserted[:added])
            lines, after = inserted[added + len(ending) :] + ending, stop + len(ending)
            edits.append(_at_whole_lines(after, (), lines, old, after, ceiling))
        elif removed is not None:
            edits += _without_comments(start, deleted[:removed], inserted)
            lines, after = deleted[removed + len(ending) :] + ending, start + removed + len(ending)
            edits.append(_at_whole_lines(after, lines, (), old, after, ceiling))
        else:
            edits += _without_comments(start, deleted, inserted)
    return edits


def _find_run(run: tuple[str, ...], items: tuple[str, ...]) -> int | None:
    """Return where a run first occurs in items; None if it is empty or does not."""
    return next((place for place in range(len(items)) if run and items[place : place + len(run)] == run), None)


def _without_comments(start: int, deleted: tuple[str, ...], inserted: tuple[str, ...]) -> Iterator[_Edit]:
    """Yield a replacement; comments and white space that come with it, before or after, are edits of their own."""
    stop = start + len(deleted)
    code = [place for place, token in enumerate(inserted) if deleted and not is_trivia(token)]
    head = code[0] if code and not is_trivia(deleted[0]) else 0
    tail = code[-1] + 1 if code and not is_trivia(deleted[-1]) else len(inserted)
    if head:
        yield _Edit(start, (), inserted[:head], start)
    yield _Edit(start, deleted, inserted[head:tail], start)
    if tail < len(inserted):
        yield _Edit(stop, (), inserted[tail:], stop)


def _at_whole_lines(
    start: int, deleted: tuple[str, ...], inserted: tuple[str, ...], old: Sequence[str], floor: int, ceiling: int
) -> _Edit:
    """Return an insertion or deletion, moved to where it comprises whole lines if such a place is within the bounds."""
    run, first = deleted or inserted, start
    while first > floor and old[first - 1] == run[(first - 1 - start) % len(run)]:
        first -= 1
    last = start
    while last + len(deleted) < ceiling and old[last + len(deleted)] == run[(last - start) % len(run)]:
        last += 1
    places = range(first, last + 1)
    whole = [
        place
        for place in places
        if run[(place - start - 1) % len(run)] == NEWLINE and (place == 0 or old[place - 1] == NEWLINE)
    ]
    first, last = (whole or places)[0], (whole or places)[-1]
    turn = (last - start) % len(run)
    turned = run[turn:] + run[:turn]
    return _Edit(last, turned if deleted else (), () if deleted else turned, first, bool(whole))


# --- conflicts of two sides ---------------------------------------------------------------------------------------


def _find_conflicts(old: Sequence[str], sides: Sequence[Sequence[_Edit]]) -> list[tuple[int, int]]:
    """Return the ranges of base tokens over which the sides are in conflict."""
    words = [0, *accumulate(map(is_word, old))]  # words[i]: how many of the first i tokens are words
    agreed = {edit.effect for edit in sides[0]} & {edit.effect for edit in sides[1]}  # rule 1
    units = [
        unit
        for side, edits in enumerate(sides)
        for unit in _in_units(side, [edit for edit in edits if edit.effect not in agreed], words)
    ]
    conflicts = []
    ordered = sorted(units, key=lambda unit: (unit.low, unit.high))
    for index, first in enumerate(ordered):
        for second in ordered[index + 1 :]:
            if second.low > first.high and words[second.low] > words[first.high]:
                break  # rule 3; those that follow are even farther away
            if second.side != first.side and not _are_apart(first, second, old):
                conflicts.append((first.low, max(first.high, second.high)))
    brought = [{token for edit in one.edits for token in edit.inserted if _is_name_or_note(token)} for one in units]
    conflicts += [  # rule 7
        (min(one.low, other.low), max(one.high, other.high))
        for one, names in zip(units, brought, strict=True)
        for other, others in zip(units, brought, strict=True)
        if one.side < other.side and names & others
    ]
    return conflicts


def _in_units(side: int, edits: Iterable[_Edit], words: Sequence[int]) -> Iterator[_Unit]:
    """Yield edits of one side, those together that leave fewer words between them than they change.

    Comments, white space and whole lines stay alone.
    """
    groups: list[tuple[tuple[_Edit, ...], int]] = []  # with the number of words that they change, at least 1
    for edit in edits:
        if edit.is_trivia:
            yield _Unit(side, (edit,))
            continue
        groups.append(((edit,), max(1, sum(map(is_word, edit.inserted)), sum(map(is_word, edit.deleted)))))
        while len(groups) > 1:
            (one, weight), (two, other) = groups[-2:]
            between = words[two[0].start] - words[one[-1].stop]
            if between >= min(weight, other) or one[-1].is_lines or two[0].is_lines:
                break
            groups[-2:] = [(one + two, weight + other)]
    for group, _ in groups:
        yield _Unit(side, group)


def _are_apart(first: _Unit, second: _Unit, old: Sequence[str]) -> bool:
    """Whether edits of the two sides, in order, have nothing to do with each other (rules 2 to 6)."""
    before, after = first.edits[-1], second.edits[0]
    gap = old[before.stop : after.start]
    if first.high > second.low or (not gap and not before.deleted and not after.deleted):
        return False
    if any(map(is_word, gap)):
        return True
    if before.is_trivia and after.is_trivia:
        return True
    if before.is_trivia or after.is_trivia:
        if any(token == NEWLINE or not is_trivia(token) for token in gap):
            return True
        note, code = (before, after) if before.is_trivia else (after, before)
        return bool(note.deleted and note.inserted) if code.only_adds else not code.only_removes
    if ";" in gap and NEWLINE in gap:
        return True
    if (before.only_adds and after.only_removes) or (before.only_removes and after.only_adds):
        return False
    if "," in gap and (_is_named(reversed(old[: before.start])) or _is_named(old[after.start :])):
        return True
    left, right = _whole_item(before), _whole_item(after)
    return bool(left or right) and not _SEPARATORS.isdisjoint([*gap, *left[-1:], *right[:1]])


def _is_named(run: Iterable[str]) -> bool:
    """Whether there is an equals sign in the item whose tokens these are, from its other end or from inside it."""
    return next((mark == "=" for mark in run if mark == "=" or mark in _BOUNDS), False)


def _whole_item(edit: _Edit) -> list[str]:
    """Return the code of an edit that adds or removes whole list items or declarations; nothing for others."""
    if not (edit.only_adds or edit.only_removes):
        return []
    run = [token for token in edit.inserted + edit.deleted if not is_trivia(token)]
    has_names = "=" in run and "," in (run[0], run[-1])
    return run if has_names or run[-1] == ";" else []
