"""Checks many robots, each in a process of its own, as many at a time as cores and memory allow."""

from __future__ import annotations

import os
import queue
import threading
from collections import deque
from collections.abc import Iterator, Sequence
from typing import TypeAlias

import msgspec

from urdfsync import machine
from urdfsync.checking import child, process
from urdfsync.checking.cache import Cache
from urdfsync.checking.compilers import choice
from urdfsync.checking.process import Ending, Limits
from urdfsync.checking.verdict import Verdict
from urdfsync.checking.wishes import Wishes
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.options import Progress

_EXPECTED = 1.5e9
"""Bytes that the check of a robot usually takes, at most."""
_SHARE = 0.9
"""Part of the free memory that may be taken."""
_PAUSE = 0.1
"""Seconds between two looks."""

_REPORT = "report it, with the source"

_News: TypeAlias = "tuple[str, str | Verdict]"


def check(
    config: Config,
    robots: Sequence[RobotConfig],
    wishes: Wishes,
    progress: Progress,
    command: Sequence[str] = tuple(process.python(child.__name__)),
) -> Iterator[Verdict]:
    """Check robots; the verdicts come in their order, each as soon as it and those before it are known.

    `command` starts the process for one robot. Raises CompilerError if what a check needs is not installed,
    CacheError if there is no place for its cache.
    """
    choice.require(wishes.tool)
    crew = _Crew(config, robots, wishes, command)
    try:
        yield from crew.verdicts(progress)
    finally:
        crew.stop()


class _Crew:
    """The processes of one command."""

    def __init__(self, config: Config, robots: Sequence[RobotConfig], wishes: Wishes, command: Sequence[str]) -> None:
        self._command = command
        self._most = min(wishes.jobs or machine.cores(), len(robots)) or 1
        self._wishes = msgspec.structs.replace(wishes, workers=max(1, machine.cores() // self._most))
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
        latest, whole = Verdict(name, self._package(name)), False

        def hear(line: str) -> None:
            nonlocal latest, whole
            step = child.loads(line)
            if step.verdict is not None:
                latest, whole = step.verdict, step.whole
            elif step.what:
                self._news.put((name, step.what))

        order = child.Order(str(self._config.file), name, os.getcwd(), self._wishes)  # noqa: PTH109 - as a text
        text = msgspec.json.encode(order, enc_hook=str).decode() + "\n"
        limits = Limits(self._wishes.timeout, memory)
        try:
            result = process.run(self._command, text, hear, limits, process.importable(), self._tick)
        except _StoppedError:
            return
        except Exception as error:  # noqa: BLE001 - whoever waits for this thread must hear of it
            self._news.put((name, _failed(latest, "check-crashed", f"its process can't be used: {error!r}", _REPORT)))
            return
        if result.ending is Ending.OUT_OF_MEMORY and memory < self._budget:
            self._alone.append(name)
            self._news.put((name, f"{name}: waits for more memory"))
            return
        self._news.put((name, latest if result.good and whole else _ended(latest, result, limits)))

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


def _ended(latest: Verdict, result: process.Result, limits: Limits) -> Verdict:
    """What was found until the process ended before it was through, and why it did."""
    if result.ending is Ending.OUT_OF_TIME:
        message, hint = f"it was not done after {limits.seconds:g} s", "allow more with `urdfsync check --timeout`"
        return _failed(latest, "check-out-of-time", message, hint, result.seconds)
    if result.ending is Ending.OUT_OF_MEMORY:
        message = f"it takes more than the {limits.memory / 1e9:.2g} GB that it may"
        hint = "allow more with `urdfsync check --memory`, as far as this machine has it"
        return _failed(latest, "check-out-of-memory", message, hint, result.seconds)
    message = ": ".join([f"its process ended with {result.cause}", *result.words.splitlines()[-1:]])
    return _failed(latest, "check-crashed", message, _REPORT, result.seconds)


def _failed(latest: Verdict, code: str, message: str, hint: str, seconds: float = 0.0) -> Verdict:
    """A verdict that has come to nothing half way, `seconds` after its begin if that is known."""
    found = Diagnostic(Severity.ERROR, code, f"the check of robot `{latest.robot}`: {message}", hint=hint)
    return msgspec.structs.replace(latest, diagnostics=(*latest.diagnostics, found), seconds=seconds or latest.seconds)
