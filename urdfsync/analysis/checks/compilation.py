"""Compiles and simulates versions of one robot's package; each version is a copy in a folder of its own."""

from __future__ import annotations

import bisect
import math
import re
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.compilers.compiler import (
    Compiler,
    CompileResult,
    CompileTask,
    Complaint,
    Series,
    Simulation,
    Tool,
    compile_task,
    one_line,
)
from urdfsync.analysis.checks.jobs import Jobs
from urdfsync.analysis.checks.libraries import Libraries
from urdfsync.analysis.checks.package import PackageTexts, RobotPackage, UsersModels
from urdfsync.analysis.checks.process import Limits
from urdfsync.analysis.checks.results import (
    MOST_SINGLE_EDITS,
    CompiledModel,
    Curve,
    EditEffect,
    ToolResult,
    listed,
)
from urdfsync.common.diagnostics import Diagnostic, Severity, findings_of
from urdfsync.common.files import shown
from urdfsync.common.processes.workers import tell
from urdfsync.common.spelling import counted
from urdfsync.domain.experiment import Compared, Deviation, Experiment, Trial
from urdfsync.engine.generation import generated_texts
from urdfsync.modelica.parser import parse

_USERS = "users"
"""The job that compiles the user's models."""
_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_SAME_TIME = 1e-7  # s
_BALANCE = re.compile(r"(?<![\d,])([\d,]++) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")

_Job: TypeAlias = tuple[Mapping[str, bytes], Sequence[CompileTask]]
"""The texts of a version of the package, and the tasks for this version."""


