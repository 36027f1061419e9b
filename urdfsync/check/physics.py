"""The comparison of one robot: what is generated with the reference, and what is edited with what is generated."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from urdfsync.check import errors
from urdfsync.check.collector import ResultCollector
from urdfsync.check.compilation import PackageCompiler, PackageVersion
from urdfsync.check.compilers.compiler import CompileTask, Simulation
from urdfsync.check.package import CheckedPackage
from urdfsync.check.results import MOST_SINGLE_EDITS, CompiledModel, EditEffect, agrees
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Deviation, Experiment

Series: TypeAlias = Mapping[str, Sequence[float]]
"""Values over time by the names of variables."""

_UNEXPLAINED = 0.01
"""Part of a change that single edits must leave unexplained before it is told as one of several together."""


class NotMovedError(OutputError):
    """A package could not be moved as the comparison wants it."""


class PhysicsCheck:
    """Moves versions of a robot's package, and compares them; the jobs of a list may be done at the same time."""

    def __init__(
        self, package: CheckedPackage, compiler: PackageCompiler, checked: PackageVersion, collector: ResultCollector
    ) -> None:
        """`checked` is the package as it is checked, where the compiler finds it."""
        self._package, self._compiler, self._checked, self._collector = package, compiler, checked, collector
        self._baseline: Series | None = None  # of the generated package, of the source as it is
        self._edited: Series | None = None
        self._single: dict[str, Series] = {}

    def first_jobs(self) -> list[Callable[[], None]]:
        """Compare what is generated with the reference, and move what is edited."""
        if self._package.is_built and not self._package.in_step:
            sentence = "what edits do was not measured: the package is not in step with its source"
            self._collector.add(unchecked=[sentence])
        elif self._package.meaningful_edits:
            return [self._move_generated, self._move_edited]
        return [self._move_generated]

    def second_jobs(self) -> list[Callable[[], None]]:
        """Move the package with each edit alone, if there are a few."""
        if self._edited is None:
            return []
        jobs: list[Callable[[], None]] = [] if self._baseline is not None else [self._move_baseline]
        files = self._package.meaningful_edits
        if 1 < len(files) <= MOST_SINGLE_EDITS:
            jobs += [functools.partial(self._move_with_one_edit, file) for file in files]
        return jobs

    def find_effects(self) -> None:
        """Find out which edit changes what."""
        package, baseline, edited = self._package, self._baseline, self._edited
        effects: list[EditEffect] = []
        if baseline is not None and edited is not None:
            compare = functools.partial(self._plain_experiment.compare, baseline=baseline)
            single = {file: compare(series) for file, series in self._single.items()}
            rest = compare(unexplained(baseline, edited, list(self._single.values())))
            effects = edit_effects(package.meaningful_edits, compare(edited), single, rest)
        effects += [EditEffect((file,), ()) for file in package.edits if file not in package.meaningful_edits]
        owners = package.files.owners
        named = (
            EditEffect(one.files, one.deviations, tuple(dict.fromkeys(owners[file] for file in one.files)))
            for one in effects
        )
        self._collector.set(effects=tuple(named))

    @functools.cached_property
    def _plain_experiment(self) -> Experiment:
        """The experiment with the source as it is."""
        return self._experiment(complete=False)

    def _experiment(self, complete: bool) -> Experiment:
        package, robot = self._package, self._package.robot
        content = package.rendering.content
        found = package.domain.experiment(content, shown(robot.source), robot.target, robot.options, complete)
        if found is None:
            message = "nothing can be compared: there is no reference for this package"
            raise OutputError(Diagnostic(Severity.ERROR, "no-reference", message, hint="check without `--physics`"))
        return found

    def _move_generated(self) -> None:
        package, content = self._package, self._package.rendering.content
        experiment = self._experiment(complete=True)
        self._collector.set(notes=experiment.notes, reference=experiment.reference)
        self._collector.add(unchecked=experiment.unchecked)
        same = experiment.content == content
        texts = package.generated if same else package.rendering.package(experiment.content)
        series = self._move(experiment, self._compiler.put("generated", texts), "what is generated")
        self._collector.set(deviations=tuple(experiment.compare(series)))
        if same:
            self._baseline = series
            if package.in_step and not package.edits:
                self._add_main_model()

    def _move_edited(self) -> None:
        """The package on disk; that it can't be moved is no fault of an edited package."""
        try:
            self._edited = self._move(self._plain_experiment, self._checked, "the edited package")
        except NotMovedError as error:
            self._collector.add(gaps=[f"what edits do was not measured: {error.diagnostics[0].message}"])
        else:
            self._add_main_model()

    def _move_baseline(self) -> None:
        version = self._compiler.put("baseline", self._package.generated)
        self._baseline = self._move(self._plain_experiment, version, "what is generated, as it is")

    def _move_with_one_edit(self, file: str) -> None:
        label = f"with-{file.replace('/', '-').removesuffix('.mo')}"
        version = self._compiler.put(label, self._package.with_one_edit(file))
        try:
            self._single[file] = self._move(self._plain_experiment, version, f"the package with {file}")
        except NotMovedError:
            return  # the edit needs another one: it is told together with it

    def _add_main_model(self) -> None:
        """The main model has compiled as a part of the comparison."""
        self._collector.add(compiled=[CompiledModel(self._package.models[0], 0, 0)])

    def _move(self, experiment: Experiment, version: PackageVersion, what: str) -> Series:
        """The series of the experiment's probe with a package. Raises NotMovedError."""
        probe = experiment.probe
        runs = (Simulation(probe.stop, probe.step),)
        task = CompileTask(probe.model, probe.source, runs, probe.values, title="the comparison")
        with self._collector.step(f"moving {what}"):
            (result,) = self._compiler.run(version, [task])
        self._collector.add_memory(result.megabytes)
        if result.problem:
            folders = self._compiler.known_folders(version)
            raise NotMovedError(*errors.explain(result.problem, self._package.files, folders, (), "the comparison"))
        (run,) = result.runs
        if run.problem:
            message = f"the robot can't be simulated: {' '.join(run.problem.split())[:200]}"
            raise NotMovedError(Diagnostic(Severity.ERROR, "no-simulation", message))
        return run.values


