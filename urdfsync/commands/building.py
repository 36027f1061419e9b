"""What commands that build do: build, then check what the configuration wants checked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from urdfsync import dependencies
from urdfsync.config import Config, RobotConfig
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Result


def built(config: Config, robots: Sequence[RobotConfig], request: BuildOptions) -> Iterator[Result]:
    """Build robots, and check the packages of those with `on_build = "check"`; a dry run checks nothing."""
    results = build(config, robots, request)
    if request.dry or not any(robot.checking for robot in robots):
        return results
    dependencies.mark_incomplete()  # checks look at more
    from urdfsync.check import afterbuild  # most configurations have no use for it

    return afterbuild.with_checks(config, request, results)
