"""Checks packages while the daemon runs: one at a time, in a thread of its own."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from queue import SimpleQueue
from typing import Self

import msgspec

from urdfsync.analysis.checks.afterbuild import BuildCheck, BuildChecker, is_general
from urdfsync.common.diagnostics import Diagnostic, internal_error
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Checked
from urdfsync.project.config import Config, RobotConfig
from urdfsync.watch import events

_PATIENCE = 10.0
"""Seconds that an ending daemon waits for a running check; a compiler that still runs ends with the daemon."""


class CheckJob(msgspec.Struct, frozen=True, eq=False):
    """One check of a package; a newer check of the same robot cancels this one."""

    robot: RobotConfig
    key: str | None
    """The key of the check's inputs; None if an input can't be read."""


class CheckEnded(msgspec.Struct, frozen=True):
    """A check has ended; `result` is None for a cancelled check."""

    job: CheckJob
    result: BuildCheck | None


class CancelledError(Exception):
    """A newer check replaced this one."""


class CheckQueue:
    """The newest check of each robot, in order. The end of the `with` block cancels all checks. Methods return events.

    Only the check itself runs in a thread; its end comes through the daemon's queue, as `CheckEnded`.
    """

    def __init__(self, queue: SimpleQueue[object], options: BuildOptions) -> None:
        self._queue, self._options = queue, options
        self._checker: BuildChecker
        self._jobs: dict[str, CheckJob] = {}
        """The checks by robot; the first one may be running."""
        self._thread: threading.Thread | None = None
        """The thread of the running check, even of a cancelled one."""
        self._last: dict[str, Checked] = {}
        self._told: set[Diagnostic] = set()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._jobs.clear()
        if self._thread is not None:
            self._thread.join(_PATIENCE)

    def use(self, config: Config) -> None:
        """Check by this configuration from now on, and forget earlier results."""
        self._checker = BuildChecker(config, self._options)
        self._jobs.clear()
        self._last.clear()

    def check(self, robot: RobotConfig) -> Sequence[events.Event]:
        """Check the present package of a robot, unless a check of these files runs or found no fault."""
        if robot.on_build != "check":
            return ()
        key, job = self._checker.key(robot), self._jobs.get(robot.name)
        if job is not None and key is not None and job.key == key:
            return ()
        self._jobs.pop(robot.name, None)  # the files of an older check have changed
        earlier = self._checker.find_earlier(key)
        if earlier is None:
            self._jobs[robot.name] = CheckJob(robot, key)
            return self._start_next()
        # still without faults: nothing new to report
        was_right = job is None and self._last.get(robot.name, Checked.RIGHT) is Checked.RIGHT
        event = self._note(robot, earlier)
        return () if was_right and earlier.checked is Checked.RIGHT else (event,)

    def finish(self, ended: CheckEnded) -> Sequence[events.Event]:
        """Record the end of a check, and start the next."""
        self._thread = None
        robot = ended.job.robot
        if ended.result is None or self._jobs.get(robot.name) is not ended.job:
            return self._start_next()
        del self._jobs[robot.name]
        return self._note(robot, ended.result), *self._start_next()

    def _start_next(self) -> Sequence[events.Event]:
        if self._thread is not None or not self._jobs:
            return ()
        name, job = next(iter(self._jobs.items()))
        self._thread = threading.Thread(target=self._run, args=(job, self._checker), daemon=True)
        self._thread.start()
        return (events.Checking(name),)

    def _run(self, job: CheckJob, checker: BuildChecker) -> None:
        def cancel_here(what: str, done: int, total: int) -> None:  # noqa: ARG001 - the signature of `Progress`
            if self._jobs.get(job.robot.name) is not job:
                raise CancelledError

        result = None
        try:
            result = next(checker.check([job.robot], cancel_here))
        except CancelledError:
            pass
        except Exception as error:  # noqa: BLE001 - a bug that one robot meets must not end the checks of all
            result = BuildCheck(Checked.WRONG, (internal_error(error, "the package can't be checked: "),))
        finally:
            self._queue.put(CheckEnded(job, result))

    def _note(self, robot: RobotConfig, result: BuildCheck) -> events.CheckDone:
        """Return the event of a finished check; findings about the machine are reported once."""
        new = tuple(finding for finding in robot.without_ignored(result.diagnostics) if finding not in self._told)
        self._told.update(filter(is_general, new))
        self._last[robot.name] = result.checked
        return events.CheckDone(robot.name, result.checked, round(result.seconds, 3), new)
