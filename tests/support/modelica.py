"""The embedded compiler for tests: takes texts with models, and returns outcomes and series of values."""

from __future__ import annotations

import dataclasses
import functools
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from support.corpus import REPOSITORY
from urdfsync.analysis.checks import libraries as modelica_libraries
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers import compiler, run_job
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompilerError, CompileTask, Simulation, Tool
from urdfsync.analysis.checks.process import Limits

Array = NDArray[np.float64]

URDFSYNC = REPOSITORY / "modelica" / "UrdfSync"
CACHE = UserCache(Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "urdfsync-tests")
"""The cache lasts from run to run, since the compiler's first look at a library takes seconds. You may delete it."""
GRAVITY = 9.80665
"""The gravity of the Modelica Standard Library's world, in m/s²."""

_DRIVE = """
  model {domain}Drive "Moves a flange as q = a0 + a1*t + a2*t^2/2"
    parameter Real a0 = 0;
    parameter Real a1 = 0;
    parameter Real a2 = 0;
    Modelica.Mechanics.{domain}.Interfaces.Flange_b flange;
  equation
    flange.{q} = a0 + a1*time + a2*time^2/2;
  end {domain}Drive;
"""
DRIVES = _DRIVE.format(domain="Rotational", q="phi") + _DRIVE.format(domain="Translational", q="s")
"""Models that move a flange, for a package that imports Modelica."""


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
    """A text with a model to compile, and runs, which return the series of `values`."""

    source: str
    model: str
    runs: Sequence[Run] = ()
    values: Sequence[str] = ()
    pattern: str = ""
    """See `CompileTask`."""


@dataclasses.dataclass(frozen=True)
class Series:
    """The result of a run: an error text, or `times` and a series per value."""

    error: str
    times: Array
    values: Mapping[str, Array]

    def end(self, *names: str) -> Array:
        """The last number of each of these values."""
        return np.array([self.values[name][-1] for name in names])


@dataclasses.dataclass(frozen=True)
class Outcome:
    """The result of a task; for a model that does not compile or is not balanced, `error` has the reason."""

    error: str
    runs: tuple[Series, ...] = ()


def bench(
    body: str,
    runs: Sequence[Run],
    values: Sequence[str] = (),
    *,
    packages: Sequence[str] = ("Bot",),
    classes: str = "",
    gravity: float = GRAVITY,
    is_animated: bool = False,
) -> Task:
    """A model `Bench` with a world, in a package with other `classes`."""
    # rumoca loads no package that the text does not import
    imports = "".join(f"  import {name};\n" for name in ("Modelica", "UrdfSync", *packages))
    modifiers = f"n = {{0, 0, -1}}, g = {gravity!r}, enableAnimation = {str(is_animated).lower()}"
    world = f"inner Modelica.Mechanics.MultiBody.World world({modifiers});"
    model = f"  model Bench\n    {world}\n    {body}\n  end Bench;\n"
    return Task(f"package Bench_\n{imports}{classes}{model}end Bench_;\n", "Bench_.Bench", runs, values)


def compile_task(model: str, *libraries: str, runs: Sequence[Run] = (), values: Sequence[str] = ()) -> Task:
    """Compile a model of a package by its full name; `libraries` are further libraries that the model needs."""
    task = compiler.compile_task(model, ("Modelica", "UrdfSync", *libraries))
    return Task(task.source, task.model, runs, values)


@functools.cache
def _trim_once() -> None:
    """Keep the cache from growing; only once, since a look at all files takes half a second."""
    CACHE.trim()


def execute(
    library: Path, packages: Iterable[Path], todo: Sequence[Task], own: Path = URDFSYNC, tool: str = "rumoca"
) -> list[Outcome]:
    """Compile and run tasks in a child process, with the standard library, UrdfSync and the folders `packages`.

    If the child dies, the outcomes have its last output as the error.
    """
    found = modelica_libraries.find_standard_library(library)
    folders, whole, copied = list(packages), [own], dict(found)
    if tool == "rumoca":
        whole, copied["UrdfSync"] = [], own
    texts = [text for folder in (*folders, *whole) for text in modelica_libraries.library_texts(folder).values()]
    copies = modelica_libraries.copy_named(copied, [*texts, *(task.source.encode() for task in todo)], CACHE)
    roots, tasks = tuple(map(str, (copies, *whole, *folders))), []
    for task in todo:
        runs = (Simulation(run.stop, run.step, run.parameters, run.tolerance) for run in task.runs)
        tasks.append(CompileTask(task.model, task.source, tuple(runs), tuple(task.values), task.pattern))
    _trim_once()
    try:
        results = run_job(Tool(tool), CompileJob(roots, tuple(tasks)), CACHE, Limits("a test", 3600, 16e9))
    except CompilerError as error:
        return [Outcome(str(error)) for _ in todo]
    outcomes = []
    for result in results:
        series = []
        for run in result.runs:
            values = {name: np.array(numbers) for name, numbers in run.values.items()}
            series.append(Series(run.problem, values.pop("time", np.array([])), values))
        outcomes.append(Outcome(result.problem, tuple(series)))
    return outcomes


def simulate_all(
    library: Path, packages: Iterable[Path], todo: Sequence[Task], own: Path = URDFSYNC, tool: str = "rumoca"
) -> list[Series]:
    """Execute tasks that compile; return all their runs, also runs that stopped early."""
    outcomes = execute(library, packages, todo, own, tool)
    errors = [outcome.error for outcome in outcomes if outcome.error]
    assert errors == [], errors  # pytest does not rewrite the assertions of this module
    return [run for outcome in outcomes for run in outcome.runs]


def simulate(
    library: Path, packages: Iterable[Path], todo: Sequence[Task], own: Path = URDFSYNC, tool: str = "rumoca"
) -> list[Series]:
    """Execute tasks that compile and whose runs all reach their end; return these runs."""
    runs = simulate_all(library, packages, todo, own, tool)
    errors = [run.error for run in runs if run.error]
    assert errors == [], errors
    return runs
