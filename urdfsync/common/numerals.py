"""The separators and the decimal marks of CSV files: English programs write `1.5,2`, European ones `1,5;2`.

The header decides on the separator: tabs if it has one outside of quotes, else semicolons, else commas. With commas,
numbers have decimal points. Otherwise all numbers of the file have the same mark, a point or a comma. A number such as
`1,234` may also have a mark of thousands: it is read only if another number, such as `0,5`, shows the decimal mark.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Any, TypeAlias

Row: TypeAlias = tuple[int, Sequence[Any]]
"""The line of a row, and its cells."""
_STATED = re.compile(r"sep=([,;\t])(?=\r?\n)", re.IGNORECASE)
_QUOTED = re.compile(r'"[^"]*"')
_NUMBER = re.compile(r"[-+]?[\d.,]+([eE][-+]?\d+)?", re.ASCII)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}([.,])\d{3}", re.ASCII)


class MarkError(ValueError):
    """The decimal mark is unknown at a line; the message has a hint after a semicolon."""

    def __init__(self, line: int, message: str, hint: str) -> None:
        super().__init__(f"{message}; {hint}")
        self.line, self.message, self.hint = line, message, hint


def find_separator(text: str) -> tuple[str, str]:
    """Return the separator of a CSV file, and the text to read with it, whose lines have the same numbers.

    A first line such as `sep=;` tells Excel the separator and is no row: the text has an empty line there.
    """
    if stated := _STATED.match(text):
        return stated[1], text[stated.end() :]
    header = _QUOTED.sub("", text).lstrip("\r\n").split("\n", 1)[0]
    return next((mark for mark in "\t;" if mark in header), ","), text


def with_points(rows: Sequence[Row], columns: Collection[int]) -> Sequence[Row]:
    """Return rows whose numbers in these columns have decimal points; for a file without separating commas.

    Raises MarkError for two marks, and for numbers that may have marks of thousands.
    """
    numbers = [(line, text) for line, cells in rows for text in _numbers(cells, columns)]
    points, commas = ([(line, text) for line, text in numbers if mark in text] for mark in ".,")
    for line, text in commas:
        if "." in text or text.count(",") > 1:
            raise MarkError(line, f"`{text}` has more than one mark", "write no marks of thousands")
    if points and commas:
        (other, point), (line, comma) = points[0], commas[0]
        message = f"`{comma}` has a comma, but `{point}` in line {other} has a point"
        raise MarkError(line, message, "write one decimal mark in all numbers, and no marks of thousands")
    for line, text in (points or commas)[:1]:
        if all(_THOUSANDS.fullmatch(text) for _, text in points or commas):
            whole = re.sub("[.,]", "", text)
            message = f"`{text}` may mean {text.replace(',', '.')} or {whole}"
            raise MarkError(line, message, f"write {text}0 or {whole}")
    if not commas:
        return rows
    return [(line, [_with_point(cell) if n in columns else cell for n, cell in enumerate(row)]) for line, row in rows]


def _numbers(cells: Sequence[Any], columns: Iterable[int]) -> Iterator[str]:
    for number in columns:
        cell = cells[number] if number < len(cells) else None
        if isinstance(cell, str) and _NUMBER.fullmatch(cell.strip()):
            yield cell.strip()


def _with_point(cell: Any) -> Any:
    return cell.replace(",", ".") if isinstance(cell, str) and _NUMBER.fullmatch(cell.strip()) else cell