class Compilation:
    """The compiling of one package by one compiler: `run` adds its answers to a result."""

    def __init__(
        self,
        package: RobotPackage,
        tool: Tool,
        needed: Libraries,
        users: UsersModels,
        needed_by_users: Libraries,
        limits: Limits,
        folder: Path,
        processes: int,
        result: ToolResult,
    ) -> None:
        """At most `processes` compile at the same time; copies of the package go below `folder`.

        The user's models, `users`, may need more libraries than the package.
        """
        self._package, self._users, self._processes = package, users, processes
        self._jobs = Jobs(package.robot, tool, needed, package.around, limits, folder)
        # separate jobs: an unreadable file of the user's would keep the package from being compiled
        self._users_jobs = msgspec.structs.replace(self._jobs, needed=needed_by_users)
        self._compiler = compilers.COMPILERS[tool.name]
        self.result = result
        result.tool = self._compiler.TITLE
        self.generated: Mapping[str, Series] = {}
        """The simulations of the generated package with completed data, by the names of trials."""
        self.edited: Mapping[str, Series] = {}
        """The simulations of the package on disk, if files in it are edited."""

    def run(self, experiment: Experiment | None) -> None:
        """Compile the package, and run the experiment: this takes 20 s for a six-axis arm, minutes for a humanoid."""
        begin = time.monotonic()
        # an experiment compiles several versions of the package at the same time, so the models need no division
        models = self._model_jobs(1 if experiment else max(1, min(self._processes, len(self._package.models))))
        done = self._run_all({**models, **(self._versions(experiment) if experiment else {})})
        failing = {task.title for label, job in models.items() for task in _failing(job, done[label])}
        alone = [part for part, whole in self._parts.items() if whole in failing]
        if alone:  # the fault may lie in the component
            models["parts"] = self._package.files.texts, self._tasks(alone)
            done |= self._run_all({"parts": models["parts"]})
        self._note_models(models, done)
        if experiment:
            self._compare(experiment, done)
        self.result.seconds = time.monotonic() - begin

    def _versions(self, experiment: Experiment) -> dict[str, _Job]:
        """Return jobs that simulate the generated package and the edited one."""
        package = self._package
        move = [_task(trial) for trial in experiment.trials]
        source = package.inputs.source
        text = msgspec.structs.replace(source, content=experiment.content, companions=experiment.companions)
        amended = text, experiment.options
        is_same = amended == (source, package.robot.options)
        completed = package.generated if is_same else generated_texts(package.inputs, package.generation, amended)
        jobs: dict[str, _Job] = {"completed": (completed, move)}
        if package.edits and experiment.options == package.robot.options:
            jobs["edited"] = package.files.texts, move
            if not is_same:
                jobs["generated"] = package.generated, move
        return jobs

    def _compare(self, experiment: Experiment, done: Mapping[str, Sequence[CompileResult]]) -> None:
        """Compare the generated package with the reference, and the edited one with the generated one."""
        package, trials = self._package, experiment.trials
        self.generated, faults = self._motions(done["completed"], trials)
        self.result.add(faults)
        if self.generated:
            self.result.deviations = compare_all(trials, self.generated)
            self.result.curves = tuple(curves(trials[0], self.generated[trials[0].name]))
        if "edited" not in done:
            return
        without_edits = self.generated
        if "generated" in done:
            without_edits, faults = self._motions(done["generated"], trials)
            self.result.add(faults)
        self.edited, faults = self._motions(done["edited"], trials)
        if faults:  # the package is not at fault
            self._add_gap(f"the effect of your edits was not measured: {faults[0].message}")
        if self.edited and without_edits:
            whole = find_changes(trials, self.edited, without_edits)
            single = self._single_edits(trials, whole, without_edits)
            self.result.effects = tuple(edit_effects(package.edits, package.files.owners, whole, single))

    def _single_edits(
        self, trials: Sequence[Trial], whole: Sequence[Deviation], without_edits: Mapping[str, Series]
    ) -> dict[str, list[Deviation]]:
        """Return, for each edited file, the changes that go away if this file alone is taken back.

        A file that other edits need is left out: without it the package does not work. If there are too many files,
        all are left out.
        """
        edits, texts, generated = self._package.edits, self._package.files.texts, self._package.generated
        if len(edits) == 1:
            return {edits[0]: list(whole)}
        trials = [trial for trial in trials if find_changes([trial], self.edited, without_edits)]
        if not trials or len(edits) > MOST_SINGLE_EDITS:
            return {}
        tasks, changes = [_task(trial) for trial in trials], dict[str, list[Deviation]]()
        done = self._run_all({f"without {file}": ({**texts, file: generated[file]}, tasks) for file in edits})
        for file, answers in zip(edits, done.values(), strict=True):
            if len(answers) == len(trials) and not any(each.problem or each.runs[0].problem for each in answers):
                series = {trial.name: each.runs[0].values for trial, each in zip(trials, answers, strict=True)}
                changes[file] = find_changes(trials, series, self.edited)
        return changes

    def _model_jobs(self, count: int) -> dict[str, _Job]:
        """Return jobs that compile all models: the package's in `count` parts, then the user's."""
        package, own = self._package, self._package.robot.target.package
        tasks = self._tasks(model for model in package.models if model not in self._parts)
        jobs: dict[str, _Job] = {
            f"models{number}": (package.files.texts, tasks[number::count]) for number in range(count)
        }
        if self._users.files:
            libraries = ("Modelica", "UrdfSync", own.partition(".")[0])
            jobs[_USERS] = package.files.texts, [compile_task(model, libraries) for model in self._users.files]
        return jobs

    def _tasks(self, models: Iterable[str]) -> list[CompileTask]:
        own = self._package.robot.target.package
        return [msgspec.structs.replace(compile_task(f"{own}.{model}"), title=model) for model in models]

    @cached_property
    def _parts(self) -> Mapping[str, str]:
        """For the name of each model that an unedited model has as a component: the name of the unedited model.

        Compiling a six-axis arm alone takes as long as compiling Test, which contains the arm.
        """
        package, parts = self._package, dict[str, str]()
        for model in package.models:
            file = f"{model.replace('.', '/')}.mo"
            generated = package.generated.get(file, b"")
            text = generated.decode() if generated == package.files.texts.get(file) else ""
            types = {str(part.type) for each in parse(text).classes for part in each.components if not part.uses}
            parts |= dict.fromkeys(types.intersection(package.models), model)
        return parts

    def _note_models(self, jobs: Mapping[str, _Job], done: Mapping[str, Sequence[CompileResult]]) -> None:
        """Record the models that were compiled by themselves."""
        compiled, files, users = list[CompiledModel](), self._package.files, self._users
        failing: dict[str, list[Diagnostic]] = {}  # findings by the names of the user's models
        for label, (_, tasks) in jobs.items():
            is_users = label == _USERS
            for task, answer in zip(tasks, done[label], strict=False):
                self._note_version(answer)
                if answer.problem and is_users:
                    failing[task.title] = explain(answer.problem, self._compiler, files, users.files[task.title])
                    continue
                if answer.problem:
                    self.result.add(explain(answer.problem, self._compiler, files))
                    continue
                # another model may have the same finding under another name
                told = {(finding.file, finding.line, finding.code) for finding in self.result.diagnostics}
                warnings = explain_warnings(answer.warnings, self._compiler, files)
                self.result.add(each for each in warnings if (each.file, each.line, each.code) not in told)
                compiled.append(CompiledModel(task.title, answer.unknowns, is_users))
                inside = (part for part, whole in self._parts.items() if whole == task.title and not is_users)
                compiled += (CompiledModel(part, 0) for part in inside)
        order = [*self._package.models, *users.files]
        self.result.compiled = tuple(sorted(compiled, key=lambda model: order.index(model.model)))
        waiting, parts = [users.files[model.model] for model in compiled if model.is_users], set[Path]()
        if {model.model for model in compiled} >= {*self._package.models}:
            waiting += (files.folder / path for path in self._package.generated)
        while waiting:
            parts |= (more := {*users.uses.get(waiting.pop(), ())} - parts)
            waiting += more
        for model, faults in failing.items():
            if users.files[model] not in parts:  # else it has compiled as a component of another model
                self.result.add(map(_as_part, faults))
                self.result.failing += (model,)

    def _add_gap(self, gap: str) -> None:
        self.result.gaps = tuple(dict.fromkeys((*self.result.gaps, gap)))

    def _note_version(self, answer: CompileResult) -> None:
        if answer.version:
            self.result.tool = f"{self._compiler.TITLE} {answer.version}"

    def _run_all(self, jobs: Mapping[str, _Job]) -> dict[str, list[CompileResult]]:
        """Run jobs, some of them at the same time. A job in which the compiler breaks down has no results."""
        done: dict[str, list[CompileResult]] = {}
        with ThreadPoolExecutor(self._processes) as pool:
            futures = {label: pool.submit(self._run, label, *job) for label, job in jobs.items()}
            for label, future in futures.items():
                try:
                    done[label] = future.result()
                except Exception as error:  # noqa: BLE001 - only this job fails
                    done[label], faults = [], findings_of(error)
                    if label == _USERS:  # the package itself may be sound
                        self._add_gap(f"your models were not compiled: {faults[0].sentence}")
                    else:
                        self.result.add(faults)
        return done

    def _run(self, label: str, texts: Mapping[str, bytes], tasks: Sequence[CompileTask]) -> list[CompileResult]:
        what = f"{self._package.robot.name}: loading libraries, then compiling {listed([task.title for task in tasks])}"
        jobs = self._users_jobs if label == _USERS else self._jobs
        limits = jobs.limits

        def progress() -> None:
            tell(f"{what}; {limits.used:.0f} of at most {limits.seconds:g} s of processor time")

        return msgspec.structs.replace(jobs, progress=progress).run(label, texts, tasks)

    def _motions(
        self, results: Sequence[CompileResult], trials: Sequence[Trial]
    ) -> tuple[dict[str, Series], list[Diagnostic]]:
        """Return the simulation of each trial of a job by its name, and the problem of the first trial.

        A problem of another trial is a gap.
        """
        motions = dict[str, Series]()
        for trial, result in zip(trials, results, strict=False):
            self._note_version(result)
            problem = result.problem or result.runs[0].problem
            if not problem:
                motions[trial.name] = result.runs[0].values
            elif trial is not trials[0]:
                self._add_gap(f"{trial.name} was not compared: {one_line(problem)[:_LONGEST_MESSAGE]}")
            elif result.problem:
                return {}, explain(problem, self._compiler, self._package.files)
            else:
                message = f"the robot can't be simulated: {one_line(problem)[:200]}"
                return {}, [Diagnostic(Severity.ERROR, "no-simulation", message)]
        return motions, []


