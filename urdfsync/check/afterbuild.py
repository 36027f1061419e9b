"""The check after a build: syntax, layout, compiling and balance of the package that is on disk.

A package that a check found right is not checked again until something that matters has changed. One that is wrong
is checked again after each build: whoever builds twice must not be told that all is well.
"""

from __future__ import annotations

import contextlib
import hashlib
import importlib.metadata
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync import __version__
from urdfsync.check import files, libraries, run
from urdfsync.check.results import CheckOptions, CheckResult
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions, Progress
from urdfsync.files import Tree, digest, put
from urdfsync.outcome import Checked, Result

CheckRobots: TypeAlias = "Callable[[Config, Sequence[RobotConfig], CheckOptions, Progress], Iterator[CheckResult]]"
"""`run.check_robots`, or what stands in for it in tests of the daemon; what `Progress` raises gives a check up."""

_ABSENT = ("no-compiler", "no-standard-library", "standard-library-too-old", "broken-standard-library")
"""Codes of what this machine lacks; the package is not to blame."""


class BuildCheck(msgspec.Struct, frozen=True):
    """What the check after a build found; kept in a file if it is not wrong."""

    checked: Checked
    diagnostics: tuple[Diagnostic, ...] = ()
    seconds: float = 0.0
    """How long it took; 0 if it is known from an earlier one."""
    key: str = ""
    """Of all that it rests on: see `CheckCache.key`."""


class CheckCache:
    """The checks of one configuration that found nothing wrong: a small file per robot in `.urdfsync/checked`.

    So building a package twice does not compile it twice, which takes 10 s for an arm. The files are not committed
    and safe to lose; one that can't be read or written costs one check more.
    """

    def __init__(self, config: Config) -> None:
        self._config = config

    def key(self, robot: RobotConfig) -> str | None:
        """SHA-256 (hex) over all that a check of a robot rests on; None if some of that can't be read."""
        total = hashlib.sha256(f"{__version__}\0{_version('rumoca')}\0{robot.domain}\0{robot.target}\0".encode())
        try:
            texts = files.package_texts(robot.folder)
            around = files.files_around(self._config, robot, texts)
            users = {path.as_posix(): text for path, text in files.users_files(self._config, robot).items()}
            every = [*texts.values(), *around.values(), *users.values()]
            top = robot.target.package.partition(".")[0]
            used = libraries.needed_libraries(every, top, libraries.search_path(robot), ())
        except (UrdfsyncError, OSError):
            return None
        states = [(name, str(path), libraries.library_state(path)) for name, path in used.items()]
        total.update(f"{states}\0{self._standard_library()}\0".encode(errors="surrogateescape"))
        for contents in (texts, around, users):
            for path, content in sorted(contents.items()):
                total.update(f"{path}\0{digest(content)}\n".encode(errors="surrogateescape"))
            total.update(b"\0")
        return total.hexdigest()

    def load(self, robot: RobotConfig, key: str | None) -> BuildCheck | None:
        """The check with this key; None if it has to be made."""
        try:
            content = Tree(self._config.root).read(self._path(robot))
            found = msgspec.json.decode(content or b"", type=BuildCheck)
        except (UrdfsyncError, OSError, msgspec.DecodeError):
            return None
        return found if found.key == key and found.checked is not Checked.WRONG else None

    def save(self, robot: RobotConfig, found: BuildCheck | None) -> None:
        """Keep a check instead of the last one, or delete that one for None."""
        path = self._path(robot)
        with contextlib.suppress(UrdfsyncError, OSError):
            if not Tree(self._config.root).check_folder(path.parent):
                path.parent.mkdir(parents=True, exist_ok=True)
            if found is None:
                path.unlink(missing_ok=True)
            else:
                put(path, msgspec.json.encode(found))

    def _standard_library(self) -> str:
        """Places and state of the Modelica Standard Library; why there is none if there is none."""
        try:
            found = libraries.find_standard_library(os.environ, self._config.check.library)
        except UrdfsyncError as error:
            return str(error)
        return repr([(name, str(path), libraries.library_state(path)) for name, path in found.parts.items()])

    def _path(self, robot: RobotConfig) -> Path:
        return self._config.root / STATE_FOLDER / "checked" / f"{robot.name}.json"


