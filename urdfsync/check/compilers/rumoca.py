"""The embedded compiler, rumoca: the process that does a job with it."""

from __future__ import annotations

import math
import re
import sys
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from urdfsync.check.compilers.compiler import (
    CompileJob,
    CompileResult,
    CompileTask,
    Simulation,
    SimulationResult,
    serve,
)

if TYPE_CHECKING:
    import rumoca

_FILE = "Task.mo"  # always the same, so that a text takes the place of the one before in the compiler's memory
_UNKNOWN = frozenset(("state", "algebraic", "output", "discrete_real", "discrete_value"))
_SPAN = re.compile(r" @ Span \{.*?\) \}")


def work(job: CompileJob) -> Iterator[CompileResult]:
    """Do all tasks with one session, in order. Raises ImportError without the compiler."""
    import rumoca  # an optional extra

    session = rumoca.Session(roots=list(job.roots))
    for task in job.tasks:
        yield _compile(session, task)


def _compile(session: rumoca.Session, task: CompileTask) -> CompileResult:
    import rumoca

    started = time.process_time()
    try:
        model = session.loads(task.source, model=task.model, filename=_FILE)
    except rumoca.RumocaError as error:
        return CompileResult(_words(error), seconds=time.process_time() - started, megabytes=_peak_megabytes())
    unknowns, states = _counts(model)
    compiling = time.process_time() - started
    runs = tuple(_simulate(model, run, task.values) for run in task.runs)
    seconds = time.process_time() - started
    return CompileResult("", unknowns, states, runs, seconds, compiling, _peak_megabytes())


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


def _simulate(model: rumoca.Model, run: Simulation, values: tuple[str, ...]) -> SimulationResult:
    import rumoca

    try:
        config = rumoca.SimConfig(dt=run.step, rtol=run.tolerance, atol=run.tolerance)
        result = model.simulate((0, run.stop), config=config, params=dict(run.parameters) or None)
        series = {name: tuple(result[name].tolist()) for name in values}
    except (rumoca.RumocaError, LookupError, ValueError) as error:
        return SimulationResult(problem=_words(error))
    times = tuple(result.time.tolist())
    for name, numbers in series.items():
        if not all(map(math.isfinite, numbers)):  # JSON has no words for them
            instant = next(time for time, number in zip(times, numbers, strict=True) if not math.isfinite(number))
            return SimulationResult(problem=f"{name} is not finite at {instant:g} s")
    return SimulationResult({"time": times, **series})


def _words(error: Exception) -> str:
    """What the compiler says, without places in its own notation."""
    return _SPAN.sub("", str(error.args[0] if error.args else error))


def _peak_megabytes() -> float:
    """The most resident memory so far."""
    if sys.platform == "win32":
        import psutil

        return float(psutil.Process().memory_info().peak_wset) / 1e6
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1e6 if sys.platform == "darwin" else peak * 1024 / 1e6


if __name__ == "__main__":
    sys.exit(serve(work))
