"""Terminals: a stream that is one for the program, and one for a process."""

from __future__ import annotations

import io
import os
import struct
import subprocess
from collections.abc import Mapping, Sequence


class Terminal(io.StringIO):
    """All that is written to a terminal."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


def print_on_terminal(command: Sequence[str], variables: Mapping[str, str]) -> tuple[int, str]:
    """Run a program on a terminal of its own; return exit code and output."""
    import fcntl
    import pty
    import termios

    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
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
