"""Reads a source as a table: checks keys, types and units, and converts numbers to SI."""

from __future__ import annotations

import datetime
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from typing import NamedTuple

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.common.spelling import counted, name_and_unit, nearest
from urdfsync.domain import Companion, Reading
from urdfsync.formats.table import formats
from urdfsync.formats.table.model import FROM, NOTHING, TO, TYPES, CellValue, Sheet, Table, TableOptions, column_name
from urdfsync.formats.table.units import Unit, find_unit, is_same_kind

_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d{1,3})?", re.ASCII)
_KIND = re.compile(r"[A-Za-z0-9_-]+")
_TEXTS = "text", "boolean"
"""The types of columns without numbers."""
_MOST_HINTS = 20
"""The greatest number of findings before a hint at a similar name: comparing all names takes up to a second."""
_TRUTH = {"true": True, "false": False}


class _Column(NamedTuple):
    """A column: name, and unit or name of the type."""

    name: str
    type: Unit | str


def read(content: bytes, file: str, options: TableOptions, *companions: Companion) -> Reading:
    """Read a source; see `Domain.read`."""
    reader = _TableReader(options)
    try:
        elements, connections = formats.read_sheets(content, file, *companions)
        table = reader.read(elements, connections)
    except SourceError as error:
        return Reading(None, (*reader.findings, *error.diagnostics))
    is_wrong = any(finding.severity is Severity.ERROR for finding in reader.findings)
    files = {path: connections.file for path in reader.lines if companions and path.startswith("connection ")}
    return Reading(None if is_wrong else table, tuple(reader.findings), reader.lines, files, tuple(reader.of_options))


