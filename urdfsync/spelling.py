"""Compares texts: similar names, common beginnings; and escapes texts for terminals."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import zip_longest


def nearest(name: str, candidates: Iterable[str], likeness: float = 0.6) -> str:
    """Return the candidate most like `name`, with a ratio of at least `likeness`; empty if there is none."""
    import difflib

    return next(iter(difflib.get_close_matches(name, list(candidates), 1, likeness)), "")


def same_count(old: Sequence[str], new: Sequence[str]) -> int:
    """Return the number of equal characters, or lines, at the beginning of both texts."""
    return next((index for index, pair in enumerate(zip_longest(old, new)) if pair[0] != pair[1]), len(old))


def counted(count: int, noun: str) -> str:
    """`1 file`, `2 files`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def visible(text: str) -> str:
    """Return the text with terminals' control characters escaped."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
