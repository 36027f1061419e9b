"""Slips of the pen: the known name that somebody may have meant."""

from __future__ import annotations

from collections.abc import Iterable


def nearest(name: str, known: Iterable[str], likeness: float = 0.6) -> str:
    """The known name most like `name`, with a ratio of at least `likeness` (see `difflib`); empty if there is none."""
    import difflib  # only slips need it

    return next(iter(difflib.get_close_matches(name, list(known), 1, likeness)), "")
