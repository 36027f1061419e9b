"""Checks many robots, as many at a time as cores and memory allow; also after builds."""

from __future__ import annotations

import contextlib
import functools
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import msgspec
import psutil

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.contents import content_hash
from urdfsync.analysis.checks.results import CheckOptions, CheckResult
from urdfsync.analysis.checks.robot import check_robot, recall_check
from urdfsync.common.diagnostics import Diagnostic, Severity, findings_of
from urdfsync.common.processes import machine
from urdfsync.common.processes.workers import do_all
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.engine.result import Checked, Result
from urdfsync.project.config import Config, RobotConfig

_EXPECTED_MEMORY = 1.5e9  # bytes that the check of a robot usually takes, at most
_SHARE_OF_FREE_MEMORY = 0.9


def check_robots(
    config: Config, robots: Sequence[RobotConfig], options: CheckOptions, progress: Progress
) -> Iterator[CheckResult]:
    """Check robots; yield the results in the order of the robots, each as soon as all earlier results are known.

    A robot whose check is remembered needs no worker. `progress` gets the step of the work, and the number of finished
    robots. Raises CacheError if there is no place for the cache.
    """
    hashed, known = functools.cache(content_hash), dict[str, CheckResult]()
    for count, robot in enumerate(robots):
        progress(f"{robot.name}: looking for an earlier check", count, len(robots))
        if result := recall_check(config, robot, options, hashed):
            known[robot.name] = result
    checks = _check_in_workers(config, [robot for robot in robots if robot.name not in known], options, progress)
    for robot in robots:
        yield known.get(robot.name) or next(checks)
    yield from checks  # there are none left: the workers end


def check_builds(config: Config, request: BuildOptions, results: Iterable[Result]) -> Iterator[Result]:
    """Yield the results of builds, in their order, each with the check of its package if `on_build` asks for it.

    All builds end before the first check: they hold the lock, and other processes wait for it.
    """
    robots = {robot.name: robot for robot in config.robots}
    told: set[Diagnostic] = set()
    built: list[Result] = []
    count = 0
    try:
        built.extend(results)
        fresh = [robots[result.robot] for result in built if not (result.failed or result.dry or result.checked)]
        due = [robot for robot in fresh if robot.on_build == "check"]
        checks = check_built(config, due, request, request.progress)
        for result in built:
            if robots[result.robot] in due:
                checked, diagnostics = verdict(next(checks))
                findings = robots[result.robot].without_ignored(diagnostics)
                new = tuple(finding for finding in findings if finding not in told)
                told.update(filter(is_general, new))  # findings about the machine are shown once for all robots
                result = msgspec.structs.replace(result, diagnostics=(*result.diagnostics, *new), checked=checked)
            count += 1
            yield result
    except (KeyboardInterrupt, Exception):
        yield from built[count:]  # the robots are built, even if their checks failed
        raise


def check_built(
    config: Config, robots: Sequence[RobotConfig], request: BuildOptions, progress: Progress
) -> Iterator[CheckResult]:
    """Check packages after a build. A failure that ends all checks is an error of each other robot."""
    tools = compilers.choose(config, trusted=request.trusted)
    options = CheckOptions(tools=tools, jobs=request.jobs, wait=request.wait, fresh=request.full)
    waiting = list(robots)
    try:
        for result in check_robots(config, robots, options, progress):
            waiting.pop(0)
            yield result
    except Exception as error:  # noqa: BLE001 - the results of builds are shown in any case
        for robot in waiting:
            yield CheckResult(robot.name, robot.target.package, diagnostics=findings_of(error))


def verdict(result: CheckResult) -> tuple[Checked, tuple[Diagnostic, ...]]:
    """Return the part of a result that a build shows."""
    if result.failed:
        return Checked.WRONG, result.diagnostics
    if result.compiled and not result.gaps:
        return Checked.RIGHT, result.diagnostics
    gaps = (Diagnostic(Severity.WARNING, "not-checked", sentence) for sentence in result.gaps or result.unchecked)
    return Checked.INCOMPLETE, (*result.diagnostics, *gaps)


def is_general(finding: Diagnostic) -> bool:
    """Whether a finding concerns this machine, and not a single robot."""
    return not finding.file and finding.severity is not Severity.ERROR


def _check_in_workers(
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
    share = msgspec.structs.replace(options, compilers=max(1, machine.cores() // jobs), memory=budget / count)
    whole = msgspec.structs.replace(share, memory=budget)
    what = "checking"

    def look(steps: Sequence[str], finished: int) -> None:
        nonlocal what
        *_, what = [what, *steps]
        progress(what, finished, len(robots))

    # clean up here, since processes of checks may be killed
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        tasks = [(config, robot, share, Path(folder)) for robot in robots]
        with contextlib.closing(do_all(count, check_robot, tasks, look)) as checks:
            found: Iterator[CheckResult | Exception] = checks
            for robot in robots:
                result = next(found)
                if count > 1 and isinstance(result, CheckResult) and _lacks_memory(result):
                    found = iter(list(found))  # the others end first: a single robot may take all memory
                    (result,) = do_all(1, check_robot, [(config, robot, whole, Path(folder))], look)
                cache.trim()
                yield _lost(robot, result) if isinstance(result, Exception) else result


def _lacks_memory(result: CheckResult) -> bool:
    return any(finding.code == "out-of-memory" for finding in result.diagnostics)


def _lost(robot: RobotConfig, error: Exception) -> CheckResult:
    """Return the result of a check whose process died."""
    message = f"the check of robot `{robot.name}`: its process ended unexpectedly: {error or type(error).__name__}"
    lost = Diagnostic(Severity.ERROR, "check-crashed", message, hint="try again with `--jobs 1`")
    return CheckResult(robot.name, robot.target.package, diagnostics=(lost,))
