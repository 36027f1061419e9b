"""Plans many robots at once, in worker processes. Workers write nothing."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Sequence
from concurrent.futures import BrokenExecutor, Future, wait
from typing import TypeAlias

import msgspec

from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import OutputError, UrdfsyncError, findings_of
from urdfsync.common.processes import machine
from urdfsync.common.processes.workers import workers
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage.writes import Plan
from urdfsync.project.config import Config, RobotConfig

_AHEAD = 3
"""The greatest number of plans per worker, unfinished or not yet used: each plan holds the texts of a robot."""
_PAUSE = 0.1
"""Seconds between two reports of progress."""
Planned: TypeAlias = tuple[Plan | UrdfsyncError | OSError, Reads]
"""A plan or an error, and all files that the worker read."""


def plan_ahead(
    config: Config, robots: Sequence[RobotConfig], options: BuildOptions
) -> Generator[tuple[RobotConfig, Planned]]:
    """Yield the plan of each robot, in their order; the workers plan some robots ahead."""
    count = min(options.jobs or machine.cores(), len(robots))
    silent = msgspec.structs.replace(options, progress=no_progress)
    waiting, futures = deque(robots), dict[str, Future[Planned]]()
    with workers(count) as started:
        for robot in robots:
            try:
                try:
                    while waiting and len(futures) < _AHEAD * count:
                        futures[waiting[0].name] = started.submit(plan_in_worker, config, waiting[0], silent)
                        waiting.popleft()
                    future = futures.pop(robot.name)
                    while wait([future], _PAUSE).not_done:
                        remaining = len(waiting) + sum(not other.done() for other in futures.values()) + 1
                        options.progress("reading", len(robots) - remaining, len(robots))
                    planned = future.result()
                except BrokenExecutor:  # one worker died, perhaps with another robot, and all workers ended
                    with workers(1) as alone:
                        planned = alone.submit(plan_in_worker, config, robot, silent).result()
            except Exception as error:  # noqa: BLE001 - libraries raise many kinds of errors for a lost worker
                reason = "a process that planned it ended unexpectedly, perhaps because memory ran out"
                message, hint = f"robot `{robot.name}`: {reason}", "try again with `--jobs 1`"
                lost = OutputError.of("lost-process", message, hint=hint)
                lost.__cause__ = error
                planned = lost, Reads()
            yield robot, planned


def plan_in_worker(config: Config, robot: RobotConfig, options: BuildOptions) -> Planned:
    """Plan in a worker; return the plan and all files that the worker read."""
    with Reads() as reads:
        try:
            plan: Plan | UrdfsyncError | OSError = plan_robot(config, robot, options, reads)
        except (UrdfsyncError, OSError) as error:
            plan = error
        except Exception as error:  # noqa: BLE001 - an uncaught error would look like the end of a worker
            plan = UrdfsyncError(*findings_of(error))
    return plan, reads
