"""Runs the experiments of packages, many in one process of the compiler."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from support import recorded_omc
from support.modelica import URDFSYNC, Run, Task, simulate
from support.packages import Package, generate
from urdfsync.analysis.checks import compilation
from urdfsync.domain import Target
from urdfsync.domain.experiment import Deviation, Experiment, Sample
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options


@dataclasses.dataclass(frozen=True)
class Case:
    """An experiment, and the package of the experiment."""

    experiment: Experiment
    package: Package

    def only(self, *names: str) -> Case:
        """The case with only the simulations of these names."""
        trials = tuple(each for each in self.experiment.trials if each.name in names)
        return Case(msgspec.structs.replace(self.experiment, trials=trials), self.package)

    def changed(self, file: str, old: str, new: str) -> Case:
        """The case with another text in one file."""
        text = self.package.texts[file]
        assert old in text, f"{file} has no {old!r}:\n{text}"
        texts = {**self.package.texts, file: text.replace(old, new)}
        return Case(self.experiment, dataclasses.replace(self.package, texts=texts))


def prepare(source: bytes | Path, name: str = "Bot", **options: Any) -> Case:
    """The experiment with a URDF, and the package that follows from it; meshes are imported beside a file only."""
    content = source if isinstance(source, bytes) else source.read_bytes()
    target = Target(name, name)
    package = generate(source, target, **options)
    experiment = DOMAIN.checks.experiment(Sample(content, "robot.urdf", target, Options(**options), package.facts))
    assert isinstance(experiment, Experiment)
    if experiment.content != content:
        package = generate(experiment.content, target, **options)
    return Case(experiment, package)


def compare(
    library: Path, folder: Path, cases: Sequence[Case], own: Path = URDFSYNC, tool: str = "rumoca", record: str = ""
) -> list[tuple[Deviation, ...]]:
    """Simulate the probes of packages, below `folder`, and return the differences of each from the reference.

    See `recorded_omc` for `record`, the name of a conversation with OpenModelica.
    """
    folders = [case.package.write(folder) for case in cases]
    probes = [trial.probe for case in cases for trial in case.experiment.trials]
    tasks = [Task(p.source, p.model, [Run(p.stop, p.step, tolerance=p.tolerance)], p.values) for p in probes]
    series = simulate(library, folders, tasks, own, tool) if tasks else []
    if record and recorded_omc.RECORDER:
        recorded_omc.keep(record, series)
    runs, results = iter(series), []
    for case in cases:
        motions = {}
        for trial in case.experiment.trials:
            run = next(runs)
            values = {name: numbers.tolist() for name, numbers in run.values.items()}
            motions[trial.name] = {"time": run.times.tolist(), **values}
        results.append(compilation.compare_all(case.experiment.trials, motions))
    return results


def fault(deviations: Sequence[Deviation]) -> Deviation | None:
    """The greatest relative difference beyond the tolerance, if there is any."""
    faults = [deviation for deviation in deviations if not deviation.agrees]
    return max(faults, key=lambda each: each.relative, default=None)
