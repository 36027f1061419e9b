"""What a benchmark is made of: measurements that are taken in turn, and what is compared with what."""

from __future__ import annotations

import dataclasses
import math
import random
import statistics
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Self

from benchmarks.measuring import Cost, Quantity

Round = Mapping[str, Cost]
"""The costs of one round, by the label of the measurement."""


@dataclasses.dataclass(frozen=True)
class Reading:
    """What a ratio is told as."""

    title: str
    of: Callable[[float], float]


RATIO = Reading("ratio", lambda ratio: ratio)


def growth(factor: float) -> Reading:
    """The exponent with which something grows, where its cause is `factor` times as large."""
    return Reading("exponent", lambda ratio: math.log(ratio) / math.log(factor))


def scaled(reference: float) -> Reading:
    """What it would be where the other takes so many milliseconds."""
    return Reading(f"ms where the other takes {reference:g}", lambda ratio: ratio * reference)


@dataclasses.dataclass(frozen=True)
class Row:
    """A measurement beside another one."""

    what: str
    against: str
    at_most: float | None = None
    """What the reading shall not exceed; None if it is only told."""
    quantity: Quantity = Quantity.WALL
    reading: Reading = RATIO


@dataclasses.dataclass(frozen=True)
class Study:
    """Measurements of one table."""

    title: str
    measurements: Mapping[str, Callable[[], Cost]]
    rows: Sequence[Row]
    slow: Collection[str] = ()
    """Labels of those that take so long that rows with them are measured in few rounds, without one to warm them up."""


@dataclasses.dataclass(frozen=True)
class Figures:
    """Numbers that are no comparison: what, and its value."""

    title: str
    values: Sequence[tuple[str, str]]


@dataclasses.dataclass(frozen=True)
class Spread:
    """Median, least and most of some values."""

    median: float
    least: float
    most: float

    @classmethod
    def over(cls, values: Sequence[float]) -> Self:
        return cls(statistics.median(values), min(values), max(values))


@dataclasses.dataclass(frozen=True)
class Finding:
    """What came out for a row."""

    row: Row
    mine: Spread
    other: Spread
    reading: Spread
    """Its median is that of the readings of the single rounds, not the reading of the medians."""
    pairs: int

    @property
    def met(self) -> bool | None:
        """Whether it does not exceed what it shall not; None if there is no such bar."""
        return None if self.row.at_most is None else self.reading.median <= self.row.at_most


def find(row: Row, rounds: Sequence[Round]) -> Finding | None:
    """What came out in those rounds that have both measurements; None if there is no such round."""
    costs = [(one[row.what], one[row.against]) for one in rounds if {row.what, row.against} <= set(one)]
    pairs = [(mine.of(row.quantity), other.of(row.quantity)) for mine, other in costs]
    if not pairs:
        return None
    mine, other = (Spread.over(values) for values in zip(*pairs, strict=True))
    readings = Spread.over([row.reading.of(one / two) for one, two in pairs])
    return Finding(row, mine, other, readings, len(pairs))


def measured(study: Study, count: int, slow: int, tell: Callable[[str], None]) -> list[Round]:
    """Take all measurements `count` times, rows with slow ones `slow` times, each round in another order.

    A round before them fills caches, without the slow ones, and is not counted. `tell` is told what is being measured.
    """
    order, shuffle = list(study.measurements), random.Random(study.title).shuffle
    rows = [row for row in study.rows if {row.what, row.against} <= set(order)]
    limits = {row: slow if {row.what, row.against} & set(study.slow) else count for row in rows}
    chosen = set(order) - set(study.slow)
    rounds: list[Round] = []
    for number in range(max(limits.values(), default=0) + 1):
        shuffle(order)
        found = {}
        for label in filter(chosen.__contains__, order):
            tell(f"{study.title}: round {number}, {label}")
            found[label] = study.measurements[label]()
        if number:
            rounds.append(found)
        chosen = {label for row in rows if number < limits[row] for label in (row.what, row.against)}
    return rounds
