"""Builds as the daemon makes them: the source is judged first, and nothing that happens to a robot ends the daemon."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, SourceError, UrdfsyncError, internal_error
from urdfsync.engine import source
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result
from urdfsync.files import shown
from urdfsync.state.store import Store
from urdfsync.watch.paths import RobotPaths

_MANY = 3
"""Least number of lost elements for which a source counts as shrunk; they have to be more than half of all, too."""


def judge_source(
    config: Config, robot: RobotConfig, paths: RobotPaths, options: BuildOptions
) -> tuple[SourceError | None, int]:
    """Return why the source of a robot is invalid, and how many elements of the last build it lacks, 0 for a few."""
    try:
        text = source.read_source(config, robot, Store(config.root), options)
        domain = registry.domain(robot.domain)
        with text.locating():
            snapshot, _ = source.read(domain, robot.options, text.content, text.name)
        by_kind = domain.names(snapshot, robot.target)
    except SourceError as error:
        return error, 0
    except UrdfsyncError as error:
        return SourceError(*error.diagnostics), 0
    except Exception as error:  # noqa: BLE001 - a bug in a domain must not end the daemon; nothing is written yet
        return SourceError(internal_error(error, f"{shown(robot.source)} can't be read: ")), 0
    lost = len(paths.built_names - {(kind, name) for kind, names in by_kind.items() for name in names})
    return None, lost if lost >= _MANY and 2 * lost > len(paths.built_names) else 0


def build_robots(config: Config, robots: Sequence[RobotConfig], options: BuildOptions) -> Iterator[Result]:
    """Build robots. A bug that one robot meets is its error, and the others are built."""
    waiting = list(robots)
    while waiting:
        try:
            for result in build(config, tuple(waiting), options):
                waiting.pop(0)
                yield result
        except Exception as error:  # noqa: BLE001 - going on is safe: the next build reads everything from the disk
            yield failed_result(config, waiting.pop(0), (internal_error(error, "it can't be built: "),))


def failed_result(config: Config, robot: RobotConfig, diagnostics: tuple[Diagnostic, ...]) -> Result:
    """Return the result of a robot that can't be built."""
    package = robot.target.package
    return Result(robot.name, package, robot.folder, config.root, diagnostics=diagnostics, failed=True)
