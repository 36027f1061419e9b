"""Misspelled names: the known name that the user may have meant."""

from __future__ import annotations

from collections.abc import Iterable


def nearest(name: str, candidates: Iterable[str], likeness: float = 0.6) -> str:
    """Return the candidate most like `name`, with a ratio of at least `likeness`; empty if there is none."""
    import difflib

    return next(iter(difflib.get_close_matches(name, list(candidates), 1, likeness)), "")
