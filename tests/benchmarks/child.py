"""Run a command as the only child and print its cost: `python -I -S child.py OUTPUT COMMAND …`.

This process is small, since the kernel reports of a process at least the peak memory of the one that started it.
The output of the command goes to the file OUTPUT. Printed are: the exit code, wall-clock seconds, processor seconds of
the command and of all that it started, and the peak memory of the command in bytes.
"""

import ctypes
import os
import signal
import sys
import time

_SUBREAPER = 36  # PR_SET_CHILD_SUBREAPER: orphans of the command become children of this process, which counts them


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
        processor, peak = usage.ru_utime + usage.ru_stime, usage.ru_maxrss
        while True:
            try:
                _, _, usage = os.wait4(-group, 0)
            except ChildProcessError:
                break
            processor += usage.ru_utime + usage.ru_stime
    except KeyboardInterrupt:
        os.killpg(group, signal.SIGKILL)
        raise
    unit = 1 if sys.platform == "darwin" else 1024  # bytes in which the kernel counts peak memory
    print(os.waitstatus_to_exitcode(status), wall, processor, peak * unit)  # noqa: T201


if __name__ == "__main__":
    main(*sys.argv[1:])
