"""The process around OpenModelica: a Job as one line of JSON on stdin, an Outcome as one line on stdout per task.

Untried with a real `omc`. Whoever starts this module keeps stdin open, or it ends.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

import msgspec

from urdfsync.checking.compilers import omc
from urdfsync.checking.compilers.compiler import MISSING
from urdfsync.checking.compilers.tasks import Job, Outcome, Task
from urdfsync.checking.process import end_with_parent

Ask: TypeAlias = Callable[[str], str]
"""Sends an expression to `omc`, and returns its answer as it comes."""


class RefusedError(Exception):
    """`omc` or its client library gives no answer, but says why."""


def main() -> int:
    """Do all tasks in one session, in order; the exit code."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what omc and its client library print is no outcome
    job = msgspec.json.decode(sys.stdin.buffer.readline(), type=Job)
    end_with_parent()
    try:
        ask = _session()
    except (ImportError, RefusedError, OSError) as error:
        sys.stderr.write(f"{error}\n")
        return MISSING
    for done in outcomes(ask, job):
        answers.write(msgspec.json.encode(done) + b"\n")
        answers.flush()
    return 0


def _session() -> Ask:
    """Start `omc`. Raises ImportError without its client library, RefusedError or OSError if it does not start."""
    import OMPython

    begin: Any = getattr(OMPython, "OMCSessionLocal", None) or OMPython.OMCSessionZMQ  # the name until 4.0
    errors = tuple(
        getattr(OMPython, name) for name in ("OMSessionException", "OMCSessionException") if hasattr(OMPython, name)
    )
    try:
        session = begin()
    except errors as error:
        raise RefusedError(str(error)) from error

    def ask(expression: str) -> str:
        try:
            return str(session.sendExpression(expression, parsed=False))
        except errors as error:
            raise RefusedError(str(error)) from error

    return ask


def outcomes(ask: Ask, job: Job) -> Iterator[Outcome]:
    """Load the libraries, and do the tasks one by one; what can't be loaded is the problem of each of them."""
    problem = _loaded(ask, job)
    for task in job.tasks:
        started = time.monotonic()
        done = Outcome(problem) if problem else _done(ask, task)
        yield msgspec.structs.replace(done, seconds=time.monotonic() - started)


def _loaded(ask: Ask, job: Job) -> str:
    try:
        ask("cd(getTempDirectoryPath())")
        for file in omc.packages(job.roots):
            problem = omc.loaded(ask(omc.loading(file)))
            if problem:
                return problem
    except RefusedError as refused:
        return str(refused)
    return ""


def _done(ask: Ask, task: Task) -> Outcome:
    load, check = omc.checking(task)
    try:
        problem = omc.loaded(ask(load))
        return Outcome(problem) if problem else omc.outcome(ask(check), task)
    except RefusedError as refused:
        return Outcome(str(refused))


if __name__ == "__main__":
    sys.exit(main())
