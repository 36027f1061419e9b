"""Reads logs of strangers in a process with limits: a small file may unpack to any size."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import msgspec
import numpy as np

from urdfsync.common.diagnostics import ConfigError, Diagnostic, SourceError
from urdfsync.common.files import shown
from urdfsync.common.processes import python_module
from urdfsync.common.processes.limited import LimitedProcess
from urdfsync.domain.regressor import Array

CPU_SECONDS = 10.0
"""CPU time for some thousand rows, on Linux and macOS; a second more for each 50 MB of the log."""
_BYTES_PER_SECOND = 50_000_000
_WALL = 15
"""Wall time, in CPU time: a busy machine may need so long."""
MEMORY = 1_000_000_000
"""The greatest number of bytes that the process may allocate, on Linux."""
_SUFFIXES = (".mcap", ".db3")
_RATIO, _FREE = 200, 100_000_000
"""A log may unpack to so many times its size, and to so many bytes more."""


class LogRequest(msgspec.Struct, frozen=True):
    """A line to the process: it opens a log, or reads the next rows if `file` is empty."""

    seconds: float
    memory: int
    most: int
    """The greatest number of bytes of the unpacked log."""
    file: str = ""
    topic: str = ""


def is_recording(file: Path) -> bool:
    """Return whether a log is a recording of ROS 2."""
    return (file / "metadata.yaml").is_file() or (file.suffix.lower() in _SUFFIXES and file.is_file())


class LogProcess(LimitedProcess):
    """The process that reads one log; it ends with the last row."""

    def __init__(self, file: Path, topic: str) -> None:
        super().__init__()
        self._file, self._topic = file, topic
        files = [*file.iterdir()] if file.is_dir() else [file]
        self._size = sum(each.stat().st_size for each in files if each.is_file())
        self._folder = ""
        """For a recording that has to be unpacked: removed even if the process was killed."""

    def command(self) -> tuple[list[str], dict[str, str]]:
        """Return the command that starts the process, and its folder for temporary files."""
        self._folder = tempfile.mkdtemp(prefix="urdfsync-")
        variables = {"TMPDIR": self._folder, "ARROW_DEFAULT_MEMORY_POOL": "system", "OMP_NUM_THREADS": "1"}
        return python_module("urdfsync.analysis.identification.worker"), variables

    def end(self) -> None:
        """End the process, if it runs, and remove its folder."""
        super().end()
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)

    def open(self) -> tuple[list[str], list[int]]:
        """Open the log; return its columns, and the places of those with instants. Raises UrdfsyncError."""
        facts, _ = self._read(str(self._file))
        return facts["header"], facts["instants"]

    def rows(self) -> Iterator[Array]:
        """Yield all rows of the log as numbers, some thousand at a time. Raises UrdfsyncError."""
        width = len(self.open()[0])
        try:
            while content := self._read()[1]:
                yield np.frombuffer(content, float).reshape(-1, width)
        finally:
            self.end()

    def _read(self, file: str = "") -> tuple[dict[str, Any], bytes]:
        seconds = CPU_SECONDS + self._size / _BYTES_PER_SECOND
        request = LogRequest(seconds, MEMORY, _RATIO * self._size + _FREE, file, self._topic if file else "")
        try:
            answer, files = self.ask(request, (), seconds, _WALL * seconds)
        except (TimeoutError, ValueError) as error:
            self._refuse(str(error))
        facts = answer.facts[0] if answer.facts else {}
        if answer.problem or "finding" in facts:
            self.end()
        if answer.problem:
            self._refuse(answer.problem)
        if finding := facts.get("finding"):
            raise (ConfigError if facts["is_of_user"] else SourceError)(msgspec.convert(finding, Diagnostic))
        return facts, files[0] if files else b""

    def _refuse(self, message: str) -> NoReturn:
        raise SourceError.of("log", message, shown(self._file), hint="record the log anew, or a part of it")
