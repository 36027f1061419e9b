"""Slips of the pen: the known name that somebody may have meant."""

from __future__ import annotations

from collections.abc import Iterable


def nearest(name: str, known: Iterable[str], likeness: float = 0.6) -> str:
    """Return the known name most like `name`, with a ratio of at least `likeness`; empty if there is none."""
    import difflib

    return next(iter(difflib.get_close_matches(name, list(known), 1, likeness)), "")
