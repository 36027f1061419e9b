"""The embedded compiler for tests: texts with models in, outcomes and series of values out."""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from support.corpus import REPOSITORY
from support.slim import CACHE

Array = NDArray[np.float64]

URDFSYNC = REPOSITORY / "modelica" / "UrdfSync"


@dataclasses.dataclass(frozen=True)
class Run:
    """One simulation: from 0 to `stop` s with results every `step` s, and with other values of `parameters`."""

    stop: float = 0.01
    step: float = 0.0025
    parameters: Mapping[str, float] = dataclasses.field(default_factory=dict)


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
    summary: str
    runs: tuple[Series, ...]
    seconds: float
    """CPU time."""
    megabytes: float
    """Peak of the process so far."""


def execute(library: Path, packages: Iterable[Path], tasks: Sequence[Task], timeout: float = 1800) -> list[Outcome]:
    """Compile and run `tasks` in a child process, with the standard library, UrdfSync and the folders `packages`.

    A child that dies gives outcomes with its last words as the error.
    """
    roots = [str(URDFSYNC), *map(str, packages)]
    job = {"library": str(library), "roots": roots, "tasks": [dataclasses.asdict(task) for task in tasks]}
    environment = {"XDG_CACHE_HOME": str(CACHE.parent), "PYTHONPATH": str(REPOSITORY / "tests")}
    done = subprocess.run(
        [sys.executable, "-m", "support.rumoca_worker"],
        input=json.dumps(job),
        capture_output=True,
        text=True,
        timeout=timeout,
        env=os.environ | environment,
        check=False,
    )
    if done.returncode:
        words = f"the compiler's process ended with {done.returncode}: {done.stderr[-2000:]}"
        return [Outcome(words, "", (), 0, 0) for _ in tasks]
    return [_outcome(outcome) for outcome in json.loads(done.stdout)]


def compile_task(model: str) -> Task:
    """Compile a model of a package by its full name."""
    imports = "".join(f"  import {name};\n" for name in ("Modelica", "UrdfSync"))
    return Task(f"model Probe_\n{imports}  extends {model};\nend Probe_;\n", "Probe_")


def _outcome(data: Mapping[str, Any]) -> Outcome:
    runs = tuple(
        Series(run["error"], np.array(run["times"]), {name: np.array(s) for name, s in run["values"].items()})
        for run in data["runs"]
    )
    return Outcome(data["error"], data["summary"], runs, data["seconds"], data["megabytes"])
