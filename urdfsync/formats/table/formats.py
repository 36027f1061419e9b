"""Reads tables from CSV, TOML, JSON, YAML and XLSX as sheets: rows of plain cells, with line numbers."""

from __future__ import annotations

import csv
import io
import json
import re
import tomllib
import warnings
import zipfile
from collections.abc import Collection, Mapping, Sequence
from pathlib import PurePath
from typing import Any

from urdfsync.common.diagnostics import SourceError
from urdfsync.common.extras import install_command
from urdfsync.common.numerals import MarkError, find_separator, with_points
from urdfsync.domain import Companion
from urdfsync.formats.table.model import NOTHING, Sheet

CONNECTIONS = "connections"
_LARGEST = 20_000_000
"""The greatest number of bytes of an unpacked workbook: openpyxl reads 1 MB/s."""
_MOST_CELLS = 5_000_000
"""The greatest number of cells of a table, empty ones included."""
_LAST_ROW = 1_048_576
_MERGED = re.compile(rb"""<(?:\w++:)?mergeCell\s[^<>]*?\bref\s*+=\s*+["']([A-Z]++(\d++)[^"'<>]*)""")
_MOST_MISSES = 100
"""The greatest number of entries whose place is looked for in vain, as if a file escapes its letters."""


def read_sheets(content: bytes, file: str, *companions: Companion) -> tuple[Sheet, Sheet]:
    """Return elements and connections; a companion is a CSV with the connections.

    Raises SourceError for a source without a table.
    """
    suffix = PurePath(file).suffix.lower()
    if suffix not in _READERS:
        hint = f"use one of {', '.join(sorted(filter(None, _READERS)))}"
        raise SourceError.of("table-format", f"`{suffix}` is no format of tables", file, hint=hint)
    elements, connections = (sheet._replace(file=file) for sheet in _READERS[suffix](content, file))
    for companion in companions:
        connections = _read_csv(companion.content, companion.file)[0]._replace(file=companion.file)
    if not elements.rows:
        raise _fault("the table has no rows", file, "write a header and a row for each element")
    return elements, connections


def _read_csv(content: bytes, file: str) -> tuple[Sheet, Sheet]:
    """Read a CSV."""
    separator, text = find_separator(_decode(content, file))
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    rows, line = list[tuple[int, Sequence[object]]](), 1
    try:
        for row in reader:
            if any(cell.strip() for cell in row):
                rows.append((line, row))
            line = reader.line_num + 1
    except csv.Error as error:
        raise _fault(f"this is no CSV: {error}", file, "correct it", line) from None
    if not rows:
        return NOTHING, NOTHING
    if not rows[0][1][-1]:  # spreadsheets write a separator for each column that ever had a cell
        width = max(len(_without_end(cells)) for _, cells in rows)
        rows = [(line, cells[:width]) for line, cells in rows]
    return Sheet([str(cell) for cell in rows[0][1]], rows[1:], may_have_commas=separator != ","), NOTHING


def with_decimal_points(sheet: Sheet, columns: Collection[int]) -> Sheet:
    """Return a sheet whose numbers in these columns have decimal points. Raises SourceError if the mark is unknown."""
    try:
        return sheet._replace(rows=with_points(sheet.rows, columns)) if sheet.may_have_commas else sheet
    except MarkError as error:
        raise SourceError.of("decimal-mark", error.message, sheet.file, error.line, hint=error.hint) from None


def _read_data(content: bytes, file: str) -> tuple[Sheet, Sheet]:
    """Read TOML, JSON or YAML."""
    text, suffix = _decode(content, file), PurePath(file).suffix.lower()
    try:
        if suffix == ".toml":
            data = tomllib.loads(text)
        elif suffix == ".json":
            data = json.loads(text, object_pairs_hook=_without_repetition)
        else:
            data = _read_yaml(text)
    except (ValueError, RecursionError) as error:
        raise _fault(f"this is no {suffix[1:].upper()}: {' '.join(str(error).split())}", file, "correct it") from None
    return _from_data(data, text, file)


