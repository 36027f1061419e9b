"""What commands print while a status stands at the bottom of a real terminal."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.screen import Screen

from urdfsync.watch.status_area import StatusArea
from urdfsync.watch.stderr_capture import StderrCapture, is_possible

REPOSITORY = Path(__file__).parents[2]
PROGRAM = r"""
import os
from pathlib import Path
from urdfsync.watch import events
from urdfsync.watch.report import watch_report

def opened():
    return [number for number in range(50) if os.path.exists(f"/dev/fd/{number}")]

before = opened()
with watch_report() as listener:
    listener.show(events.Started(Path("urdfsync.toml"), ("arm", "cart")))
    os.system(r"exec >&2; printf 'one\r\ntwo\n\n 10 %%\r100 %%\n\033[2Jthree\033[31m red\033[0m\nfour'")
assert opened() == before
os.system("echo after >&2")
"""


def seen(program: str) -> list[str]:
    """What a program leaves on a terminal of 60 columns and 18 rows."""
    import fcntl
    import pty
    import struct
    import termios

    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 18, 60, 0, 0))
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY), "TERM": "xterm", "NO_COLOR": "1"}
    with subprocess.Popen([sys.executable, "-c", program], stdin=slave, stdout=slave, stderr=slave, env=environment):
        os.close(slave)
        output = b""
        while chunk := _read(master):
            output += chunk
    os.close(master)
    screen = Screen(60, 18)
    screen.write(output.decode())
    return screen.shown()


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 4096)
    except OSError:  # nobody has the other end any more
        return b""


@pytest.mark.skipif(sys.platform == "win32", reason="needs a terminal of POSIX")
def test_what_commands_print_scrolls_above_the_status_and_stays() -> None:
    rows = seen(PROGRAM)
    assert rows[0].endswith("  watching 2 robots of urdfsync.toml")
    assert rows[1:] == ["one", "two", "", "100 %", "three red", "four", "after"]


OUTLIVED = r"""
import os, subprocess
from pathlib import Path
from urdfsync.watch import events
from urdfsync.watch.report import watch_report

with watch_report() as listener:
    listener.show(events.Started(Path("urdfsync.toml"), ("arm",)))
    command = "echo early >&2; sleep 1; seq 20000 >&2; echo late >&2; touch {}"
    subprocess.Popen(command, shell=True)
    listener.show(events.Stopping("SIGTERM"))
os._exit(0)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="needs a terminal of POSIX")
def test_a_command_that_outlives_the_daemon_still_reaches_the_terminal(tmp_path: Path) -> None:
    """It would die of SIGPIPE if the daemon's pipe had no reader any more."""
    rows = seen(OUTLIVED.format(tmp_path / "done"))
    assert (tmp_path / "done").exists()
    assert rows[-2:] == ["20000", "late"]
    assert "early" in rows


def test_a_stream_that_is_no_terminal_is_left_alone() -> None:
    assert not is_possible(), "as pytest captures it"
    before = os.fstat(2).st_ino
    capture = StderrCapture(StatusArea(sys.stderr))
    capture.start()
    assert os.fstat(2).st_ino == before
    capture.close()
