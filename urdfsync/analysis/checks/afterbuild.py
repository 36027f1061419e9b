"""The check after a build: syntax, layout, compiling and balance of the package on disk.

A package without faults is not checked again until an input of the check changes: a check takes 10 s for an arm. A
faulty package is checked again after each build: a second build must not hide its faults.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from urdfsync.analysis.checks import compilers, run
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.contents import Hashes
from urdfsync.analysis.checks.fingerprint import fingerprint
from urdfsync.analysis.checks.results import CheckOptions, CheckResult
from urdfsync.common.diagnostics import Diagnostic, Severity, findings_of
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.engine.result import Checked, Result
from urdfsync.project.config import Config, RobotConfig


class BuildCheck(msgspec.Struct, frozen=True):
    """The verdict of the check after a build."""

    checked: Checked
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """Seconds that the check took; 0 for an earlier check."""


class BuildChecker:
    """Checks packages of one configuration as they are on disk."""

    def __init__(self, config: Config, request: BuildOptions) -> None:
        self._config = config
        self._options = CheckOptions(
            tools=compilers.choose(config, trusted=request.trusted),
            jobs=request.jobs,
            wait=request.wait,
            fresh=request.full,
        )

    def key(self, robot: RobotConfig, hashes: Hashes | None = None) -> str | None:
        """Return the fingerprint of all inputs of a robot's check; None if an input can't be read.

        `hashes` as in `result_key`.
        """
        return fingerprint(self._config, robot, self._options, hashes)

    def find_earlier(self, key: str | None) -> BuildCheck | None:
        """Return an earlier check with this key, without findings about the robot; None if there is no such check."""
        result = None if self._options.fresh or key is None else UserCache.default().load(key, CheckResult)
        if result is None:
            return None
        check = _judge(result)
        return BuildCheck(check.checked, tuple(filter(is_general, check.diagnostics)))

    def check(self, robots: Sequence[RobotConfig], tell: Progress) -> Iterator[BuildCheck]:
        """Yield a check of each robot's package, in their order; an earlier check is reused.

        Faults of a package, or of its check, come back as diagnostics.
        """
        hashes = Hashes()
        earlier = {robot.name: self.find_earlier(self.key(robot, hashes)) for robot in robots}
        unknown = [robot for robot in robots if earlier[robot.name] is None]
        results = run.check_in_workers(self._config, unknown, self._options, tell)
        trouble: BuildCheck | None = None  # the failure that ended all checks
        for robot in robots:
            try:
                yield earlier[robot.name] or trouble or _judge(next(results))
            except Exception as error:  # noqa: BLE001 - the results of builds are shown in any case
                trouble = BuildCheck(Checked.WRONG, findings_of(error))
                yield trouble


def with_checks(config: Config, request: BuildOptions, results: Iterable[Result]) -> Iterator[Result]:
    """Yield the results of builds, in their order, each with the check of its package.

    All builds end before the first check: they hold the lock, and other processes wait for it.
    """
    robots = {robot.name: robot for robot in config.robots}
    told: set[Diagnostic] = set()
    built: list[Result] = []
    count = 0
    try:
        built.extend(results)
        fresh = [result.robot for result in built if not (result.failed or result.dry or result.checked)]
        due = [robots[name] for name in fresh if robots[name].on_build == "check"]
        checks = BuildChecker(config, request).check(due, request.progress)
        for result in built:
            if robots[result.robot] in due:
                check = next(checks)
                findings = robots[result.robot].without_ignored(check.diagnostics)
                new = tuple(finding for finding in findings if finding not in told)
                told.update(filter(is_general, new))  # findings about the machine are shown once for all robots
                diagnostics = (*result.diagnostics, *new)
                result = msgspec.structs.replace(result, diagnostics=diagnostics, checked=check.checked)
            count += 1
            yield result
    except (KeyboardInterrupt, Exception):
        yield from built[count:]  # the robots are built, even if their checks failed
        raise


def is_general(finding: Diagnostic) -> bool:
    """Whether a finding concerns this machine, and not a single robot."""
    return not finding.file and finding.severity is not Severity.ERROR


def _judge(result: CheckResult) -> BuildCheck:
    """Return the part of a result that a build shows."""
    if result.failed:
        return BuildCheck(Checked.WRONG, result.diagnostics, result.seconds)
    if result.compiled and not result.gaps:
        return BuildCheck(Checked.RIGHT, result.diagnostics, result.seconds)
    gaps = (Diagnostic(Severity.WARNING, "not-checked", sentence) for sentence in result.gaps or result.unchecked)
    return BuildCheck(Checked.INCOMPLETE, (*result.diagnostics, *gaps), result.seconds)
