"""A Modelica compiler as the check sees it: it works in a process of its own, and whatever ends that is explained."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import msgspec

from urdfsync.checking import process
from urdfsync.checking.compilers.tasks import Job, Outcome
from urdfsync.checking.process import Ending, Limits, Result
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

MISSING = 3
"""The exit code of a worker without a compiler; the last line that it writes to stderr says why there is none."""

_KILLED = 9


class CompilerError(UrdfsyncError):
    """A compiler could not do its job; carries the outcomes of the tasks before."""

    def __init__(self, diagnostic: Diagnostic, outcomes: Sequence[Outcome] = ()) -> None:
        super().__init__(diagnostic)
        self.outcomes = tuple(outcomes)


class Compiler(Protocol):
    """Compiles and simulates models."""

    def compile(self, job: Job, limits: Limits, tell: Callable[[int, Outcome], None] = ...) -> list[Outcome]:
        """Do all tasks of a job, in order, within `limits`; one outcome each.

        `tell` gets the number of a task, from 0, and its outcome as soon as it is known. A model that does not
        compile is an outcome. Raises CompilerError if the compiler is missing, breaks a limit or breaks down.
        """
        ...


def ignore(number: int, outcome: Outcome) -> None:
    """Nobody wants to hear of an outcome before all are known."""


class Tool(msgspec.Struct, frozen=True):
    """A compiler that works behind a process of ours."""

    name: str
    """What messages call it."""
    worker: str
    """The module that takes a Job on stdin, and writes an Outcome per task."""
    install: str
    """What to do if there is none."""
    report: str
    """What to do if it breaks down."""


def ask(
    tool: Tool, job: Job, limits: Limits, environment: Mapping[str, str], tell: Callable[[int, Outcome], None]
) -> list[Outcome]:
    """Have a tool's worker do a job; see `Compiler.compile`."""
    outcomes: list[Outcome] = []

    def heard(line: str) -> None:
        outcome = msgspec.json.decode(line, type=Outcome)
        outcomes.append(outcome)
        tell(len(outcomes) - 1, outcome)

    text = msgspec.json.encode(job).decode() + "\n"
    command, environment = process.python(tool.worker), {**environment, **process.importable()}
    result = process.run(command, text, heard, limits, environment)
    if result.good and len(outcomes) == len(job.tasks):
        return outcomes
    raise CompilerError(_explained(tool, result, limits, job, len(outcomes)), outcomes)


def missing(tool: Tool, reason: str) -> CompilerError:
    """There is no such compiler."""
    return CompilerError(_error("no-compiler", f"there is no compiler: {reason}", tool.install))


def _explained(tool: Tool, result: Result, limits: Limits, job: Job, done: int) -> Diagnostic:
    """Why the worker ended before it was through, after `done` tasks."""
    words = result.words.splitlines()[-1:]
    if result.ending is Ending.EXITED and result.code == MISSING:
        return missing(tool, ": ".join([f"{tool.name} does not start", *words])).diagnostics[0]
    place = f"at {job.tasks[done].title}" if done < len(job.tasks) else "at its end"
    if result.ending is Ending.OUT_OF_MEMORY:
        allowed = f"more than the {_gigabytes(limits.memory)} that it may"
        message = f"{tool.name} took {_gigabytes(result.memory)} {place}, {allowed}"
        hint = "allow more with `urdfsync check --memory`, or use a machine that has more"
        return _error("compiler-out-of-memory", message, hint)
    if result.ending is Ending.OUT_OF_TIME:
        message = f"{tool.name} was not done after {limits.seconds:.3g} s, {place}"
        return _error("compiler-out-of-time", message, "allow more with `urdfsync check --timeout`")
    message = ": ".join([f"{tool.name} broke down {place}: {result.cause}", *words])
    if result.ending is Ending.CRASHED and result.code == _KILLED:
        hint = (
            f"most likely the system for want of memory, at {_gigabytes(result.memory)}: check fewer robots at a time"
        )
        return _error("compiler-crashed", message, hint)
    return _error("compiler-crashed", message, tool.report)


def _error(code: str, message: str, hint: str) -> Diagnostic:
    return Diagnostic(Severity.ERROR, code, message, hint=hint)


def _gigabytes(count: float) -> str:
    return f"{count / 1e9:.2g} GB"
