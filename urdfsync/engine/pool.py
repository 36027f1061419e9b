"""Plans many robots at once, in worker processes of this machine or of a Dask cluster. Only this process writes."""

from __future__ import annotations

import contextlib
from collections import deque
from collections.abc import Sequence
from concurrent.futures import Future, wait
from typing import Any, Self

import msgspec

from urdfsync import dependencies, machine
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies import Dependencies
from urdfsync.diagnostics import OutputError, UrdfsyncError
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage import Plan
from urdfsync.workers import Workers, workers

LEAST_ROBOTS = 6
"""With fewer robots, importing urdfsync in each worker takes longer than it saves."""
_AHEAD = 3
"""Plans per worker that may be under way or wait to be carried out: each holds the texts of a robot."""
_CLUSTER_WORKERS = 16
"""Workers that a cluster is taken to have, unless `--jobs` says otherwise."""
_PAUSE = 0.1
"""Seconds between two reports of progress."""


class Pool:
    """Plans the robots of one command; a plan that was made in advance serves once."""

    def __init__(self, config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> None:
        self._config, self._robots, self._options = config, robots, options
        self._is_started = False
        self._stack = contextlib.ExitStack()
        self._workers: Workers | None = None
        self._futures: dict[str, Future[tuple[Plan, Dependencies]]] = {}
        self._waiting: deque[RobotConfig] = deque()
        self._most = 0

    def __enter__(self) -> Self:
        """Connect to the cluster, if there is one. Raises ConfigError if it does not answer."""
        if self._options.executor:
            self._workers = self._stack.enter_context(workers(_CLUSTER_WORKERS, self._options.executor))
        return self

    def __exit__(self, *error: Any) -> None:
        self._stack.__exit__(*error)

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
        count = self._options.jobs or (_CLUSTER_WORKERS if self._workers else machine.cores())
        if self._workers is None:
            if len(self._robots) < LEAST_ROBOTS:
                return
            count = min(count, len(self._robots))
            self._workers = self._stack.enter_context(workers(count))
        self._most, self._waiting = _AHEAD * count, deque(self._robots)
        self._submit()

    def _submit(self) -> None:
        options = msgspec.structs.replace(self._options, progress=no_progress, executor="")
        while self._workers is not None and self._waiting and len(self._futures) < self._most:
            robot = self._waiting.popleft()
            self._futures[robot.name] = self._workers.submit(plan_in_worker, self._config, robot, options)

    def _result(self, robot: RobotConfig) -> Plan:
        message = f"robot `{robot.name}`: a process that planned it ended unexpectedly, perhaps because memory ran out"
        lost = OutputError.of("lost-process", message, hint="try again with `--jobs 1`")
        future = self._futures.pop(robot.name, None)
        if future is None:  # its place in the queue was lost with a worker
            raise lost
        while wait([future], _PAUSE).not_done:
            done = sum(other.done() for other in self._futures.values())
            remaining = len(self._waiting) + len(self._futures) + 1
            total = len(self._robots)
            self._options.progress("reading", total - remaining + done, total)
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
        plan, reads = future.result()
        dependencies.include(reads)
        return plan


def plan_in_worker(config: Config, robot: RobotConfig, options: BuildOptions) -> tuple[Plan, Dependencies]:
    """Plan in a worker; also what that has read. Raises UrdfsyncError."""
    with Dependencies() as reads:
        plan = plan_robot(config, robot, options)
    reads.add_modules()
    return plan, reads
