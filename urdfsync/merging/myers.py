"""The shortest edit script between two sequences, chosen among equals as git chooses it.

E. W. Myers, "An O(ND) Difference Algorithm and Its Variations", Algorithmica 1 (1986), in the variant
that needs linear space: search from both ends, split where the searches meet, go on with both halves.
Shortest scripts are rarely unique, and a three-way merge depends on which one is taken. So that
`urdfsync.merge` agrees with `git merge-file`, this module makes git's choices too: it sets aside lines
that can't help, prefers the same one of two equal ways, gives up on the shortest script at the same
cost, and settles changes that could stand in several places as git does.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

_MAX_COST = 256
"""Edits from either end after which the search takes the best way so far (git: for files below 65,536 lines)."""
_MAX_WORK = 1_500_000
"""Diagonals to look at, unless a caller says otherwise: about a third of a second."""
_FREQUENT = 1024
"""Occurrences from which an item is frequent in any case; in short sequences, about their length's root."""
_WINDOW = 100
"""Neighbours on either side that decide on a frequent item."""


class Change(NamedTuple):
    """`old[start:stop]` became `new[new_start:new_stop]`; both are half open, and one of them may be empty."""

    start: int
    stop: int
    new_start: int
    new_stop: int


class _Box(NamedTuple):
    """A part of both sequences that is still to be compared: `x[left:right]` and `y[top:bottom]`."""

    left: int
    right: int
    top: int
    bottom: int
    exact: bool
    """The shortest script is wanted, whatever it costs: a search has already been here."""


def diff(old: Sequence[Hashable], new: Sequence[Hashable], *, thin: bool = True, work: int = _MAX_WORK) -> list[Change]:
    """The changes that lead from `old` to `new`, in order, with at least one common item between any two.

    `thin` leaves out of the comparison, as git does with lines, what is unlikely to matter: items that
    the other side lacks, and frequent items among them. After `work` steps, what has not been compared yet
    counts as changed, so that sequences with little in common take no longer.
    """
    x, y = _numbered(old, new)
    head, tail = _common_ends(x, y)
    rows, columns = list(range(head, len(x) - tail)), list(range(head, len(y) - tail))
    if thin:
        rows, columns = _promising(x, y, rows), _promising(y, x, columns)
    common = [(place, place) for place in range(head)]
    common += [(rows[i], columns[j]) for i, j in _compare([x[row] for row in rows], [y[row] for row in columns], work)]
    common += [(len(x) + place, len(y) + place) for place in range(-tail, 0)]
    slots_x, slots_y = _slots(len(x), [i for i, _ in common]), _slots(len(y), [j for _, j in common])
    _settle(x, slots_x, slots_y)
    _settle(y, slots_y, slots_x)
    return list(_changes(slots_x, slots_y))


def _numbered(old: Sequence[Hashable], new: Sequence[Hashable]) -> tuple[list[int], list[int]]:
    """Both sequences with equal items as equal small numbers, which are quick to compare."""
    numbers: dict[Hashable, int] = {}
    x = [numbers.setdefault(item, len(numbers)) for item in old]
    return x, [numbers.setdefault(item, len(numbers)) for item in new]


def _common_ends(x: Sequence[int], y: Sequence[int]) -> tuple[int, int]:
    """How many items both have in common at the head and, of the rest, at the tail."""
    shorter = min(len(x), len(y))
    head = 0
    while head < shorter and x[head] == y[head]:
        head += 1
    tail = 0
    while tail < shorter - head and x[-1 - tail] == y[-1 - tail]:
        tail += 1
    return head, tail


def _promising(items: Sequence[int], others: Sequence[int], rows: Sequence[int]) -> list[int]:
    """The rows worth comparing: not what the others lack, nor what is frequent there and stands among such rows."""
    count = Counter(others)
    frequent = min(_root(len(items)), _FREQUENT)
    matches = [count[items[row]] for row in rows]
    many = [number >= frequent for number in matches]
    return [
        row for place, row in enumerate(rows) if matches[place] and not (many[place] and _drowned(matches, many, place))
    ]


def _root(length: int) -> int:
    """A power of two near the square root: 2 to the number of digits to base 4."""
    return 1 << (length.bit_length() + 1) // 2


