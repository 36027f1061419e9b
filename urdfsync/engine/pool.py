"""Plans many robots at once, in worker processes. Workers write nothing."""

from __future__ import annotations

import contextlib
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import BrokenExecutor, Future, wait
from typing import TypeAlias

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies.reads import Reads, include
from urdfsync.diagnostics import OutputError, UrdfsyncError, findings_of
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage.writes import Plan
from urdfsync.processes import machine
from urdfsync.processes.workers import Workers, workers

_AHEAD = 3
"""The greatest number of plans per worker, unfinished or not yet used: each plan holds the texts of a robot."""
_PAUSE = 0.1
"""Seconds between two reports of progress."""
_Planned: TypeAlias = tuple[Plan | UrdfsyncError | OSError, Reads]
"""A plan or an error, and all files that the worker read."""


@contextlib.contextmanager
def start_pool(config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> Iterator[Pool]:
    """Start workers for the robots of one command."""
    count = min(options.jobs or machine.cores(), len(robots))
    with workers(count) as started:
        yield Pool(config, robots, options, started, _AHEAD * count)


class Pool:
    """Plans robots in advance, `most` at a time; each plan is used once."""

    def __init__(
        self, config: Config, robots: Sequence[RobotConfig], options: BuildOptions, started: Workers, most: int
    ) -> None:
        self._config, self._options, self._workers = config, options, started
        self._total, self._most = len(robots), most
        self._waiting, self._futures = deque(robots), dict[str, Future[_Planned]]()

    def plan(self, robot: RobotConfig, reads: Reads) -> Plan:
        """Plan one robot; `reads` is the list of this process. Raises UrdfsyncError for all faults."""
        if robot not in self._waiting and robot.name not in self._futures:
            return plan_robot(self._config, robot, self._options, reads)
        options = msgspec.structs.replace(self._options, progress=no_progress)
        try:
            try:
                plan, worker_reads = self._plan_ahead(robot, options)
            except BrokenExecutor:  # one worker died, perhaps with another robot, and all workers ended
                with workers(1) as alone:
                    plan, worker_reads = alone.submit(plan_in_worker, self._config, robot, options).result()
        except Exception as error:  # libraries raise many kinds of errors for a lost worker
            reason = "a process that planned it ended unexpectedly, perhaps because memory ran out"
            raise OutputError.of(
                "lost-process", f"robot `{robot.name}`: {reason}", hint="try again with `--jobs 1`"
            ) from error
        include(worker_reads)
        if isinstance(plan, Exception):
            raise plan
        return plan

    def _plan_ahead(self, robot: RobotConfig, options: BuildOptions) -> _Planned:
        """Return the plan of this robot, and let the workers plan further robots."""
        while self._waiting and (len(self._futures) < self._most or robot in self._waiting):
            ahead = self._waiting[0]
            self._futures[ahead.name] = self._workers.submit(plan_in_worker, self._config, ahead, options)
            self._waiting.popleft()
        future = self._futures.pop(robot.name)
        while wait([future], _PAUSE).not_done:
            remaining = len(self._waiting) + sum(not other.done() for other in self._futures.values()) + 1
            self._options.progress("reading", self._total - remaining, self._total)
        return future.result()


def plan_in_worker(config: Config, robot: RobotConfig, options: BuildOptions) -> _Planned:
    """Plan in a worker; return the plan and all files that the worker read."""
    with Reads() as reads:
        try:
            plan: Plan | UrdfsyncError | OSError = plan_robot(config, robot, options, reads)
        except (UrdfsyncError, OSError) as error:
            plan = error
        except Exception as error:  # noqa: BLE001 - an uncaught error would look like the end of a worker
            plan = UrdfsyncError(*findings_of(error))
    return plan, reads
