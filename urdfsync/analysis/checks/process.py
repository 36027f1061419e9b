"""Runs native code (a compiler, a reference) in a process of its own, with limits of time and memory.

As a program, this module calls the function that is pickled on stdin.
"""

from __future__ import annotations

import contextlib
import io
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from typing import IO, Any, TypeVar

import msgspec
import psutil

from urdfsync.common import processes, system
from urdfsync.common.diagnostics import UrdfsyncError

T = TypeVar("T")

_INTERVAL = 0.25
"""Seconds between two checks of memory and time; a check reads a file of each process of the system."""
_GRACE = 10.0
"""Seconds of processor time beyond the limit after which a process ends itself: its parent has not ended it."""
_MOST_IDLE = 60.0
"""Seconds by the clock after which an idle process is ended."""
_WORK = 0.1
"""A process that takes at most so many seconds of processor time is idle: waiting takes a little, too, and Windows
counts in steps of 0.016 s."""


class Limits(msgspec.Struct):
    """The processor time and memory that all processes of one check may take together."""

    owner: str
    """The name of the check in messages."""
    seconds: float
    """Seconds of processor time, since on a busy machine a process waits while the clock runs."""
    memory: float
    """Bytes."""
    times: dict[float, float] = {}
    """Processor time so far of each process, by the start time of the process."""

    @property
    def used(self) -> float:
        """The processor time so far."""
        return sum(self.times.values())


def limits_of(owner: str, seconds: float, gigabytes: float | None) -> Limits:
    """Return limits. Memory None means all free memory."""
    return Limits(owner, seconds, gigabytes * 1e9 if gigabytes else psutil.virtual_memory().available)


class LimitError(UrdfsyncError):
    """A process exceeded its time or memory; the code of the only diagnostic tells which of the two."""


class BrokenProcessError(Exception):
    """A process ended before its work was done: the text has the exit code and the last line of its errors."""

    def __init__(self, results: list[Any], code: int, words: str) -> None:
        super().__init__(": ".join(filter(None, (processes.exit_cause(code), words))))
        self.results, self.was_killed = results, code == -9


def run(
    function: Callable[..., Iterator[T]],
    *arguments: Any,
    limits: Limits,
    environment: Mapping[str, str] | None = None,
    progress: Callable[[], None] | None = None,
    on_result: Callable[[T], None] | None = None,
) -> list[T]:
    """Return all that a function yields in a process of its own, and end the process.

    Calls `progress` repeatedly until the function ends, and `on_result` with each result, soon after it was yielded.
    Raises LimitError, BrokenProcessError, and the function's own UrdfsyncError or ImportError.
    """
    started = set[psutil.Process]()  # the children of an ended process can't be found any more
    results, position = list[Any](), 0

    def take(data: IO[bytes]) -> None:
        """Take the results in `data`, which begins behind the results that were taken before."""
        nonlocal position
        begin, place = position, data.tell()
        for result in _loaded(data):
            results.append(result)
            position = begin + data.tell() - place
            if on_result and result is not None and not isinstance(result, Exception):
                on_result(result)

    def look() -> None:
        # The process writes at the file's present place, so this place must not move. Windows has no `pread`.
        if on_result and hasattr(os, "pread"):
            take(io.BytesIO(os.pread(answers.fileno(), os.fstat(answers.fileno()).st_size - position, position)))
        if progress:
            progress()

    with tempfile.TemporaryFile() as answers, tempfile.TemporaryFile() as errors:
        with subprocess.Popen(  # noqa: S603 - a command of ours
            processes.python_module("urdfsync.analysis.checks.process"),
            stdin=subprocess.PIPE,
            stdout=answers,
            stderr=errors,
            env={**os.environ, **processes.importable(), **(environment or {})},
            # An interruption from the keyboard is for the command, which ends this process. In a session of its own
            # the user's `nice` would have no effect: Linux schedules sessions as groups.
            **system.own_group(),
        ) as process:
            try:
                if process.stdin is not None:
                    with contextlib.suppress(OSError):  # the process has ended; its exit code says why
                        process.stdin.write(pickle.dumps((limits.seconds - limits.used, function, arguments)))
                        process.stdin.flush()
                _wait(process, limits, started, look)
            finally:
                for child in started:
                    with contextlib.suppress(psutil.Error):
                        child.kill()
                process.kill()
        answers.seek(position)
        take(answers)
        if results and isinstance(results[-1], Exception):
            raise results[-1]
        if processes.is_out_of_time(process.returncode):  # on a busy machine, before we have looked
            raise _out_of_time(limits)
        if process.returncode or not results or results[-1] is not None:
            errors.seek(0)
            words = errors.read().decode(errors="replace").strip().splitlines()[-1:]
            raise BrokenProcessError(results, process.returncode, "".join(words).strip())
        return results[:-1]


