"""The process that checks one robot, under limits of time and memory for it and for the compilers that it starts.

The reference is native code as the compilers are, and reading, rendering and comparing need memory: none of it is in
the process of whoever wants to know.
"""

from __future__ import annotations

import contextlib
import enum
import os
import queue
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import IO, Any, cast

import msgspec

from urdfsync.check.collector import Step
from urdfsync.check.compilers.compiler import end_with_parent
from urdfsync.check.results import CheckOptions, CheckResult, from_text, to_text
from urdfsync.config import load
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.processes import importable, python_module, reserve_stdout

COMMAND = tuple(python_module("urdfsync.check.process"))
"""Starts the process that checks one robot."""
_INTERVAL = 0.2  # s between two looks at memory and clock
_PATIENCE = 10.0  # s for a process to end after its last answer


class RobotOrder(msgspec.Struct, frozen=True):
    """A robot to check."""

    config: str
    """The configuration file, absolute."""
    robot: str
    folder: str
    """The working folder: messages name files as they are seen from there."""
    options: CheckOptions


class Ending(enum.Enum):
    """How a process came to its end."""

    EXITED = "exited"
    OUT_OF_TIME = "out of time"
    OUT_OF_MEMORY = "out of memory"


class StoppedError(Exception):
    """Nobody wants to know any more."""


def main() -> None:
    """Check the robot that is ordered on stdin; each step is a line on stdout."""
    answers = reserve_stdout()
    order = from_text(sys.stdin.buffer.readline(), RobotOrder)
    end_with_parent()
    lock = threading.Lock()  # compilers of one robot may run at the same time

    def answer(step: Step) -> None:
        with lock:
            answers.write(to_text(step).encode() + b"\n")
            answers.flush()

    from urdfsync.check.robot import check_robot  # 0.3 s that the process which only waits can do without

    os.chdir(order.folder)
    try:
        config = load(Path(order.config))
        (robot,) = config.select([order.robot])
    except UrdfsyncError as error:  # the configuration has changed since
        result = CheckResult(order.robot, "", diagnostics=error.diagnostics)
    else:
        result = check_robot(config, robot, order.options, answer)
    answer(Step("", 1.0, result, is_last=True))


def run_process(
    order: RobotOrder,
    tell: Callable[[Step], None],
    seconds: float,
    memory: float,
    stopped: threading.Event,
    command: Sequence[str],
) -> tuple[Ending, int, str]:
    """Check a robot in a process of at most so many seconds and bytes: how it ended, its exit code, its last words.

    At the end nothing that the process started is left. Raises StoppedError once `stopped` is set, ValueError if the
    process answers what is no step.
    """
    begin, lines = time.monotonic(), queue.SimpleQueue[bytes]()
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(  # noqa: S603 - a command of ours
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            env={**os.environ, **importable()},
            start_new_session=True,  # an interruption from the keyboard is for whoever waits, who ends this process
        )
        try:
            stdin = cast(IO[bytes], process.stdin)
            stdin.write(to_text(order).encode() + b"\n")
            stdin.flush()
            threading.Thread(target=_read, args=(process.stdout, lines), daemon=True).start()
            ending = _follow(process.pid, lines, tell, begin + seconds, memory, stopped)
            if ending is Ending.EXITED:  # it has closed its stdout, and ends now
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(_PATIENCE)
        finally:
            _kill(process)
        errors.seek(0)
        return ending, process.returncode, errors.read().decode(errors="replace").strip()


def _read(stdout: Any, lines: queue.SimpleQueue[bytes]) -> None:
    for line in stdout:
        lines.put(line)
    lines.put(b"")


def _follow(
    pid: int,
    lines: queue.SimpleQueue[bytes],
    tell: Callable[[Step], None],
    deadline: float,
    memory: float,
    stopped: threading.Event,
) -> Ending:
    """Follow a process until it has closed its stdout, or must end."""
    due = 0.0
    while True:
        try:
            line = lines.get(timeout=_INTERVAL)
        except queue.Empty:
            line = None
        if line == b"":
            return Ending.EXITED
        if line is not None:
            tell(from_text(line, Step))
        now = time.monotonic()
        if stopped.is_set():
            raise StoppedError
        if now >= deadline:
            return Ending.OUT_OF_TIME
        if now >= due:
            due = now + _INTERVAL
            if _resident_bytes(pid) > memory:
                return Ending.OUT_OF_MEMORY


def _resident_bytes(pid: int) -> int:
    """Of a process and all that it started."""
    import psutil  # an optional extra

    total = 0
    try:
        process = psutil.Process(pid)
        for one in (process, *process.children(recursive=True)):
            total += one.memory_info().rss
    except psutil.Error:  # it has just ended
        pass
    return total


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a process and all that it started."""
    import psutil

    try:
        children = psutil.Process(process.pid).children(recursive=True)
    except psutil.Error:
        children = []
    process.kill()
    for child in children:
        with contextlib.suppress(psutil.Error):
            child.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            stream.close()


if __name__ == "__main__":
    main()
