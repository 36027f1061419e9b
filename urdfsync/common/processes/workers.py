"""Runs jobs at the same time, in processes of this machine."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from concurrent.futures.process import ProcessPoolExecutor
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.queues import SimpleQueue
from signal import SIG_IGN, SIGINT, signal
from types import ModuleType
from typing import Any, TypeVar

from urdfsync.common.processes import end_with_parent

T = TypeVar("T")

_steps: SimpleQueue[str] | None = None
"""Channel for the steps of jobs in this process; None in the process of the command."""


class Workers:
    """Takes jobs, which are functions of modules with arguments that can be pickled."""

    def __init__(self, executor: Executor, steps: SimpleQueue[str]) -> None:
        self._executor, self._queue = executor, steps

    def submit(self, job: Callable[..., T], *arguments: Any) -> Future[T]:
        """Submit a job, to run in the working folder of the start."""
        with _safe_path():
            return self._executor.submit(job, *arguments)

    def steps(self) -> Iterator[str]:
        """Yield the steps that jobs have reported since the last call."""
        while not self._queue.empty():
            yield self._queue.get()


@contextlib.contextmanager
def workers(count: int) -> Iterator[Workers]:
    """Start `count` processes, which end with the `with` block; after an exception they end at once."""
    # No fork: the thread of a progress bar may hold a lock at that moment. No server for forks: it needs a socket in
    # the folder for temporary files, whose path may be too long for a socket.
    context = get_context("spawn")
    with _safe_path():
        end, steps = context.Pipe(duplex=False), context.SimpleQueue()
        executor = ProcessPoolExecutor(count, context, _begin, (os.getcwd(), end[0], steps))  # noqa: PTH109 - as a text
    try:
        yield Workers(executor, steps)
    except BaseException:
        end[1].close()  # ends the workers, which read the other end of this pipe
        raise
    finally:
        executor.shutdown()
        for resource in (*end, steps):
            resource.close()


def tell(step: str) -> None:
    """Report this job's present step to the process of the command."""
    if _steps is not None:
        _steps.put(step)


@contextlib.contextmanager
def _safe_path() -> Iterator[None]:
    """Start Python processes in a `with` block that import nothing from the working folder: it may be a stranger's.

    Nor do they import the main module: it may be a script that calls the API, and would call it again. An executor
    starts some processes at once, for its locks, and others when work is submitted. The end restores PYTHONSAFEPATH: a
    later command of the user's may need its own folder on the path.
    """
    before, main = os.environ.get("PYTHONSAFEPATH"), sys.modules["__main__"]
    os.environ["PYTHONSAFEPATH"], sys.modules["__main__"] = "1", ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main
        if before is None:
            del os.environ["PYTHONSAFEPATH"]
        else:
            os.environ["PYTHONSAFEPATH"] = before


def _begin(folder: str, end: Connection, steps: SimpleQueue[str]) -> None:
    """Prepare a process, which ends when the command ends or closes its pipe; Ctrl-C does not end the process.

    Files in diagnostics are relative to `folder`.
    """
    global _steps
    os.chdir(folder)
    _steps = steps
    signal(SIGINT, SIG_IGN)  # Ctrl-C also reaches the command, which ends the workers
    end_with_parent(end.recv_bytes)