def _failing(job: _Job, answers: Sequence[CompileResult]) -> Iterator[CompileTask]:
    return (task for task, answer in zip(job[1], answers, strict=False) if answer.problem)


def _task(trial: Trial) -> CompileTask:
    probe = trial.probe
    run, title = Simulation(probe.stop, probe.step, tolerance=probe.tolerance), f"the comparison ({trial.name})"
    return CompileTask(probe.model, probe.source, (run,), probe.values, title=title)


def _as_part(finding: Diagnostic) -> Diagnostic:
    """Turn an error of a user's model into a warning: the model may be a component of other models."""
    hint = "; ".join(filter(None, (finding.hint, "a component of other models need not compile by itself")))
    return msgspec.structs.replace(finding, severity=Severity.WARNING, hint=hint)


def compare_all(
    trials: Iterable[Trial], motions: Mapping[str, Series], others: Mapping[str, Series] | None = None
) -> tuple[Deviation, ...]:
    """Return the differences of simulations from expected values, or from other simulations."""
    deviations = list[Deviation]()
    for trial in trials:
        expected = trial.expected if others is None else others.get(trial.name)
        if trial.name in motions and expected is not None:
            deviations += compare(trial.compared, motions[trial.name], expected)
    return tuple(deviations)


def compare(compared: Iterable[Compared], series: Series, expected: Series) -> tuple[Deviation, ...]:
    """Return the differences from the expected values at each compared instant; infinite if one lacks a number."""
    deviations: list[Deviation] = []
    for quantity in compared:
        places = [(name, instant) for name in quantity.values for instant in quantity.instants]
        pairs = [(_number(series, *place), _number(expected, *place)) for place in places]
        # an edit may take a number away that another edit does not bring back
        differences = [0.0 if _is_same(value, other) else abs(value - other) for value, other in pairs]
        greatest = math.inf if any(map(math.isnan, differences)) else max(differences)
        value = max((abs(other) for _, other in pairs if math.isfinite(other)), default=0.0)
        deviations.append(
            Deviation(
                *(quantity.quantity, quantity.element, greatest, value, 0.0, quantity.unit),
                *(quantity.part, quantity.detail, quantity.least_tolerance),
            )
        )
    sizes: dict[tuple[str, str, str], float] = {}
    for deviation in deviations:
        kind = deviation.quantity, deviation.unit, deviation.part
        sizes[kind] = max(sizes.get(kind, 0.0), deviation.value)
    return tuple(
        msgspec.structs.replace(deviation, size=sizes[deviation.quantity, deviation.unit, deviation.part])
        for deviation in deviations
    )