def unexplained(baseline: Series, edited: Series, single: Sequence[Series]) -> Series:
    """The simulation in which everything has happened but what each single edit does: what they do only together."""
    return {
        name: [
            base + (value - base) - sum(one[name][instant] - base for one in single)
            for instant, (base, value) in enumerate(zip(values, edited[name], strict=True))
        ]
        for name, values in baseline.items()
        if all(len(series.get(name, ())) == len(values) for series in (edited, *single))
    }


def edit_effects(
    files: Sequence[str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
    rest: Sequence[Deviation],
) -> list[EditEffect]:
    """What the edits in `files` do, each apart where that can be told, in their order.

    All deviations are from the generated package: `whole` of the one on disk, `single` of those with one edit each,
    `rest` of what none of these explains.
    """
    changes = [one for one in whole if not agrees(one)]
    if len(files) == 1:
        return [EditEffect((files[0],), tuple(changes))]
    left = {(one.quantity, one.element, one.unit): one.difference for one in rest if not agrees(one)}
    together = tuple(
        one
        for one in changes
        if not left.get((one.quantity, one.element, one.unit), 0.0) <= _UNEXPLAINED * one.difference
    )
    apart = [
        EditEffect((file,), tuple(one for one in single[file] if not agrees(one))) for file in files if file in single
    ]
    untried = tuple(file for file in files if file not in single)
    if not together:
        return [*apart, *([EditEffect(untried, ())] if untried else [])]
    effective = [effect for effect in apart if effect.deviations]
    told = {effect.files[0] for effect in effective}
    return [*effective, EditEffect(tuple(file for file in files if file not in told) or tuple(files), together)]
