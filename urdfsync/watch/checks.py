"""Checks packages while the daemon runs: one at a time, in a thread of its own."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from queue import SimpleQueue
from typing import Self

import msgspec

from urdfsync.analysis.checks.results import CheckResult
from urdfsync.analysis.checks.run import check_built, is_general, verdict
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.engine.options import BuildOptions
from urdfsync.project.config import Config, RobotConfig
from urdfsync.watch import events

_PATIENCE = 10.0
"""Seconds that an ending daemon waits for a running check; a compiler that still runs ends with the daemon."""


class CheckJob(msgspec.Struct, frozen=True, eq=False):
    """One check of a package; a newer check of the same robot cancels this one."""

    robot: RobotConfig


class CheckEnded(msgspec.Struct, frozen=True):
    """A check has ended; `result` is None for a cancelled check."""

    job: CheckJob
    result: CheckResult | None


class CancelledError(BaseException):
    """A newer check replaced this one."""


class CheckQueue:
    """The newest check of each robot, in order. The end of the `with` block cancels all checks. Methods return events.

    Only the check itself runs in a thread; its end comes through the daemon's queue, as `CheckEnded`.
    """

    def __init__(self, queue: SimpleQueue[object], options: BuildOptions) -> None:
        self._queue, self._options = queue, options
        self._config: Config
        self._jobs: dict[str, CheckJob] = {}
        """The checks by robot; the first one may be running."""
        self._thread: threading.Thread | None = None
        """The thread of the running check, even of a cancelled one."""
        self._told: set[Diagnostic] = set()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._jobs.clear()
        if self._thread is not None:
            self._thread.join(_PATIENCE)

    def use(self, config: Config) -> None:
        """Check by this configuration from now on."""
        self._config = config
        self._jobs.clear()

    def check(self, robot: RobotConfig) -> Sequence[events.Event]:
        """Check the present package of a robot, instead of an earlier one."""
        if robot.on_build != "check":
            return ()
        self._jobs.pop(robot.name, None)
        self._jobs[robot.name] = CheckJob(robot)
        return self._start_next()

    def finish(self, ended: CheckEnded) -> Sequence[events.Event]:
        """Return the end of a check, unless it was cancelled, and start the next."""
        self._thread, robot, result = None, ended.job.robot, ended.result
        if result is None or self._jobs.get(robot.name) is not ended.job:
            return self._start_next()
        del self._jobs[robot.name]
        checked, diagnostics = verdict(result)
        # findings about the machine are reported once
        new = tuple(finding for finding in robot.without_ignored(diagnostics) if finding not in self._told)
        self._told.update(filter(is_general, new))
        return events.CheckDone(robot.name, checked, round(result.seconds, 3), new), *self._start_next()

    def _start_next(self) -> Sequence[events.Event]:
        if self._thread is not None or not self._jobs:
            return ()
        name, job = next(iter(self._jobs.items()))
        self._thread = threading.Thread(target=self._run, args=(job, self._config), daemon=True)
        self._thread.start()
        return (events.Checking(name),)

    def _run(self, job: CheckJob, config: Config) -> None:
        def cancel_here(what: str, done: int, total: int) -> None:  # noqa: ARG001 - the signature of `Progress`
            if self._jobs.get(job.robot.name) is not job:
                raise CancelledError

        result = None
        try:
            (result,) = check_built(config, [job.robot], self._options, cancel_here)
        except CancelledError:
            pass
        finally:
            self._queue.put(CheckEnded(job, result))
