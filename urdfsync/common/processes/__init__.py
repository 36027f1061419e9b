"""Helper processes that run this Python: functions to start them, and functions that they call."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

from urdfsync.common import system

if sys.platform != "win32":
    import resource


def python_module(module: str, *arguments: str) -> list[str]:
    """Return the command that runs a module with this Python, without imports from the working folder."""
    return [sys.executable, "-P", "-m", module, *arguments]


def importable() -> dict[str, str]:
    """Return the environment variables with which another Python imports this package, even if it is not installed."""
    home = Path(__file__).parents[3]
    if home.name in ("site-packages", "dist-packages"):
        return {}
    others = os.environ.get("PYTHONPATH")
    return {"PYTHONPATH": os.pathsep.join([str(home), *([others] if others else [])])}


def reserve_stdout() -> IO[bytes]:
    """Return the stdout of this process; from now on, output of native code goes to stderr."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def reserve_stdin() -> IO[bytes]:
    """Return the stdin of this process, a pipe from its parent; from now on, native code finds an empty stdin.

    On Windows, a library that asks for the kind of its stdin while it is loaded waits for a thread that reads the pipe
    (numpy's OpenBLAS): both wait for ever.
    """
    pipe = os.fdopen(os.dup(0), "rb")
    with Path(os.devnull).open("rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    return pipe


def end_with_parent(read: Callable[[], object]) -> None:
    """End this process and its children when the parent closes a pipe: `read` then returns nothing, or raises."""

    def wait() -> None:
        with contextlib.suppress(EOFError, OSError):
            while read():
                pass
        import psutil  # takes 15 ms, and only a check needs it

        for child in psutil.Process().children(recursive=True):
            child.kill()  # a busy compiler may not notice the end of stdin
        os._exit(1)  # the main thread may be in native code

    threading.Thread(target=wait, name="end-with-parent", daemon=True).start()


def is_out_of_time(code: int) -> bool:
    """Return whether a process ended with this exit code since its time was over (see `limits`)."""
    if sys.platform == "win32":
        return code == system.OUT_OF_TIME
    return code == -signal.SIGPROF


def exit_cause(code: int) -> str:
    """Return the exit code of a process in words: `exit code 3`, `signal 11 (SIGSEGV)`."""
    if code >= 0xC0000000:  # Windows
        return f"exception 0x{code:08X}"
    if code >= 0:
        return f"exit code {code}"
    names = {number.value: f" ({number.name})" for number in signal.Signals}
    return f"signal {-code}{names.get(-code, '')}"


@contextlib.contextmanager
def limits(seconds: float, memory: int, largest: int = 0) -> Iterator[None]:
    """Limit CPU time (s), memory (bytes, on Linux) and written files (bytes of each) of this process.

    SIGPROF, or a job object on Windows, ends the process when its time is over. Load libraries before.
    """
    if sys.platform == "win32":
        system.limit_process(seconds, memory)
        try:
            yield
        finally:
            system.limit_process(0, 0)
    else:
        kinds = {resource.RLIMIT_FSIZE: largest, resource.RLIMIT_CORE: 0}
        if sys.platform == "linux":  # macOS accepts this limit but does not enforce it
            kinds[resource.RLIMIT_DATA] = memory
        before = {kind: resource.getrlimit(kind) for kind in kinds}
        for kind, limit in kinds.items():
            resource.setrlimit(kind, (limit, before[kind][1]))
        # RLIMIT_CPU has whole seconds and counts all earlier work
        signal.setitimer(signal.ITIMER_PROF, seconds)
        try:
            yield
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
            for kind, both in before.items():
                resource.setrlimit(kind, both)
