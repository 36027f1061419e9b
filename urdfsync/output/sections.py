"""The results of a command about one robot, as values that `terminal`, `markdown`, `sarif` and `pages` show."""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from typing import Any

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.output.console import StyledLine
from urdfsync.output.documents import with_slashes


class Mark(enum.StrEnum):
    """The sign before a robot's name, which no program draws as a picture; the worst first."""

    WRONG = "✗ "
    OPEN = "! "
    NONE = ""
    """No verdict: versions may differ."""
    FINE = "✓ "


_SEVERITIES = {Severity.ERROR: Mark.WRONG, Severity.WARNING: Mark.OPEN, Severity.NOTE: Mark.NONE}


class TextTable(msgspec.Struct, frozen=True):
    """Rows of texts; each format escapes the texts."""

    title: str
    columns: tuple[str, ...]
    """Heads; a column of empty cells is left out."""
    rows: Sequence[Sequence[Any]]
    line: Callable[..., StyledLine] | None = None
    """Turns the cells of a row into a line for terminals; None if terminals do not show the table."""
    most: int = 12
    """The greatest number of rows that a terminal shows without --verbose."""
    noun: str = "line"
    heading: Sequence[StyledLine] = ()
    """Lines of a terminal above the rows."""


class Section(msgspec.Struct, frozen=True):
    """All results of a command for one robot."""

    robot: str
    summary: str
    mark: Mark
    points: Sequence[StyledLine] = ()
    """Sentences before the tables, the structure first."""
    tables: Sequence[TextTable] = ()
    findings: Sequence[Diagnostic] = ()
    verdict: Diagnostic | None = None
    """The finding about the package as a whole; its `hint` says what to do."""
    hints: Sequence[str] = ()
    """Lines of a terminal about what to do next."""
    most: int = 12
    """The greatest number of points that a terminal shows without --verbose."""

    @property
    def has_details(self) -> bool:
        """Whether there is more to show than one line."""
        return bool(self.points or any(table.rows for table in self.tables) or self.findings or self.verdict)


def findings_table(findings: Sequence[Diagnostic]) -> TextTable:
    """Return findings as a table, the worst first."""
    order = list(Severity)
    rows = [
        (
            f"{_SEVERITIES[finding.severity]}{finding.severity}",
            ":".join([with_slashes(finding.file), *(str(number) for number in (finding.line,) if number)]),
            finding.sentence,
            finding.code,
        )
        for finding in sorted(findings, key=lambda finding: order.index(finding.severity))
    ]
    return TextTable("Findings", ("", "Place", "Finding", "Code"), rows)
