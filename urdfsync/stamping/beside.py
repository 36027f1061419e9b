"""Two questions at the same time, one of them in a second process where that is safe; without one, all is asked here.

It is for the start of the program, when nothing is loaded that a copy of the process could come to harm with.
"""

import os
import sys

from urdfsync import machine

TYPE_CHECKING = False  # as in `stamp`
if TYPE_CHECKING:
    from collections.abc import Callable

_YES, _NO = 23, 1
"""Exit codes; no other end of a process looks like a yes."""


def both(first: "Callable[[], bool]", second: "Callable[[], bool]") -> bool:
    """Whether both questions are answered with yes.

    A second process may ask the first one meanwhile; only its yes is believed, else this process asks as well.
    """
    process = _process(first) if _may_fork() else None
    try:
        is_second = second()
    finally:
        is_first = process is not None and _said_yes(process)
    return is_second and (is_first or first())


def _may_fork() -> bool:
    """Whether a copy of this process works and helps: no other threads, which it would lack, and another core."""
    return hasattr(os, "fork") and "threading" not in sys.modules and machine.cores() > 1


def _process(question: "Callable[[], bool]") -> int | None:
    """A process that ends with the answer; None if none can be made.

    It never leaves this function: nothing that is to happen at the end of the program happens there as well.
    """
    here, answer = os.getpid(), _NO
    try:
        process = os.fork()
        if process == 0 and question():
            answer = _YES
    except OSError:
        return None
    finally:
        if os.getpid() != here:
            os._exit(answer)
    return process


def _said_yes(process: int) -> bool:
    """How a process has ended, when it has."""
    try:
        return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == _YES
    except ChildProcessError:  # somebody else has heard of it, or this process was started as one that does not
        return False
