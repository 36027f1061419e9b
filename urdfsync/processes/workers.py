"""Runs jobs at the same time, in processes of this machine or by the workers of a Dask cluster.

Workers of a cluster must see the project at the same path, and have the same urdfsync.
"""

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

from urdfsync.diagnostics import ConfigError
from urdfsync.extras import install_command
from urdfsync.processes import end_with_parent

T = TypeVar("T")

PATIENCE = 10
"""Seconds to wait for a Dask scheduler to answer."""

_steps: SimpleQueue[str] | None = None
"""Channel for the steps of jobs in this process; None in the process of the command, and on a cluster."""


class Workers:
    """Takes jobs, which are functions of modules with arguments that can be pickled."""

    def __init__(self, executor: Executor, steps: SimpleQueue[str] | None, count: int) -> None:
        """`count` is the number of jobs that run at the same time."""
        self._executor, self._queue, self.count = executor, steps, count

    def submit(self, job: Callable[..., T], *arguments: Any) -> Future[T]:
        """Submit a job, to run in the present working folder."""
        folder = os.getcwd()  # noqa: PTH109 - as a text
        with _safe_path():
            return self._executor.submit(_run, folder, job, *arguments)

    def steps(self) -> Iterator[str]:
        """Yield the steps that jobs have reported since the last call; nothing on a cluster."""
        while self._queue is not None and not self._queue.empty():
            yield self._queue.get()


@contextlib.contextmanager
def workers(count: int, address: str = "") -> Iterator[Workers]:
    """Start `count` processes, or use the Dask scheduler at an address. Raises ConfigError if no scheduler answers.

    All processes end with the `with` block. After an exception they end at once, and a cluster drops waiting jobs.
    """
    if address:
        with contextlib.closing(_connect(address)) as client:
            executor = client.get_executor()
            try:
                yield Workers(executor, None, max(1, sum(client.nthreads().values())))
            except BaseException:
                executor.shutdown(wait=False)  # cancels jobs that no worker has begun
                raise
            executor.shutdown()
        return
    # No fork: the thread of a progress bar may hold a lock at that moment. No server for forks: it needs a socket in
    # the folder for temporary files, whose path may be too long for a socket.
    context = get_context("spawn")
    with _safe_path():
        end, steps = context.Pipe(duplex=False), context.SimpleQueue()
        executor = ProcessPoolExecutor(count, context, _begin, (end[0], steps))
    try:
        yield Workers(executor, steps, count)
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


def _connect(address: str) -> Any:
    """Connect to the Dask scheduler at an address that the user named. Raises ConfigError.

    Answers are unpickled, so the program at this address must be trusted.
    """
    try:
        from distributed import Client  # Dask is an extra; its import takes a second
    except ImportError:
        message, hint = "`--executor` needs Dask, which is not installed", install_command("cluster")
        raise ConfigError.of("no-cluster", message, hint=hint) from None
    try:
        return Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        message = f"no Dask scheduler answers at `{address}`: {error or 'no answer in time'}"
        hint = "start one with `dask scheduler`, or go without `--executor`"
        raise ConfigError.of("no-cluster", message, hint=hint) from None


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


def _begin(end: Connection, steps: SimpleQueue[str]) -> None:
    """Prepare a process, which ends when the command ends or closes its pipe; Ctrl-C does not end the process."""
    global _steps
    _steps = steps
    signal(SIGINT, SIG_IGN)  # Ctrl-C also reaches the command, which ends the workers
    end_with_parent(end.recv_bytes)


def _run(folder: str, job: Callable[..., T], *arguments: Any) -> T:
    """Run a job in the folder to which files in diagnostics are relative."""
    os.chdir(folder)
    return job(*arguments)
