"""The process that checks one robot: an Order as one line of JSON on stdin, progress and verdicts as lines on stdout.

The reference is native code as well, and reading, rendering and comparing need memory: none of it is in the process
of whoever wants to know.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.checking.process import Limits, end_with_parent
from urdfsync.checking.verdict import Verdict
from urdfsync.checking.wishes import Wishes
from urdfsync.diagnostics import UrdfsyncError


class Order(msgspec.Struct, frozen=True):
    """A robot to check."""

    config: str
    """The configuration file, absolute."""
    robot: str
    folder: str
    """The working folder: messages name files as they are seen from there."""
    wishes: Wishes


class Step(msgspec.Struct, frozen=True):
    """One line of the answer: what is being done, or what is known so far."""

    what: str = ""
    verdict: Verdict | None = None
    whole: bool = False
    """Whether nothing more comes after this verdict."""


def dumps(step: Step) -> str:
    """One line of text; unlike in JSON, numbers may be infinite."""
    return json.dumps(msgspec.to_builtins(step, enc_hook=str))


def loads(line: str) -> Step:
    """What `dumps` gave. Raises ValueError or msgspec.ValidationError for anything else."""
    return msgspec.convert(json.loads(line), Step, dec_hook=_restored)


def main() -> None:
    """Check the robot that is ordered."""
    with os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8") as answer:
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what native code may say is no answer
        order = msgspec.json.decode(sys.stdin.readline(), type=Order, dec_hook=_restored)
        end_with_parent()
        lock = threading.Lock()  # compilers of one robot may run at the same time

        def write(step: Step) -> None:
            with lock:
                answer.write(f"{dumps(step)}\n")
                answer.flush()

        try:
            _check(order, write)
        except UrdfsyncError as error:  # the configuration has changed since
            write(Step(verdict=Verdict(order.robot, "", diagnostics=error.diagnostics), whole=True))


def _check(order: Order, answer: Callable[[Step], None]) -> None:
    from urdfsync import config
    from urdfsync.checking.examine import examine

    os.chdir(order.folder)
    loaded = config.load(Path(order.config))
    (robot,) = loaded.select([order.robot])
    verdict = examine(
        loaded,
        robot,
        order.wishes,
        Limits(),
        tell=lambda what, *_: answer(Step(what=what)),
        keep=lambda so_far: answer(Step(verdict=so_far)),
    )
    answer(Step(verdict=verdict, whole=True))


def _restored(kind: type, value: Any) -> Any:
    """Paths travel as text."""
    return kind(value)


if __name__ == "__main__":
    main()
