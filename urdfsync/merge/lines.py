"""Three-way merge of texts by lines, with the result of `git merge-file`.

What only one side changed is taken from it, what both changed alike is taken once, and changes that overlap or touch
are a conflict.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from urdfsync.merge.sequence import Replacement, compare


class ChangedLines(NamedTuple):
    """Where a side differs from base: the indices of the lines in the three texts, and `mine`, `generated` or both."""

    base: range
    mine: range
    generated: range
    sides: set[str]


class Region(NamedTuple):
    """Lines of base, mine and generated that belong together, by numbers from 0, and their merged text."""

    parts: tuple[range, range, range]
    text: str | None
    """None if the sides are in conflict."""


def split_lines(text: str) -> list[str]:
    r"""Return the lines of a text with their endings; nothing but `\n` ends a line, as in git."""
    *lines, rest = text.split("\n")
    return [*(line + "\n" for line in lines), *([rest] if rest else [])]


def merge_lines(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> list[Region]:
    """Return the regions in which `mine` needs changing, in order: git's three-way merge of whole lines."""
    regions = []
    for lines, ours, theirs, sides in find_changes(base, mine, generated):
        text = "".join(generated[theirs.start : theirs.stop])
        if "generated" in sides and "".join(mine[ours.start : ours.stop]) != text:
            regions.append(Region((lines, ours, theirs), None if "mine" in sides else text))
    return regions


def merge_whole_lines(base: str, mine: str, generated: str) -> str | None:
    """Merge texts; None if there is a conflict. Kinds of line endings are no difference."""
    written, new = split_lines(mine), split_lines(generated)
    result: list[str] = []
    place = 0
    for (_, ours, theirs), text in merge_lines(
        *(split_lines(one.replace("\r\n", "\n")) for one in (base, mine, generated))
    ):
        if text is None:
            return None
        result += [*written[place : ours.start], *new[theirs.start : theirs.stop]]
        place = ours.stop
    return "".join([*result, *written[place:]])


def merge_sequences(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> list[str] | None:
    """Merge sequences of different things; None if the sides changed one place, or moved one thing to two places."""
    found: list[str] = []
    place = 0
    for lines, ours, theirs, sides in find_changes(base, mine, generated):
        own, new = mine[ours.start : ours.stop], generated[theirs.start : theirs.stop]
        if len(sides) > 1 and own != new:
            return None
        found += [*base[place : lines.start], *(new if "generated" in sides else own)]
        place = lines.stop
    found += base[place:]
    return found if len(set(found)) == len(found) else None


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