class BuildChecker:
    """Checks packages of one configuration as they are on disk."""

    def __init__(self, config: Config, request: BuildOptions, check_robots: CheckRobots = run.check_robots) -> None:
        self._config, self._request, self._check_robots = config, request, check_robots
        self.cache = CheckCache(config)

    def known(self, robot: RobotConfig, key: str | None) -> BuildCheck | None:
        """The last check, if it rests on the same; None if it has to be made."""
        return None if self._request.full else self.cache.load(robot, key)

    def check(self, robots: Sequence[RobotConfig], tell: Progress) -> Iterator[BuildCheck]:
        """Check packages, in their order. What is wrong with one, or with its check, comes back as diagnostics."""
        request = self._request
        options = CheckOptions(jobs=request.jobs, wait=request.wait, package_paths=request.package_paths)
        keys = [self.cache.key(robot) for robot in robots]
        results = self._check_robots(self._config, robots, options, tell)
        trouble: BuildCheck | None = None
        for robot, key in zip(robots, keys, strict=True):
            try:
                found = trouble or _judged(next(results))
            except (UrdfsyncError, OSError) as error:
                found = trouble = _trouble(error)
            lasting = key is not None and found.checked in (Checked.RIGHT, Checked.INCOMPLETE)
            if lasting and key == self.cache.key(robot):  # else somebody has saved meanwhile
                general = tuple(one for one in found.diagnostics if is_general(one))
                self.cache.save(robot, BuildCheck(found.checked, general, 0.0, key or ""))
            else:
                self.cache.save(robot, None)
            yield found


def with_checks(
    config: Config, request: BuildOptions, results: Iterable[Result], check_robots: CheckRobots = run.check_robots
) -> Iterator[Result]:
    """The results of builds, in their order, each with what the check of its package found.

    The checks come after all builds, since others wait for the lock as long as these are not done.
    """
    checker = BuildChecker(config, request, check_robots)
    robots = {robot.name: robot for robot in config.robots}
    said: set[Diagnostic] = set()

    def checked(result: Result, found: BuildCheck) -> Result:
        new = tuple(one for one in found.diagnostics if one not in said)
        said.update(filter(is_general, new))  # what is about the machine is said once for all robots
        return msgspec.structs.replace(result, diagnostics=(*result.diagnostics, *new), checked=found.checked)

    def is_due(result: Result) -> bool:
        return robots[result.robot].checking and not result.failed and not result.dry and result.checked is None

    waiting: list[Result] = []
    for result in results:
        robot = robots[result.robot]
        if is_due(result) and (found := checker.known(robot, checker.cache.key(robot))):
            result = checked(result, found)
        if waiting or is_due(result):
            waiting.append(result)
        else:
            yield result
    due = [robots[result.robot] for result in waiting if is_due(result)]
    checks = checker.check(due, request.progress) if due else iter(())
    while waiting:
        try:
            done = checked(waiting[0], next(checks)) if is_due(waiting[0]) else waiting[0]
        except KeyboardInterrupt:
            yield from waiting  # they are built, whatever becomes of their checks
            raise
        waiting.pop(0)
        yield done


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


def _trouble(error: UrdfsyncError | OSError) -> BuildCheck:
    """What there is to say of packages that can't be checked at all."""
    if isinstance(error, OSError):
        place = error.filename if isinstance(error.filename, str) else ""
        message = f"the packages can't be checked: {error.strerror or error}"
        return BuildCheck(Checked.WRONG, (Diagnostic(Severity.ERROR, "system", message, place),))
    diagnostics = _lenient(error.diagnostics)
    lacking = all(one.severity is not Severity.ERROR for one in diagnostics)
    return BuildCheck(Checked.UNCHECKED if lacking else Checked.WRONG, diagnostics)


def _lenient(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Findings, what this machine lacks being no error: a build can do without."""
    return tuple(
        msgspec.structs.replace(found, severity=Severity.WARNING) if found.code in _ABSENT else found
        for found in diagnostics
    )


def _version(distribution: str) -> str:
    try:
        return importlib.metadata.version(distribution)
    except importlib.metadata.PackageNotFoundError:
        return ""
