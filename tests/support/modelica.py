"""The embedded compiler for tests: texts with models in, outcomes and series of values out."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from support.corpus import REPOSITORY
from urdfsync.check import libraries as modelica_libraries
from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import compiler, run_job
from urdfsync.check.compilers.compiler import CompileJob, CompilerError, CompileResult, CompileTask, Simulation

Array = NDArray[np.float64]

URDFSYNC = REPOSITORY / "modelica" / "UrdfSync"
CACHE = UserCache(Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "urdfsync-tests")
"""Stays from run to run, since the compiler's first look at a library takes seconds; may be deleted."""


@dataclasses.dataclass(frozen=True)
class Run:
    """One simulation: from 0 to `stop` s with results every `step` s, and with other values of `parameters`.

    Without a `tolerance` it is the compiler's own.
    """

    stop: float = 0.01
    step: float = 0.0025
    parameters: Mapping[str, float] = dataclasses.field(default_factory=dict)
    tolerance: float | None = None


@dataclasses.dataclass(frozen=True)
class Task:
    """A text with a model to compile; then runs, of which the series of `values` come back."""

    source: str
    model: str
    runs: Sequence[Run] = ()
    values: Sequence[str] = ()


@dataclasses.dataclass(frozen=True)
class Series:
    """What a run gave: an error text, or `times` and a series per value."""

    error: str
    times: Array
    values: Mapping[str, Array]


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What became of a task; a model that is not balanced does not compile, and says so in `error`."""

    error: str
    unknowns: int
    runs: tuple[Series, ...]
    seconds: float
    """CPU time."""
    compiling: float
    """The part of it before the first run."""


def execute(library: Path, packages: Iterable[Path], todo: Sequence[Task]) -> list[Outcome]:
    """Compile and run tasks in a child process, with the standard library, UrdfSync and the folders `packages`.

    A child that dies gives outcomes with its last words as the error.
    """
    roots = (standard(library), str(URDFSYNC), *map(str, packages))
    CACHE.trim()
    try:
        results = run_job("rumoca", CompileJob(roots, tuple(map(_task, todo))), CACHE)
    except CompilerError as error:
        return [Outcome(str(error), 0, (), 0, 0) for _ in todo]
    return [_outcome(result) for result in results]


def simulate(library: Path, packages: Iterable[Path], todo: Sequence[Task]) -> list[Series]:
    """Execute tasks that compile, and whose runs all come to their end; returns these runs."""
    outcomes = execute(library, packages, todo)
    assert [outcome.error for outcome in outcomes] == [""] * len(todo)
    runs = [run for outcome in outcomes for run in outcome.runs]
    assert [run.error for run in runs] == [""] * len(runs)
    return runs


def standard(library: Path) -> str:
    """The folder with the part of the standard library in the folder `library` that robots need."""
    found = modelica_libraries.find_standard_library(os.environ, library)
    return str(modelica_libraries.standard_library_copy(found.parts, (), CACHE))


def compile_task(model: str, *libraries: str) -> Task:
    """Compile a model of a package by its full name; `libraries` are what it needs beside those of all packages."""
    task = compiler.compile_task(model, ("Modelica", "UrdfSync", *libraries))
    return Task(task.source, task.model)


def _task(task: Task) -> CompileTask:
    runs = tuple(Simulation(run.stop, run.step, run.parameters, run.tolerance) for run in task.runs)
    return CompileTask(task.model, task.source, runs, tuple(task.values))


def _outcome(result: CompileResult) -> Outcome:
    runs = []
    for run in result.runs:
        values = {name: np.array(series) for name, series in run.values.items()}
        runs.append(Series(run.problem, values.pop("time", np.array([])), values))
    return Outcome(result.problem, result.unknowns, tuple(runs), result.seconds, result.compiling)
