"""Start this Python as a helper process, and be one."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import IO


def python_module(module: str, *arguments: str) -> list[str]:
    """Return the command that runs a module with this Python; the working folder has no say in what it imports."""
    return [sys.executable, "-P", "-m", module, *arguments]


def importable() -> dict[str, str]:
    """Return what the environment of such a command needs so that it finds this package, if that is not installed."""
    home = Path(__file__).parents[1]
    if home.name in ("site-packages", "dist-packages"):
        return {}
    others = os.environ.get("PYTHONPATH")
    return {"PYTHONPATH": os.pathsep.join([str(home), *([others] if others else [])])}


def reserve_stdout() -> IO[bytes]:
    """Return the stdout of this process; what native code prints goes to stderr from now on."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def end_with_parent(read: Callable[[], object]) -> None:
    """End this process and its children when the parent closes a pipe: `read` then returns nothing, or raises."""

    def wait() -> None:
        with contextlib.suppress(EOFError, OSError):
            while read():
                pass
        import psutil  # 15 ms, and only a check needs it

        for child in psutil.Process().children(recursive=True):
            child.kill()  # a compiler at work may not let its own thread look at stdin
        os._exit(1)  # the main thread may be in native code

    threading.Thread(target=wait, name="end-with-parent", daemon=True).start()


def exit_cause(code: int) -> str:
    """Return the exit code of a process in words: `exit code 3`, `signal 11 (SIGSEGV)`."""
    if code >= 0xC0000000:  # Windows
        return f"exception 0x{code:08X}"
    if code >= 0:
        return f"exit code {code}"
    names = {one.value: f" ({one.name})" for one in signal.Signals}
    return f"signal {-code}{names.get(-code, '')}"
