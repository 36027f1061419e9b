"""Builds: packages are brought in step, or looked at."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import msgspec

from urdfsync import config as configuration
from urdfsync import dependencies
from urdfsync.api import Place, Results, ignore, load
from urdfsync.config import Config, RobotConfig
from urdfsync.engine.build import build as build_robots
from urdfsync.engine.options import BuildOptions, Progress, no_progress
from urdfsync.engine.result import Result
from urdfsync.output.results import all_lines


def build(
    *robots: str,
    config: Place = None,
    dry_run: bool = False,
    merge: bool = False,
    full: bool = False,
    svg: bool = False,
    trust: bool = False,
    wait: float = 60,
    jobs: int | None = None,
    executor: str = "",
    progress: Progress = no_progress,
    on_result: Callable[[Result], object] = ignore,
) -> Results[Result]:
    """Bring packages in step with their sources, as `urdfsync build` does, whose options these are.

    `robots` are names, sources or outputs; without any, all robots are built. A robot that can't be built has
    `failed`, and says why in `diagnostics`; the others are built. `wait` is in seconds. `on_result` gets each result as
    soon as it is there. Raises UrdfsyncError for a configuration that can't be used, and for a robot that it does not
    have.
    """
    loaded = load(config)
    chosen: Sequence[RobotConfig] = loaded.select(robots)
    if merge:
        chosen = [msgspec.structs.replace(robot, on_conflict="merge") for robot in chosen]
    options = build_options(
        dry=dry_run, full=full, draw=svg, trusted=trust, wait=wait, jobs=jobs, executor=executor, progress=progress
    )
    return Results(build_and_check(loaded, chosen, options), all_lines, on_result)


def adopt(
    *robots: str,
    config: Place = None,
    dry_run: bool = False,
    trust: bool = False,
    wait: float = 60,
    progress: Progress = no_progress,
    on_result: Callable[[Result], object] = ignore,
) -> Results[Result]:
    """Build robots whose packages were there before: what differs from the generated files counts as edited."""
    loaded = load(config)
    options = build_options(dry=dry_run, adopts=True, trusted=trust, wait=wait, progress=progress)
    return Results(build_robots(loaded, loaded.select(robots), options), all_lines, on_result)


def build_options(**options: Any) -> BuildOptions:
    """Return how to build, with the ROS packages of the environment."""
    return BuildOptions(package_paths=configuration.ros_package_path(os.environ), **options)


def build_and_check(config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> Iterator[Result]:
    """Build robots, and check the packages of those with `on_build = "check"`; a dry run checks nothing."""
    results = build_robots(config, robots, options)
    if options.dry or not any(robot.checking for robot in robots):
        return results
    dependencies.mark_incomplete()  # checks look at more
    from urdfsync.checks import afterbuild  # most configurations have no use for it

    return afterbuild.with_checks(config, options, results)
