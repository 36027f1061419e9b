"""The embedded compiler for tests: the part of the Modelica Standard Library that is needed, and child processes."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from support.corpus import REPOSITORY

Array = NDArray[np.float64]

URDFSYNC = REPOSITORY / "modelica" / "UrdfSync"
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "urdfsync-tests"
"""Stays from run to run, since a compiler's first look at a library takes seconds; may be deleted."""

_WORKER = Path(__file__).with_name("rumoca_worker.py")
_PARTS = ("package.mo", "Constants.mo", "Icons.mo", "Units.mo", "Math", "Mechanics", "Blocks", "Utilities", "Thermal")
_UNNEEDED = (
    *(f"Blocks/{name}" for name in ("Noise", "Tables", "Nonlinear", "Discrete", "MathBoolean", "MathInteger")),
    *(f"Math/{name}" for name in ("Distributions", "Random", "Nonlinear", "FastFourierTransform", "Polynomials")),
    *(f"Thermal/{name}" for name in ("FluidHeatFlow",)),
    *("Math/Special", "Mechanics/MultiBody/Joints/Assemblies", "Mechanics/MultiBody/Visualizers/Colors"),
)
_GUIDES = ("Examples", "UsersGuide")


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


def slim_library(library: Path) -> Path:
    """A copy of what multibody models need of the Modelica Standard Library found in `library`, made once a machine.

    The compiler reads a root as a whole; the copy takes a fifth of the time and of the memory.
    """
    sources = {name: _entry(library, name) for name in ("Modelica", "ModelicaServices", "Complex.mo")}
    version = hashlib.sha256(repr((sources, _PARTS, _UNNEEDED)).encode()).hexdigest()[:12]
    target = CACHE / f"library-{version}"
    if not target.is_dir():
        CACHE.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=CACHE) as folder:
            _copy_slim(sources, Path(folder) / "library")
            if not target.is_dir():  # another process may have been faster
                (Path(folder) / "library").rename(target)
    return target


def execute(library: Path, packages: Iterable[Path], tasks: Sequence[Task], timeout: float = 1800) -> list[Outcome]:
    """Compile and run `tasks` in a child process; roots are the slim library, UrdfSync and the folders `packages`.

    A child that dies gives outcomes with its last words as the error.
    """
    job = {
        "roots": [str(slim_library(library)), str(URDFSYNC), *map(str, packages)],
        "tasks": [dataclasses.asdict(task) for task in tasks],
    }
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "outcomes.json"
        done = subprocess.run(
            [sys.executable, str(_WORKER), str(answer)],
            input=json.dumps(job),
            capture_output=True,
            text=True,
            timeout=timeout,
            env=os.environ | {"XDG_CACHE_HOME": str(CACHE)},
            check=False,
        )
        if done.returncode:
            words = f"the compiler's process ended with {done.returncode}: {done.stderr[-2000:]}"
            return [Outcome(words, "", (), 0, 0) for _ in tasks]
        return [_outcome(outcome) for outcome in json.loads(answer.read_text())]


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


def _entry(library: Path, name: str) -> Path:
    stem, suffix = name.removesuffix(".mo"), ".mo" if name.endswith(".mo") else ""
    versions = sorted(library.glob(f"{stem} [4-9]*{suffix}"))
    return library / name if (library / name).exists() else versions[-1]


def _copy_slim(sources: Mapping[str, Path], target: Path) -> None:
    modelica = target / "Modelica"
    modelica.mkdir(parents=True)
    ignore = shutil.ignore_patterns("Resources", *_GUIDES, *(f"{name}.mo" for name in _GUIDES))
    for part in _PARTS:
        source = sources["Modelica"] / part
        if source.is_dir():
            shutil.copytree(source, modelica / part, ignore=ignore)
        else:
            shutil.copy(source, modelica / part)
    for name in _UNNEEDED:
        shutil.rmtree(modelica / name, ignore_errors=True)
        (modelica / f"{name}.mo").unlink(missing_ok=True)
    shutil.copytree(sources["ModelicaServices"], target / "ModelicaServices", ignore=ignore)
    shutil.copy(sources["Complex.mo"], target / "Complex.mo")
    for order in target.rglob("package.order"):
        _prune_order(order)


def _prune_order(order: Path) -> None:
    """Take the names out of a `package.order` whose files were not copied; names inside `package.mo` stay."""
    inside = (order.parent / "package.mo").read_text("utf-8")
    names = [name for name in order.read_text("utf-8").split() if _exists(order.parent, name) or f" {name}" in inside]
    order.write_text("".join(f"{name}\n" for name in names), "utf-8")


def _exists(folder: Path, name: str) -> bool:
    return (folder / name).is_dir() or (folder / f"{name}.mo").is_file()
