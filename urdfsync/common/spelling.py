"""Compares texts and numbers: similar names, common beginnings, growth; and escapes texts for terminals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice, zip_longest

_LONGEST, _MOST = 100, 5000
"""The greatest number of characters of a name, and the most names, that are compared: each takes up to 0.2 ms."""


def nearest(name: str, candidates: Iterable[str], likeness: float = 0.6) -> str:
    """Return the candidate most like `name`, with a ratio of at least `likeness`; empty if there is none."""
    import difflib

    if len(name) > _LONGEST:
        return ""
    possible = islice((candidate for candidate in candidates if len(candidate) <= _LONGEST), _MOST)
    return next(iter(difflib.get_close_matches(name, possible, 1, likeness)), "")


def name_and_unit(header: str) -> tuple[str, str]:
    """Return the name and the unit in a header such as `mass [kg]`. Both may be empty."""
    name, bracket, unit = header.strip().rpartition("[")
    if bracket and unit.find("]") == len(unit) - 1:
        return name.rstrip(), unit[:-1].strip()
    return header.strip(), ""


def same_count(old: Sequence[str], new: Sequence[str]) -> int:
    """Return the number of equal characters, or lines, at the beginning of both texts."""
    return next((index for index, pair in enumerate(zip_longest(old, new)) if pair[0] != pair[1]), len(old))


def counted(count: int, noun: str) -> str:
    """`1 file`, `2 files`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def growth(old: float, new: float) -> float | None:
    """Return by how many percent the size of a number grew; None after zero, or a change of sign."""
    return None if old == 0 or new / old < 0 else 100 * (abs(new) - abs(old)) / abs(old)


def visible(text: str) -> str:
    """Return the text with terminals' control characters escaped."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
