"""Checks many robots: as many at a time as cores and memory allow."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, wait
from pathlib import Path

import msgspec
import psutil

from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.contents import Hashes
from urdfsync.analysis.checks.results import CheckOptions, CheckResult
from urdfsync.analysis.checks.robot import check_robot, recall_check
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.processes import machine
from urdfsync.common.processes.workers import Workers, workers
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig

_EXPECTED_MEMORY = 1.5e9  # bytes that the check of a robot usually takes, at most
_SHARE_OF_FREE_MEMORY = 0.9
_PAUSE = 0.1  # s between two reports of progress


def check_robots(
    config: Config, robots: Sequence[RobotConfig], options: CheckOptions, progress: Progress
) -> Iterator[CheckResult]:
    """Check robots; yield the results in the order of the robots, each as soon as all earlier results are known.

    A robot whose check is remembered needs no worker. `progress` gets the step of the work, and the number of finished
    robots. Raises CacheError if there is no place for the cache.
    """
    hashes, known = Hashes(), dict[str, CheckResult]()
    for count, robot in enumerate(robots):
        progress(f"{robot.name}: looking for an earlier check", count, len(robots))
        if result := recall_check(config, robot, options, hashes):
            known[robot.name] = result
    checks = check_in_workers(config, [robot for robot in robots if robot.name not in known], options, progress)
    for robot in robots:
        yield known.get(robot.name) or next(checks)
    yield from checks  # there are none left: the workers end


def check_in_workers(
    config: Config, robots: Sequence[RobotConfig], options: CheckOptions, progress: Progress
) -> Iterator[CheckResult]:
    """Check robots whose checks are not remembered, as `check_robots` does."""
    if not robots:
        return
    cache = UserCache.default()
    cache.prepare()
    cache.trim()
    budget = options.memory or _SHARE_OF_FREE_MEMORY * psutil.virtual_memory().available / 1e9
    jobs = min(options.jobs or machine.cores(), len(robots))
    count = max(1, min(jobs, int(budget * 1e9 // _EXPECTED_MEMORY)))
    each = max(1, machine.cores() // jobs)
    share = msgspec.structs.replace(options, compilers=each, memory=budget / count)
    # clean up here, since processes of checks may be killed
    with (
        tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder,
        workers(count) as pool,
    ):
        place = Path(folder)
        futures = {each.name: pool.submit(check_robot, config, each, share, place) for each in robots}
        for robot in robots:
            result = _result(robot, futures, pool, progress)
            if count > 1 and any(finding.code == "out-of-memory" for finding in result.diagnostics):
                wait(futures.values())  # a single robot may take all memory
                whole = msgspec.structs.replace(share, memory=budget)
                futures[robot.name] = pool.submit(check_robot, config, robot, whole, place)
                result = _result(robot, futures, pool, progress)
            cache.trim()
            yield result


def _result(
    robot: RobotConfig, futures: dict[str, Future[CheckResult]], pool: Workers, progress: Progress
) -> CheckResult:
    """Wait for the check of one robot, and report the progress of all."""
    future, what = futures[robot.name], "checking"
    while wait([future], _PAUSE).not_done:
        *_, what = [what, *pool.steps()]
        progress(what, sum(each.done() for each in futures.values()), len(futures))
    if (error := future.exception()) is None:
        return future.result()
    message = f"the check of robot `{robot.name}`: its process ended unexpectedly: {error or type(error).__name__}"
    lost = Diagnostic(Severity.ERROR, "check-crashed", message, hint="try again with `--jobs 1`")
    return CheckResult(robot.name, robot.target.package, diagnostics=(lost,))
