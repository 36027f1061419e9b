"""Compares sequences with git's algorithm, by libgit2, and merges sequences; lines as `git merge-file` does.

A change of one side is taken; equal changes are taken once; overlapping or touching changes are a contradiction.
"""

from __future__ import annotations

import itertools
from collections.abc import Hashable, Iterator, Sequence
from typing import NamedTuple, TypeAlias


class Contradiction(NamedTuple):
    """A node with different texts on the two sides; the text is empty on a side without the node."""

    path: tuple[str, ...]
    """The keys that lead to the node, from the outermost node to this node; empty for lines."""
    base: str
    mine: str
    generated: str

    @property
    def swapped(self) -> Contradiction:
        """The same contradiction with the sides exchanged."""
        return self._replace(mine=self.generated, generated=self.mine)


Piece: TypeAlias = str | Contradiction


class Hunk(NamedTuple):
    """`old[start:stop]` became `new[new_start:new_stop]`; one of these two ranges may be empty."""

    start: int
    stop: int
    new_start: int
    new_stop: int


class Region(NamedTuple):
    """A place where one or both sides differ from base: the indices in the three sequences, and which sides differ."""

    base: slice
    mine: slice
    generated: slice
    is_mine: bool
    is_generated: bool


def split_lines(text: str) -> list[str]:
    r"""Return the lines of a text with their endings; nothing but `\n` ends a line, as in git."""
    *lines, rest = text.split("\n")
    return [*(line + "\n" for line in lines), *([rest] if rest else [])]


def merge_lines(base: str, mine: str, generated: str) -> list[Piece]:
    """Merge texts line by line. Kinds of line endings are no difference; unchanged lines keep those of `mine`."""
    written, new_written = split_lines(mine), split_lines(generated)
    old, own, new = (split_lines(text.replace("\r\n", "\n")) for text in (base, mine, generated))
    pieces: list[Piece] = []
    place = 0
    for region in find_regions(old, own, new):
        texts = ["".join(lines[child]) for lines, child in zip((old, own, new), region[:3], strict=True)]
        if not region.is_generated or texts[1] == texts[2]:
            continue
        pieces.append("".join(written[place : region.mine.start]))
        pieces.append(Contradiction((), *texts) if region.is_mine else "".join(new_written[region.generated]))
        place = region.mine.stop
    return [*pieces, "".join(written[place:])]


def merge_whole_lines(base: str, mine: str, generated: str) -> str | None:
    """Merge texts line by line; None if there is a contradiction."""
    pieces = merge_lines(base, mine, generated)
    texts = [piece for piece in pieces if isinstance(piece, str)]
    return "".join(texts) if len(texts) == len(pieces) else None


def merge_sequences(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> list[str] | None:
    """Merge sequences without repeated nodes; None if both sides changed one place, or moved a node differently."""
    merged: list[str] = []
    place = 0
    for region in find_regions(base, mine, generated):
        own, new = mine[region.mine], generated[region.generated]
        if region.is_mine and region.is_generated and own != new:
            return None
        merged += [*base[place : region.base.start], *(new if region.is_generated else own)]
        place = region.base.stop
    merged += base[place:]
    return merged if len(set(merged)) == len(merged) else None


def merge_order(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> list[str]:
    """Return all items of `mine` and `generated`, in the generated order.

    An item that the user added or moved stands behind its predecessor in `mine`; without a predecessor, it is first.
    """
    old, own = set(base), set(mine)
    before, after = [key for key in base if key in own], [key for key in mine if key in old]
    changes = compare(before, after) if before != after else []
    users = own.difference(generated).union(*(after[change.new_start : change.new_stop] for change in changes))
    following: dict[str | None, str] = {
        key: next_key for key, next_key in itertools.pairwise((None, *mine)) if next_key in users
    }
    merged: list[str] = []
    for start in (None, *(key for key in generated if key not in users)):
        key = following.get(start) if start is None else start
        while key is not None:
            merged.append(key)
            key = following.get(key)
    return merged


def compare(old: Sequence[Hashable], new: Sequence[Hashable]) -> list[Hunk]:
    """Return the changes that turn `old` into `new`, in order; between two changes there is a common item.

    If several lists of changes are shortest, this returns git's list. As in git, the list may be too long if items are
    frequent, or if long sequences are very different.
    """
    # importing pygit2 takes 55 ms and 20 MB, which only a conflict needs ("one mass changed" in docs/speed.md)
    import pygit2

    numbers: dict[Hashable, int] = {}
    # libgit2 compares lines: write each item as a number
    old_text, new_text = (
        "".join(f"{numbers.setdefault(item, len(numbers))}\n" for item in items) for items in (old, new)
    )
    changes = []
    for hunk in pygit2.Patch.create_from(old_text.encode(), new_text.encode(), context_lines=0).hunks:
        # libgit2 numbers lines from 1, and gives an empty range the number of the line before
        start, new_start = hunk.old_start - (hunk.old_lines > 0), hunk.new_start - (hunk.new_lines > 0)
        changes.append(Hunk(start, start + hunk.old_lines, new_start, new_start + hunk.new_lines))
    return changes


def find_regions(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> Iterator[Region]:
    """Yield the places where a side differs from base, in order; overlapping or touching changes are one place."""
    changes = [(change, side) for side, text in enumerate((mine, generated)) for change in compare(base, text)]
    groups: list[list[tuple[Hunk, int]]] = []
    stop = -1
    for change, side in sorted(changes):
        if change.start > stop:  # an unchanged line separates this change from the changes before
            groups.append([])
        groups[-1].append((change, side))
        stop = max(stop, change.stop)
    shifts = [0, 0]  # difference of line numbers between base and each side
    for group in groups:
        start, stop = group[0][0].start, max(change.stop for change, _ in group)
        starts = [start + shift for shift in shifts]
        for change, side in group:
            shifts[side] = change.new_stop - change.stop
        ours, theirs = (slice(begin, stop + shift) for begin, shift in zip(starts, shifts, strict=True))
        sides = {side for _, side in group}
        yield Region(slice(start, stop), ours, theirs, 0 in sides, 1 in sides)