def _drowned(matches: Sequence[int], many: Sequence[bool], place: int) -> bool:
    """Whether a frequent item stands among lacking and frequent ones, with lacking ones on both sides and in plenty."""
    lacking, frequent = 0, 2  # the item itself counts in both directions
    for step in (-1, 1):
        before, neighbour = lacking, place + step
        last = min(max(place + step * _WINDOW, 0), len(matches) - 1)
        while step * (last - neighbour) >= 0 and (many[neighbour] or not matches[neighbour]):
            lacking += not matches[neighbour]
            frequent += matches[neighbour] > 0
            neighbour += step
        if lacking == before:
            return False
    return 4 * frequent < frequent + lacking


def _compare(x: Sequence[int], y: Sequence[int], work: int) -> list[tuple[int, int]]:
    """Indices of the common items of `x` and `y` along a short edit script, in order."""
    common: list[tuple[int, int]] = []
    boxes = [_Box(0, len(x), 0, len(y), exact=False)]
    while boxes:
        left, right, top, bottom, exact = boxes.pop()
        while left < right and top < bottom and x[left] == y[top]:
            common.append((left, top))
            left, top = left + 1, top + 1
        while left < right and top < bottom and x[right - 1] == y[bottom - 1]:
            right, bottom = right - 1, bottom - 1
            common.append((right, bottom))
        if left == right or top == bottom or work <= 0:
            continue
        box = _Box(left, right, top, bottom, exact)
        column, row, exact_before, exact_after, steps = _split(x, y, box)
        work -= steps
        boxes.append(_Box(left, column, top, row, exact_before))
        boxes.append(_Box(column, right, row, bottom, exact_after))
    return sorted(common)


class _Split(NamedTuple):
    """Where to split a box, which halves deserve an exact search, and how many diagonals were looked at."""

    column: int
    row: int
    exact_before: bool
    exact_after: bool
    work: int


class _Front:
    """How far a search has come on each diagonal (`x` index minus `y` index) that its next step touches.

    `reach` holds the `x` index per diagonal; Python's negative indices serve for negative diagonals.
    """

    def __init__(self, box: _Box, start: int, column: int, unreached: int) -> None:
        self.lowest, self.highest = box.left - box.bottom, box.right - box.top
        self.low = self.high = start
        self.reach = [unreached] * (max(self.highest, 0) - min(self.lowest, 0) + 3)
        self.reach[start] = column

    def widen(self) -> range:
        """The diagonals that one more edit leads to, from the highest; their parity alternates."""
        self.low += -1 if self.low > self.lowest else 1
        self.high += 1 if self.high < self.highest else -1
        return range(self.high, self.low - 1, -2)


def _split(x: Sequence[int], y: Sequence[int], box: _Box) -> _Split:
    """Search from both corners of a box, whose own corners don't match, until the searches meet or cost too much."""
    ahead = _Front(box, box.left - box.top, box.left, -1)
    back = _Front(box, box.right - box.bottom, box.right, len(x) + 1)
    odd = (ahead.low - back.low) % 2 == 1
    cost = work = 0
    while True:
        cost += 1
        diagonals = ahead.widen()
        meeting = _advance(x, y, box, ahead, back if odd else None, diagonals)
        work += len(diagonals)
        if meeting is None:
            diagonals = back.widen()
            meeting = _retreat(x, y, box, back, None if odd else ahead, diagonals)
            work += len(diagonals)
        if meeting is not None:
            return _Split(*meeting, exact_before=True, exact_after=True, work=work)
        if cost >= _MAX_COST and not box.exact:
            return _best_so_far(box, ahead, back, work)


def _advance(
    x: Sequence[int], y: Sequence[int], box: _Box, front: _Front, other: _Front | None, diagonals: range
) -> tuple[int, int] | None:
    """One more edit from the upper left; the point where the search meets the `other` one, if it does."""
    reach, right, bottom = front.reach, box.right, box.bottom
    low, high, met = _touched(other)
    for diagonal in diagonals:
        column, here = reach[diagonal - 1] + 1, reach[diagonal + 1]
        if here > column:
            column = here
        row = column - diagonal
        while column < right and row < bottom and x[column] == y[row]:
            column += 1
            row += 1
        reach[diagonal] = column
        if low <= diagonal <= high and met[diagonal] <= column:
            return column, row
    return None


