"""A section as lines of a terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from urdfsync.common.streams import has_marks
from urdfsync.output.console import StyledLine, first_lines, line
from urdfsync.output.sections import Mark, Section

_STYLES = {Mark.WRONG: "bold red", Mark.OPEN: "yellow", Mark.NONE: "", Mark.FINE: "green"}
_FILES = {
    "green": "update create restore merge undo move stale missing",
    "magenta": "delete",
    "bold red": "conflict",
    "cyan": "keep edited",
    "yellow": "orphan needed waiting unknown",
}
"""Styles of the words for actions on files and for their states."""
_CHANGES = {"added": "green", "removed": "red", "renamed": "cyan", "rounding": "dim", "not modelled": "dim"}


def text(section: Section, *, verbose: bool = False, quiet: bool = False) -> Iterator[StyledLine]:
    """Yield all lines about a robot but its findings; with `quiet`, the first line and what to do."""
    marks = [(section.mark.value, _STYLES[section.mark])] if has_marks(sys.stdout) else []
    yield line(*marks, (section.robot, "bold"), (f": {section.summary}", ""))
    yield from details(section, verbose=verbose) if not quiet else _hints(section)


def details(section: Section, *, verbose: bool = False) -> Iterator[StyledLine]:
    """Yield the lines below the first one; without `verbose`, long tables are cut."""
    yield from first_lines(section.points, section.most, "line", verbose=verbose)
    for table in section.tables:
        if table.line and table.rows:
            yield from table.heading
            yield from first_lines([table.line(*row) for row in table.rows], table.most, table.noun, verbose=verbose)
    yield from _hints(section)


def _hints(section: Section) -> Iterator[StyledLine]:
    return (line((f"  {hint}", "dim")) for hint in section.hints)


def file_line(path: str, word: str, why: str = "") -> StyledLine:
    """Return a line for one file: `  update     modelica/Arm/Arm.mo  why`."""
    style = next((style for style, words in _FILES.items() if word in words.split()), "dim")
    return line((f"  {word:<9}  ", style), (path, ""), (f"  {why}" if why else "", "dim"))


def change_line(text: str) -> StyledLine:
    """Return a line about a change, with its element in bold: `  link fore: inertial / mass 1 → 1.2 kg (+20 %)`."""
    element, colon, what = text.partition(": ")
    style = next((style for word, style in _CHANGES.items() if what.startswith(word)), "")
    return line((f"  {element}{colon}", "bold" if colon else ""), (what, style))
