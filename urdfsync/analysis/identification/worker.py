"""The program that reads logs, each part within limits of time, memory and disk; `process` starts it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import IO

import msgspec
import numpy as np

from urdfsync.analysis.identification.bag import TOO_LARGE, Bag
from urdfsync.analysis.identification.process import LogRequest, is_recording
from urdfsync.analysis.identification.tables import INSTANTS, csv_rows, open_parquet, parquet_rows, read_header
from urdfsync.common.diagnostics import ConfigError, SourceError, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.common.processes import limits
from urdfsync.common.processes.limited import LimitedAnswer, answer_requests
from urdfsync.domain.regressor import Array

_ROWS, _NUMBERS = 50_000, 5_000_000
"""The greatest number of rows, and of their numbers, that are read at once."""


class Worker:
    """One open log."""

    def __init__(self) -> None:
        self._rows: Iterator[Array] = iter(())

    def answer(self, line: bytes, _: IO[bytes]) -> tuple[LimitedAnswer, list[bytes]]:
        """Open a log, or read its next rows."""
        request = msgspec.json.decode(line, type=LogRequest)
        try:
            with limits(request.seconds, request.memory, request.most):
                if not request.file:
                    return LimitedAnswer(), [np.ascontiguousarray(next(self._rows, np.zeros(0)), float).tobytes()]
                header, instants = self._open(Path(request.file), request)
                return LimitedAnswer(facts=({"header": header, "instants": instants},)), []
        except MemoryError:
            return LimitedAnswer(
                problem=f"reading the log takes more than {request.memory // 1_000_000} MB of memory"
            ), []
        except UrdfsyncError as error:
            finding = msgspec.to_builtins(error.diagnostics[0])
            return LimitedAnswer(facts=({"finding": finding, "is_of_user": isinstance(error, ConfigError)},)), []

    def _open(self, file: Path, request: LogRequest) -> tuple[list[str], list[int]]:
        """Return the columns of a log, and the places of those with instants."""
        if is_recording(file):
            bag = Bag(file, request.topic, request.most)
            self._rows = bag.rows(_count(bag.header))
            return bag.header, []
        if file.suffix.lower() not in (".parquet", ".pq"):
            header = read_header(file)
            self._rows = csv_rows(file, header, _count(header))
            return header, []
        source = open_parquet(file)
        header = source.schema_arrow.names
        if 8 * source.metadata.num_rows * len(header) > request.most:
            raise SourceError.of("log", f"{TOO_LARGE} {request.most:.3g} bytes", shown(file))
        self._rows = parquet_rows(file, _count(header))
        return header, [k for k, kind in enumerate(source.schema_arrow.types) if str(kind).startswith(INSTANTS)]


def _count(header: list[str]) -> int:
    """Return how many rows are read at once."""
    return max(1, min(_ROWS, _NUMBERS // max(1, len(header))))


if __name__ == "__main__":
    answer_requests(Worker().answer)
