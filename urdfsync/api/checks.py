"""Checks: packages are compiled, and compared with an independent reference."""

from __future__ import annotations

import os
from collections.abc import Callable

from urdfsync import config as configuration
from urdfsync.api import Place, Results, ignore, load
from urdfsync.checks import run
from urdfsync.checks.report import all_lines
from urdfsync.checks.results import CheckOptions, CheckResult
from urdfsync.checks.tools import chosen_tools
from urdfsync.engine.options import Progress, no_progress


def check(
    *robots: str,
    config: Place = None,
    physics: bool = False,
    strict: bool = False,
    tool: str | None = None,
    trust: bool = False,
    timeout: float = 600,
    memory: float | None = None,
    jobs: int | None = None,
    executor: str = "",
    wait: float = 60,
    progress: Progress = no_progress,
    on_result: Callable[[CheckResult], object] = ignore,
) -> Results[CheckResult]:
    """Check packages as they are on disk, as `urdfsync check` does, whose options these are.

    `result.status(strict)` is the verdict. `timeout` is in seconds for a robot, `memory` in GB for all. `on_result`
    gets each result as soon as it is there. Raises UrdfsyncError for a configuration that can't be used, a robot that
    it does not have, a compiler that is not trusted, and where there is no place for the cache.
    """
    loaded = load(config)
    chosen, tools = loaded.select(robots), chosen_tools(loaded, tool, trusted=trust)
    options = CheckOptions(
        physics=physics,
        strict=strict,
        tools=tools,
        jobs=jobs,
        timeout=timeout,
        memory=memory,
        wait=wait,
        package_paths=configuration.ros_package_path(os.environ),
        executor=executor,
    )
    checked = run.check_robots(loaded, chosen, options, progress)
    return Results(checked, lambda result: all_lines(result, strict=strict), on_result)