def _retreat(
    x: Sequence[int], y: Sequence[int], box: _Box, front: _Front, other: _Front | None, diagonals: range
) -> tuple[int, int] | None:
    """One more edit from the lower right; the point where the search meets the `other` one, if it does."""
    reach, left, top = front.reach, box.left, box.top
    low, high, met = _touched(other)
    for diagonal in diagonals:
        column, here = reach[diagonal + 1] - 1, reach[diagonal - 1]
        if here < column:
            column = here
        row = column - diagonal
        while column > left and row > top and x[column - 1] == y[row - 1]:
            column -= 1
            row -= 1
        reach[diagonal] = column
        if low <= diagonal <= high and column <= met[diagonal]:
            return column, row
    return None


def _touched(front: _Front | None) -> tuple[int, int, Sequence[int]]:
    """The range of diagonals that a search's last step touched, and how far it has come; an empty range for None."""
    return (front.low, front.high, front.reach) if front else (1, 0, ())


def _best_so_far(box: _Box, ahead: _Front, back: _Front, work: int) -> _Split:
    """The point farthest from its corner that either search has reached; that side of it is known to be cheap."""
    forth = max((_inside(box, ahead, diagonal) for diagonal in range(ahead.high, ahead.low - 1, -2)), key=sum)
    home = min((_inside(box, back, diagonal) for diagonal in range(back.high, back.low - 1, -2)), key=sum)
    if box.right + box.bottom - sum(home) < sum(forth) - box.left - box.top:
        return _Split(*forth, exact_before=True, exact_after=False, work=work)
    return _Split(*home, exact_before=False, exact_after=True, work=work)


def _inside(box: _Box, front: _Front, diagonal: int) -> tuple[int, int]:
    """The point reached on a diagonal, brought back into the box along it."""
    column = min(max(front.reach[diagonal], box.left, box.top + diagonal), box.right, box.bottom + diagonal)
    return column, column - diagonal


def _slots(length: int, common: Sequence[int]) -> list[int]:
    """How many changed items stand before each common one, and after the last."""
    edges = [-1, *common, length]
    return [stop - start - 1 for start, stop in pairwise(edges)]


def _settle(items: Sequence[int], slots: list[int], others: Sequence[int]) -> None:
    """Move each change of one side that could stand in several places to where git puts it.

    A change moves by one when the item before it equals its last one, or its first the one after it; what
    was common becomes part of the change and the other way round. Changes that meet become one. A change goes
    as far down as it can, but not past the last place where it faces a change of the other side.
    """
    slot = place = 0
    while slot < len(slots):
        if slots[slot]:
            slot, place = _settle_one(items, slots, others, slot, place)
        place += slots[slot] + 1
        slot += 1


def _settle_one(
    items: Sequence[int], slots: list[int], others: Sequence[int], slot: int, place: int
) -> tuple[int, int]:
    """Settle the change in one slot, whose first item is at `place`; returns where it ends up."""
    size = 0
    while size != slots[slot]:
        size = slots[slot]
        while slot and items[place - 1] == items[place + slots[slot] - 1]:
            place -= 1 + slots[slot - 1]
            slot = _move(slots, slot, slot - 1)
        facing = slot if others[slot] else None
        while slot + 1 < len(slots) and items[place] == items[place + slots[slot]]:
            place += 1
            slot = _move(slots, slot, slot + 1)
            facing = slot if others[slot] else facing
    if facing is not None:
        place -= slot - facing
        slot = _move(slots, slot, facing)
    return slot, place


def _move(slots: list[int], source: int, target: int) -> int:
    """Add the items of one slot to those of another, whose number is returned."""
    if source != target:
        slots[target] += slots[source]
        slots[source] = 0
    return target


def _changes(slots: Sequence[int], new_slots: Sequence[int]) -> Iterator[Change]:
    start = new_start = 0
    for size, new_size in zip(slots, new_slots, strict=True):
        if size or new_size:
            yield Change(start, start + size, new_start, new_start + new_size)
        start += size + 1
        new_start += new_size + 1
