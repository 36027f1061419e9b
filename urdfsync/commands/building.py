"""What commands that build do: build, then check what the configuration wants checked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from urdfsync import looking
from urdfsync.build import build
from urdfsync.config import Config, RobotConfig
from urdfsync.outcome import Result
from urdfsync.planning.situation import Request


def built(config: Config, robots: Sequence[RobotConfig], request: Request) -> Iterator[Result]:
    """Build robots, and check the packages of those with `on_build = "check"`; a dry run checks nothing."""
    results = build(config, robots, request)
    if request.dry or not any(robot.checking for robot in robots):
        return results
    looking.beyond()  # checks look at more
    from urdfsync.check import afterbuild  # most configurations have no use for it

    return afterbuild.with_checks(config, request, results)
