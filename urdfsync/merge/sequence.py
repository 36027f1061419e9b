"""Compare two sequences with the algorithm of git, by libgit2."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import NamedTuple

_MAX_MINIMAL = 5_000
"""Longest sequences for which the shortest script is worth its time: 40 ms for two unrelated ones of 4,000 items."""


class Replacement(NamedTuple):
    """`old[start:stop]` became `new[new_start:new_stop]`; both are half open, and one of them may be empty."""

    start: int
    stop: int
    new_start: int
    new_stop: int


def compare(old: Sequence[Hashable], new: Sequence[Hashable], *, minimal: bool = False) -> list[Replacement]:
    """Return the replacements that make `new` of `old`, in order, with a common item between any two.

    Of several shortest scripts git's own is taken. Like git, this leaves out frequent items and gives up on the
    shortest script of long sequences with little in common; `minimal` does neither, up to some length.
    """
    # importing pygit2 takes 55 ms and 20 MB, which only a conflict needs ("one mass changed" in docs/speed.md)
    import pygit2

    numbers: dict[Hashable, int] = {}
    # libgit2 compares lines; numbers stand for the items, whatever these contain
    one, two = ("".join(f"{numbers.setdefault(item, len(numbers))}\n" for item in items) for items in (old, new))
    shortest = minimal and max(len(old), len(new)) <= _MAX_MINIMAL
    flag = pygit2.enums.DiffOption.MINIMAL if shortest else pygit2.enums.DiffOption.NORMAL
    patch = pygit2.Patch.create_from(one.encode(), two.encode(), flag=flag, context_lines=0)
    found = []
    for hunk in patch.hunks:
        # numbered from 1; an empty range is named by the line before it
        start, new_start = hunk.old_start - (hunk.old_lines > 0), hunk.new_start - (hunk.new_lines > 0)
        found.append(Replacement(start, start + hunk.old_lines, new_start, new_start + hunk.new_lines))
    return found
