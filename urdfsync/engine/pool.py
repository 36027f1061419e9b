"""Plans many robots at once, in worker processes. Workers write nothing."""

from __future__ import annotations

import contextlib
from collections.abc import Generator, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import OutputError, UrdfsyncError, findings_of
from urdfsync.common.processes import machine
from urdfsync.common.processes.workers import do_all
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage.writes import Plan
from urdfsync.project.config import Config, RobotConfig

_AHEAD = 3
"""The greatest number of plans per worker, unfinished or not yet used: each plan holds the texts of a robot."""
Planned: TypeAlias = tuple[Plan | UrdfsyncError | OSError, Reads]
"""A plan or an error, and all files that the worker read."""


def plan_ahead(
    config: Config, robots: Sequence[RobotConfig], options: BuildOptions
) -> Generator[tuple[RobotConfig, Planned]]:
    """Yield the plan of each robot, in their order; the workers plan some robots ahead."""
    count = min(options.jobs or machine.cores(), len(robots))
    tasks = [(config, robot, msgspec.structs.replace(options, progress=no_progress)) for robot in robots]

    def look(_steps: Sequence[str], finished: int) -> None:
        options.progress("reading", finished, len(robots))

    plans = do_all(count, plan_in_worker, tasks, look, ahead=_AHEAD * count)
    with contextlib.closing(plans):
        for robot, planned in zip(robots, plans, strict=True):
            if isinstance(planned, Exception):
                reason = "a process that planned it ended unexpectedly, perhaps because memory ran out"
                message, hint = f"robot `{robot.name}`: {reason}", "try again with `--jobs 1`"
                lost = OutputError.of("lost-process", message, hint=hint)
                lost.__cause__ = planned
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
