"""Literals behind numbers: by two readings with other numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from urdfsync.analysis.patches.feeds import Feeds, NewTexts
from urdfsync.analysis.patches.literals import find_literals
from urdfsync.common.diagnostics import SourceError

FILE = Path("arm.xacro")
LITERALS = find_literals(FILE, b"2 2 0 1 3")
COUNT = LITERALS[3]
Numbers = Mapping[str, Callable[..., float]]


def feeds(numbers: Numbers) -> tuple[Feeds, list[int]]:
    """Feeds of numbers that are computed from all literals, and the size of each reading."""
    sizes = list[int]()

    def read(texts: NewTexts) -> dict[tuple[str, str, int], float]:
        sizes.append(len(texts))
        if COUNT in texts:
            raise SourceError.of("xacro", "no count")
        values = [float(texts.get(literal, literal.text)) for literal in LITERALS]
        return {("", name, 0): number(*values) for name, number in numbers.items()}

    found = Feeds(read, read({}))
    sizes.clear()
    return found, sizes


@pytest.mark.parametrize(
    ("number", "direct", "computed"),
    [
        (lambda a, b, c, d, e: a, 0, None),
        (lambda a, b, c, d, e: b, 1, None),
        (lambda a, b, c, d, e: c, 2, None),
        (lambda a, b, c, d, e: 3 * b + 1, None, 1),
        (lambda a, b, c, d, e: 1 / e**2, None, 4),
        (lambda a, b, c, d, e: 1000 * c, None, 2),
        (lambda a, b, c, d, e: a * e, None, None),
        (lambda a, b, c, d, e: (a + e) / 2, None, None),
        (lambda a, b, c, d, e: round(a, 2), None, None),
    ],
)
def test_what_a_number_comes_from(number: Callable[..., float], direct: int | None, computed: int | None) -> None:
    found, _ = feeds({"x": number})
    movable = {each: (each.value,) for each in LITERALS if each is not COUNT}
    found.trace(movable, {("", "x", 0)})
    assert found.direct == ({} if direct is None else {("", "x", 0): LITERALS[direct]})
    assert {place: literal for place, (literal, _) in found.computed.items()} == (
        {} if computed is None else {("", "x", 0): LITERALS[computed]}
    )


def test_the_nearest_of_literals_with_almost_the_same_ratio_of_steps_counts() -> None:
    """Of three literals, the random ratios of the first and the last differ by 1.5e-6 only."""
    literals = find_literals(FILE, b"-90 30 60")
    found = Feeds(lambda texts: {("", "x", 0): float(texts.get(literals[2], "60")) / 2}, {("", "x", 0): 30.0})
    found.trace({each: (each.value,) for each in literals}, {("", "x", 0)})
    assert found.computed["", "x", 0][0] == literals[2]


def test_a_literal_that_cannot_change_is_left_out() -> None:
    found, sizes = feeds({"x": lambda a, *_: a, "y": lambda *all_: 2 * all_[4]})
    found.trace({each: (each.value,) for each in LITERALS}, {("", "x", 0)})
    assert found.direct["", "x", 0] == LITERALS[0]
    assert found.computed["", "y", 0][0] == LITERALS[4]
    assert len(sizes) < 2 * len(LITERALS)
