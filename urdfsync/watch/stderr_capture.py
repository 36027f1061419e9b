"""What others write to the error stream while a status stands at the bottom of the terminal.

Commands of `--exec` and libraries in C know nothing of the status, and would write into it. So the error stream of
this process and of its children leads to a pipe, and its lines are shown above the status.
"""

from __future__ import annotations

import contextlib
import os
import select
import selectors
import sys
import threading

from urdfsync.watch.status_area import StatusArea

_STDERR = 2
_LONGEST = 10_000
"""Bytes that are shown as a line at the latest, even if it has not ended."""
_CHUNK = 8192
"""Bytes that are read before the end is looked for: somebody may write without end."""
_LAST = 8
"""Chunks that are read at the end: as much as a pipe holds."""


class StderrCapture:
    """Shows the error stream of this process and of its children above a status."""

    def __init__(self, area: StatusArea) -> None:
        self._area = area
        self._thread: threading.Thread | None = None
        self._saved = self._reader = self._end = self._wake = -1

    def start(self) -> None:
        """Lead the stream to a pipe if it is a terminal and the system can wait for pipes."""
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
        """Lead the stream to where it went before, after all that was written until now.

        A command of `--exec` may outlive the daemon. It would die of SIGPIPE if its pipe had no reader any more, so
        `cat` passes on what it writes, and ends with it.
        """
        if self._thread is None:
            return
        os.dup2(self._saved, _STDERR)
        os.close(self._wake)
        self._thread.join()
        self._thread = None
        if _has_writers(self._reader):
            os.set_blocking(self._reader, True)
            streams = [(os.POSIX_SPAWN_DUP2, self._reader, 0), (os.POSIX_SPAWN_DUP2, self._saved, 1)]
            with contextlib.suppress(OSError):  # the system has no process left for it
                # a process group of its own, since Ctrl-C is meant for the daemon
                os.posix_spawnp("cat", ["cat"], os.environ, file_actions=streams, setpgroup=0)
        for file in (self._saved, self._reader, self._end):
            os.close(file)

    def _listen(self) -> None:
        rest, has_ended = b"", False
        with selectors.DefaultSelector() as selector:
            selector.register(self._reader, selectors.EVENT_READ)
            selector.register(self._end, selectors.EVENT_READ)
            while not has_ended:
                has_ended = any(key.fd == self._end for key, _ in selector.select())
                for _ in range(_LAST if has_ended else 1):
                    with contextlib.suppress(BlockingIOError):
                        rest = self._show_lines(rest + os.read(self._reader, _CHUNK))
        if rest:
            self._show_lines(rest + b"\n")

    def _show_lines(self, data: bytes) -> bytes:
        """Show the lines that are complete, and return the rest. Of a line that overwrites itself the last is shown."""
        *lines, rest = data.replace(b"\r\n", b"\n").split(b"\n")
        if len(rest) > _LONGEST:
            lines, rest = [*lines, rest], b""
        if lines:
            from rich.text import Text  # only here is a terminal

            texts = (line.rpartition(b"\r")[2].decode(errors="replace") for line in lines)
            self._area.write([Text.from_ansi(text) for text in texts])  # colours are all that they may do to it
        return rest


def _has_writers(pipe: int) -> bool:
    poll = select.poll()
    poll.register(pipe, select.POLLIN)
    return not any(event & select.POLLHUP for _, event in poll.poll(0))


def is_possible() -> bool:
    """Return whether the error stream is a terminal, and pipes can be waited for."""
    try:
        return os.name == "posix" and sys.stderr.isatty() and sys.stderr.fileno() == _STDERR
    except (OSError, ValueError):  # a stream of a test
        return False
