"""Which lines of the shipped templates a text shows: templates with a mark in each line."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

from support.golden import TEMPLATES, Piece
from urdfsync.engine.package.render import Renderer

_TAG = re.compile(r"<[%#].*?[%#]>", re.DOTALL)
_ALTERNATIVE = re.compile(r'(?:"[^"\\]*(?:\\.[^"\\]*)*"(?= if | ~ ))|(?:(?<= else )|(?<= ~ ))"[^"\\]*(?:\\.[^"\\]*)*"')
"""A string of an expression that not every text has, or a part of a longer string."""
_ABSENCE = re.compile(r" if (?P<condition>(?:(?! else )[\w. ])+)(?= >>)")
"""An expression that is empty unless a condition holds."""


def mark(text: str, lines: list[str]) -> str:
    """Return a template whose lines, and the alternatives in a line, end with marks; `lines` gets what they mark."""

    def mark_string(match: re.Match[str]) -> str:
        lines.append(f"{match[0]} in {line.strip()}")
        return f'{match[0][:-1]}§{len(lines) - 1}§"'

    def mark_absence(match: re.Match[str]) -> str:
        lines.append(f"nothing unless {match['condition']} in {line.strip()}")
        return f'{match[0]} else "§{len(lines) - 1}§"'

    marked, tags, begin = list[str](), [tag.span() for tag in _TAG.finditer(text)], 0
    for line in text.split("\n"):
        end = begin + len(line)
        new = line
        if not any(first < begin < last or first < end < last for first, last in tags):  # of several lines
            new = _ABSENCE.sub(mark_absence, _ALTERNATIVE.sub(mark_string, line))
            if _TAG.sub("", line).strip():
                lines.append(line)
                new += f"§{len(lines) - 1}§"
        marked.append(new)
        begin = end + 1
    return "\n".join(marked)


@functools.cache
def _marked() -> tuple[Renderer, list[str], TemporaryDirectory[str]]:
    folder, lines = TemporaryDirectory(), list[str]()
    for path in sorted(TEMPLATES.rglob("*.jinja")):
        own = folder.name / path.relative_to(TEMPLATES)
        own.parent.mkdir(parents=True, exist_ok=True)
        own.write_text(mark(path.read_text("utf-8"), lines), "utf-8")
    return Renderer([Path(folder.name)]), lines, folder


def marked_lines() -> list[str]:
    """All lines and alternatives of the templates."""
    return _marked()[1]


def lines_shown(pieces: Iterable[Piece]) -> set[int]:
    """The numbers, in `marked_lines`, of the lines that some texts show."""
    renderer, *_ = _marked()
    return {int(number) for piece in pieces for number in re.findall("§([0-9]+)§", piece.text(renderer))}
