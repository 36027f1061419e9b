"""What a command found out about one robot, as values: `terminal`, `markdown`, `sarif` and `pages` show them."""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from typing import Any

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.output.console import StyledLine


class Mark(enum.StrEnum):
    """The verdict on a robot, as a sign before its name; the worst first."""

    WRONG = "❌ "
    OPEN = "⚠️ "
    NONE = ""
    """No verdict: two versions differ, as they may."""
    FINE = "✅ "


_SEVERITIES = {Severity.ERROR: Mark.WRONG, Severity.WARNING: Mark.OPEN, Severity.NOTE: "ℹ️ "}


class Table(msgspec.Struct, frozen=True):
    """Rows of texts, which are escaped when they are written."""

    title: str
    columns: tuple[str, ...]
    """Heads; of a column whose cells are all empty, nothing is written."""
    rows: Sequence[Sequence[Any]]
    line: Callable[..., StyledLine] | None = None
    """The line of a terminal for the cells of a row; None if a terminal does not show them."""
    most: int = 12
    """So many rows are lines of a terminal without --verbose."""
    noun: str = "line"
    heading: Sequence[StyledLine] = ()
    """Lines above these on a terminal."""


class Section(msgspec.Struct, frozen=True):
    """All that a command says of one robot."""

    robot: str
    summary: str
    mark: Mark
    points: Sequence[StyledLine] = ()
    """Sentences before the tables, the structure first."""
    tables: Sequence[Table] = ()
    findings: Sequence[Diagnostic] = ()
    verdict: Diagnostic | None = None
    """The finding that the package as a whole is not as it should be; its `hint` says what to do."""
    hints: Sequence[str] = ()
    """Lines of a terminal about what to do next."""
    most: int = 12
    """So many points are lines of a terminal without --verbose."""

    @property
    def has_details(self) -> bool:
        """Whether there is more to say than one line."""
        return bool(self.points or any(table.rows for table in self.tables) or self.findings or self.verdict)


def findings_table(findings: Sequence[Diagnostic]) -> Table:
    """Return findings as a table, the worst first."""
    order = list(Severity)
    rows = [
        (
            f"{_SEVERITIES[finding.severity]}{finding.severity}",
            ":".join([finding.file, *(str(number) for number in (finding.line,) if number)]),
            finding.sentence,
            finding.code,
        )
        for finding in sorted(findings, key=lambda finding: order.index(finding.severity))
    ]
    return Table("Findings", ("", "Place", "Finding", "Code"), rows)
