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
    """Carry out a command; returns its exit code. No interruption leaves a traceback, even while it is being loaded."""
    gc.set_threshold(OBJECTS)
    try:
        return command()
    except KeyboardInterrupt:
        return _INTERRUPTED


def end(code: int) -> "NoReturn":
    """End this process. What a command has said is with the system by now (`streams`), what it has written too.

    Python's own end takes down module after module, and every tenth of the time that a command without work
    takes: that is only waited for if somebody asked to be told of it, or is still at work.
    """
    if atexit._ncallbacks() or ("threading" in sys.modules and sys.modules["threading"].active_count() > 1):
        gc.freeze()  # what is left goes with the process
        sys.exit(code)
    os._exit(code)
