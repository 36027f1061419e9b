"""Merge markers of git: they have seven signs; nested markers have more."""

from __future__ import annotations

import re

_MARKER = re.compile(r"^(<{7,}|\|{7,}|={7,}|>{7,})(?=\s|\Z)", re.MULTILINE)


def find_markers(text: str, signs: str = "<>") -> list[tuple[str, int]]:
    """Return the markers of these signs with their lines, from 1. `=======` alone may also be a line in a comment."""
    found = (marker for marker in _MARKER.finditer(text) if marker[1][0] in signs)
    return [(marker[1], text.count("\n", 0, marker.start()) + 1) for marker in found]


def read_sides(text: str) -> tuple[str, str]:
    """Return two texts: between the outermost markers, one text has only our lines, the other text only their lines."""
    pattern = _conflict(_size(text))
    return pattern.sub(r"\g<ours>", text), pattern.sub(r"\g<theirs>", text)


def join_sides(text: str) -> str:
    """Return the text with the lines of both sides, and without the outermost markers."""
    return _conflict(_size(text)).sub(r"\g<ours>\g<theirs>", text)


def without_labels(text: str) -> str:
    """Return the text without labels after the outermost markers; lines end with line feeds."""
    return re.sub(rf"(?m)^([<>]{{{_size(text)}}}) .*$", r"\1", text)


def signs(text: str) -> tuple[str, str, str]:
    """Return the three markers that a merge driver puts around the sides of a conflict."""
    size = _size(text)
    return "<" * size, "=" * size, ">" * size


def _size(text: str) -> int:
    """Return the length of the outermost markers."""
    return min((len(sign) for sign, _ in find_markers(text)), default=7)


def _conflict(size: int) -> re.Pattern[str]:
    first, base, middle, last = (rf"^{re.escape(sign)}{{{size}}}(?=\s|\Z)[^\n]*(?:\n|\Z)" for sign in "<|=>")
    return re.compile(rf"(?ms){first}(?P<ours>.*?)(?:{base}.*?)?{middle}(?P<theirs>.*?){last}")