class _TableReader:
    """Reads one source, and collects its findings."""

    def __init__(self, options: TableOptions) -> None:
        self.findings: list[Diagnostic] = []
        self.of_options: list[tuple[str, Diagnostic]] = []
        self.lines: dict[str, int] = {}
        self._options = options

    def read(self, elements: Sheet, connections: Sheet) -> Table:
        """Return the table, which is complete if no finding is an error."""
        key = self._options.key or (name_and_unit(elements.header[0])[0] if elements.header else "")
        columns = self._columns(elements, {key, self._options.kind} - {""})
        links = self._columns(connections, {FROM, TO})
        elements, connections = (
            formats.with_decimal_points(sheet, [n for n, c in enumerate(found) if c.type not in _TEXTS])
            for sheet, found in ((elements, columns), (connections, links))
        )
        known = {column.name for column in (*columns, *links)}
        for option, name in [
            ("key", key),
            ("kind", self._options.kind),
            *(("columns", n) for n in self._options.columns),
        ]:
            if name and name not in known and elements.header:
                near = nearest(name, known)
                hint = f"did you mean `{near}`?" if near else f"the columns are {', '.join(sorted(known))}"
                message = f"there is no column `{name}`"
                self.of_options.append((option, Diagnostic(Severity.ERROR, "no-column", message, hint=hint)))
        if connections.rows and (lacking := {FROM, TO} - known):
            message = f"the connections have no column `{min(lacking)}`"
            self._error(connections, "no-column", message, 0, "name both elements in each row")
            connections = NOTHING
        rows = {} if self.of_options else self._rows(elements, columns, key)
        is_whole = not self.of_options and len(rows) == len(elements.rows)
        joined = self._connections(connections, links, rows) if is_whole else {}
        self.findings += [
            Diagnostic(Severity.NOTE, "not-modelled", f"not modelled: {note}", elements.file) for note in elements.notes
        ]
        types, of_links = (
            {c.name: c.type if isinstance(c.type, str) else c.type.si for c in each} for each in (columns, links)
        )
        return Table(types, rows, of_links, joined)

    def _columns(self, sheet: Sheet, texts: set[str]) -> list[_Column]:
        """Return the columns; the columns in `texts` have texts."""
        columns, names = list[_Column](), dict[str, str]()
        for number, cell in enumerate(sheet.header):
            name, unit = name_and_unit(cell)
            if not name or not name.isprintable():
                self._error(sheet, "no-column", f"column {number + 1} has no name", 1, "name the column in the header")
            elif other := names.get(column_name(name)):
                words = f"columns `{other}` and `{name}` have one name in Modelica, `{column_name(name)}`"
                message = f"there are two columns `{name}`" if other == name else words
                self._error(sheet, "no-column", message, 1, "rename one")
            if name in texts and unit not in ("", "text"):
                hint = "name columns of texts as `key` and `kind` in the configuration"
                self._error(sheet, "no-key", f"column `{name}` has the unit {unit}: it can't name elements", 1, hint)
            names[column_name(name)] = name
            is_text = name in texts or not name
            columns.append(_Column(name, "text" if is_text else self._type(name, unit, sheet, number)))
        return columns

    def _type(self, name: str, unit: str, sheet: Sheet, number: int) -> Unit | str:
        """Return the unit or the type of a column, from the header and the configuration."""
        declared = self._options.columns.get(name, "")
        try:
            if (unit or declared) in TYPES:
                return unit or declared
            if unit and declared and not is_same_kind(unit, declared):
                message = f"column `{name}` is in {unit}, but the configuration says {declared}"
                self._error(sheet, "bad-unit", message, 1, "correct one")
            if unit or declared:
                return find_unit(unit or declared)
        except ValueError as error:
            self._error(
                sheet, "bad-unit", f"column `{name}`: {error}", 1, "write a unit such as `kg.m2`, or `1` for none"
            )
            return "text"
        except SourceError as error:
            self._error(sheet, error.diagnostics[0].code, error.diagnostics[0].message, 1, error.diagnostics[0].hint)
            return "text"
        cells = [cells[number] for _, cells in sheet.rows if number < len(cells) and cells[number] not in (None, "")]
        if sheet.may_have_commas:
            cells = [cell.replace(",", ".") if isinstance(cell, str) else cell for cell in cells]
        if cells and all(_is_number(cell) for cell in cells):
            hint = f"write `{name} [kg]` with the unit, `{name} [1]` without a unit, or `{name} [text]`"
            self._error(sheet, "no-unit", f"column `{name}` has numbers but no unit", 1, hint)
        return "text"

    def _rows(self, sheet: Sheet, columns: Sequence[_Column], key: str) -> dict[str, dict[str, CellValue]]:
        rows = dict[str, dict[str, CellValue]]()
        for line, row in self._values(sheet, columns):
            name = str(row.pop(key, None) or "")
            kind = row.get(self._options.kind) if self._options.kind else None
            if not name:
                self._error(sheet, "no-key", "the row has no key", line, f"fill its column `{key}`")
            elif name in rows:
                first = self.lines[f"element {name}"]
                self._error(sheet, "duplicate-key", f"the key `{name}` stands in line {first}, too", line, "rename one")
            elif self._options.kind and not (isinstance(kind, str) and _KIND.fullmatch(kind)):
                hint = "use letters, digits, `_` and `-`: the kind names a template"
                self._error(sheet, "no-kind", f"the kind `{kind or ''}` of `{name}` can't be a template", line, hint)
            else:
                rows[name], self.lines[f"element {name}"] = row, line
        return rows

    def _connections(
        self, sheet: Sheet, columns: Sequence[_Column], elements: Mapping[str, object]
    ) -> dict[str, dict[str, CellValue]]:
        rows, numbers = dict[str, dict[str, CellValue]](), dict[str, int]()
        first_lines = dict[object, int]()
        for line, row in self._values(sheet, columns):
            ends = [str(row.get(end) or "") for end in (FROM, TO)]
            for name in ends:
                if name not in elements:
                    near = nearest(name, elements) if len(self.findings) < _MOST_HINTS else ""
                    hint = f"did you mean `{near}`?" if near else "add the element, or correct the connection"
                    self._error(sheet, "no-element", f"there is no element `{name}`", line, hint)
            cells = tuple(sorted(row.items()))
            if cells in first_lines:
                message = f"the connection `{' '.join(ends)}` stands in line {first_lines[cells]}, too"
                hint = "delete one, or number equal connections in a column of their own"
                self.findings.append(
                    Diagnostic(Severity.WARNING, "equal-connections", message, sheet.file, line, hint=hint)
                )
            first_lines.setdefault(cells, line)
            key, number = " ".join(ends), numbers.get(" ".join(ends), 2)
            while key in rows:
                key, number = f"{' '.join(ends)} {number}", number + 1
            numbers[" ".join(ends)] = number
            rows[key], self.lines[f"connection {key}"] = row, line
        return rows

    def _values(self, sheet: Sheet, columns: Sequence[_Column]) -> Iterator[tuple[int, dict[str, CellValue]]]:
        """Yield the rows with their values; report the first fault of each cell."""
        for line, cells in sheet.rows:
            if len(cells) != len(columns):
                message = f"the row has {counted(len(cells), 'cell')}, but the header has {len(columns)}"
                self._error(
                    sheet, "ragged-row", message, line, "fill each cell, or quote a text that has the separator"
                )
                continue
            row = dict[str, CellValue]()
            for column, cell in zip(columns, cells, strict=True):
                try:
                    if (value := read_value(cell, column.type)) is not None:
                        row[column.name] = value
                except ValueError as error:
                    self._error(sheet, "bad-cell", f"column `{column.name}`: {error}", line, "correct the cell")
            yield line, row

    def _error(self, sheet: Sheet, code: str, message: str, line: int, hint: str) -> None:
        self.findings.append(Diagnostic(Severity.ERROR, code, message, sheet.file, line, hint=hint))


