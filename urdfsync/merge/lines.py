"""Three-way merge of texts by lines, with the result of `git merge-file`; conflicts are tried again by tokens.

What only one side changed is taken from it, what both changed alike is taken once, and changes that overlap or touch
are a conflict. The rules for tokens are in `urdfsync.merge.tokens`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import msgspec

from urdfsync.merge.sequence import Replacement, compare
from urdfsync.merge.tokens import NEWLINE, Region, inner_lines, merge_tokens
from urdfsync.modelica.lexer import find_markers
from urdfsync.modelica.parser import parse

_MAX_LINES = 200
"""Length of a conflict above which it is a rewrite rather than an edit, and not tried again by tokens."""


class ConflictingLines(msgspec.Struct, frozen=True):
    """Where the sides disagree: line numbers, from 1, in the three texts; an empty range is the place before a line."""

    base: range
    mine: range
    generated: range


class ChangedLines(NamedTuple):
    """Where a side differs from base: the indices of the lines in the three texts, and `mine`, `generated` or both."""

    base: range
    mine: range
    generated: range
    sides: set[str]


class Merge(msgspec.Struct, frozen=True):
    """The result of a merge."""

    text: str | None
    """The merged text; None if there is a conflict or a flaw."""
    proposal: str
    """The merged text, with all three versions of a conflict between markers: for people, never for a `.mo` file."""
    conflicts: tuple[ConflictingLines, ...]
    flaw: str = ""
    """Why the merged text can't be right as Modelica, as the end of a sentence that begins with "the merge"."""


def merge(base: str, mine: str, generated: str, *, is_modelica: bool = False) -> Merge:
    """Bring what changed from `base` to `generated` into `mine`.

    Kinds of line endings are no difference. Lines of `mine` keep theirs, others get the one that prevails in
    `mine`. Whether the last line has an ending is content, and merged like everything else. With `is_modelica`,
    a merge is checked for flaws that neither side has.
    """
    texts = [split_lines(text.replace("\r\n", NEWLINE)) for text in (base, mine, generated)]
    ending = "\r\n" if 2 * mine.count("\r\n") > mine.count(NEWLINE) else NEWLINE
    written, place = split_lines(mine), 0
    result: list[str] = []
    conflicts: list[ConflictingLines] = []
    for region in _retry_by_tokens(merge_lines(*texts), texts):
        own, text = _texts_of(region, texts)[1], region.text
        if text is None:
            conflicts.append(ConflictingLines(*(range(part.start + 1, part.stop + 1) for part in region.parts)))
            text = _with_markers(*_texts_of(region, texts))
        if text != own:
            result += [*written[place : region.parts[1].start], text.replace(NEWLINE, ending)]
            place = region.parts[1].stop
    merged = "".join([*result, *written[place:]])
    flaw = find_flaw(merged, (mine, generated)) if is_modelica and not conflicts and merged != mine else ""
    return Merge(None if conflicts or flaw else merged, merged, tuple(conflicts), flaw)


def split_lines(text: str) -> list[str]:
    r"""Return the lines of a text with their endings; nothing but `\n` ends a line, as in git."""
    *lines, rest = text.split(NEWLINE)
    return [*(line + NEWLINE for line in lines), *([rest] if rest else [])]


def merge_lines(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> list[Region]:
    """Return the regions in which `mine` needs changing, in order: git's three-way merge of whole lines."""
    regions = []
    for lines, ours, theirs, sides in find_changes(base, mine, generated):
        text = "".join(generated[theirs.start : theirs.stop])
        if "generated" in sides and "".join(mine[ours.start : ours.stop]) != text:
            regions.append(Region((lines, ours, theirs), None if "mine" in sides else text))
    return regions


def find_changes(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> Iterator[ChangedLines]:
    """Yield the places where a side differs from base, in order; changes that overlap or touch are one."""
    sides = {"mine": mine, "generated": generated}
    changes = [(change, side) for side, text in sides.items() for change in compare(base, text)]
    groups: list[list[tuple[Replacement, str]]] = []
    stop = -1
    for change, side in sorted(changes, key=lambda pair: pair[0]):
        if change.start > stop:  # an unchanged line keeps it apart from those before
            groups.append([])
        groups[-1].append((change, side))
        stop = max(stop, change.stop)
    shifts = dict.fromkeys(sides, 0)  # how far a line of base has moved in each side
    for group in groups:
        lines = range(group[0][0].start, max(change.stop for change, _ in group))
        starts = [lines.start + shift for shift in shifts.values()]
        for change, side in group:
            shifts[side] = change.new_stop - change.stop
        ours, theirs = (range(start, lines.stop + shift) for start, shift in zip(starts, shifts.values(), strict=True))
        yield ChangedLines(lines, ours, theirs, {side for _, side in group})


def _retry_by_tokens(regions: Sequence[Region], texts: Sequence[Sequence[str]]) -> Iterator[Region]:
    """Replace each conflict by what merging its tokens gives."""
    has_conflict = any(region.text is None for region in regions)
    inner = [inner_lines("".join(lines)) if has_conflict else frozenset() for lines in texts]
    for region in regions:
        places = region.parts
        is_long = any(len(place) > _MAX_LINES for place in places)
        # tokens can't be told where a string or comment goes beyond the lines
        is_cut = any(place.start in within or place.stop in within for place, within in zip(places, inner, strict=True))
        if region.text is not None or is_long or is_cut:
            yield region
            continue
        for parts, text in merge_tokens(*_texts_of(region, texts)):
            old, own, new = (
                range(place.start + part.start, place.start + part.stop)
                for part, place in zip(parts, places, strict=True)
            )
            yield Region((old, own, new), text)


def _texts_of(region: Region, texts: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """The lines of a region in base, mine and generated."""
    return tuple("".join(lines[part.start : part.stop]) for lines, part in zip(texts, region.parts, strict=True))


def _with_markers(base: str, mine: str, generated: str) -> str:
    """Return all three versions of some lines between markers."""
    parts = [("<<<<<<< mine", mine), ("||||||| base", base), ("=======", generated), (">>>>>>> generated", "")]
    return "".join(f"{marker}\n{text.removesuffix(NEWLINE)}\n" if text else f"{marker}\n" for marker, text in parts)


def find_flaw(text: str, sides: Sequence[str]) -> str:
    """Return why a merged text can't be right as Modelica; empty if it can. Names and types are not checked.

    What is wrong with one of the sides already, as often as in the merge, is no flaw: it is its author's business.
    """
    faults = [*find_markers(text), *parse(text).faults]
    known: Counter[str] = Counter()
    for side in sides if faults else ():
        known |= Counter(fault.reason for fault in (*find_markers(side), *parse(side).faults))
    seen: Counter[str] = Counter()
    for reason, line, _ in faults:
        seen[reason] += 1
        if seen[reason] > known[reason]:
            return f"{reason} (line {line})"
    return ""
