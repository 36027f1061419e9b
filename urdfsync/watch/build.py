"""Builds as the daemon makes them: the source is judged first, and nothing that happens to a robot ends the daemon."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine import source
from urdfsync.engine.build import build
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_robot
from urdfsync.files import digest
from urdfsync.outcome import Result
from urdfsync.watch.paths import RobotPaths

_MANY = 3
"""Least number of lost elements for which a source counts as shrunk; they have to be more than half of all, too."""


class SourceState(msgspec.Struct, frozen=True):
    """What is to be said of a source before it is built."""

    sha256: str = ""
    """Of the bytes that were read; empty if they could not be."""
    errors: tuple[Diagnostic, ...] = ()
    """Why it is invalid; empty if it is valid."""
    lost: int = 0
    """Elements of the last build that it lacks; 0 if these are few."""


def read_source(config: Config, robot: RobotConfig, paths: RobotPaths, cache: Cache) -> SourceState:
    """Read the source of a robot, and compare its elements with those of the last build. A bug is an error of it."""
    try:
        content = source.read_source(config, robot)
        domain = registry.domain(robot.domain)
        reading = source.read_cached(domain, robot.options, content, shown(robot.source), cache)
        if reading.snapshot is None or any(found.severity is Severity.ERROR for found in reading.diagnostics):
            return SourceState(digest(content), reading.diagnostics)
        by_kind = domain.names(reading.snapshot, robot.target)
    except UrdfsyncError as error:
        return SourceState(errors=error.diagnostics)
    except Exception as error:  # noqa: BLE001 - a bug in a domain must not end the daemon; nothing is written yet
        return SourceState(errors=(internal_error(error, f"{shown(robot.source)} can't be read"),))
    lost = len(paths.built_names - {(kind, name) for kind, names in by_kind.items() for name in names})
    return SourceState(digest(content), lost=lost if lost >= _MANY and 2 * lost > len(paths.built_names) else 0)


def build_robots(config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> Iterator[Result]:
    """Build robots. A bug that one robot meets is its error, and the others are built.

    Going on is safe: a transaction is finished or undone by the next build, which reads everything from the disk.
    """
    waiting = list(robots)
    while waiting:
        try:
            for result in build(config, tuple(waiting), options):
                waiting.pop(0)
                yield result
        except Exception as error:  # noqa: BLE001
            yield failed_result(config, waiting.pop(0), (internal_error(error, "it can't be built"),))


def failed_result(config: Config, robot: RobotConfig, diagnostics: tuple[Diagnostic, ...]) -> Result:
    """Return the result of a robot that can't be built."""
    package = robot.target.package
    return Result(robot.name, package, robot.folder, config.root, diagnostics=diagnostics, failed=True)


def left_alone(result: Result) -> frozenset[tuple[str, str]]:
    """Return the files that a build does not write although they differ, each with the kind of its action."""
    actions = (action for action in result.actions.decided if not action.writes)
    return frozenset((action.path, str(action.kind)) for action in actions)


def internal_error(error: Exception, what: str) -> Diagnostic:
    """Return the finding for a bug, with the place where the exception was raised."""
    trace, line, place = error.__traceback__, 0, ""
    while trace is not None:
        line, place = trace.tb_lineno, Path(trace.tb_frame.f_code.co_filename).name
        trace = trace.tb_next
    message = f"{what}: {type(error).__name__} in {place}, line {line}: {error}"
    hint = "this is a mistake in urdfsync: please report it"
    return Diagnostic(Severity.ERROR, "internal", message.rstrip(": "), hint=hint)


def warm_up(config: Config, robots: Sequence[RobotConfig]) -> None:
    """Plan a build that writes nothing for one robot of each domain, the one with the smallest source.

    So libraries are imported and templates compiled while nobody waits: without it the first change in the daemon
    takes about a second more than the rows "one mass changed in the daemon" of docs/speed.md allow.
    """
    importlib.import_module("deepdiff")  # only the first difference imports it
    for robot in {robot.domain: robot for robot in sorted(robots, key=_source_size, reverse=True)}.values():
        try:
            plan_robot(config, robot, BuildOptions(dry=True, draw=True))  # to draw, the plan reads the whole source
        except Exception:  # noqa: BLE001, S112 - told when the robot is built
            continue


def _source_size(robot: RobotConfig) -> int:
    try:
        return robot.source.stat().st_size
    except OSError:
        return 0
