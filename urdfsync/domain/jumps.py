"""Numbers that jump from one export to the next, for any domain: a unit has probably changed."""

from __future__ import annotations

import math
from collections.abc import Sequence

SAME_UNIT = 0.005
"""The greatest relative difference of two ratios of the same units: exporters round."""
_UNITS = {
    1000.0: "m and mm",
    180 / math.pi: "rad and degrees",
    30 / math.pi: "rad/s and turns a minute",
    25.4: "mm and inches",
}
"""Pairs of units that exporters confuse, by their ratio."""


def units_of(ratio: float) -> str:
    """Return the two units that have this ratio, in words; empty for another ratio."""
    for size, words in _UNITS.items():
        if abs(ratio / size - 1) < SAME_UNIT or abs(ratio * size - 1) < SAME_UNIT:
            return words
    return ""


def more(items: Sequence[object]) -> str:
    """Return the number of jumps after the first one, as the end of a sentence."""
    return f" (and {len(items) - 1} more like it)" if len(items) > 1 else ""
