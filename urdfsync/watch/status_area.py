"""A few lines that stay at the bottom of a terminal while other lines scroll above them.

Not rich's Live, which hides the cursor, so that a daemon that is killed leaves a terminal without one, and which
erases what a shell wrote while the program was stopped (Ctrl-Z) or in the background. Here only lines are erased that
were written as status, and only if nobody else has written since.
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

_WIDEST = 79
"""Columns of the status at most: lines that fill a wide terminal would be broken when it gets narrower."""


class StatusArea:
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
        """Handler of SIGCONT before `start`."""

    @property
    def room(self) -> int:
        """Rows that the status may take: a third of the terminal, but four if there are five."""
        height = self.console.height
        return max(min(4, height - 1), height // 3)

    def write(self, lines: Sequence[Text], status: Sequence[Text] | None = None) -> None:
        """Write lines; the terminal breaks those that are too long. `status` is what stands below from now on."""
        with self._lock:
            if status is not None:
                self._status = status
            self._draw(lines)

    def start(self) -> None:
        """Handle that the program is continued: what stands above then was written by a shell."""
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