def _is_number(cell: object) -> bool:
    if isinstance(cell, str):
        return _NUMBER.fullmatch(cell.strip()) is not None
    return isinstance(cell, int | float) and not isinstance(cell, bool) and math.isfinite(cell)


def read_value(cell: object, kind: Unit | str) -> CellValue | None:
    """Return the value of a cell in SI; None for an empty cell. Raises ValueError."""
    text = cell.strip() if isinstance(cell, str) else cell
    if text is None or text == "":
        return None
    if isinstance(text, datetime.date | datetime.time):
        if kind != "text":
            raise ValueError(f"{text} is a date, not a number")
        return text.isoformat()
    if kind == "boolean":
        if not isinstance(text, str | bool):
            raise ValueError("write true or false")
        if isinstance(text, bool) or str(text).lower() in _TRUTH:
            return _TRUTH[str(text).lower()]
        raise ValueError(f"`{text}` is neither true nor false")
    if not isinstance(text, str | int | float):  # the text of a list may be endless
        raise ValueError("a cell can't be a list or a table")  # noqa: TRY004 - as all faults of cells
    if kind == "text":
        str(text).encode()  # JSON may have half of a character: UnicodeError is a ValueError
        return str(text)
    if not _is_number(text):
        point = str(text).replace(",", ".") if str(text).count(",") == 1 else ""
        more = f": write {point}" if _NUMBER.fullmatch(point) else ""
        if re.fullmatch(r"[-+]?\d{1,3},\d{3}", str(text)):  # an English number with thousands
            more = f": write {point} or {str(text).replace(',', '')}, as you mean it"
        raise ValueError(f"`{text}` is no number{more}")
    number = Decimal(str(text))
    if isinstance(kind, Unit):
        value = kind.convert(number)
        if abs(value) == float("inf"):
            raise ValueError(f"{text} is too large")
        return value
    if number != int(number) or abs(number) >= 2**31:
        raise ValueError(f"{text} is no integer that Modelica can hold")
    return int(number)
