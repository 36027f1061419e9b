"""Checks many robots, each in a process of its own, as many at a time as cores and memory allow."""

from __future__ import annotations

import dataclasses
import os
import queue
import threading
from collections import deque
from collections.abc import Iterator, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.checking import child, compiler, process
from urdfsync.checking.cache import Cache
from urdfsync.checking.process import Ending, Limits
from urdfsync.checking.verdict import Verdict
from urdfsync.checking.wishes import Wishes
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.planning.situation import Progress

_EXPECTED = 1.5e9
"""Bytes that the check of a robot usually takes, at most."""
_SHARE = 0.9
"""Part of the free memory that may be taken."""
_PAUSE = 0.1
"""Seconds between two looks."""

_News: TypeAlias = "tuple[str, str | Verdict]"


def check(config: Config, robots: Sequence[RobotConfig], wishes: Wishes, progress: Progress) -> Iterator[Verdict]:
    """Check robots; the verdicts come in their order, each as soon as it and those before it are known.

    Raises CompilerError if what a check needs is not installed, CacheError if there is no place for its cache.
    """
    compiler.require()
    crew = _Crew(config, robots, wishes)
    try:
        yield from crew.verdicts(progress)
    finally:
        crew.stop()


class _Crew:
    """The processes of one command."""

    def __init__(self, config: Config, robots: Sequence[RobotConfig], wishes: Wishes) -> None:
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        self._most = min(wishes.jobs or cores, len(robots)) or 1
        self._wishes = dataclasses.replace(wishes, workers=max(1, cores // self._most))
        self._config, self._cache = config, Cache.of_user()
        self._budget = wishes.memory * 1e9 if wishes.memory else _SHARE * _free()
        self._order = [robot.name for robot in robots]
        self._waiting, self._alone = deque(self._order), deque[str]()
        self._news: queue.SimpleQueue[_News] = queue.SimpleQueue()
        self._running: dict[str, threading.Thread] = {}
        self._done: dict[str, Verdict] = {}
        self._steps: dict[str, str] = {}
        self._stopped = threading.Event()

    def verdicts(self, progress: Progress) -> Iterator[Verdict]:
        """All verdicts in order."""
        self._cache.prepare()
        self._cache.trim()
        for count, name in enumerate(self._order):
            while name not in self._done:
                self._start_some()
                self._hear()
                progress(self._words(), len(self._done), len(self._order))
            yield self._done[name]
            progress(self._words(), max(count + 1, len(self._done)), len(self._order))

    def stop(self) -> None:
        """End what is running."""
        self._stopped.set()
        for thread in list(self._running.values()):
            thread.join()

    def _start_some(self) -> None:
        """Start checks as long as there are cores and memory for them; those that need all of it run alone."""
        while self._waiting and len(self._running) < self._room():
            self._start(self._waiting.popleft(), self._budget / self._room())
        if self._alone and not self._running:
            self._start(self._alone.popleft(), self._budget)

    def _room(self) -> int:
        return max(1, min(self._most, int(self._budget // _EXPECTED)))

    def _start(self, name: str, memory: float) -> None:
        thread = threading.Thread(target=self._check, args=(name, memory), name=f"check {name}", daemon=True)
        self._running[name] = thread
        thread.start()

    def _check(self, name: str, memory: float) -> None:
        """One robot, from its process's start to its end. In a thread of its own."""
        latest = Verdict(name, self._package(name))

        def hear(line: str) -> None:
            nonlocal latest
            step = child.loads(line)
            if step.verdict is not None:
                latest = step.verdict
            if step.what:
                self._news.put((name, step.what))

        order = child.Order(str(self._config.file), name, os.getcwd(), self._wishes)  # noqa: PTH109 - as a text
        text = msgspec.json.encode(order, enc_hook=str).decode() + "\n"
        limits = Limits(self._wishes.timeout, memory)
        try:
            result = process.run(process.python(child.__name__), text, hear, limits, process.importable(), self._tick)
        except _StoppedError:
            return
        except (OSError, ValueError, msgspec.ValidationError) as error:
            message, hint = f"robot `{name}`: the process that checks it can't be used: {error}", "report it"
            found = Diagnostic(Severity.ERROR, "check-crashed", message, hint=hint)
            self._news.put((name, dataclasses.replace(latest, diagnostics=(found,))))
            return
        if result.ending is Ending.OUT_OF_MEMORY and memory < self._budget:
            self._alone.append(name)
            self._news.put((name, "waits for more memory"))
            return
        self._news.put((name, latest if result.good else _ended(latest, result, limits)))

    def _tick(self) -> None:
        if self._stopped.is_set():
            raise _StoppedError

    def _hear(self) -> None:
        """Take in what the processes have said, and who is through."""
        try:
            while True:
                name, news = self._news.get(timeout=_PAUSE)
                if isinstance(news, Verdict):
                    self._done[name] = news
                    self._steps.pop(name, None)
                    self._cache.trim()
                else:
                    self._steps[name] = news
        except queue.Empty:
            pass
        self._running = {name: thread for name, thread in self._running.items() if thread.is_alive()}

    def _words(self) -> str:
        return ", ".join(self._steps.values()) or "checking"

    def _package(self, name: str) -> str:
        return next(robot.target.package for robot in self._config.robots if robot.name == name)


class _StoppedError(Exception):
    """Nobody wants to know any more."""


def _free() -> float:
    import psutil

    return float(psutil.virtual_memory().available)


def _ended(verdict: Verdict, result: process.Result, limits: Limits) -> Verdict:
    """What was found until the process ended before it was through, and why it did."""
    if result.ending is Ending.OUT_OF_TIME:
        message, hint = f"not done after {limits.seconds:g} s", "allow more with `--timeout`"
        code = "check-out-of-time"
    elif result.ending is Ending.OUT_OF_MEMORY:
        message = f"takes more than the {limits.memory / 1e9:.1f} GB that it may"
        code, hint = "check-out-of-memory", "allow more with `--memory`, or use a machine that has more"
    else:
        last = result.words.splitlines()[-1:]
        message = ": ".join([f"the check broke down with {result.cause}", *last])
        code, hint = "check-crashed", "report it, with the URDF"
    found = Diagnostic(Severity.ERROR, code, f"robot `{verdict.robot}`: {message}", hint=hint)
    return dataclasses.replace(verdict, diagnostics=(*verdict.diagnostics, found), seconds=result.seconds)