def _read_yaml(text: str) -> Any:
    """Raises ValueError."""
    import yaml

    class Loader(yaml.SafeLoader):  # type: ignore[misc] # PyYAML has no types
        """Reads all cells as texts, and refuses equal keys. PyYAML reads `100:1` as 6001, and `010` as 8."""

        yaml_implicit_resolvers = {  # noqa: RUF012 - PyYAML's name and type
            first: [(tag, pattern) for tag, pattern in kinds if tag.endswith((":merge", ":null"))]
            for first, kinds in yaml.SafeLoader.yaml_implicit_resolvers.items()
        }

    def mapping(loader: yaml.SafeLoader, node: yaml.MappingNode) -> dict[Any, Any]:
        loader.flatten_mapping(node)
        return _without_repetition(loader.construct_pairs(node, deep=True))

    Loader.add_constructor("tag:yaml.org,2002:map", mapping)
    try:
        return yaml.load(text, Loader)  # noqa: S506 - a safe loader
    except (yaml.YAMLError, TypeError) as error:  # TypeError: a key is a list
        raise ValueError(str(error)) from None


def _without_repetition(pairs: Sequence[tuple[Any, Any]]) -> dict[Any, Any]:
    """Return a dict. Raises ValueError for a repeated key."""
    found = dict[Any, Any]()
    for key, value in pairs:
        if key in found:
            raise ValueError(f"the key `{key}` stands there twice")
        found[key] = value
    return found


def _from_data(data: object, text: str, file: str) -> tuple[Sheet, Sheet]:
    """Return the sheets of elements and connections.

    The data has `elements` and perhaps `connections`. Without `elements`, the list or the mapping itself has the
    elements, and the keys of the mapping name them.
    """
    lists = data if isinstance(data, Mapping) else {"elements": data}
    if "elements" not in lists:
        lists = {
            CONNECTIONS: lists.get(CONNECTIONS, []),
            "elements": {k: v for k, v in lists.items() if k != CONNECTIONS},
        }
    if unknown := lists.keys() - {"elements", CONNECTIONS}:
        raise _fault(f"`{min(map(str, unknown))}` is unknown", file, f"a table has `elements` and `{CONNECTIONS}`")
    elements, connections = (
        _from_entries(lists.get(name, []), text, file, max(text.find(name), 0)) for name in ("elements", CONNECTIONS)
    )
    return elements, connections


def _from_entries(entries: object, text: str, file: str, position: int) -> Sheet:
    """Return the sheet of entries that begin after a position in the text."""
    if isinstance(entries, Mapping) and all(isinstance(entry, Mapping) for entry in entries.values()):
        column = "key" if any("name" in entry for entry in entries.values()) else "name"
        entries = [{column: name, **entry} for name, entry in entries.items()]
    if not (isinstance(entries, list) and all(isinstance(entry, Mapping) for entry in entries)):
        hint = "write one entry for each element, with the columns as keys"
        raise _fault("the elements are neither a list nor a table of entries", file, hint)
    header = list(dict.fromkeys(str(column) for entry in entries for column in entry))
    if len(header) * len(entries) > _MOST_CELLS:
        raise _too_many_cells(file)
    rows, misses = list[tuple[int, Sequence[object]]](), 0
    line = text.count("\n", 0, position) + 1
    for entry in entries:
        cells = {str(column): value for column, value in entry.items()}
        # entries are in order: the line of an entry is that of its first value after the previous entry
        first = next(iter(cells.values()), "")
        if isinstance(first, str | int | float) and misses < _MOST_MISSES:
            word = re.compile(rf"(?<![^\W_]){re.escape(str(first))}(?![^\W_])").search(text, position)
            misses += word is None
            if word:
                line, position = line + text.count("\n", position, word.start()), word.start() + 1
        rows.append((line, [cells.get(column) for column in header]))
    return Sheet(header, rows)


