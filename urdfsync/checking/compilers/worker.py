"""The process around the compiler rumoca: a Job as a line of JSON on stdin, an Outcome as a line on stdout per task.

The compiler is native code that takes gigabytes for large robots and keeps them, and may crash. Whoever starts this
module keeps stdin open, or it ends.
"""

from __future__ import annotations

import math
import os
import re
import sys
import time
from typing import IO, TYPE_CHECKING

import msgspec

from urdfsync.checking.compilers.compiler import MISSING
from urdfsync.checking.compilers.tasks import Job, Outcome, Series, Simulation, Task
from urdfsync.checking.process import end_with_parent

if TYPE_CHECKING:
    import rumoca

FILE = "Task.mo"
"""What the compiler calls the text of a task. Always the same, so that a text takes the place of the one before."""

_UNKNOWN = frozenset(("state", "algebraic", "output", "discrete_real", "discrete_value"))
_SPAN = re.compile(r" @ Span \{.*?\) \}")


def main() -> int:
    """Do all tasks with one session, in order; the exit code."""
    answers = _reserve_stdout()
    job = msgspec.json.decode(sys.stdin.buffer.readline(), type=Job)
    end_with_parent()
    try:
        import rumoca
    except ImportError as error:
        sys.stderr.write(f"{error}\n")
        return MISSING
    session = rumoca.Session(roots=list(job.roots))
    for task in job.tasks:
        answers.write(msgspec.json.encode(_done(session, task)) + b"\n")
        answers.flush()
    return 0


def _reserve_stdout() -> IO[bytes]:
    """The stdout of this process; what native code prints goes to stderr from now on."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def _done(session: rumoca.Session, task: Task) -> Outcome:
    import rumoca

    started = time.process_time()
    problem, unknowns, states, compiling = "", 0, 0, 0.0
    runs: tuple[Series, ...] = ()
    try:
        model = session.loads(task.source, model=task.model, filename=FILE)
    except rumoca.RumocaError as error:
        problem = _words(error)
    else:
        unknowns, states = _counts(model)
        compiling = time.process_time() - started
        runs = tuple(_run(model, run, task.values) for run in task.runs)
    seconds = time.process_time() - started
    return Outcome(problem, unknowns, states, runs, seconds, compiling, _peak())


class _Type(msgspec.Struct):
    dimensions: list[int]


class _Variable(msgspec.Struct):
    role: str
    value_type: int


class _Storage(msgspec.Struct):
    value_types: list[_Type]
    variables: list[_Variable]


class _Equations(msgspec.Struct):
    """The part of the compiler's own form of a model that says how many variables there are."""

    storage: _Storage


def _counts(model: rumoca.Model) -> tuple[int, int]:
    """Scalar unknowns and states, counted as the compiler does when it finds a model unbalanced."""
    storage = msgspec.json.decode(model.to_json("dae"), type=_Equations).storage
    sizes = [math.prod(one.dimensions) for one in storage.value_types]
    unknowns = sum(sizes[one.value_type] for one in storage.variables if one.role in _UNKNOWN)
    return unknowns, sum(sizes[one.value_type] for one in storage.variables if one.role == "state")


def _run(model: rumoca.Model, run: Simulation, values: tuple[str, ...]) -> Series:
    import rumoca

    try:
        config = rumoca.SimConfig(dt=run.step, rtol=run.tolerance, atol=run.tolerance)
        result = model.simulate((0, run.stop), config=config, params=dict(run.parameters) or None)
        series = {name: tuple(result[name].tolist()) for name in values}
    except (rumoca.RumocaError, LookupError, ValueError) as error:
        return Series(problem=_words(error))
    times = tuple(result.time.tolist())
    for name, numbers in series.items():
        if not all(map(math.isfinite, numbers)):
            instant = next(time for time, number in zip(times, numbers, strict=True) if not math.isfinite(number))
            return Series(problem=f"{name} is not finite at {instant:g} s")
    return Series({"time": times, **series})


def _words(error: Exception) -> str:
    """What the compiler says, without places in its own notation."""
    return _SPAN.sub("", str(error.args[0] if error.args else error))


def _peak() -> float:
    """The most resident memory so far, in megabytes."""
    if sys.platform == "win32":
        import psutil

        return float(psutil.Process().memory_info().peak_wset) / 1e6
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1e6 if sys.platform == "darwin" else peak * 1024 / 1e6


if __name__ == "__main__":
    sys.exit(main())
