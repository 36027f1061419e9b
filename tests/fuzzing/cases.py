"""Runs seeded cases one after the other, and says which of them show a fault.

Case n of a run has the seed of the run plus n, and depends on nothing else: whoever runs one case with that seed gets
the same input again.
"""

from __future__ import annotations

import contextlib
import faulthandler
import signal
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from random import Random
from types import FrameType

from support.workplace import Fault

CPU_LIMIT = 20.0
"""Seconds of computing after which a case hangs."""
TIME_LIMIT = 300.0
"""Seconds after which a case hangs that waits, for a FIFO say; the process ends with the traceback of where it does."""
LAST_SEED = "last-seed"
"""File in the working folder that holds the seed of the case at work, for those that end the process."""
_LINES = 6
"""Lines of a traceback that are shown."""


class _Hang(BaseException):
    """The time of a case is over. Not an Exception: the program under test must not catch it."""


def run_cases(kind: str, case: Callable[[Random], str], count: int, seed: int) -> int:
    """Run cases, print each fault with its seed and at the end the counts; returns the number of faults.

    A case returns what became of it, in one word. It raises Fault; any other exception is a fault, too.
    """
    outcomes, faults, begin = Counter[str](), 0, time.process_time()
    with open(LAST_SEED, "w", encoding="ascii") as last:  # noqa: PTH123 - relative to where the run began
        for number in range(seed, seed + count):
            last.seek(0)
            last.write(f"{number}\n")
            last.flush()
            try:
                with _limited_time():
                    outcomes[case(Random(number))] += 1
            except (Exception, _Hang) as error:  # noqa: BLE001 - each is a finding
                faults += 1
                print(f"{kind}, seed {number}: {_told(error)}", flush=True)  # noqa: T201
    seconds = time.process_time() - begin
    told = ", ".join(f"{number} {outcome}" for outcome, number in outcomes.most_common())
    rate = f"{count / seconds:.0f} per second of CPU" if seconds else ""
    print(f"{kind}: {count} cases, {rate}: {told}; {faults} faults", flush=True)  # noqa: T201
    return faults


def _told(error: BaseException) -> str:
    if isinstance(error, Fault):
        return str(error)
    lines = "".join(traceback.format_exception(error)).splitlines()
    return "\n    ".join([type(error).__name__, *lines[-_LINES:]])


@contextlib.contextmanager
def _limited_time() -> Iterator[None]:
    """Raise _Hang after too much computing; end the process after too long a time."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise _Hang(f"more than {CPU_LIMIT:g} s of computing")

    before = signal.signal(signal.SIGPROF, stop)
    faulthandler.dump_traceback_later(TIME_LIMIT, exit=True, file=2)
    signal.setitimer(signal.ITIMER_PROF, CPU_LIMIT)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        faulthandler.cancel_dump_traceback_later()
        signal.signal(signal.SIGPROF, before)
