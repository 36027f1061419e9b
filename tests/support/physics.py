"""Packages put to the test by their domain's experiment, many in one process of the compiler."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from support.modelica import Run, Task, execute
from support.packages import Package, generate
from urdfsync.checking.verdict import Comparison
from urdfsync.domain import Experiment, Target
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options


@dataclasses.dataclass(frozen=True)
class Case:
    """An experiment, and the package that it is done with."""

    experiment: Experiment
    package: Package


def prepare(source: bytes | Path, name: str = "Bot", *, complete: bool = True, **options: Any) -> Case:
    """The experiment with a URDF, and the package that follows from it; meshes are imported beside a file only."""
    content = source if isinstance(source, bytes) else source.read_bytes()
    target = Target(name, name)
    experiment = DOMAIN.experiment(content, "robot.urdf", target, Options(cross_check=False, **options), complete)
    if experiment.content != content:
        source = experiment.content
    return Case(experiment, generate(source, target, **options))


def changed(case: Case, path: str, change: Callable[[str], str]) -> Case:
    """The same with another text in one file of the package."""
    texts = {**case.package.texts, path: change(case.package.texts[path])}
    return Case(case.experiment, dataclasses.replace(case.package, texts=texts))


def replaced(old: str, new: str) -> Callable[[str], str]:
    """A change of one place in a text."""

    def change(text: str) -> str:
        assert text.count(old) == 1, f"{old!r} is not once in:\n{text}"
        return text.replace(old, new)

    return change


def compare(library: Path, folder: Path, cases: Iterable[Case]) -> list[Comparison]:
    """Simulate the probes of packages with names of their own, below `folder`, and compare."""
    cases = list(cases)
    folders = [case.package.write(folder) for case in cases]
    probes = [case.experiment.probe for case in cases]
    tasks = [Task(p.source, p.model, [Run(p.stop, p.step)], p.values) for p in probes]
    results = []
    for case, outcome in zip(cases, execute(library, folders, tasks), strict=True):
        assert not outcome.error, outcome.error
        (run,) = outcome.runs
        assert not run.error, run.error
        series = {"time": run.times.tolist()} | {name: values.tolist() for name, values in run.values.items()}
        results.append(Comparison(tuple(case.experiment.compare(series))))
    return results
