"""Builds of what has settled: what is said of them, and whether anything is left to do at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.engine.actions import Kind
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Result
from urdfsync.watching import builder, events
from urdfsync.watching.robots import Robots, Watched
from urdfsync.watching.samples import alike, changed

_ROUNDS = 3
"""So often a robot is built in a row; if it is not in step then, somebody writes all the time, and it has to settle."""


class Builds:
    """Builds robots, and tells the listener what is new."""

    def __init__(
        self,
        robots: Robots,
        request: BuildOptions,
        tell: Callable[[events.Event], None],
        touch: Callable[[Watched], None],
        arm: Callable[[], None],
        ran: Callable[[RobotConfig, Sequence[Path]], None],
        done: Callable[[RobotConfig], None],
        pauses: Callable[[], bool],
    ) -> None:
        """What a build leads to: `touch` for a robot that has to settle again, `arm` where scopes have changed.

        `ran` is told of a robot of which these files were written or deleted, `done` of one that is built for now.
        `pauses` says whether nothing may be built at this moment.
        """
        self._robots, self._request = robots, request
        self._tell, self._touch, self._arm, self._ran, self._done = tell, touch, arm, ran, done
        self._pauses = pauses

    def build(self, config: Config, settled: Sequence[Watched]) -> None:
        """Build robots until each is in step with itself: until a build of it finds nothing to write."""
        for watched in settled:
            if watched.announced:
                self._tell(events.Building(watched.name))
        request = self._request
        for _ in range(_ROUNDS):
            self._build_once(config, {watched.name: watched for watched in settled}, request)
            request = msgspec.structs.replace(request, jobs=1)  # what other processes see, the memory does not
            settled = [watched for watched in settled if not self._conclude(watched)]
            if not settled:
                return
            if self._pauses():
                break
        for watched in settled:
            self._touch(watched)

    def fail(self, config: Config, watched: Watched) -> None:
        """Say that a source is no model, and leave the robot alone until something changes."""
        self._say_failed(watched, builder.failure(config, watched.robot, watched.trouble))
        self._leave(watched)

    def _build_once(self, config: Config, settled: dict[str, Watched], request: BuildOptions) -> None:
        for result in builder.results(config, [watched.robot for watched in settled.values()], request):
            watched = settled[result.robot]
            if not result.failed:
                self._say_built(watched, result)
            elif alike(watched.settled, self._robots.sample(watched)):
                self._say_failed(watched, result)
        for watched in settled.values():
            self._robots.renew(watched)
        self._arm()

    def _conclude(self, watched: Watched) -> bool:
        """Whether there is nothing left to do for a robot at once.

        What a robot is built from was sampled before the last build, and is compared with what is there after it:
        where it differs, it has to settle. A build that wrote something is never the last: what it has left, and what
        others wrote meanwhile, is known from the next one. What changes after that has an event, or is found later.
        """
        before, watched.settled = watched.settled, self._robots.sample(watched)
        if any(changed(before, watched.settled)):
            self._touch(watched)
            return True
        if watched.failed is None and not (self._robots.is_known(watched) and alike(before, watched.settled)):
            return False
        self._leave(watched)
        return True

    def _leave(self, watched: Watched) -> None:
        watched.rest()
        if watched.failed is None:
            self._done(watched.robot)
        else:
            self._robots.take_stock(watched)

    def _say_failed(self, watched: Watched, result: Result) -> None:
        again = watched.failed == result.diagnostics
        if watched.announced or not again:
            self._tell(events.Failed(result, again))
        watched.failed, watched.announced = result.diagnostics, False

    def _say_built(self, watched: Watched, result: Result) -> None:
        files, recovered = builder.written(result), watched.failed is not None
        decided = result.actions.decided
        left = (action for action in decided if action.kind is not Kind.UNCHANGED and not action.writes)
        special = frozenset((action.path, str(action.kind)) for action in left)
        if watched.announced or files or recovered or special != watched.special:
            self._tell(events.Built(result, files, recovered))
        watched.failed, watched.announced, watched.special, watched.trouble = None, False, special, ()
        if files:
            self._ran(watched.robot, files)
