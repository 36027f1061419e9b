"""A terminal of a given size that remembers what is on it and what has scrolled away."""

from __future__ import annotations

import io
import os
import re
import struct
import subprocess
from collections.abc import Mapping, Sequence

_PIECES = re.compile(r"\x1b\[([\d;?]*)([A-Za-z])|(.)", re.DOTALL)


class Terminal(io.StringIO):
    """All that is written to a terminal."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


class Screen(Terminal):
    """Understands line feeds, `ESC [ n A`, `ESC [ 2 K`, colours, and codes for the cursor; other codes are errors.

    It breaks lines as xterm does, and does not join them again when it gets wider.
    """

    def __init__(self, width: int = 80, height: int = 24) -> None:
        super().__init__()
        self.width, self.height = width, height
        self.rows = [""]
        self.has_cursor = True
        self._row = self._column = 0

    def write(self, text: str) -> int:
        super().write(text)
        for match in _PIECES.finditer(text):
            number, command, character = match.groups()
            if command:
                self._obey(command, number)
            else:
                self._put(character)
        return len(text)

    def shown(self) -> list[str]:
        """All rows, without empty rows and blanks at the end."""
        return "\n".join(row.rstrip() for row in self.rows).rstrip("\n").split("\n")

    def _obey(self, command: str, number: str) -> None:
        match command:
            case "A":
                self._row = max(self._row - int(number or 1), len(self.rows) - self.height, 0)
            case "K":
                assert number == "2"
                self.rows[self._row] = ""
            case "m":
                pass
            case "l" | "h":
                assert number == "?25"
                self.has_cursor = command == "h"
            case _:
                raise AssertionError(f"ESC [ {number} {command}")

    def _put(self, character: str) -> None:
        if character == "\r":
            self._column = 0
        elif character == "\n":
            self._feed()
        else:
            if self._column == self.width:
                self._feed()
            row = self.rows[self._row].ljust(self._column)
            self.rows[self._row] = row[: self._column] + character + row[self._column + 1 :]
            self._column += 1

    def _feed(self) -> None:
        self._row, self._column = self._row + 1, 0
        if self._row == len(self.rows):
            self.rows.append("")


def print_on_terminal(
    command: Sequence[str], variables: Mapping[str, str], size: tuple[int, int] = (80, 24)
) -> tuple[int, str]:
    """Run a program on a terminal of its own, with so many columns and rows; return exit code and output."""
    import fcntl
    import pty
    import termios

    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", *reversed(size), 0, 0))
    with subprocess.Popen(command, stdin=its, stdout=its, stderr=its, env={**os.environ, **variables}) as process:
        os.close(its)
        printed = b""
        while block := _read(ours):
            printed += block
    os.close(ours)
    return process.returncode, printed.decode()


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 4096)
    except OSError:  # no process has the other end any more
        return b""