def _wait(
    process: subprocess.Popen[bytes],
    limits: Limits,
    started: set[psutil.Process],
    look: Callable[[], None],
) -> None:
    """Wait until a process ends, and collect its child processes in `started`. Raises LimitError."""
    begin = worked = time.monotonic()
    while True:
        look()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(_INTERVAL)
            return
        used, seconds = 0, 0.0
        for child in psutil.Process().children(recursive=True):  # other threads have processes, too
            with contextlib.suppress(psutil.Error):  # the child has just ended
                used += child.memory_info().rss
                is_started = process.pid in [parent.pid for parent in child.parents()]
                if is_started:
                    started.add(child)
                if is_started or child.pid == process.pid:
                    seconds += sum(child.cpu_times()[:4])  # includes ended children of the child
        if seconds > limits.times.get(begin, 0.0) + _WORK:
            limits.times[begin], worked = seconds, time.monotonic()
        if limits.used >= limits.seconds:
            raise _out_of_time(limits)
        if time.monotonic() - worked >= _MOST_IDLE:
            message = f"{limits.owner} does nothing: a process has waited for {_MOST_IDLE:g} s"
            hint = "try again, or try another compiler with `--tool`"
            raise LimitError.of("out-of-time", message, hint=hint)
        if used > limits.memory:
            message = f"{limits.owner} takes more memory than its limit, {limits.memory / 1e9:.2g} GB"
            hint = "allow more with `--memory`, if this machine has more"
            raise LimitError.of("out-of-memory", message, hint=hint)


def _out_of_time(limits: Limits) -> LimitError:
    message = f"{limits.owner} takes more than {limits.seconds:g} s of processor time"
    return LimitError.of(
        "out-of-time", message, hint="allow more with `--timeout`, or try another compiler with `--tool`"
    )


def _loaded(answers: IO[bytes]) -> Iterator[Any]:
    with contextlib.suppress(EOFError, pickle.UnpicklingError):  # the process ended while it wrote
        while True:
            yield pickle.load(answers)  # noqa: S301 - written by a process of ours


def main() -> None:
    """Call the function from stdin. Write each result, then None or an error, to stdout."""
    parent = processes.reserve_stdin()
    with processes.reserve_stdout() as answers:
        seconds, function, arguments = pickle.load(parent)  # noqa: S301 - from a process of ours
        _end_after(seconds)
        # not by `parent`, whose lock would disturb Python's exit
        processes.end_with_parent(lambda: os.read(parent.fileno(), 1))
        last = None
        try:
            for result in function(*arguments):
                answers.write(pickle.dumps(result))
                answers.flush()  # after a crash, earlier answers are complete
                _end_after(seconds)  # a parent may allow this time for each result
        except (UrdfsyncError, ImportError) as error:
            last = error
        answers.write(pickle.dumps(last))


def _end_after(seconds: float) -> None:
    """End this process after some processor time if its parent is gone: native code may block Python's threads."""
    if sys.platform != "win32":
        signal.setitimer(signal.ITIMER_PROF, max(seconds, 0.0) + _GRACE)


if __name__ == "__main__":
    main()
