"""Tables of what was measured, for terminals and as Markdown."""

from __future__ import annotations

from collections.abc import Sequence

from rich.table import Table

from benchmarks.measuring import Quantity
from benchmarks.study import RATIO, Figures, Finding, Spread

_HEADINGS = ("what", "against", "at most", "measured", "spread of it", "cost", "cost of the other", "pairs")
_WORDS = 2
"""So many columns hold words; the others hold numbers."""


def figure(value: float) -> str:
    """A number with about three digits."""
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"


def table(title: str, findings: Sequence[Finding]) -> Table:
    """For a terminal."""
    result = Table(title=title)
    for number, heading in enumerate(_HEADINGS):
        result.add_column(heading, justify="left" if number < _WORDS else "right")
    for finding in findings:
        *before, reading, spread, cost, other, pairs = cells(finding)
        style = {True: "green", False: "red", None: "default"}[finding.met]
        result.add_row(*before, f"[{style}]{reading}[/]", spread, cost, other, pairs)
    return result


def markdown(title: str, findings: Sequence[Finding]) -> str:
    """To paste into a page; what exceeds its bar is bold."""
    rows = []
    for finding in findings:
        what, against, bar, reading, *rest = cells(finding)
        rows.append((what, against, bar, f"**{reading}**" if finding.met is False else reading, *rest))
    alignment = "| --- " * _WORDS + "| ---: " * (len(_HEADINGS) - _WORDS) + "|"
    return "\n".join([f"### {title}", "", _line(_HEADINGS), alignment, *map(_line, rows), ""])


def cells(finding: Finding) -> tuple[str, ...]:
    """What the row of a finding says."""
    row, unit = finding.row, finding.row.quantity.unit
    what = row.what if row.quantity is Quantity.WALL else f"{row.what}: {row.quantity.title}"
    bar = "" if row.at_most is None else figure(row.at_most)
    name = "" if row.reading is RATIO else f" {row.reading.title}"
    reading = f"{figure(finding.reading.median)}{name}"
    costs = (f"{figure(spread.median)} {unit} ({_range(spread)})" for spread in (finding.mine, finding.other))
    return (what, row.against, bar, reading, _range(finding.reading), *costs, f"{finding.pairs}")


def figures_table(figures: Figures) -> Table:
    """Numbers without a comparison, for a terminal."""
    result = Table("what", "measured", title=figures.title)
    for row in figures.values:
        result.add_row(*row)
    return result


def figures_markdown(figures: Figures) -> str:
    """The same to paste into a page."""
    rows = map(_line, figures.values)
    return "\n".join([f"### {figures.title}", "", "| what | measured |", "| --- | --- |", *rows, ""])


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _range(spread: Spread) -> str:
    return f"{figure(spread.least)} to {figure(spread.most)}"
