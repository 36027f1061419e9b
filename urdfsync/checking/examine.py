"""The check of one robot: syntax and layout, then compiling and balance, then the comparison with a reference."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor

from urdfsync.checking import edits, layout, problems, toolbox
from urdfsync.checking.cache import Cache
from urdfsync.checking.findings import Findings
from urdfsync.checking.problems import Case
from urdfsync.checking.process import Limits
from urdfsync.checking.subject import Subject
from urdfsync.checking.tasks import Outcome, Simulation, Task, compiling
from urdfsync.checking.toolbox import Loaded, Toolbox
from urdfsync.checking.verdict import Comparison, Compiled, Verdict
from urdfsync.checking.wishes import Wishes
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.domain import Experiment
from urdfsync.planning.situation import Progress, Request

_UNSTEP = "the package is not in step with its source: `urdfsync build` brings it there"


def examine(
    config: Config,
    robot: RobotConfig,
    wishes: Wishes,
    limits: Limits,
    tell: Progress,
    keep: Callable[[Verdict], None],
) -> Verdict:
    """Check one robot; `limits` are those of each compiler, `keep` gets the verdict as it grows."""
    findings = Findings(robot.name, robot.target.package, keep)
    with _noting(findings):
        request = Request(dry=True, package_paths=wishes.package_paths, wait=wishes.wait, jobs=1)
        subject = Subject(config, robot, request)
        findings.note(built=subject.built, in_step=subject.in_step)
        findings.say(subject.warnings)
        said = layout.check(subject.package)
        findings.say(said)
        if any(one.severity is Severity.ERROR for one in said):
            findings.leave_out("nothing was compiled, since the files are not in order")
        else:
            cache = Cache.of_user()
            with toolbox.bench(cache, config, robot) as folder:
                tools = Toolbox(subject, wishes, limits, cache, folder)
                _Stages(subject, tools, findings, wishes, tell).run()
    return findings.verdict


@contextlib.contextmanager
def _noting(findings: Findings) -> Iterator[None]:
    """Whatever is wrong becomes a finding."""
    try:
        yield
    except UrdfsyncError as error:
        findings.say(error.diagnostics)
    except OSError as error:
        findings.say([Diagnostic(Severity.ERROR, "system", error.strerror or str(error), str(error.filename or ""))])


class _Stages:
    """What a compiler has to do for one robot."""

    def __init__(self, subject: Subject, tools: Toolbox, findings: Findings, wishes: Wishes, tell: Progress) -> None:
        self._subject, self._tools, self._findings = subject, tools, findings
        self._wishes, self._tell = wishes, tell
        self._whole: Comparison | None = None
        self._generated: Comparison | None = None

    def run(self) -> None:
        """Compile, and compare if that is wanted."""
        if self._tools.missing is not None:
            self._without_library(self._tools.missing)
            return
        jobs = [*self._comparisons(), *self._compilations()] if self._wishes.physics else self._compilations()
        self._all(jobs)
        if self._whole is not None and self._generated is not None:
            self._attribute(self._whole, self._generated)
        order = list(self._subject.models)
        if self._compares and not any(one.model == order[0] for one in self._findings.verdict.compiled):
            self._all([functools.partial(self._compile, self._loaded, order[:1])])
        compiled = sorted(self._findings.verdict.compiled, key=lambda one: order.index(one.model))
        self._findings.note(compiled=tuple(compiled))

    def _compilations(self) -> list[Callable[[], None]]:
        """The models by themselves, in as many processes as may work; the main one is part of a comparison."""
        wishes, models = self._wishes, self._subject.models
        if self._compares:
            models = models[1:]
        elif not wishes.physics:
            self._findings.leave_out("poses and efforts were not compared: `--physics` does that")
        count = 1 if self._compares else max(1, min(wishes.workers, len(models)))
        return [functools.partial(self._compile, self._loaded, models[number::count]) for number in range(count)]

    @functools.cached_property
    def _loaded(self) -> Loaded:
        return self._tools.load("package", self._subject.texts)

    def _comparisons(self) -> list[Callable[[], None]]:
        """What is generated, and what is on disk if that differs."""
        if not self._compares:
            self._findings.leave_out(f"poses and efforts were not compared: `--tool {self._wishes.tool}` only compiles")
            return []
        if not self._subject.in_step:
            self._findings.leave_out(f"the package on disk was not compared: {_UNSTEP}")
            return [self._compare_generated]
        return [self._compare_generated, *([self._compare_edited] if self._subject.edited else [])]

    @property
    def _compares(self) -> bool:
        return self._wishes.physics and self._wishes.tool == "rumoca"

    def _without_library(self, missing: UrdfsyncError) -> None:
        """Say why nothing is compiled: an error only if somebody asked for more."""
        found = missing.diagnostics[0]
        if self._subject.config.check.library is not None or self._wishes.physics:
            self._findings.say([found])
        self._findings.leave_out(f"nothing was compiled: {found.message}; {found.hint}")

    def _compile(self, loaded: Loaded, models: Sequence[str]) -> None:
        tasks = [self._task(model) for model in models]

        def tell(number: int, outcome: Outcome) -> None:
            self._findings.used(outcome.megabytes)
            if outcome.problem:
                self._explain(outcome.problem, loaded)
            else:
                self._findings.compiled(Compiled(models[number], outcome.unknowns, outcome.states))
            if number + 1 < len(models):
                self._progress(f"compiling {models[number + 1]}")

        self._progress(f"compiling {models[0]}")
        self._tools.run(loaded, tasks, tell)

    def _task(self, model: str) -> Task:
        return compiling(f"{self._subject.robot.target.package}.{model}")

    def _explain(self, text: str, loaded: Loaded) -> None:
        case = Case(self._subject.package, self._tools.folders(loaded), self._findings.verdict.diagnostics)
        self._findings.say(problems.explain(text, case))

    def _experiment(self, complete: bool) -> Experiment | None:
        subject = self._subject
        robot, content = subject.robot, subject.rendering.content
        return subject.domain.experiment(content, shown(robot.source), robot.target, robot.options, complete)

    def _compare_generated(self) -> None:
        """The package as it is generated, against the reference."""
        self._progress("moving what is generated")
        experiment = self._experiment(complete=True)
        if experiment is None:
            self._findings.leave_out(f"nothing was compared: the domain `{self._subject.domain.name}` has no reference")
            return
        self._findings.note(notes=experiment.notes, reference=experiment.reference)
        self._findings.leave_out(*experiment.unchecked)
        loaded = self._tools.load("generated", self._subject.rendering.package(experiment.content))
        self._generated = self._measure(experiment, loaded)
        self._findings.note(generated=self._generated)
        if experiment.content == self._subject.rendering.content and not self._subject.edited:
            self._is_part()

    def _compare_edited(self) -> None:
        """The package on disk, against the reference; that it can't be compared is no fault of an edited package."""
        self._progress("moving the edited package")
        self._whole = self._try(self._loaded)
        if self._whole is not None:
            self._is_part()

    def _is_part(self) -> None:
        """The main model has compiled as a part of a comparison."""
        self._findings.compiled(Compiled(self._subject.models[0], 0, 0))

    def _try(self, loaded: Loaded) -> Comparison | None:
        experiment = self._experiment(complete=False)
        if experiment is None:
            return None
        try:
            return self._measure(experiment, loaded)
        except _NotMeasuredError as error:
            self._findings.leave_out(f"the edited package was not compared: {error.diagnostics[0].message}")
            return None

    def _attribute(self, whole: Comparison, generated: Comparison) -> None:
        """Find out which edit changes what."""
        subject, single = self._subject, dict[str, Comparison]()
        if not whole.agrees:
            packages = edits.variants(subject.edited, subject.generated, subject.disk)
            self._all([functools.partial(self._try_one, file, texts, single) for file, texts in packages])
        self._findings.note(effects=edits.effects(subject.edited, whole, single, generated))

    def _try_one(self, file: str, texts: Mapping[str, bytes], single: dict[str, Comparison]) -> None:
        self._progress(f"moving the package with {file}")
        label = f"with-{file.replace('/', '-').removesuffix('.mo')}"
        found = self._try(self._tools.load(label, texts))
        if found is not None:
            single[file] = found

    def _measure(self, experiment: Experiment, loaded: Loaded) -> Comparison:
        probe = experiment.probe
        run = Simulation(probe.stop, probe.step)
        task = Task(probe.model, probe.source, (run,), probe.values, name="the comparison")
        (outcome,) = self._tools.run(loaded, [task])
        self._findings.used(outcome.megabytes)
        if outcome.problem:
            case = Case(self._subject.package, self._tools.folders(loaded))
            raise _NotMeasuredError(*problems.explain(outcome.problem, case))
        (series,) = outcome.runs
        if series.problem:
            message = f"the robot can't be simulated: {series.problem.strip().splitlines()[0]}"
            raise _NotMeasuredError(Diagnostic(Severity.ERROR, "no-simulation", message))
        return Comparison(tuple(experiment.compare(series.values)))

    def _progress(self, what: str) -> None:
        self._tell(f"{self._subject.robot.name}: {what}", 0, 0)

    def _all(self, jobs: Sequence[Callable[[], None]]) -> None:
        """Do jobs, some at the same time; what goes wrong with one is a finding."""

        def noted(job: Callable[[], None]) -> None:
            with _noting(self._findings):
                job()

        if self._wishes.workers == 1:
            for job in jobs:
                noted(job)
            return
        with ThreadPoolExecutor(self._wishes.workers) as pool:
            for future in [pool.submit(noted, job) for job in jobs]:
                future.result()


class _NotMeasuredError(OutputError):
    """A package could not be compared with the reference."""
