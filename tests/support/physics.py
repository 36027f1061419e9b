"""Packages put to the test by their domain's experiment, many in one process of the compiler."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from support.modelica import Run, Task, simulate
from support.packages import Package, generate
from urdfsync.check import compilation
from urdfsync.check.results import agrees, largest
from urdfsync.domain import Deviation, Experiment, Quantity, Target
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options


@dataclasses.dataclass(frozen=True)
class Case:
    """An experiment, and the package that it is done with."""

    experiment: Experiment
    package: Package


def prepare(source: bytes | Path, name: str = "Bot", **options: Any) -> Case:
    """The experiment with a URDF, and the package that follows from it; meshes are imported beside a file only."""
    content = source if isinstance(source, bytes) else source.read_bytes()
    target = Target(name, name)
    experiment = DOMAIN.experiment(content, "robot.urdf", target, Options(**options))
    assert isinstance(experiment, Experiment)
    if experiment.content != content:
        source = experiment.content
    return Case(experiment, generate(source, target, **options))


def compare(library: Path, folder: Path, cases: Sequence[Case]) -> list[tuple[Deviation, ...]]:
    """Simulate the probes of packages with names of their own, below `folder`: how far each is from the reference."""
    folders = [case.package.write(folder) for case in cases]
    probes = [case.experiment.probe for case in cases]
    tasks = [Task(p.source, p.model, [Run(p.stop, p.step)], p.values) for p in probes]
    results = []
    for case, run in zip(cases, simulate(library, folders, tasks), strict=True):
        series = {name: values.tolist() for name, values in run.values.items()}
        results.append(compilation.compare(case.experiment.compared, series, case.experiment.expected))
    return results


def fault(deviations: Sequence[Deviation]) -> Deviation | None:
    """The difference that is greatest against its kind, if one is beyond the tolerance."""
    return None if all(map(agrees, deviations)) else largest(deviations, tuple(Quantity))