def _read_xlsx(content: bytes, file: str) -> tuple[Sheet, Sheet]:
    """Read the first sheet, and the sheet `connections`. Formulas have the values that were last computed."""
    try:
        import openpyxl
    except ImportError:
        hint = install_command("table")
        raise SourceError.of(
            "no-openpyxl", "a workbook needs openpyxl, which is not installed", file, hint=hint
        ) from None
    if zipfile.is_zipfile(io.BytesIO(content)):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if sum(each.file_size for each in archive.infolist()) > _LARGEST:
                raise _fault(f"the workbook has more than {_LARGEST:,} bytes", file, "split it")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # openpyxl warns of ignored parts, such as conditional formats
        try:
            # `read_only` reads cells alone: a merged range or a link of the whole sheet would fill the memory
            values, formulas = (
                openpyxl.load_workbook(io.BytesIO(content), read_only=True, data_only=computed)
                for computed in (True, False)
            )
            names = values.sheetnames
            named = {name.lower(): name for name in names}
            found = [names[0], named[CONNECTIONS]] if CONNECTIONS in named and len(names) > 1 else names[:1]
            sheets = [_from_worksheet(values[name], formulas[name], file) for name in found]
        except SourceError:
            raise
        except Exception as error:  # noqa: BLE001 - openpyxl may raise any error for a damaged file
            raise _fault(f"this is no workbook: {error}", file, "save the workbook as .xlsx again") from None
    return sheets[0], sheets[1] if len(sheets) > 1 else NOTHING


def _from_worksheet(values: Any, formulas: Any, file: str) -> Sheet:
    with values._get_source() as source:  # in the mode `read_only`, openpyxl tells no merged cells
        merged = _MERGED.search(source.read())
    if merged:
        message = f"sheet `{values.title}` has merged cells: {merged[1].decode(errors='replace')}"
        raise _fault(message, file, "unmerge these cells, and fill each cell", int(merged[2][:9]))
    rows, count = list[tuple[int, Sequence[object]]](), 0
    for sheet in (values, formulas):
        sheet.reset_dimensions()  # the file may state another size
    for number, (cells, originals) in enumerate(zip(values.iter_rows(), formulas.iter_rows(), strict=True), 1):
        count += len(cells)
        if count > _MOST_CELLS or number > _LAST_ROW:
            raise _too_many_cells(file)
        for cell, original in zip(cells, originals, strict=True):
            if cell.value is None and original.value is not None:
                message = f"the formula in {cell.coordinate} has no result"
                raise _fault(message, file, "open the workbook, and save it", number)
        if any(cell.value is not None for cell in cells):
            rows.append((number, [cell.value for cell in cells]))
    if not rows:
        return NOTHING
    header = _without_end(rows[0][1])
    width, empty = len(header), [None] * len(header)
    if width * len(rows) > _MOST_CELLS:
        raise _too_many_cells(file)
    return Sheet(
        ["" if cell is None else str(cell) for cell in header],
        [
            (line, _without_end(cells) if any(c is not None for c in cells[width:]) else [*cells, *empty][:width])
            for line, cells in rows[1:]
        ],
    )


def _too_many_cells(file: str) -> SourceError:
    message = f"the table has more than {_MOST_CELLS:,} cells, empty ones included"
    return _fault(message, file, "delete what lies far outside")


def _fault(message: str, file: str, hint: str, line: int = 0) -> SourceError:
    return SourceError.of("table-file", message, file, line, hint=hint)


def _without_end(cells: Sequence[object]) -> Sequence[object]:
    """Return the cells up to the last filled cell."""
    last = max((number for number, cell in enumerate(cells, 1) if cell not in (None, "")), default=0)
    return cells[:last]


def _read_epanet(content: bytes, file: str) -> tuple[Sheet, Sheet]:
    from urdfsync.formats.table import epanet

    return epanet.read(content, file)


def _decode(content: bytes, file: str) -> str:
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        is_csv = PurePath(file).suffix.lower() not in (".json", ".toml", ".yaml", ".yml")
        hint = f"save the file as {'`CSV UTF-8`, as Excel calls it' if is_csv else 'UTF-8'}, then try again"
        raise _fault("the file is not UTF-8", file, hint, line) from None


_READERS = {
    "": _read_csv,
    ".csv": _read_csv,
    ".inp": _read_epanet,
    ".json": _read_data,
    ".toml": _read_data,
    ".tsv": _read_csv,
    ".xlsx": _read_xlsx,
    ".yaml": _read_data,
    ".yml": _read_data,
}
