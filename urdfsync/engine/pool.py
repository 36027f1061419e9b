"""Plans many robots at once, in worker processes of this machine or of a Dask cluster.

Workers of a cluster see the project at the same path, such as on a shared file system, and have the same urdfsync. Only
this process writes.
"""

from __future__ import annotations

import contextlib
import os
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, Future, wait
from concurrent.futures.process import ProcessPoolExecutor
from multiprocessing import active_children, get_all_start_methods, get_context, parent_process
from multiprocessing.connection import wait as wait_for
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from threading import Thread
from types import TracebackType
from typing import Self, TypeAlias

import msgspec

from urdfsync import dependencies, machine, profiling
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import Plan, plan_if_current, plan_robot
from urdfsync.extras import install_command

LEAST_STALE = 6
"""With fewer stale robots, importing urdfsync in each worker takes longer than it saves."""
_AHEAD = 3
"""Plans per worker that may be under way or wait to be carried out: each holds the texts of a robot."""
_CLUSTER_WORKERS = 16
"""Workers that a cluster is taken to have, unless `--jobs` says otherwise."""
_PATIENCE = 10
"""Seconds to wait for a Dask scheduler to answer."""
_PAUSE = 0.1
"""Seconds between two reports of progress."""

_Answer: TypeAlias = tuple[Plan | None, type[UrdfsyncError], tuple[Diagnostic, ...], "profiling.Measured | None"]
"""A plan, or class and findings of the error that prevented it; and what was measured, if it was."""


class Pool:
    """Plans the robots of one command; a plan that was made in advance serves once."""

    def __init__(self, config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> None:
        self._config, self._robots, self._options = config, robots, options
        self._prefetched: dict[str, Plan] = {}
        self._is_started = False
        self._executor: Executor | None = None
        self._futures: dict[str, Future[_Answer]] = {}
        self._waiting: deque[RobotConfig] = deque()
        self._stale = self._most = 0

    def plan(self, robot: RobotConfig) -> Plan:
        """Plan one robot. Raises UrdfsyncError for whatever is wrong."""
        if not self._is_started:
            self._is_started = True
            self._start()
        if robot.name in self._futures or robot in self._waiting:
            return self._result(robot)
        plan = self._prefetched.pop(robot.name, None)
        return plan or plan_robot(self._config, robot, self._options)

    def __enter__(self) -> Self:
        """Connect to the cluster, if there is one. Raises ConfigError if it does not answer."""
        if self._options.executor:
            self._executor = _cluster(self._options.executor)
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

    def _start(self) -> None:
        """Find the stale robots, and start workers if they are many."""
        stale = []
        for robot in self._robots:
            try:
                plan = plan_if_current(self._config, robot, self._options)
            except (UrdfsyncError, OSError):
                continue  # told when it is planned in its turn
            if plan is None:
                stale.append(robot)
            else:
                self._prefetched[robot.name] = plan
        if self._executor is None:
            if len(stale) < LEAST_STALE:
                return
            workers = min(self._options.jobs or machine.cores(), len(stale))
            self._executor = _processes(workers)
        else:
            workers = self._options.jobs or _CLUSTER_WORKERS
        dependencies.mark_incomplete()  # what workers read is not recorded as a dependency of the answer
        self._stale, self._most, self._waiting = len(stale), _AHEAD * workers, deque(stale)
        self._submit()

    def _submit(self) -> None:
        options = msgspec.structs.replace(self._options, progress=no_progress, cache=None, executor="")
        while self._executor is not None and self._waiting and len(self._futures) < self._most:
            robot = self._waiting.popleft()
            with _safe_path():
                self._futures[robot.name] = self._executor.submit(
                    _plan, str(Path.cwd()), self._config, robot, options, profiling.current() is not None
                )

    @profiling.stage("waiting")
    def _result(self, robot: RobotConfig) -> Plan:
        future = self._futures.pop(robot.name, None)
        if future is None:  # its place in the queue was lost with a worker
            raise _lost_process(robot)
        while wait([future], _PAUSE).not_done:
            done = sum(other.done() for other in self._futures.values())
            left = len(self._waiting) + len(self._futures) + 1
            self._options.progress("reading", self._stale - left + done, self._stale)
        try:
            plan, error, diagnostics, measured = future.result()
            self._submit()
        except Exception as problem:  # `_plan` raises none: the worker is lost, in one of many ways
            raise _lost_process(robot) from problem
        if measured and (profile := profiling.current()):
            profile.add(measured)
        if plan is None:
            raise error(*diagnostics)
        return plan


def _lost_process(robot: RobotConfig) -> OutputError:
    message = f"robot `{robot.name}`: a process that planned it ended unexpectedly, perhaps for want of memory"
    return OutputError(Diagnostic(Severity.ERROR, "lost-process", message, hint="try again with `--jobs 1`"))


def _processes(workers: int) -> Executor:
    # not a plain fork: the thread of a progress bar may hold a lock at that moment
    method = "forkserver" if "forkserver" in get_all_start_methods() else "spawn"
    with _safe_path():
        return ProcessPoolExecutor(workers, get_context(method), initializer=_prepare_worker)


def _cluster(address: str) -> Executor:
    """Connect to the Dask scheduler at an address that the user named. Raises ConfigError.

    Its answers are unpickled, so whoever answers at the address is trusted.
    """
    try:
        from distributed import Client  # an extra, and a second to import
    except ImportError:
        message, hint = "`--executor` needs Dask, which is not installed", install_command("cluster")
        raise ConfigError(Diagnostic(Severity.ERROR, "no-cluster", message, hint=hint)) from None
    try:
        executor: Executor = Client(address, timeout=_PATIENCE, set_as_default=False).get_executor()
    except (OSError, ValueError, TimeoutError) as error:
        message = f"no Dask scheduler answers at `{address}`: {error or 'time is up'}"
        hint = "start one with `dask scheduler`, or build without `--executor`"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-cluster", message, hint=hint)) from None
    return executor


def _plan(folder: str, config: Config, robot: RobotConfig, options: BuildOptions, profiled: bool) -> _Answer:
    """Plan in a worker, in the folder that diagnostics name files from."""
    os.chdir(folder)
    with profiling.measured() if profiled else contextlib.nullcontext() as profile:
        try:
            plan, error, found = plan_robot(config, robot, options), UrdfsyncError, tuple[Diagnostic, ...]()
        except UrdfsyncError as problem:
            plan, error, found = None, type(problem), problem.diagnostics
        return plan, error, found, profile.results() if profile else None


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
