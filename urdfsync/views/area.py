"""A few lines that stay at the bottom of a terminal while other lines scroll above them.

They are written when there is something new, and never in between, so idling costs nothing. Only lines that were
written as status are ever erased: rich's own live display counts its rows for the width at which they were drawn, and
takes away what others wrote once a terminal is resized or the program has been stopped and continued. The cursor is
left visible, on a line of its own, so that a terminal is in order however the program ends.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Sequence
from types import FrameType
from typing import IO, TYPE_CHECKING, Any

from urdfsync.output.console import rich_console

if TYPE_CHECKING:
    from rich.text import Text

_SHARE = 3
"""The status takes a third of the terminal's rows at most …"""
_LEAST = 4
"""… but so many rows if there are that many and one more."""
_WIDEST = 79
"""Columns of the status at most: lines that fill a wide terminal would be broken when it gets narrower."""


class Area:
    """Lines on a stream, and a status below them if the stream is a terminal that people look at."""

    def __init__(self, stream: IO[str], *, status: bool = True) -> None:
        """`status` says whether one is wanted."""
        self.console = rich_console(stream)
        self._stream = stream
        self.has_status = status and stream.isatty() and not self.console.is_dumb_terminal
        self._status: Sequence[Text] = ()
        self._rows = 0
        self._lock = threading.Lock()
        self._before: Any = None

    @property
    def room(self) -> int:
        """Rows that the status may take."""
        height = self.console.height
        return max(min(_LEAST, height - 1), height // _SHARE)

    def write(self, lines: Sequence[Text], status: Sequence[Text] | None = None) -> None:
        """Write lines; the terminal breaks those that are too long. `status` is what stands below from now on."""
        with self._lock:
            if status is not None:
                self._status = status
            self._draw(lines)

    def start(self) -> None:
        """Be prepared for the program to be stopped and continued: what is above then was written by others."""
        if self.has_status and hasattr(signal, "SIGCONT") and threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGCONT, self._continued)

    def close(self) -> None:
        """Take the status away for good."""
        self.write((), ())
        if self._before is not None:
            signal.signal(signal.SIGCONT, self._before)
            self._before = None

    def _draw(self, lines: Sequence[Text]) -> None:
        from rich.control import Control
        from rich.segment import ControlType

        status = self._status if self.has_status and self._is_foreground() else ()
        with self.console:  # all of it is written at once
            if self._rows:
                erase = (ControlType.ERASE_IN_LINE, 2)  # also of the line below, which may say ^C
                up = [(ControlType.CURSOR_UP, 1), erase] * self._rows
                self.console.control(Control(ControlType.CARRIAGE_RETURN, erase, *up))
            for line in lines:
                self.console.print(line, soft_wrap=True)
            for line in status:
                width = min(self.console.width, _WIDEST)
                self.console.print(line, no_wrap=True, overflow="ellipsis", crop=True, width=width)
        self._rows = len(status)

    def _continued(self, _number: int, _frame: FrameType | None) -> None:
        """Leave what is there alone and write the status anew."""
        if self._lock.acquire(blocking=False):  # else it is about to be written
            try:
                self._rows = 0
                self._draw(())
            finally:
                self._lock.release()

    def _is_foreground(self) -> bool:
        """Whether the terminal is the program's: a shell that has put it into the background writes there, too."""
        if sys.platform == "win32":
            return True
        try:
            mine = os.tcgetpgrp(self._stream.fileno()) == os.getpgrp()
        except (OSError, ValueError):  # a terminal of somebody else, as in a test
            return True
        if not mine:
            self._rows = 0
        return mine
