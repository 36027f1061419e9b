"""Merge markers of git: they have seven signs; nested markers have more."""

from __future__ import annotations

import re

_MARKER = re.compile(r"(<{7,}|\|{7,}|={7,}|>{7,})(?=\s|\Z)")


def find_markers(text: str, signs: str = "<>") -> list[tuple[str, int]]:
    """Return the markers of these signs with their lines, from 1. `=======` alone may also be a line in a comment."""
    lines = ((line, number) for number, line in enumerate(text.split("\n"), 1) if line[:1] in signs)
    return [(marker[1], number) for line, number in lines if (marker := _MARKER.match(line))]


def read_sides(text: str) -> tuple[str, str]:
    """Return two texts: between the outermost markers, one text has only our lines, the other text only their lines."""
    pieces = _pieces(text)
    return "".join(ours for ours, _ in pieces), "".join(ours if theirs is None else theirs for ours, theirs in pieces)


def join_sides(text: str) -> str:
    """Return the text with the lines of both sides, and without the outermost markers."""
    return "".join(ours + (theirs or "") for ours, theirs in _pieces(text))


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


def _pieces(text: str) -> list[tuple[str, str | None]]:
    """Return the text in pieces: texts between conflicts with None, and of each conflict our lines and their lines.

    One pass: a search for the end of each marker would take hours on a text of markers without an end.
    """
    marker = re.compile(rf"^([<|=>])\1{{{_size(text) - 1}}}(?=\s|\Z)[^\n]*(?:\n|\Z)", re.MULTILINE)
    pieces, end, places = list[tuple[str, str | None]](), 0, dict[str, re.Match[str]]()
    for found in marker.finditer(text):
        sign = found[1]
        if not places:
            places = {sign: found} if sign == "<" else {}
        elif sign == "=" or (sign == "|" and "=" not in places):
            places.setdefault(sign, found)
        elif sign == ">" and "=" in places:
            begin, middle = places["<"], places["="]
            ours = text[begin.end() : places.get("|", middle).start()]
            pieces += [(text[end : begin.start()], None), (ours, text[middle.end() : found.start()])]
            end, places = found.end(), {}
    return [*pieces, (text[end:], None)]
