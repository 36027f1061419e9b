"""The check after a build: syntax, layout, compiling and balance of the package that is on disk.

A package that a check found right is not checked again until something that matters has changed: that takes 10 s for
an arm. One that is wrong is checked again after each build: whoever builds twice must not be told that all is well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from urdfsync import __version__
from urdfsync.check import compilers, libraries, package, run
from urdfsync.check.cache import UserCache, fingerprint
from urdfsync.check.compilation import findings_of
from urdfsync.check.results import CheckOptions, CheckResult
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.engine.result import Checked, Result

_ABSENT = ("no-compiler", "no-standard-library", "standard-library-too-old")
"""Codes of what this machine lacks; the package is not to blame."""


class BuildCheck(msgspec.Struct, frozen=True):
    """What the check after a build found; kept in the user's cache if it is not wrong."""

    checked: Checked
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """How long it took; 0 if it is known from an earlier one."""


class BuildChecker:
    """Checks packages of one configuration as they are on disk."""

    def __init__(self, config: Config, request: BuildOptions) -> None:
        self._config, self._request, self._cache = config, request, UserCache.default()

    def key(self, robot: RobotConfig) -> str | None:
        """Fingerprint of all that a check of a robot rests on; None if some of that can't be read."""
        try:
            texts = package.package_texts(robot.folder)
            around = package.files_around(self._config, robot, texts)
            users = package.users_files(self._config, robot)
            every = [*texts.values(), *around.values(), *users.values()]
            needed = libraries.find_libraries(self._config, robot, every)
            states = needed.state(), str(needed.problem)
        except (UrdfsyncError, OSError):
            return None
        return fingerprint(
            *(__version__, compilers.installed_version("rumoca"), robot.domain, robot.folder, robot.target),
            *(states, sorted(texts.items()), sorted(around.items()), sorted(users.items())),
        )

    def known(self, key: str | None) -> BuildCheck | None:
        """An earlier check with this key; None if it has to be made."""
        return None if self._request.full or key is None else self._cache.load(key, BuildCheck)

    def check(self, robots: Sequence[RobotConfig], tell: Progress) -> Iterator[BuildCheck]:
        """Check packages, in their order, as far as no earlier check is known.

        What is wrong with a package, or with its check, comes back as diagnostics.
        """
        request = self._request
        options = CheckOptions(jobs=request.jobs, wait=request.wait, package_paths=request.package_paths)
        keys = {robot.name: self.key(robot) for robot in robots}
        known = {name: self.known(key) for name, key in keys.items()}
        results = run.check_robots(self._config, [one for one in robots if known[one.name] is None], options, tell)
        trouble: BuildCheck | None = None
        for robot in robots:
            found, key = known[robot.name], keys[robot.name]
            if found is None:
                try:
                    found = trouble or _judged(next(results))
                except (UrdfsyncError, OSError) as error:
                    diagnostics = _lenient(findings_of(error))
                    lacking = all(one.severity is not Severity.ERROR for one in diagnostics)
                    found = trouble = BuildCheck(Checked.UNCHECKED if lacking else Checked.WRONG, diagnostics)
                if key is not None and key == self.key(robot):  # else somebody has saved meanwhile
                    kept = BuildCheck(found.checked, tuple(filter(is_general, found.diagnostics)))
                    is_right = found.checked in (Checked.RIGHT, Checked.INCOMPLETE)
                    self._cache.save(key, kept if is_right else None)
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
                new = tuple(one for one in found.diagnostics if one not in said)
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
    diagnostics = _lenient(result.diagnostics)
    if any(found.severity is Severity.ERROR for found in diagnostics):
        return BuildCheck(Checked.WRONG, diagnostics, result.seconds)
    if result.compiled and not result.gaps:
        return BuildCheck(Checked.RIGHT, diagnostics, result.seconds)
    said = (Diagnostic(Severity.WARNING, "not-checked", sentence) for sentence in result.gaps or result.unchecked)
    return BuildCheck(Checked.INCOMPLETE, (*diagnostics, *said), result.seconds)


def _lenient(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Findings, what this machine lacks being no error: a build can do without."""
    return tuple(
        msgspec.structs.replace(found, severity=Severity.WARNING) if found.code in _ABSENT else found
        for found in diagnostics
    )
