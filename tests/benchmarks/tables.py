"""Tables of what was measured, for terminals and as Markdown."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence

from rich.table import Table

from benchmarks.measuring import Quantity
from benchmarks.study import RATIO, Figures, Finding, Spread

_WORDS = ("what", "against")
"""Columns of words; all others hold numbers, to the right."""
_MEASURED = "measured"
_PAIRS = (*_WORDS, "at most", _MEASURED, "spread of it", "cost", "cost of the other", "pairs")
_BARS = (*_WORDS, "at most", _MEASURED, "pairs")


@dataclasses.dataclass(frozen=True)
class Grid:
    """A table, however it is printed."""

    title: str
    headings: Sequence[str]
    rows: Sequence[Sequence[str]]
    met: Sequence[bool | None]
    """For each row, whether what it measured meets its bar; None if it has none."""


def pairs(title: str, findings: Sequence[Finding]) -> Grid:
    """All that is known of measurements and of what they are compared with."""
    return _grid(title, _PAIRS, [(_cells(finding), finding.met) for finding in findings])


def bars(findings: Iterable[tuple[str, Finding]]) -> Grid:
    """What shall hold, and whether it does; each finding with the title of its study."""
    chosen = [(title, finding) for title, finding in findings if finding.met is not None]
    rows = [({**_cells(one), "what": f"{title}: {_what(one)}"}, one.met) for title, one in chosen]
    return _grid("what shall hold", _BARS, rows)


def figures(numbers: Figures) -> Grid:
    """Numbers without a comparison."""
    rows = [({"what": what, _MEASURED: value}, None) for what, value in numbers.values]
    return _grid(numbers.title, ("what", _MEASURED), rows)


def table(grid: Grid) -> Table:
    """For a terminal, in colours that say what is met."""
    result = Table(title=grid.title)
    for heading in grid.headings:
        result.add_column(heading, justify="left" if heading in _WORDS else "right")
    column = grid.headings.index(_MEASURED)
    for row, met in zip(grid.rows, grid.met, strict=True):
        style = {True: "green", False: "red", None: "default"}[met]
        result.add_row(*row[:column], f"[{style}]{row[column]}[/]", *row[column + 1 :])
    return result


def markdown(grid: Grid) -> str:
    """To paste into a page; what does not meet its bar is bold."""
    column, lines = grid.headings.index(_MEASURED), []
    for row, met in zip(grid.rows, grid.met, strict=True):
        reading = f"**{row[column]}**" if met is False else row[column]
        lines.append(_line([*row[:column], reading, *row[column + 1 :]]))
    alignment = _line(["---" if heading in _WORDS else "---:" for heading in grid.headings])
    return "\n".join([f"### {grid.title[:1].upper()}{grid.title[1:]}", "", _line(grid.headings), alignment, *lines, ""])


def figure(value: float) -> str:
    """A number with about three digits."""
    return f"{value:,.0f}" if abs(value) >= 100 else f"{value:.3g}"


def _grid(title: str, headings: Sequence[str], rows: Sequence[tuple[dict[str, str], bool | None]]) -> Grid:
    cells = [[found[heading] for heading in headings] for found, _ in rows]
    return Grid(title, headings, cells, [met for _, met in rows])


def _cells(finding: Finding) -> dict[str, str]:
    """What is known of a finding, by the heading of the column."""
    row, unit = finding.row, finding.row.quantity.unit
    name = "" if row.reading is RATIO else f" {row.reading.title}"
    costs = [f"{figure(spread.median)} {unit} ({_range(spread)})" for spread in (finding.mine, finding.other)]
    reading = f"{figure(finding.reading.median)}{name}"
    bar = "" if row.at_most is None else figure(row.at_most)
    values = (_what(finding), row.against, bar, reading, _range(finding.reading), *costs, f"{finding.pairs}")
    return dict(zip(_PAIRS, values, strict=True))


def _what(finding: Finding) -> str:
    row = finding.row
    return row.what if row.quantity is Quantity.WALL else f"{row.what}, {row.quantity.title}"


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _range(spread: Spread) -> str:
    return f"{figure(spread.least)} to {figure(spread.most)}"
