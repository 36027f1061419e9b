"""Does jobs at the same time, in processes of this machine."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, wait
from concurrent.futures.process import ProcessPoolExecutor
from multiprocessing import get_context
from multiprocessing.queues import SimpleQueue
from signal import SIG_IGN, SIGINT, signal
from types import ModuleType
from typing import Any, TypeVar

from urdfsync.common.processes import end_with_parent

T = TypeVar("T")

_PAUSE = 0.1
"""Seconds between two looks at the progress."""

_steps: SimpleQueue[str] | None = None
"""Channel for the steps of jobs in this process; None in the process of the command."""


def do_all(
    count: int,
    job: Callable[..., T],
    tasks: Sequence[tuple[Any, ...]],
    look: Callable[[Sequence[str], int], None],
    ahead: int | None = None,
) -> Generator[T | Exception]:
    """Yield `job(*task)` for each task, in order, by `count` processes; the error of a task whose process died.

    A job is a function of a module, raises no error, and runs in the present working folder; tasks and results can be
    pickled. At most `ahead` tasks are begun before the result of the first of them is used; None sets no limit.

    Calls `look` repeatedly with the steps that jobs have reported since the last call, and with the number of finished
    tasks.
    """
    futures, begun = dict[int, Future[T]](), 0
    with workers(count) as (executor, steps):
        for number, task in enumerate(tasks):
            try:
                try:
                    while begun < len(tasks) and len(futures) < (ahead or len(tasks)):
                        futures[begun] = _submit(executor, job, tasks[begun])
                        begun += 1
                    while wait([futures[number]], _PAUSE).not_done:
                        look(list(_take(steps)), number + sum(future.done() for future in futures.values()))
                    result = futures[number].result()
                except BrokenExecutor:  # one process died, perhaps of another task, and all ended
                    with workers(1) as (alone, _):
                        result = _submit(alone, job, task).result()
            except Exception as error:  # noqa: BLE001 - libraries raise many kinds of errors for a lost process
                yield error
            else:
                yield result
            futures.pop(number, None)


@contextlib.contextmanager
def workers(count: int) -> Iterator[tuple[Executor, SimpleQueue[str]]]:
    """Start `count` processes, which end with the `with` block; after an exception they end at once.

    Yields them with a channel for the steps of their jobs.
    """
    # No fork: the thread of a progress bar may hold a lock at that moment. No server for forks: it needs a socket in
    # the folder for temporary files, whose path may be too long for a socket.
    context = get_context("spawn")
    with _safe_path():
        end, steps = context.Pipe(duplex=False), context.SimpleQueue()
        executor = ProcessPoolExecutor(count, context, _begin, (os.getcwd(), end[0], steps))  # noqa: PTH109 - as a text
    try:
        yield executor, steps
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


def _take(steps: SimpleQueue[str]) -> Iterator[str]:
    while not steps.empty():
        yield steps.get()


def _submit(executor: Executor, job: Callable[..., T], task: tuple[Any, ...]) -> Future[T]:
    with _safe_path():
        return executor.submit(job, *task)


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


def _begin(folder: str, end: Any, steps: SimpleQueue[str]) -> None:
    """Prepare a process, which ends when the command ends or closes its pipe; Ctrl-C does not end the process.

    Files in diagnostics are relative to `folder`. `end` is a connection, of another type on each system.
    """
    global _steps
    os.chdir(folder)
    _steps = steps
    signal(SIGINT, SIG_IGN)  # Ctrl-C also reaches the command, which ends the workers
    end_with_parent(end.recv_bytes)
