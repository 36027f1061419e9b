"""Checks of packages while the daemon goes on: one at a time, in a thread of its own."""

from __future__ import annotations

import threading
from queue import SimpleQueue
from types import TracebackType
from typing import Self

import msgspec

from urdfsync.check.afterbuild import BuildCheck, BuildChecker, is_general
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.options import BuildOptions
from urdfsync.outcome import Checked
from urdfsync.watch import events
from urdfsync.watch.build import internal_error

_PATIENCE = 10.0
"""Seconds that a check gets to end when the daemon does; a compiler that is left ends with the process."""


class CheckJob(msgspec.Struct, eq=False):
    """One check of a package."""

    robot: RobotConfig
    key: str | None
    """Of all that the check rests on; None if some of it can't be read."""
    is_cancelled: bool = False


class CheckEnded(msgspec.Struct, frozen=True):
    """A check has ended; without findings if it was cancelled."""

    job: CheckJob
    found: BuildCheck | None


class CancelledError(Exception):
    """A newer check has taken the place of this one."""


class CheckQueue:
    """The checks that run and wait; cancelled at the end of its context. Methods return the events to show.

    A robot's newer check takes the place of its older one: the files of that are not on disk any more. Only the check
    itself runs in the thread; its end comes through the daemon's queue, as `CheckEnded`.
    """

    def __init__(self, queue: SimpleQueue[object], options: BuildOptions) -> None:
        self._queue, self._options = queue, options
        self._checker: BuildChecker
        self._waiting: dict[str, CheckJob] = {}
        self._running: CheckJob | None = None
        self._thread: threading.Thread | None = None
        self._last: dict[str, tuple[str | None, events.CheckDone]] = {}
        self._told: set[Diagnostic] = set()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._cancel_all()
        if self._thread is not None:
            self._thread.join(_PATIENCE)

    def use(self, config: Config) -> None:
        """Check by this configuration from now on, whatever was found before."""
        self._checker = BuildChecker(config, self._options)
        self._cancel_all()
        self._last.clear()

    def check(self, robot: RobotConfig) -> list[events.Event]:
        """Check the package of a robot as it is now, unless such a check runs or its result is known."""
        if not robot.checking:
            return []
        key = self._checker.key(robot)
        pending, running = self._waiting.get(robot.name), self._running
        if pending is None and running and running.robot.name == robot.name and not running.is_cancelled:
            pending = running
        if pending is not None:
            if key is not None and pending.key == key:
                return []
            pending.is_cancelled = True
            self._waiting.pop(robot.name, None)
        last_key, last = self._last.get(robot.name, (None, None))
        if last is not None and key is not None and last_key == key:
            return [last] if pending is not None else []
        if found := self._checker.known(key):
            event = self._note(CheckJob(robot, key), found)
            was_right = pending is None and (last is None or last.checked is Checked.RIGHT)
            return [] if was_right and found.checked is Checked.RIGHT else [event]
        self._waiting[robot.name] = CheckJob(robot, key)
        return self._start_next()

    def finish(self, ended: CheckEnded) -> list[events.Event]:
        """Take note of the end of a check, and start the next."""
        self._running = None
        if ended.found is None or ended.job.is_cancelled:
            return self._start_next()
        return [self._note(ended.job, ended.found), *self._start_next()]

    def _cancel_all(self) -> None:
        for job in (*self._waiting.values(), *([self._running] if self._running else [])):
            job.is_cancelled = True
        self._waiting.clear()

    def _start_next(self) -> list[events.Event]:
        if self._running is not None or not self._waiting:
            return []
        name = next(iter(self._waiting))
        job = self._running = self._waiting.pop(name)
        self._thread = threading.Thread(
            target=self._run, args=(job, self._checker), name=f"check of {name}", daemon=True
        )
        self._thread.start()
        return [events.Checking(name)]

    def _run(self, job: CheckJob, checker: BuildChecker) -> None:
        def cancel_here(what: str, done: int, total: int) -> None:  # noqa: ARG001 - the signature of `Progress`
            if job.is_cancelled:
                raise CancelledError

        found = None
        try:
            found = next(checker.check([job.robot], cancel_here))
        except CancelledError:
            pass
        except Exception as error:  # noqa: BLE001 - a bug that one robot meets must not end the checks of all
            found = BuildCheck(Checked.WRONG, (internal_error(error, "it can't be checked"),))
        finally:
            self._queue.put(CheckEnded(job, found))

    def _note(self, job: CheckJob, found: BuildCheck) -> events.CheckDone:
        """Keep what was found; findings about the machine are told once."""
        new = tuple(one for one in found.diagnostics if one not in self._told)
        self._told.update(one for one in new if is_general(one))
        event = events.CheckDone(job.robot.name, found.checked, round(found.seconds, 3), new)
        self._last[job.robot.name] = job.key, event
        return event
