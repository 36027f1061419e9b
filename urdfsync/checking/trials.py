"""The comparisons of one robot: what is generated with the reference, and what is edited with what is generated."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping

from urdfsync.checking import edits
from urdfsync.checking.compilers.tasks import Simulation, Task
from urdfsync.checking.diagnosis import problems
from urdfsync.checking.diagnosis.problems import Case
from urdfsync.checking.edits import Values
from urdfsync.checking.findings import Findings
from urdfsync.checking.loading import Loaded
from urdfsync.checking.subject import Subject
from urdfsync.checking.toolbox import Toolbox
from urdfsync.checking.verdict import Comparison, Compiled, Effect
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Experiment

_UNSTEP = "what edits do was not measured: the package is not in step with its source"


class Trials:
    """Moves versions of a robot's package, and compares them; the jobs may be done at the same time."""

    def __init__(
        self,
        subject: Subject,
        tools: Toolbox,
        findings: Findings,
        disk: Loaded,
        progress: Callable[[str], None],
    ) -> None:
        """`disk` is what is checked, as the compiler finds it."""
        self._subject, self._tools, self._findings = subject, tools, findings
        self._disk, self._progress = disk, progress
        self._baseline: Values | None = None
        """The generated package, of the source as it is."""
        self._whole: Values | None = None
        self._single: dict[str, Values] = {}

    def jobs(self) -> list[Callable[[], None]]:
        """What can be done at once."""
        jobs: list[Callable[[], None]] = [self._move_generated]
        if not self._subject.in_step and self._subject.built:
            self._findings.leave_out(_UNSTEP)
        elif self._subject.telling:
            jobs.append(self._move_edited)
        return jobs

    def variants(self) -> list[Callable[[], None]]:
        """What is to be done then: the package with each edit alone."""
        subject = self._subject
        if self._whole is None:
            return []
        jobs: list[Callable[[], None]] = [] if self._baseline is not None else [self._move_baseline]
        packages = edits.variants(subject.telling, subject.generated, subject.disk)
        return [*jobs, *(functools.partial(self._move_variant, file, texts) for file, texts in packages)]

    def conclude(self) -> None:
        """Find out which edit changes what."""
        subject, baseline, whole = self._subject, self._baseline, self._whole
        found: tuple[Effect, ...] = ()
        if baseline is not None and whole is not None:
            compare = functools.partial(self._plain.compare, baseline=baseline)
            single = {file: compare(values) for file, values in self._single.items()}
            rest = compare(edits.leftover(baseline, whole, list(self._single.values())))
            found = edits.effects(subject.telling, compare(whole), single, rest)
        cosmetic = (Effect((file,), ()) for file in subject.edited if file not in subject.telling)
        self._findings.effects((*found, *cosmetic), subject.package.owners)

    @functools.cached_property
    def _plain(self) -> Experiment:
        """The experiment with the source as it is."""
        return self._experiment(complete=False)

    def _experiment(self, complete: bool) -> Experiment:
        subject = self._subject
        robot, content = subject.robot, subject.rendering.content
        found = subject.domain.experiment(content, shown(robot.source), robot.target, robot.options, complete)
        if found is None:
            message = "nothing can be compared: there is no reference for this package"
            raise OutputError(Diagnostic(Severity.ERROR, "no-reference", message, hint="check without `--physics`"))
        return found

    def _move_generated(self) -> None:
        """The package as it is generated, against the reference."""
        self._progress("moving what is generated")
        experiment, content = self._experiment(complete=True), self._subject.rendering.content
        self._findings.note(notes=experiment.notes, reference=experiment.reference)
        self._findings.leave_out(*experiment.unchecked)
        loaded = self._tools.loader.load("generated", self._subject.generated_from(experiment.content))
        values = self._moved(experiment, loaded)
        self._findings.note(generated=Comparison(tuple(experiment.compare(values))))
        if experiment.content == content:
            self._baseline = values
            if not self._subject.edited and self._subject.in_step:
                self._is_part()

    def _move_edited(self) -> None:
        """The package on disk; that it can't be moved is no fault of an edited package."""
        self._progress("moving the edited package")
        try:
            self._whole = self._moved(self._plain, self._disk)
        except NotMovedError as error:
            self._findings.miss(f"what edits do was not measured: {error.diagnostics[0].message}")
        else:
            self._is_part()

    def _move_baseline(self) -> None:
        self._progress("moving what is generated, as it is")
        self._baseline = self._moved(self._plain, self._tools.loader.load("baseline", self._subject.generated))

    def _move_variant(self, file: str, texts: Mapping[str, bytes]) -> None:
        """The package with one edit alone, if that works at all."""
        self._progress(f"moving the package with {file}")
        label = f"with-{file.replace('/', '-').removesuffix('.mo')}"
        try:
            self._single[file] = self._moved(self._plain, self._tools.loader.load(label, texts))
        except NotMovedError:
            return  # the edit needs another one: it is told together with it

    def _is_part(self) -> None:
        """The main model has compiled as a part of the comparison."""
        self._findings.compiled(Compiled(self._subject.models[0], 0, 0))

    def _moved(self, experiment: Experiment, loaded: Loaded) -> Values:
        """The series of the experiment's probe with a package. Raises NotMovedError."""
        probe = experiment.probe
        task = Task(
            probe.model, probe.source, (Simulation(probe.stop, probe.step),), probe.values, name="the comparison"
        )
        (outcome,) = self._tools.run(loaded, [task])
        self._findings.used(outcome.megabytes)
        if outcome.problem:
            case = Case(self._subject.package, self._tools.loader.folders(loaded), model="the comparison")
            raise NotMovedError(*problems.explain(outcome.problem, case))  # at least one: nothing is said yet
        (series,) = outcome.runs
        if series.problem:
            message = f"the robot can't be simulated: {' '.join(series.problem.split())[:200]}"
            raise NotMovedError(Diagnostic(Severity.ERROR, "no-simulation", message))
        return series.values


class NotMovedError(OutputError):
    """A package could not be moved as the comparison wants it."""
