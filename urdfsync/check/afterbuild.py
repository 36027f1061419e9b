"""The check after a build: syntax, layout, compiling and balance of the package that is on disk.

A package that a check found right is not checked again until something that matters has changed: that takes 10 s for
an arm. One that is wrong is checked again after each build: whoever builds twice must not be told that all is well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from urdfsync.check import run
from urdfsync.check.cache import UserCache
from urdfsync.check.fingerprint import fingerprint
from urdfsync.check.results import CheckOptions, CheckResult
from urdfsync.check.tools import chosen_tools
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError, findings_of
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.engine.result import Checked, Result


class BuildCheck(msgspec.Struct, frozen=True):
    """What the check after a build found."""

    checked: Checked
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """How long it took; 0 if it is known from an earlier one."""


class BuildChecker:
    """Checks packages of one configuration as they are on disk."""

    def __init__(self, config: Config, request: BuildOptions) -> None:
        self._config, self._cache = config, UserCache.default()
        self._options = CheckOptions(
            tools=chosen_tools(config, trusted=request.trusted),
            jobs=request.jobs,
            wait=request.wait,
            package_paths=request.package_paths,
            fresh=request.full,
        )

    def key(self, robot: RobotConfig) -> str | None:
        """Fingerprint of all that a check of a robot rests on; None if some of that can't be read."""
        return fingerprint(self._config, robot, self._options)

    def known(self, key: str | None) -> BuildCheck | None:
        """An earlier check with this key, of which only findings about the machine are left; None if there is none."""
        result = None if self._options.fresh or key is None else self._cache.load(key, CheckResult)
        if result is None:
            return None
        found = _judged(result)
        return BuildCheck(found.checked, tuple(filter(is_general, found.diagnostics)))

    def check(self, robots: Sequence[RobotConfig], tell: Progress) -> Iterator[BuildCheck]:
        """Check packages, in their order, as far as no earlier check is known.

        What is wrong with a package, or with its check, comes back as diagnostics.
        """
        known = {robot.name: self.known(self.key(robot)) for robot in robots}
        unknown = [robot for robot in robots if known[robot.name] is None]
        results = run.check_robots(self._config, unknown, self._options, tell)
        trouble: BuildCheck | None = None
        for robot in robots:
            found = known[robot.name]
            if found is None:
                try:
                    found = trouble or _judged(next(results))
                except (UrdfsyncError, OSError) as error:
                    found = trouble = BuildCheck(Checked.WRONG, findings_of(error))
            yield found


def with_checks(config: Config, request: BuildOptions, results: Iterable[Result]) -> Iterator[Result]:
    """The results of builds, in their order, each with what the check of its package found.

    The checks come after all builds, since others wait for the lock as long as these are not done.
    """
    robots = {robot.name: robot for robot in config.robots}
    said: set[Diagnostic] = set()
    built: list[Result] = []
    told = 0
    try:
        built.extend(results)
        fresh = [one.robot for one in built if not (one.failed or one.dry or one.checked)]
        due = [robots[name] for name in fresh if robots[name].checking]
        checks = BuildChecker(config, request).check(due, request.progress)
        for result in built:
            if robots[result.robot] in due:
                found = next(checks)
                kept = robots[result.robot].without_ignored(found.diagnostics)
                new = tuple(one for one in kept if one not in said)
                said.update(filter(is_general, new))  # what is about the machine is said once for all robots
                diagnostics = (*result.diagnostics, *new)
                result = msgspec.structs.replace(result, diagnostics=diagnostics, checked=found.checked)
            told += 1
            yield result
    except (KeyboardInterrupt, Exception):
        yield from built[told:]  # they are built, whatever becomes of their checks
        raise


def is_general(found: Diagnostic) -> bool:
    """Whether a finding is about this machine, and not about one robot."""
    return not found.file and found.severity is not Severity.ERROR


def _judged(result: CheckResult) -> BuildCheck:
    """A result, as far as it matters after a build."""
    if result.failed:
        return BuildCheck(Checked.WRONG, result.diagnostics, result.seconds)
    if result.compiled and not result.gaps:
        return BuildCheck(Checked.RIGHT, result.diagnostics, result.seconds)
    said = (Diagnostic(Severity.WARNING, "not-checked", sentence) for sentence in result.gaps or result.unchecked)
    return BuildCheck(Checked.INCOMPLETE, (*result.diagnostics, *said), result.seconds)
