"""Compare sequences with the algorithm of git, by libgit2, and merge them."""

from __future__ import annotations

import itertools
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


def merge_order(base: Sequence[str], mine: Sequence[str], generated: Sequence[str]) -> list[str]:
    """Return all that `mine` and `generated` have, in the generated order.

    What the user added or moved stands behind what precedes it in `mine`; before all else if nothing does.
    """
    old, own = set(base), set(mine)
    before, after = [key for key in base if key in own], [key for key in mine if key in old]
    changes = compare(before, after) if before != after else []
    users = own.difference(generated).union(*(after[one.new_start : one.new_stop] for one in changes))
    following: dict[str | None, str] = {
        one: other for one, other in itertools.pairwise((None, *mine)) if other in users
    }
    found: list[str] = []
    for start in (None, *(key for key in generated if key not in users)):
        key = following.get(start) if start is None else start
        while key is not None:
            found.append(key)
            key = following.get(key)
    return found
