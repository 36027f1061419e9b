"""Run a command as the only child, and say what it cost: `python -I -S child.py OUTPUT COMMAND …`.

It is a process of its own, and small: the peak memory that the kernel reports of a process is at least that of the
one that started it. What the command says goes to the file OUTPUT. What is printed: exit code, wall-clock
seconds, processor seconds of it and of all that it started, peak memory in bytes of the command itself (or of the
largest process that it waited for), and of the largest process that it left to itself, such as the workers of a fork
server.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import time

_SUBREAPER = 36
"""PR_SET_CHILD_SUBREAPER: orphans of the command become children of this process, which so learns what they cost."""
_UNIT = 1 if sys.platform == "darwin" else 1024
"""Bytes in which the kernel counts peak memory."""


def main(output: str, *command: str) -> None:
    """Run the command and print its cost."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_SUBREAPER, 1, 0, 0, 0)
    opened = (os.POSIX_SPAWN_OPEN, 1, output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    errors = (os.POSIX_SPAWN_DUP2, 1, 2)
    begin = time.perf_counter()
    group = os.posix_spawnp(command[0], command, os.environ, file_actions=[opened, errors], setpgroup=0)
    try:
        _, status, usage = os.wait4(group, 0)
        wall = time.perf_counter() - begin
        processor, peak, orphans = usage.ru_utime + usage.ru_stime, usage.ru_maxrss, 0
        while True:
            try:
                _, _, usage = os.wait4(-group, 0)
            except ChildProcessError:
                break
            processor += usage.ru_utime + usage.ru_stime
            orphans = max(orphans, usage.ru_maxrss)
    except KeyboardInterrupt:
        os.killpg(group, signal.SIGKILL)
        raise
    print(os.waitstatus_to_exitcode(status), wall, processor, peak * _UNIT, orphans * _UNIT)  # noqa: T201


if __name__ == "__main__":
    main(*sys.argv[1:])
