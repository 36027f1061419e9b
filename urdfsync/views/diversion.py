"""What others write to the error stream while a status stands below: commands that were started, libraries in C.

They know nothing of the status, and the next one would be written over their lines. So the stream leads to a pipe
meanwhile, and its lines to whoever shows the status.
"""

from __future__ import annotations

import contextlib
import os
import selectors
import sys
import threading
from collections.abc import Callable, Sequence

_STDERR = 2
_LONGEST = 10_000
"""Bytes that are passed on as a line at the latest, even if it has not ended."""
_CHUNK = 8192
"""Bytes that are passed on before it is looked whether the end has come: somebody may write without end."""
_LAST = 8
"""So many pieces at the end: what a pipe holds."""


class Diversion:
    """The error stream of this process and of its children, line by line."""

    def __init__(self, tell: Callable[[Sequence[str]], None]) -> None:
        """`tell` gets the lines, from another thread."""
        self._tell = tell
        self._thread: threading.Thread | None = None
        self._saved = self._reader = self._end = self._wake = -1

    def start(self) -> None:
        """Lead the stream here if it is a terminal; it stays as it is where that can't be done."""
        if not is_possible():
            return
        self._saved = os.dup(_STDERR)
        self._reader, writer = os.pipe()
        os.set_blocking(self._reader, False)
        os.dup2(writer, _STDERR)
        os.close(writer)
        self._end, self._wake = os.pipe()
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Lead the stream to where it went before; what was written until now is passed on first."""
        if self._thread is None:
            return
        os.dup2(self._saved, _STDERR)
        os.close(self._wake)
        self._thread.join()
        self._thread = None
        for file in (self._saved, self._reader, self._end):
            os.close(file)

    def _listen(self) -> None:
        rest, ended = b"", False
        with selectors.DefaultSelector() as selector:
            selector.register(self._reader, selectors.EVENT_READ)
            selector.register(self._end, selectors.EVENT_READ)
            while not ended:
                ended = any(key.fd == self._end for key, _ in selector.select())
                for _ in range(_LAST if ended else 1):
                    rest = self._pass_on(rest + self._read())
        if rest:
            self._pass_on(rest + b"\n")

    def _read(self) -> bytes:
        with contextlib.suppress(BlockingIOError):
            return os.read(self._reader, _CHUNK)
        return b""

    def _pass_on(self, data: bytes) -> bytes:
        """Tell of the lines that are complete; returns the others. Of what overwrites itself the last is told."""
        *lines, rest = data.replace(b"\r\n", b"\n").split(b"\n")
        if len(rest) > _LONGEST:
            lines, rest = [*lines, rest], b""
        if lines:
            self._tell([line.rpartition(b"\r")[2].decode(errors="replace") for line in lines])
        return rest


def is_possible() -> bool:
    """Whether the error stream is a terminal, and pipes can be waited for."""
    try:
        return os.name == "posix" and sys.stderr.isatty() and sys.stderr.fileno() == _STDERR
    except (OSError, ValueError):  # a stream of a test
        return False
