"""The check after a build: the first stages of `check` on the package that is on disk.

A package that a check found right is not checked again until something that matters has changed. One that is wrong
is checked again after each build: whoever builds twice must not be told that all is well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from urdfsync.checking.memory import Memory, Note
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.outcome import Checked, Result

if TYPE_CHECKING:
    from urdfsync.checking.verdict import Verdict

Examine: TypeAlias = "Callable[[Config, Sequence[RobotConfig], BuildOptions, Progress], Iterator[Verdict]]"
"""Checks the packages of robots that are on disk, in their order; whatever `Progress` raises gives it up."""

_ABSENT = ("no-compiler", "no-standard-library", "standard-library-too-old", "broken-standard-library", "no-cache")
"""Codes of what this machine lacks; the package is not to blame."""


def on_disk(config: Config, robots: Sequence[RobotConfig], request: BuildOptions, tell: Progress) -> Iterator[Verdict]:
    """Check syntax and layout of packages, compile and balance their models; all of that in other processes.

    Raises CompilerError if what this needs is not installed.
    """
    from urdfsync.checking.compilers import rumoca

    rumoca.require()  # before anything is imported that comes with it
    from urdfsync.checking import checker
    from urdfsync.checking.wishes import Wishes

    wishes = Wishes(jobs=request.jobs, wait=request.wait, package_paths=request.package_paths)
    return checker.check(config, robots, wishes, tell)


class Findings(msgspec.Struct, frozen=True):
    """What a check found."""

    checked: Checked
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """How long it took; 0 if it is remembered."""


class Inspector:
    """Checks the packages of one configuration, and remembers those that are right."""

    def __init__(self, config: Config, request: BuildOptions, examine: Examine) -> None:
        self._config, self._request, self._examine = config, request, examine
        self._memory = Memory(config)

    def fingerprint(self, robot: RobotConfig) -> str | None:
        """All that a check of a robot rests on in one value; None if some of that can't be read."""
        return self._memory.fingerprint(robot)

    def recall(self, robot: RobotConfig, fingerprint: str | None) -> Findings | None:
        """What is remembered of just this; None if it has to be checked."""
        note = None if self._request.full else self._memory.recall(robot, fingerprint)
        return Findings(note.checked, note.said) if note else None

    def inspect(self, robots: Sequence[RobotConfig], tell: Progress) -> Iterator[Findings]:
        """Check packages, in their order. What is wrong with one, or with its check, comes back as diagnostics."""
        before = [self.fingerprint(robot) for robot in robots]
        verdicts: Iterator[Verdict] = iter(())
        trouble = None
        try:
            verdicts = self._examine(self._config, robots, self._request, tell)
        except (UrdfsyncError, OSError) as error:
            trouble = _trouble(error)
        for robot, fingerprint in zip(robots, before, strict=True):
            if trouble is None:
                try:
                    found = findings(next(verdicts))
                except (UrdfsyncError, OSError) as error:
                    trouble = _trouble(error)
            found = trouble or found
            self._remember(robot, fingerprint, found)
            yield found

    def _remember(self, robot: RobotConfig, fingerprint: str | None, found: Findings) -> None:
        """Remember what was found, unless it is wrong, or nothing, or somebody has saved meanwhile."""
        note, lasting = None, found.checked in (Checked.RIGHT, Checked.INCOMPLETE)
        if fingerprint is not None and lasting and fingerprint == self.fingerprint(robot):
            note = Note(fingerprint, found.checked, tuple(one for one in found.diagnostics if is_general(one)))
        self._memory.keep(robot, note)


def findings(verdict: Verdict) -> Findings:
    """A verdict, as far as it matters after a build."""
    diagnostics = _lenient(verdict.diagnostics)
    if any(found.severity is Severity.ERROR for found in diagnostics):
        return Findings(Checked.WRONG, diagnostics, verdict.seconds)
    if verdict.compiled and not verdict.gaps:
        return Findings(Checked.RIGHT, diagnostics, verdict.seconds)
    said = (Diagnostic(Severity.WARNING, "not-checked", sentence) for sentence in verdict.gaps or verdict.unchecked)
    return Findings(Checked.INCOMPLETE, (*diagnostics, *said), verdict.seconds)


def _trouble(error: UrdfsyncError | OSError) -> Findings:
    """What there is to say of packages that can't be checked at all."""
    if isinstance(error, OSError):
        place = error.filename if isinstance(error.filename, str) else ""
        message = f"the packages can't be checked: {error.strerror or error}"
        return Findings(Checked.WRONG, (Diagnostic(Severity.ERROR, "system", message, place),))
    diagnostics = _lenient(error.diagnostics)
    lacking = all(one.severity is not Severity.ERROR for one in diagnostics)
    return Findings(Checked.UNCHECKED if lacking else Checked.WRONG, diagnostics)


def _lenient(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Findings, what this machine lacks being no error: a build can do without."""
    return tuple(
        msgspec.structs.replace(found, severity=Severity.WARNING) if found.code in _ABSENT else found
        for found in diagnostics
    )


def is_general(found: Diagnostic) -> bool:
    """Whether a finding is about this machine, and not about one robot."""
    return not found.file and found.severity is not Severity.ERROR


def checked(
    config: Config, request: BuildOptions, results: Iterable[Result], examine: Examine = on_disk
) -> Iterator[Result]:
    """The results of builds, in their order, each with what the check of its package found.

    The checks come after all builds, since others wait for the lock as long as these are not done.
    """
    after = _AfterBuild(config, request, examine)
    waiting: list[Result] = []
    for result in results:
        known = after.recalled(result)
        if waiting or after.is_due(known):
            waiting.append(known)
        else:
            yield known
    found = after.inspected([result for result in waiting if after.is_due(result)])
    while waiting:
        try:
            done = next(found) if after.is_due(waiting[0]) else waiting[0]
        except KeyboardInterrupt:
            yield from waiting  # they are built, whatever becomes of their checks
            raise
        waiting.pop(0)
        yield done


class _AfterBuild:
    """The checks of one command."""

    def __init__(self, config: Config, request: BuildOptions, examine: Examine) -> None:
        self._inspector, self._request = Inspector(config, request, examine), request
        self._robots = {robot.name: robot for robot in config.robots}
        self._said: set[Diagnostic] = set()

    def is_due(self, result: Result) -> bool:
        """Whether a package is to be checked, and is not yet."""
        built = not result.failed and not result.dry
        return self._robots[result.robot].checking and built and result.checked is None

    def recalled(self, result: Result) -> Result:
        """The result of a build, with what is remembered of the last check if that still holds."""
        if not self.is_due(result):
            return result
        robot = self._robots[result.robot]
        found = self._inspector.recall(robot, self._inspector.fingerprint(robot))
        return self._with(result, found) if found else result

    def inspected(self, results: Sequence[Result]) -> Iterator[Result]:
        """The results of builds, each with what a check of its package finds."""
        robots = [self._robots[result.robot] for result in results]
        found = self._inspector.inspect(robots, self._request.progress) if robots else ()
        for result, findings in zip(results, found, strict=True):
            yield self._with(result, findings)

    def _with(self, result: Result, found: Findings) -> Result:
        """A result with findings; what is about the machine is said once for all robots."""
        new = tuple(one for one in found.diagnostics if one not in self._said)
        self._said.update(one for one in new if is_general(one))
        return msgspec.structs.replace(result, diagnostics=(*result.diagnostics, *new), checked=found.checked)
