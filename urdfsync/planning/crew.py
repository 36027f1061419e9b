"""Plans many robots at once, in processes of their own, if there is enough to do to be worth it."""

from __future__ import annotations

import contextlib
import functools
import os
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

import msgspec

from urdfsync import machine, profiling
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies import mark_incomplete
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.planning.planner import plan, plan_if_unchanged
from urdfsync.planning.situation import Request, in_silence

if TYPE_CHECKING:
    from concurrent.futures import Future, ProcessPoolExecutor

    from urdfsync.planning.work import Work

_ENOUGH = 6
"""So many robots have to be read and rendered before processes are started: each imports everything again."""
_AHEAD = 3
"""So many plans per process may be under way or wait to be carried out."""
_PAUSE = 0.1
"""Seconds between two looks at how far the others are."""


class Crew:
    """Plans the robots of one command; each plan that was made ahead serves once."""

    def __init__(self, config: Config, robots: Sequence[RobotConfig], request: Request) -> None:
        self._config, self._robots, self._request = config, robots, request
        self._surveyed = False
        self._ahead: dict[str, Callable[[], Work]] = {}
        self._pool: ProcessPoolExecutor | None = None
        self._futures: dict[str, Future[_Answer]] = {}
        self._waiting: deque[RobotConfig] = deque()
        self._total = self._window = 0

    def plan(self, robot: RobotConfig) -> Work:
        """What there is to do for a robot. Raises UrdfsyncError for whatever is wrong."""
        if not self._surveyed:
            self._survey()
        ahead = self._ahead.pop(robot.name, None)
        return ahead() if ahead else plan(self._config, robot, self._request)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._pool is None:
            return
        if kind is not None and not issubclass(kind, Exception):
            from multiprocessing import active_children

            for child in active_children():  # whoever interrupts does not want to wait
                child.terminate()
        self._pool.shutdown(cancel_futures=True)

    def _survey(self) -> None:
        """Find out which robots have to be read and rendered, and start with that if they are many."""
        self._surveyed = True
        jobs = self._request.jobs or machine.cores()
        if jobs < 2 or len(self._robots) < _ENOUGH:
            return
        changed = []
        for robot in self._robots:
            try:
                work = plan_if_unchanged(self._config, robot, self._request)
            except (UrdfsyncError, OSError):
                continue  # planned again when it is its turn: then it is said
            if work is None:
                changed.append(robot)
            else:
                self._ahead[robot.name] = _known(work)
        if len(changed) >= _ENOUGH:
            mark_incomplete()  # other processes look at more
            self._start(changed, jobs)

    def _start(self, robots: Sequence[RobotConfig], jobs: int) -> None:
        from concurrent.futures import ProcessPoolExecutor
        from multiprocessing import get_all_start_methods, get_context

        # not a plain fork: the thread of a progress bar may hold a lock at that moment
        method = "forkserver" if "forkserver" in get_all_start_methods() else "spawn"
        count, context = min(jobs, len(robots)), get_context(method)
        with _safe_path():
            self._pool = ProcessPoolExecutor(count, context, initializer=_join, initargs=(str(Path.cwd()),))
        self._total, self._window, self._waiting = len(robots), _AHEAD * count, deque(robots)
        self._submit()
        for robot in robots:
            self._ahead[robot.name] = functools.partial(self._result, robot)

    def _submit(self) -> None:
        """Let others plan some robots more, but not so many that their texts and meshes fill the memory."""
        request = msgspec.structs.replace(self._request, progress=in_silence, memory=None)
        while self._pool is not None and self._waiting and len(self._futures) < self._window:
            robot = self._waiting.popleft()
            profiled = profiling.current() is not None
            with _safe_path():
                self._futures[robot.name] = self._pool.submit(_plan, self._config, robot, request, profiled)

    @profiling.staged("waiting")
    def _result(self, robot: RobotConfig) -> Work:
        from concurrent.futures import wait
        from concurrent.futures.process import BrokenProcessPool

        try:
            while robot.name in self._futures and wait([self._futures[robot.name]], _PAUSE).not_done:
                done = sum(future.done() for future in self._futures.values())
                left = len(self._waiting) + len(self._futures)
                self._request.progress("reading", self._total - left + done, self._total)
            answer = self._futures.pop(robot.name).result() if robot.name in self._futures else None
            self._submit()
        except BrokenProcessPool:
            answer = None
        if answer is None:
            message = f"robot `{robot.name}`: a process that planned it ended unexpectedly, perhaps for want of memory"
            hint = "try again with `--jobs 1`"
            raise OutputError(Diagnostic(Severity.ERROR, "lost-process", message, hint=hint))
        work, error, diagnostics, measured = answer
        if measured and (profile := profiling.current()):
            profile.add(measured)
        if work is None:
            raise error(*diagnostics)
        return work


def _known(work: Work) -> Callable[[], Work]:
    return lambda: work


_Answer = tuple["Work | None", type[UrdfsyncError], tuple[Diagnostic, ...], "profiling.Elsewhere | None"]
"""A robot's work, or the class and the findings of the error that stopped it; and what was measured, if it was."""


def _plan(config: Config, robot: RobotConfig, request: Request, profiled: bool) -> _Answer:
    with profiling.measured() if profiled else contextlib.nullcontext() as profile:
        try:
            work, error, found = plan(config, robot, request), UrdfsyncError, tuple[Diagnostic, ...]()
        except UrdfsyncError as problem:
            work, error, found = None, type(problem), problem.diagnostics
        return work, error, found, profile.results() if profile else None


@contextlib.contextmanager
def _safe_path() -> Iterator[None]:
    """Start Python processes such that they import nothing from the working folder; a repository may be there.

    A pool starts some when it is made, for its locks, and others when work is submitted.
    The variable is gone afterwards: a command of the user's that runs later may want its own folder on the path.
    """
    before = os.environ.get("PYTHONSAFEPATH")
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ["PYTHONSAFEPATH"]
        else:
            os.environ["PYTHONSAFEPATH"] = before


def _join(folder: str) -> None:
    """Prepare a process of the crew: it works in the same folder, and ends when its parent does."""
    import signal  # most builds have no crew
    from multiprocessing import parent_process
    from multiprocessing.connection import wait

    os.chdir(folder)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent gets it, too, and tells the crew
    parent = parent_process()

    def follow() -> None:
        if parent is not None:
            wait([parent.sentinel])
            os._exit(1)

    threading.Thread(target=follow, daemon=True).start()
