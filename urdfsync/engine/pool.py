"""Plans many robots at once, in worker processes of this machine or of a Dask cluster.

Workers of a cluster see the project at the same path, such as on a shared file system, and have the same urdfsync. Only
this process writes.
"""

from __future__ import annotations

import contextlib
import os
import weakref
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, Future, wait
from concurrent.futures.process import ProcessPoolExecutor
from multiprocessing import active_children, get_context, parent_process
from multiprocessing.connection import wait as wait_for
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from threading import Thread
from types import TracebackType
from typing import Self

import msgspec

from urdfsync import dependencies, machine
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies import Dependencies
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage import Plan
from urdfsync.extras import install_command

LEAST_ROBOTS = 6
"""With fewer robots, importing urdfsync in each worker takes longer than it saves."""
_AHEAD = 3
"""Plans per worker that may be under way or wait to be carried out: each holds the texts of a robot."""
_CLUSTER_WORKERS = 16
"""Workers that a cluster is taken to have, unless `--jobs` says otherwise."""
_PATIENCE = 10
"""Seconds to wait for a Dask scheduler to answer."""
_PAUSE = 0.1
"""Seconds between two reports of progress."""


class Pool:
    """Plans the robots of one command; a plan that was made in advance serves once."""

    def __init__(self, config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> None:
        self._config, self._robots, self._options = config, robots, options
        self._is_started = False
        self._executor: Executor | None = None
        self._futures: dict[str, Future[tuple[Plan, Dependencies]]] = {}
        self._waiting: deque[RobotConfig] = deque()
        self._most = 0

    def __enter__(self) -> Self:
        """Connect to the cluster, if there is one. Raises ConfigError if it does not answer."""
        if self._options.executor:
            self._executor = connect_cluster(self._options.executor)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._executor is None:
            return
        if kind is not None and not issubclass(kind, Exception) and isinstance(self._executor, ProcessPoolExecutor):
            for child in active_children():  # whoever interrupts does not want to wait
                child.terminate()
        else:  # not of a pool whose processes have ended: it fails with a traceback on futures that are cancelled
            for future in self._futures.values():
                future.cancel()
        self._executor.shutdown()

    def plan(self, robot: RobotConfig) -> Plan:
        """Plan one robot. Raises UrdfsyncError for whatever is wrong."""
        if not self._is_started:
            self._is_started = True
            self._start()
        if robot.name in self._futures or robot in self._waiting:
            return self._result(robot)
        return plan_robot(self._config, robot, self._options)

    def _start(self) -> None:
        """Start workers if the robots are many."""
        workers = self._options.jobs or (_CLUSTER_WORKERS if self._executor else machine.cores())
        if self._executor is None:
            if len(self._robots) < LEAST_ROBOTS:
                return
            # no fork: the thread of a progress bar may hold a lock at that moment. No server for forks either: it needs
            # a socket in the folder for temporary files, whose path may be too long for one.
            workers = min(workers, len(self._robots))
            with _safe_path():
                self._executor = ProcessPoolExecutor(workers, get_context("spawn"), initializer=_prepare_worker)
        self._most, self._waiting = _AHEAD * workers, deque(self._robots)
        self._submit()

    def _submit(self) -> None:
        options = msgspec.structs.replace(self._options, progress=no_progress, executor="")
        while self._executor is not None and self._waiting and len(self._futures) < self._most:
            robot = self._waiting.popleft()
            with _safe_path():
                arguments = str(Path.cwd()), self._config, robot, options
                self._futures[robot.name] = self._executor.submit(_plan, *arguments)

    def _result(self, robot: RobotConfig) -> Plan:
        message = f"robot `{robot.name}`: a process that planned it ended unexpectedly, perhaps for want of memory"
        lost = OutputError(Diagnostic(Severity.ERROR, "lost-process", message, hint="try again with `--jobs 1`"))
        future = self._futures.pop(robot.name, None)
        if future is None:  # its place in the queue was lost with a worker
            raise lost
        while wait([future], _PAUSE).not_done:
            done = sum(other.done() for other in self._futures.values())
            left = len(self._waiting) + len(self._futures) + 1
            total = len(self._robots)
            self._options.progress("reading", total - left + done, total)
        try:
            problem = future.exception()
            if problem is None or isinstance(problem, UrdfsyncError):
                self._submit()
        except Exception as error:  # the workers are lost, in one of many ways
            raise lost from error
        if isinstance(problem, UrdfsyncError):
            dependencies.mark_incomplete()
            raise problem
        if problem is not None:
            raise lost from problem
        plan, found = future.result()
        dependencies.include(found)
        return plan


def connect_cluster(address: str) -> Executor:
    """Connect to the Dask scheduler at an address that the user named. Raises ConfigError.

    Its answers are unpickled, so whoever answers at the address is trusted.
    """
    try:
        from distributed import Client  # an extra, and a second to import
    except ImportError:
        message, hint = "`--executor` needs Dask, which is not installed", install_command("cluster")
        raise ConfigError(Diagnostic(Severity.ERROR, "no-cluster", message, hint=hint)) from None
    try:
        client = Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        message = f"no Dask scheduler answers at `{address}`: {error or 'time is up'}"
        hint = "start one with `dask scheduler`, or go without `--executor`"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-cluster", message, hint=hint)) from None
    executor: Executor = client.get_executor()
    weakref.finalize(executor, client.close)  # its own end does not close it: it would try to connect again for seconds
    return executor


def _plan(folder: str, config: Config, robot: RobotConfig, options: BuildOptions) -> tuple[Plan, Dependencies]:
    """Plan in a worker, in the folder that diagnostics name files from. Raises UrdfsyncError."""
    os.chdir(folder)
    with Dependencies() as found:
        plan = plan_robot(config, robot, options)
    found.add_modules()
    return plan, found


@contextlib.contextmanager
def _safe_path() -> Iterator[None]:
    """Start Python processes that import nothing from the working folder, which may be a stranger's repository.

    An executor starts some when it is made, for its locks, and others when work is submitted. The variable is removed
    afterwards: a command of the user's that runs later may want its own folder on the path.
    """
    before = os.environ.get("PYTHONSAFEPATH")
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ["PYTHONSAFEPATH"]
        else:
            os.environ["PYTHONSAFEPATH"] = before


def _prepare_worker() -> None:
    """End when the parent ends, and not with Ctrl-C."""
    signal(SIGINT, SIG_IGN)  # the parent gets it, too, and ends the workers
    parent = parent_process()

    def follow() -> None:
        if parent is not None:
            wait_for([parent.sentinel])
            os._exit(1)

    Thread(target=follow, daemon=True).start()
