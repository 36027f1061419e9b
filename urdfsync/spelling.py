"""Texts that are alike: names that the user may have meant, and how far two texts are the same."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import zip_longest


def nearest(name: str, candidates: Iterable[str], likeness: float = 0.6) -> str:
    """Return the candidate most like `name`, with a ratio of at least `likeness`; empty if there is none."""
    import difflib

    return next(iter(difflib.get_close_matches(name, list(candidates), 1, likeness)), "")


def same_count(old: Sequence[str], new: Sequence[str]) -> int:
    """Return how many characters, or lines, at the beginning are the same."""
    return next((index for index, pair in enumerate(zip_longest(old, new)) if pair[0] != pair[1]), len(old))
