"""A command as a program of its own: nobody looks for cycles of references in it, and it ends at once."""

import atexit
import gc
import os
import sys

TYPE_CHECKING = False  # that of `typing`, whose import takes longer than all that a command without work does
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import NoReturn

OBJECTS = 100_000
"""So many new objects until Python looks for reference cycles: a command and its modules have some 40,000."""
_INTERRUPTED = 130


def carry_out(command: "Callable[[], int]") -> int:
    """Carry out a command; returns its exit code, that of an interruption as well.

    Few searches for cycles begin meanwhile, and none in the end, since what is left goes with the process.
    """
    gc.set_threshold(OBJECTS)
    try:
        return command()
    except KeyboardInterrupt:
        return _INTERRUPTED
    finally:
        gc.freeze()


def end(code: int) -> "NoReturn":
    """End this process. What a command has written is with the system by now.

    Python's own end takes down module after module, which takes a tenth of the time of a command without work. It is
    only waited for if somebody has asked to be told of it, is still at work, or looks on.
    """
    if _is_awaited() or not _has_said_all():
        sys.exit(code)
    os._exit(code)


def _is_awaited() -> bool:
    """Whether anybody else in this process waits for its end: functions, threads, profilers, debuggers, a prompt."""
    told = atexit._ncallbacks()  # of CPython, which alone counts them
    at_work = "threading" in sys.modules and sys.modules["threading"].active_count() > 1
    monitoring = getattr(sys, "monitoring", None)  # from Python 3.12 on
    monitored = monitoring is not None and any(map(monitoring.get_tool, range(6)))
    return bool(told or at_work or monitored or sys.getprofile() or sys.gettrace() or sys.flags.inspect)


def _has_said_all() -> bool:
    """Whether both streams have passed on everything; if they can't, Python says so at its own end."""
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except (OSError, ValueError):
        return False
    return True
