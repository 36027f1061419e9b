"""Finds the numbers of a robot that each literal of its source feeds, by reading the source with other numbers.

1. Each literal gets a number of its own, near its old one. A number of a record that equals it shows its literal,
   through all of xacro.
2. Each literal gets another number near. A computed number moves twice, and its two steps have the ratio of its
   literal's steps. These are drawn at random: no other literal has their ratio, and no mean of two literals.

So two readings find all places of all literals, however many there are.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence, Set
from random import Random
from typing import TypeAlias

from urdfsync.analysis.patches.literals import Literal
from urdfsync.common.diagnostics import UrdfsyncError

Place: TypeAlias = tuple[str, str, int]
"""A number: the path of a record, the path of the value in the record, and the number's index in the value.

A number of the expanded text has no record, but a line in words. A number of another robot has the robot's name.
"""
NewTexts: TypeAlias = dict[Literal, str]
"""The new texts of literals."""
_STEP = 1e-8
"""The relative distance of a new number, at least: no reading takes it for another number."""
_TINY = 1e-200
"""Stands for zero."""
_SAME = 2e-6
"""Two ratios of steps that differ less are the same. A number with 15 digits has an error of 1e-7 of its step."""


class Feeds:
    """The literals behind the numbers of a robot."""

    def __init__(self, read: Callable[[NewTexts], Mapping[Place, float]], before: Mapping[Place, float]) -> None:
        """`read` returns the numbers for new texts, and raises UrdfsyncError; `before` has the numbers on disk."""
        self._read, self.before = read, before
        self.direct = dict[Place, Literal]()
        """The literal that a number repeats."""
        self.computed = dict[Place, tuple[Literal, float]]()
        """The literal that a number is computed from, and how much faster the number moves."""

    def trace(self, literals: Mapping[Literal, Sequence[float]], wanted: Set[Place]) -> Set[Place]:
        """Find the numbers that these literals feed; each has numbers, which the new ones are near.

        Return all numbers that moved. Literals that cannot change are left out, such as a count: without them, the
        numbers at the `wanted` places would be missing.
        """
        pairs = [(literal, value) for literal, values in literals.items() for value in values]
        first, second = (_numbers_near([value for _, value in pairs], seed) for seed in (1, 2))
        moved = self._moved(pairs, first, wanted) if pairs else {}
        if moved is None:
            half = len(literals) // 2
            parts = [dict(part) for part in ([*literals.items()][:half], [*literals.items()][half:]) if half]
            return {place for part in parts for place in self.trace(part, wanted)}
        by_number = {number: literal for (literal, _), number in zip(pairs, first, strict=True)}
        self.direct |= {place: by_number[number] for place, number in moved.items() if number in by_number}
        rest = moved.keys() & self.before.keys() - self.direct.keys()
        again = self._moved(pairs, second, wanted) if rest else {}
        steps = zip(pairs, first, second, strict=True)
        ratios = sorted(((b - value) / (a - value), number) for number, ((_, value), a, b) in enumerate(steps))
        for place, after in again.items() if again else ():
            if place in rest:
                old = self.before[place]
                ratio = (after - old) / (moved[place] - old)
                at = bisect_left(ratios, (ratio, 0))
                nearest, which = min(ratios[max(0, at - 1) : at + 1], key=lambda each: abs(each[0] - ratio))
                if abs(nearest - ratio) < _SAME:
                    literal, value = pairs[which]
                    self.computed[place] = literal, (moved[place] - old) / (first[which] - value)
        return moved.keys()

    def _moved(
        self, pairs: Sequence[tuple[Literal, float]], numbers: Sequence[float], wanted: Set[Place]
    ) -> dict[Place, float] | None:
        """Return all numbers that differ if the literals have these numbers; None if a wanted one is missing."""
        texts = NewTexts()
        for (literal, _), number in zip(pairs, numbers, strict=True):
            texts[literal] = f"{texts.get(literal, '')} {number!r}".lstrip()
        try:
            now = self._read(texts)
        except UrdfsyncError:
            return None
        if wanted & self.before.keys() - now.keys():
            return None
        return {place: number for place, number in now.items() if self.before.get(place) != number}


def _numbers_near(values: Sequence[float], seed: int) -> list[float]:
    """Return a number near each value: no two are equal."""
    random = Random(seed)  # noqa: S311 - any numbers do
    steps = random.sample(range(len(values)), len(values))
    parts = [1 + (step + random.random() / 2) / len(values) for step in steps]
    sizes = [value if abs(value) > _TINY else _TINY for value in values]
    return [size * (1 + _STEP * part) for size, part in zip(sizes, parts, strict=True)]