def _is_same(value: float, other: float) -> bool:
    return value == other or (math.isnan(value) and math.isnan(other))


def curves(trial: Trial, series: Series) -> Iterator[Curve]:
    """Yield the curves to draw, each beside its expected curve."""
    for each in trial.over_time:
        values, expected = (
            tuple(tuple(_number(numbers, name, time) for time in each.instants) for name in each.values)
            for numbers in (series, trial.expected_over_time)
        )
        yield Curve(each.quantity, each.element, each.unit, each.instants, values, expected)


def _number(series: Series, name: str, instant: float) -> float:
    """Return the number of a variable at a time."""
    numbers, times = series.get(name), series.get("time", ())
    place = bisect.bisect_left(times, instant - _SAME_TIME)
    return numbers[place] if numbers and place < len(times) and times[place] < instant + _SAME_TIME else math.nan


def find_changes(
    trials: Iterable[Trial], motions: Mapping[str, Series], others: Mapping[str, Series]
) -> list[Deviation]:
    """Return the differences of simulations from other simulations, beyond the tolerance."""
    return [deviation for deviation in compare_all(trials, motions, others) if not deviation.agrees]


def edit_effects(
    files: Sequence[str],
    owners: Mapping[str, str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
) -> Iterator[EditEffect]:
    """Yield the effect of each edited file in `single`, then the changes in `whole` that none of these has.

    All files together have the remaining changes. Files without a change come last, as one effect.
    """

    def effect(files: Sequence[str], deviations: Sequence[Deviation]) -> EditEffect:
        return EditEffect(tuple(files), tuple(deviations), tuple(dict.fromkeys(owners[file] for file in files)))

    explained = {deviation.key for deviations in single.values() for deviation in deviations}
    rest = [deviation for deviation in whole if deviation.key not in explained]
    quiet = [file for file in (single if whole else files) if not single.get(file)]
    yield from (effect([file], deviations) for file, deviations in single.items() if deviations)
    if rest or quiet:
        yield effect(files if rest else quiet, rest)


def explain(problem: str, compiler: Compiler, package: PackageTexts, file: Path | None = None) -> list[Diagnostic]:
    """Return the findings in a compiler's text about a model; they name the user's files, not the copies.

    `file` is the file of a user's model.
    """
    users_file = str(file) if file else ""
    if (balance := _BALANCE.search(problem)) and balance[1] != balance[2]:
        equations, unknowns = (int(number.replace(",", "")) for number in balance.groups())
        lacking = abs(equations - unknowns)
        # without the model's name: the models that contain it lack as many equations, and the message is shown once
        message = f"there {'is' if lacking == 1 else 'are'} {counted(lacking, 'equation')} too "
        message += "many" if equations > unknowns else "few"
        return [_diagnostic(Complaint(message, users_file), package, "unbalanced")]
    every = compiler.complaints(problem) or [Complaint(one_line(problem))] * bool(problem.strip())
    complaints = [complaint for complaint in every if complaint.code == "does-not-compile"] or every
    own = [complaint for complaint in complaints if Path(complaint.file).is_relative_to(package.folder)]
    placed = [msgspec.structs.replace(complaint, file=complaint.file or users_file) for complaint in own or complaints]
    findings = dict.fromkeys(_diagnostic(complaint, package, "does-not-compile") for complaint in placed)
    return list(findings)[:_MOST_DIAGNOSTICS]


def explain_warnings(text: str, compiler: Compiler, package: PackageTexts) -> list[Diagnostic]:
    """Return the warnings in a compiler's text about a model that compiles; only those about files of the package."""
    complaints = dict.fromkeys(compiler.complaints(text))
    own = [complaint for complaint in complaints if Path(complaint.file).is_relative_to(package.folder)]
    findings = [_diagnostic(complaint, package, complaint.code) for complaint in own]
    return [msgspec.structs.replace(finding, severity=Severity.WARNING) for finding in findings]


def _diagnostic(complaint: Complaint, package: PackageTexts, code: str) -> Diagnostic:
    """Return a compiler's complaint as a finding. If the compiler gives no place, the edited file is likely."""
    file, message = Path(complaint.file), complaint.message.removesuffix(".")
    message = message if len(message) <= _LONGEST_MESSAGE else f"{message[: _LONGEST_MESSAGE - 1]}…"
    edited = [shown(package.folder / path) for path in sorted(package.edited)]
    look = f"look at {listed(edited)}, which {'was' if len(edited) == 1 else 'were'} edited" if edited else ""
    place = complaint.line, complaint.column
    if file.is_absolute() and file.is_relative_to(package.folder):
        path = file.relative_to(package.folder).as_posix().removeprefix(".")
        return package.diagnostic(Severity.ERROR, code, message, path, *place, hint=package.by_hand(path) or look)
    if file.is_absolute():
        return Diagnostic(Severity.ERROR, code, message, shown(file), *place, hint=look)
    where = edited[0] if len(edited) == 1 else shown(package.folder)
    return Diagnostic(Severity.ERROR, code, message, where, hint=look)
