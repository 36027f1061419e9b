"""Reads the rows of CSV and Parquet, a part at a time: for the process that reads logs."""

from __future__ import annotations

import csv
import itertools
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from urdfsync.common.diagnostics import ConfigError, SourceError
from urdfsync.common.extras import install_command
from urdfsync.common.files import shown
from urdfsync.common.numerals import find_separator
from urdfsync.domain.regressor import Array

TIME_UNITS = {"ms": 1e-3, "us": 1e-6, "ns": 1e-9}
INSTANTS = ("timestamp", "duration")
"""The types of Parquet that have their own unit."""
_LONGEST = 100_000
"""The greatest number of characters of a header."""


def read_header(file: Path) -> list[str]:
    """Return the names of the columns of a CSV. Raises SourceError."""
    try:
        with file.open(encoding="utf-8-sig", newline="") as lines:
            first = lines.readline(_LONGEST)
            separator, text = find_separator(first)
            return [
                cell.strip() for cell in next(csv.reader([text or lines.readline(_LONGEST)], delimiter=separator), [])
            ]
    except UnicodeDecodeError:
        refuse(file, "the file is no text", hint="name a CSV or Parquet file")
    except (OSError, csv.Error) as error:
        refuse(file, f"the file can't be read: {error}")


def csv_rows(file: Path, header: Sequence[str], count: int) -> Iterator[Array]:
    """Yield the rows as numbers, with NaN for an empty cell."""
    with file.open(encoding="utf-8-sig", newline=None) as lines:
        separator, _ = find_separator(lines.readline(_LONGEST))
        number = 2
        try:
            while chunk := list(itertools.islice(lines, count)):
                if separator != ",":
                    chunk = [line.replace(",", ".") for line in chunk]
                try:
                    rows = np.loadtxt(chunk, delimiter=separator, ndmin=2, comments=None)
                except ValueError:  # empty cells, or a fault: the slow way finds out
                    rows = np.array(list(_cells(file, chunk, separator, number, len(header))))
                if rows.size and rows.shape[1] != len(header):
                    refuse(file, f"the row has {rows.shape[1]} cells, the header {len(header)}", number)
                if rows.size:
                    yield rows
                number += len(chunk)
        except UnicodeDecodeError:
            refuse(file, "the file is not in UTF-8", number)


def _cells(file: Path, chunk: Sequence[str], separator: str, number: int, width: int) -> Iterator[list[float]]:
    for line, row in enumerate(csv.reader(chunk, delimiter=separator), number):
        if not any(cell.strip() for cell in row):
            continue
        if len(row) != width:
            refuse(file, f"the row has {len(row)} cells, the header {width}", line)
        try:
            yield [float(cell) if cell.strip() else math.nan for cell in row]
        except ValueError as error:
            refuse(file, f"a cell is no number: {str(error).rpartition(': ')[2]}", line)


def open_parquet(file: Path) -> Any:
    """Return the file, whose rows are not read yet. Raises UrdfsyncError."""
    try:
        from pyarrow import ArrowException, parquet
    except ImportError:
        raise ConfigError.of(
            "log", "Parquet needs pyarrow, which is not installed", hint=install_command("log")
        ) from None
    try:
        return parquet.ParquetFile(file)
    except (ArrowException, OSError) as error:
        refuse(file, f"the file can't be read: {str(error).splitlines()[0]}")


def parquet_rows(file: Path, count: int) -> Iterator[Array]:
    """Yield the rows as numbers."""
    source = open_parquet(file)
    from pyarrow import ArrowException

    try:
        for batch in source.iter_batches(batch_size=count, use_threads=False):
            yield np.column_stack([_numbers(column.to_numpy(zero_copy_only=False)) for column in batch.columns])
    except (TypeError, ValueError) as error:
        refuse(file, f"a column has no numbers: {error}")
    except (ArrowException, OSError) as error:
        refuse(file, f"the file can't be read: {str(error).splitlines()[0]}", hint="copy or record it anew")


def _numbers(values: np.ndarray) -> Array:
    """Return numbers as they are, and instants and durations in s."""
    if values.dtype.kind not in "mM":
        return np.array(values, float)
    unit, _ = np.datetime_data(values.dtype)
    return np.where(np.isnat(values), np.nan, values.astype(np.int64) * TIME_UNITS.get(unit, 1.0))


def refuse(file: Path, message: str, line: int = 0, hint: str = "") -> NoReturn:
    """Raise SourceError for a log."""
    raise SourceError.of("log", message, shown(file), line, hint=hint)
