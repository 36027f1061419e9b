"""A status at the bottom of a terminal, while other lines scroll above it."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import IO

from rich.console import Group
from rich.constrain import Constrain
from rich.live import Live
from rich.text import Text

from urdfsync.output.console import rich_console

_WIDEST = 79
"""The greatest number of columns of the status: a narrowed terminal would wrap longer lines."""


class StatusArea:
    """Lines on a terminal, and a status below them."""

    def __init__(self, stream: IO[str]) -> None:
        self.console = rich_console(stream)
        self._stream = stream
        self._live: Live | None = None
        """None while the status is empty, or while a shell has the terminal."""

    @property
    def room(self) -> int:
        """The greatest number of rows of the status: a third of the terminal's, but at least four of five."""
        height = self.console.height
        return max(min(4, height - 1), height // 3)

    def write(self, lines: Sequence[Text], status: Sequence[Text]) -> None:
        """Write lines, which the terminal wraps; from now on `status` stands below."""
        with self.console:  # one write
            is_shown = bool(status) and self._is_foreground()
            if not is_shown and self._live is not None:
                self._live.stop()
                self._live = None
            if lines:
                self.console.print(Text("\n").join(lines), soft_wrap=True)
            if is_shown and self._live is None:
                has_errors = sys.stderr.isatty()  # libraries' output goes above the status
                self._live = Live(
                    console=self.console,
                    auto_refresh=False,
                    transient=True,
                    redirect_stdout=False,
                    redirect_stderr=has_errors,
                )
                self._live.start()
                self.console.show_cursor()  # a killed daemon must not leave the terminal without a cursor
            if self._live is not None:
                for row in status:
                    row.no_wrap, row.overflow = True, "ellipsis"
                self._live.update(Constrain(Group(*status), _WIDEST), refresh=True)

    def _is_foreground(self) -> bool:
        """Whether the program is in the foreground: otherwise a shell writes to the terminal, too."""
        if sys.platform == "win32":
            return True
        try:
            return os.tcgetpgrp(self._stream.fileno()) == os.getpgrp()
        except (OSError, ValueError):  # another process's terminal, as in a test
            return True
