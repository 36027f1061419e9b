"""The result of a check while it is made, also by several threads, and how far the check is."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import msgspec

from urdfsync.check.results import CheckResult
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError


class Step(msgspec.Struct, frozen=True):
    """What is being done, how far the check of the robot is (0 to 1), and what is known so far."""

    what: str
    done: float
    result: CheckResult
    is_last: bool = False
    """Whether nothing more comes after this result."""


class ResultCollector:
    """Collects what there is to say of one robot; `tell` gets each step."""

    def __init__(self, robot: str, package: str, tell: Callable[[Step], None]) -> None:
        self._result, self._tell = CheckResult(robot, package), tell
        self._lock, self._begin = threading.Lock(), time.monotonic()
        self._steps: list[str] = []
        self._done, self._total = 0, 0

    @property
    def result(self) -> CheckResult:
        """What is known now."""
        return msgspec.structs.replace(self._result, seconds=time.monotonic() - self._begin)

    def set(self, **facts: Any) -> None:
        """Set fields of the result."""
        with self._lock:
            self._result = msgspec.structs.replace(self._result, **facts)

    def add(self, **more: Iterable[Any]) -> None:
        """Add to fields of the result that are tuples, each item once."""
        with self._lock:
            for name, items in more.items():
                both = tuple(dict.fromkeys((*getattr(self._result, name), *items)))
                self._result = msgspec.structs.replace(self._result, **{name: both})

    def add_memory(self, megabytes: float) -> None:
        """Take note of the memory of a process."""
        with self._lock:
            greatest = max(self._result.megabytes, megabytes)
            self._result = msgspec.structs.replace(self._result, megabytes=greatest)

    @contextlib.contextmanager
    def errors(self) -> Iterator[None]:
        """Whatever is wrong inside becomes a diagnostic."""
        try:
            yield
        except UrdfsyncError as error:
            self.add(diagnostics=error.diagnostics)
        except OSError as error:
            message, place = error.strerror or str(error), str(error.filename or "")
            self.add(diagnostics=[Diagnostic(Severity.ERROR, "system", message, place)])

    def expect(self, steps: int) -> None:
        """So many steps will follow, as far as is known."""
        with self._lock:
            self._total = self._done + steps

    @contextlib.contextmanager
    def step(self, what: str) -> Iterator[None]:
        """A step of the check, which people see while it is made."""
        with self._lock:
            self._steps.append(what)
        self.tell()
        try:
            yield
        finally:
            with self._lock:
                self._steps.remove(what)
                self._done += 1
            self.tell()

    def tell(self) -> None:
        """Hand on the result so far, and what is being done."""
        with self._lock:
            what = self._steps[-1] if self._steps else ""
            done = self._done / max(self._done + len(self._steps), self._total, 1)
            self._tell(Step(f"{self._result.robot}: {what}" if what else "", done, self.result))
