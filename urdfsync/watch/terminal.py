"""A status at the bottom of a terminal, while other lines scroll above it.

Commands of `--exec` and libraries in C know nothing of the status, and would write into it. So the error stream of
this process and of its children leads to a pipe, and its lines are shown above the status.
"""

from __future__ import annotations

import contextlib
import os
import select
import sys
import threading
from collections.abc import Sequence
from typing import IO

from rich.console import Group
from rich.constrain import Constrain
from rich.live import Live
from rich.text import Text

from urdfsync.output.console import rich_console

_WIDEST = 79
"""Columns of the status at most: lines that fill a wide terminal would be broken when it gets narrower."""
_STDERR = 2
_LONGEST = 10_000
"""Bytes that are shown as a line at the latest, even if it has not ended."""
_CHUNK = 8192
"""Bytes that are read at once: somebody may write without end."""
_END = b"\0end of the status\0"
"""Written into the pipe when the status ends; what follows is for another reader."""


class StatusArea:
    """Lines on a terminal, and a status below them."""

    def __init__(self, stream: IO[str]) -> None:
        self.console = rich_console(stream)
        self._stream = stream
        self._lock = threading.RLock()  # a signal may come while lines are written
        self._status: Sequence[Text] = ()
        self._capture = StderrCapture(self)
        self._live: Live | None = None
        """Not there while the status is empty, or the terminal is a shell's."""

    @property
    def room(self) -> int:
        """Rows that the status may take: a third of the terminal, but four if there are five."""
        height = self.console.height
        return max(min(4, height - 1), height // 3)

    def start(self) -> None:
        """Capture the error stream."""
        self._capture.start()

    def close(self) -> None:
        """Take the status away for good."""
        self._capture.close()
        self.write((), ())

    def write(self, lines: Sequence[Text], status: Sequence[Text] | None = None) -> None:
        """Write lines; the terminal breaks those that are too long. `status` is what stands below from now on."""
        with self._lock, self.console:  # all of it is written at once
            if status is not None:
                self._status = status
                for row in status:
                    row.no_wrap, row.overflow = True, "ellipsis"
            is_shown = bool(self._status) and self._is_foreground()
            if not is_shown and self._live is not None:
                self._live.stop()
                self._live = None
            if lines:
                self.console.print(Text("\n").join(lines), soft_wrap=True)
            if is_shown and self._live is None:
                self._live = Live(
                    console=self.console,
                    auto_refresh=False,
                    transient=True,
                    redirect_stdout=False,
                    redirect_stderr=False,
                )
                self._live.start()
                self.console.show_cursor()  # a daemon that is killed must not leave a terminal without one
            if self._live is not None:
                self._live.update(Constrain(Group(*self._status), _WIDEST), refresh=True)

    def _is_foreground(self) -> bool:
        """Whether the terminal is the program's: a shell that has put it into the background writes there, too."""
        if sys.platform == "win32":
            return True
        try:
            return os.tcgetpgrp(self._stream.fileno()) == os.getpgrp()
        except (OSError, ValueError):  # a terminal of somebody else, as in a test
            return True


class StderrCapture:
    """Shows the error stream of this process and of its children above a status."""

    def __init__(self, area: StatusArea) -> None:
        self._area = area
        self._saved = self._reader = -1
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Lead the stream to a pipe if it is a terminal and the system can wait for pipes."""
        try:
            is_possible = os.name == "posix" and sys.stderr.isatty() and sys.stderr.fileno() == _STDERR
        except (OSError, ValueError):  # a stream of a test
            return
        if is_possible:
            self._saved = os.dup(_STDERR)
            self._reader, writer = os.pipe()
            os.dup2(writer, _STDERR)
            os.close(writer)
            self._thread = threading.Thread(target=self._listen, daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Lead the stream to where it went before, after all that was written until now.

        A command of `--exec` may outlive the daemon. It would die of SIGPIPE if its pipe had no reader any more, so
        `cat` passes on what it writes, and ends with it.
        """
        if self._thread is None:
            return
        os.write(_STDERR, _END)
        os.dup2(self._saved, _STDERR)
        self._thread.join()
        self._thread = None
        poll = select.poll()
        poll.register(self._reader, select.POLLIN)
        if not any(event & select.POLLHUP for _, event in poll.poll(0)):  # somebody has the other end
            streams = [(os.POSIX_SPAWN_DUP2, self._reader, 0), (os.POSIX_SPAWN_DUP2, self._saved, 1)]
            with contextlib.suppress(OSError):  # the system has no process left for it
                # a process group of its own, since Ctrl-C is meant for the daemon
                os.posix_spawnp("cat", ["cat"], os.environ, file_actions=streams, setpgroup=0)
        os.close(self._saved)
        os.close(self._reader)

    def _listen(self) -> None:
        """Show complete lines until `_END`, and what comes in one piece with that."""
        data = b""
        while _END not in data:
            data += os.read(self._reader, _CHUNK)
            if _END not in data:
                data = self._show_lines(data)
        data = data.replace(_END, b"")
        if data:
            self._show_lines(data + b"\n")

    def _show_lines(self, data: bytes) -> bytes:
        """Show the lines that are complete, and return the rest. Of a line that overwrites itself the last is shown."""
        *lines, rest = data.replace(b"\r\n", b"\n").split(b"\n")
        if len(rest) > _LONGEST:
            lines, rest = [*lines, rest], b""
        if lines:
            texts = (line.rpartition(b"\r")[2].decode(errors="replace") for line in lines)
            self._area.write([Text.from_ansi(text) for text in texts])  # colours are all that they may do to it
        return rest
