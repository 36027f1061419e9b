"""Builds as the daemon needs them: one robot after the other, whatever happens to one of them."""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions, no_progress
from urdfsync.engine.plan import plan_robot
from urdfsync.outcome import Result


class StoppedError(Exception):
    """The daemon is told to end while it plans a build: nothing of it is written yet."""


def results(config: Config, robots: Sequence[RobotConfig], request: BuildOptions) -> Iterator[Result]:
    """Build robots. One that makes the program fail unexpectedly has failed as any other; the rest is built.

    Going on is safe then: a batch of files is written or put back as a whole, whatever stops it, and the next
    build reads everything from the disk.
    """
    waiting = list(robots)
    while waiting:
        try:
            for result in build(config, tuple(waiting), request):
                waiting.pop(0)
                yield result
        except StoppedError:
            raise
        except Exception as error:  # noqa: BLE001 - a bug that one robot meets must not end the daemon for all
            yield failure(config, waiting.pop(0), (unexpected(error, "it can't be built"),))


def failure(config: Config, robot: RobotConfig, diagnostics: tuple[Diagnostic, ...]) -> Result:
    """What there is to say of a robot that can't be built."""
    package = robot.target.package
    return Result(robot.name, package, robot.folder, config.root, diagnostics=diagnostics, failed=True)


def unexpected(error: Exception, what: str) -> Diagnostic:
    """A finding for what must not happen."""
    frame, line, place = error.__traceback__, 0, ""
    while frame is not None:
        line, place = frame.tb_lineno, Path(frame.tb_frame.f_code.co_filename).name
        frame = frame.tb_next
    message = f"{what}: {type(error).__name__} in {place}, line {line}: {error}"
    hint = "this is a mistake in urdfsync: please report it"
    return Diagnostic(Severity.ERROR, "internal", message.rstrip(": "), hint=hint)


def written(result: Result) -> tuple[Path, ...]:
    """The files that a build wrote or deleted, absolute."""
    if result.failed or result.dry:
        return ()
    return tuple(Path(os.path.normpath(result.root / one.path)) for one in result.actions.decided if one.writes)


def warm_up(config: Config, robots: Sequence[RobotConfig]) -> None:
    """Load what a build needs by planning one that writes nothing, so that the first real one need not.

    One robot of each domain serves, the one with the smallest source. One that can't be planned is none to warm up
    with, and is said elsewhere.
    """
    importlib.import_module("deepdiff")  # loaded by the first difference only
    for robot in {robot.domain: robot for robot in sorted(robots, key=_size, reverse=True)}.values():
        try:
            plan_robot(
                config, robot, BuildOptions(dry=True, draw=True, progress=no_progress)
            )  # to draw, all has to be read
        except Exception:  # noqa: BLE001, S112 - whatever is wrong is said when the robot is built
            continue


def _size(robot: RobotConfig) -> int:
    try:
        return robot.source.stat().st_size
    except OSError:
        return 0
