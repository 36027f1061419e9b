"""Builds as the daemon makes them: the source is judged first, and nothing that happens to a robot ends the daemon."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence

from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError, internal_error
from urdfsync.engine import source
from urdfsync.engine.build import build
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.result import Result
from urdfsync.files import shown
from urdfsync.watch.robot import WatchedRobot

_MANY = 3
"""Least number of lost elements for which a source counts as shrunk; they have to be more than half of all, too."""


def judge_source(config: Config, watched: WatchedRobot, cache: Cache) -> tuple[tuple[Diagnostic, ...], int]:
    """Return why the source of a robot is invalid, and how many elements of the last build it lacks, 0 for a few."""
    robot, built_names = watched.robot, watched.paths.built_names
    try:
        content = source.read_source(config, robot)
        domain = registry.domain(robot.domain)
        reading = source.read_cached(domain, robot.options, content, shown(robot.source), cache)
        if reading.snapshot is None or any(found.severity is Severity.ERROR for found in reading.diagnostics):
            return reading.diagnostics, 0
        by_kind = domain.names(reading.snapshot, robot.target)
    except UrdfsyncError as error:
        return error.diagnostics, 0
    except Exception as error:  # noqa: BLE001 - a bug in a domain must not end the daemon; nothing is written yet
        return (internal_error(error, f"{shown(robot.source)} can't be read: "),), 0
    lost = len(built_names - {(kind, name) for kind, names in by_kind.items() for name in names})
    return (), lost if lost >= _MANY and 2 * lost > len(built_names) else 0


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
            yield failed_result(config, waiting.pop(0), (internal_error(error, "it can't be built: "),))


def failed_result(config: Config, robot: RobotConfig, diagnostics: tuple[Diagnostic, ...]) -> Result:
    """Return the result of a robot that can't be built."""
    package = robot.target.package
    return Result(robot.name, package, robot.folder, config.root, diagnostics=diagnostics, failed=True)


def warm_up(config: Config, robots: Sequence[RobotConfig]) -> None:
    """Plan a build that writes nothing for one robot of each domain, the one with the smallest source.

    So libraries are imported and templates compiled while nobody waits: without it the first change in the daemon
    takes about a second more than the rows "one mass changed in the daemon" of docs/speed.md allow.
    """
    with contextlib.suppress(OSError):  # a source that is missing is told when the robot is built
        robots = sorted(robots, key=lambda robot: robot.source.stat().st_size, reverse=True)
    for robot in {robot.domain: robot for robot in robots}.values():
        try:
            plan_robot(config, robot, BuildOptions(dry=True, draw=True))  # to draw, the plan reads the whole source
        except Exception:  # noqa: BLE001, S112 - told when the robot is built
            continue
