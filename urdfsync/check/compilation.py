"""Compiles and simulates versions of one robot's package, each a copy in a folder where the compiler finds it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.check import compilers
from urdfsync.check.compilers.compiler import (
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
from urdfsync.check.jobs import Jobs
from urdfsync.check.libraries import Libraries
from urdfsync.check.package import PackageTexts, RobotPackage, UsersModels
from urdfsync.check.process import Limits
from urdfsync.check.results import MOST_SINGLE_EDITS, CompiledModel, EditEffect, ToolResult, agrees, listed
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError, findings_of
from urdfsync.domain import Compared, Deviation, Experiment
from urdfsync.engine.generation import generated_texts
from urdfsync.files import shown
from urdfsync.output.phrases import counted
from urdfsync.workers import tell

_USERS = "users"
"""The job that compiles models of the user's outside of the package."""
_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_BALANCE = re.compile(r"([\d,]+) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")

_Job: TypeAlias = tuple[Mapping[str, bytes], Sequence[CompileTask]]
"""The texts of a version of the package, and what is done with it."""


class Compilation:
    """The compiling of one package by one compiler: `run` fills `result`, `diagnostics` and `gaps`."""

    def __init__(
        self,
        package: RobotPackage,
        tool: Tool,
        needed: Libraries,
        users: UsersModels,
        needed_by_users: Libraries,
        limits: Limits,
        folder: Path,
        processes: int = 1,
    ) -> None:
        """So many `processes` may compile at a time; copies of the package go below `folder`.

        The models of the user outside of the package, `users`, need more libraries than the package.
        """
        self._package, self._users, self._processes = package, users, processes
        self._jobs = Jobs(package.robot, tool, needed, package.around, limits, folder)
        # of their own: what can't be read of the user's files would keep the package from being compiled
        self._users_jobs = msgspec.structs.replace(self._jobs, needed=needed_by_users)
        self._users_models = package.files.models_not_in(package.generated.keys() | package.written)
        self._compiler = compilers.COMPILERS[tool.name]
        self.result = ToolResult(self._compiler.TITLE)
        self.diagnostics: list[Diagnostic] = []
        self.gaps: list[str] = []
        self.generated: Series | None = None
        """The motion of the package as it is generated, completed for the comparison; None without a simulation."""
        self.edited: Series | None = None
        """The motion of the package on disk, if it is edited; None without a simulation."""

    def run(self, experiment: Experiment | None) -> None:
        """Compile the package, and compare it by an experiment: 20 s for a six-axis arm, minutes for a humanoid."""
        # versions of the package are compiled beside its models, so that these need not be divided
        models = self._model_jobs(1 if experiment else max(1, min(self._processes, len(self._package.models))))
        done = self._run_all({**models, **(self._versions(experiment) if experiment else {})})
        self._note_models(models, done)
        if experiment:
            self._compare(experiment, done)

    def _versions(self, experiment: Experiment) -> dict[str, _Job]:
        """Return jobs that move the generated package and the edited one, and each edit of the user by itself."""
        package, probe = self._package, experiment.probe
        run = Simulation(probe.stop, probe.step)
        move = [CompileTask(probe.model, probe.source, (run,), probe.values, title="the comparison")]
        is_same = experiment.content == package.generation.inputs.source.content
        completed = package.generated if is_same else generated_texts(package.generation, experiment.content)
        jobs: dict[str, _Job] = {"completed": (completed, move)}
        if package.edits:
            jobs["edited"] = package.files.texts, move
            if not is_same:
                jobs["generated"] = package.generated, move
            own = {path: content for path, content in package.on_disk.items() if path not in package.generated}
            for file in package.edits if 1 < len(package.edits) <= MOST_SINGLE_EDITS else ():
                jobs[file] = {**package.generated, **own, file: package.on_disk[file]}, move
        return jobs

    def _compare(self, experiment: Experiment, done: Mapping[str, Sequence[CompileResult]]) -> None:
        """Hold the generated package against the reference, and the edited one against the generated."""
        package, compared = self._package, experiment.compared
        self.generated, faults = self._series(done["completed"])
        self.diagnostics += faults
        if self.generated is not None:
            self.result.deviations = compare(compared, self.generated, experiment.expected)
        if not package.edits:
            return
        without_edits = self.generated
        if "generated" in done:
            without_edits, faults = self._series(done["generated"])
            self.diagnostics += faults
        self.edited, faults = self._series(done["edited"])
        if faults:  # no fault of an edited package
            self.gaps.append(f"the effect of your edits was not measured: {faults[0].message}")
        if self.edited is None or without_edits is None:
            return
        alone = {file: self._series(done[file])[0] for file in package.edits if file in done}
        single = {
            file: compare(compared, series, without_edits) for file, series in alone.items() if series is not None
        }
        whole = compare(compared, self.edited, without_edits)
        self.result.effects = tuple(edit_effects(package.edits, package.files.owners, whole, single))

    def _model_jobs(self, count: int) -> dict[str, _Job]:
        """Return jobs that compile all models: those of the package in `count` parts, then the user's."""
        package, own = self._package, self._package.robot.target.package
        models = *package.models, *self._users_models
        tasks = [msgspec.structs.replace(compile_task(f"{own}.{model}"), title=model) for model in models]
        jobs: dict[str, _Job] = {
            f"models{number}": (package.files.texts, tasks[number::count]) for number in range(count)
        }
        if self._users.files:
            libraries = ("Modelica", "UrdfSync", own.partition(".")[0])
            jobs[_USERS] = package.files.texts, [compile_task(model, libraries) for model in self._users.files]
        return jobs

    def _note_models(self, jobs: Mapping[str, _Job], done: Mapping[str, Sequence[CompileResult]]) -> None:
        """Take note of the models that were compiled by themselves."""
        compiled, files, users = list[CompiledModel](), self._package.files, self._users
        failing: dict[str, list[Diagnostic]] = {}  # of the models outside of the package
        for label, (_, tasks) in jobs.items():
            is_users = label == _USERS
            for task, answer in zip(tasks, done[label], strict=False):
                self._note_version(answer)
                if answer.problem:
                    file = users.files.get(task.title) if is_users else None
                    faults = explain(answer.problem, self._compiler, files, task.title, file)
                    if is_users:
                        failing[task.title] = faults
                    else:
                        self.diagnostics += map(_as_part, faults) if task.title in self._users_models else faults
                    continue
                # another model with the same part has it under another name
                told = {(finding.file, finding.line, finding.code) for finding in self.diagnostics}
                warnings = explain_warnings(answer.warnings, self._compiler, files)
                self.diagnostics += [
                    finding for finding in warnings if (finding.file, finding.line, finding.code) not in told
                ]
                if is_users or task.title not in self._users_models:
                    compiled.append(CompiledModel(task.title, answer.unknowns, is_users))
        order = [*self._package.models, *users.files]
        self.result.compiled = tuple(sorted(compiled, key=lambda model: order.index(model.model)))
        parts = {part for model in compiled if model.is_users for part in users.uses.get(users.files[model.model], ())}
        for model, faults in failing.items():
            if users.files[model] not in parts:  # else it compiles there, which is what it is for
                self.diagnostics += map(_as_part, faults)
                self.result.failing += (model,)

    def _note_version(self, answer: CompileResult) -> None:
        if answer.version:
            self.result.tool = f"{self._compiler.TITLE} {answer.version}"

    def _run_all(self, jobs: Mapping[str, _Job]) -> dict[str, list[CompileResult]]:
        """Do jobs, some at the same time. Of one in which the compiler breaks down there are no results."""
        done: dict[str, list[CompileResult]] = {}
        with ThreadPoolExecutor(self._processes) as pool:
            futures = {label: pool.submit(self._run, label, *job) for label, job in jobs.items()}
            for label, future in futures.items():
                try:
                    done[label] = future.result()
                except (UrdfsyncError, OSError) as error:
                    done[label], faults = [], findings_of(error)
                    if label == _USERS:  # the package itself may be right
                        reason = "; ".join(filter(None, (faults[0].message, faults[0].hint)))
                        self.gaps.append(f"your models outside of the package were not compiled: {reason}")
                    else:
                        self.diagnostics += faults
        return done

    def _run(self, label: str, texts: Mapping[str, bytes], tasks: Sequence[CompileTask]) -> list[CompileResult]:
        tell(f"{self._package.robot.name}: loading libraries, then compiling {listed([task.title for task in tasks])}")
        return (self._users_jobs if label == _USERS else self._jobs).run(label, texts, tasks)

    def _series(self, results: Sequence[CompileResult]) -> tuple[Series | None, list[Diagnostic]]:
        """Return the one simulation of a job; None, and why, if there is none."""
        if not results:
            return None, []
        (result,) = results
        self._note_version(result)
        if result.problem:
            return None, explain(result.problem, self._compiler, self._package.files)
        (run,) = result.runs
        if run.problem:
            message = f"the robot can't be simulated: {one_line(run.problem)[:200]}"
            return None, [Diagnostic(Severity.ERROR, "no-simulation", message)]
        return run.values, []


def _as_part(finding: Diagnostic) -> Diagnostic:
    """Make a warning of what keeps a model of the user's from being compiled, since it may be a part of others."""
    hint = "; ".join(filter(None, (finding.hint, "a part of other models need not compile by itself")))
    return msgspec.structs.replace(finding, severity=Severity.WARNING, hint=hint)


def compare(compared: Iterable[Compared], series: Series, expected: Series) -> tuple[Deviation, ...]:
    """Return the differences from the expected values, at beginning and end; one without a number is infinite."""
    deviations: list[Deviation] = []
    for quantity in compared:
        places = [(name, instant) for name in quantity.values for instant in (0, -1)]
        pairs = [(_number(series, *place), _number(expected, *place)) for place in places]
        differences = [abs(value - other) for value, other in pairs]
        greatest = math.inf if any(map(math.isnan, differences)) else max(differences)
        value = max((abs(other) for _, other in pairs if math.isfinite(other)), default=0.0)
        deviations.append(Deviation(quantity.quantity, quantity.element, greatest, value, 0.0, quantity.unit))
    sizes: dict[tuple[str, str], float] = {}
    for deviation in deviations:
        kind = deviation.quantity, deviation.unit
        sizes[kind] = max(sizes.get(kind, 0.0), deviation.value)
    return tuple(
        msgspec.structs.replace(deviation, size=sizes[deviation.quantity, deviation.unit]) for deviation in deviations
    )


def _number(series: Series, name: str, instant: int) -> float:
    numbers = series.get(name)
    return numbers[instant] if numbers else math.nan


def edit_effects(
    files: Sequence[str],
    owners: Mapping[str, str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
) -> Iterator[EditEffect]:
    """Yield the effects of edits in `files`, each apart if possible; the rest is the effect of the others together.

    Deviations are from the generated package: `whole` of the one on disk, `single` of those with one edit each.
    """

    def effect(files: Sequence[str], deviations: Sequence[Deviation]) -> EditEffect:
        return EditEffect(tuple(files), tuple(deviations), tuple(dict.fromkeys(owners[file] for file in files)))

    changes = [deviation for deviation in whole if not agrees(deviation)]
    apart = {
        file: [deviation for deviation in deviations if not agrees(deviation)] for file, deviations in single.items()
    }
    explained = {
        (deviation.quantity, deviation.element, deviation.unit)
        for deviations in apart.values()
        for deviation in deviations
    }
    rest = [
        deviation for deviation in changes if (deviation.quantity, deviation.element, deviation.unit) not in explained
    ]
    quiet = [file for file in files if not apart.get(file)]
    yield from (effect([file], deviations) for file, deviations in apart.items() if deviations)
    if rest or quiet:
        yield effect(quiet or files, rest)


def explain(
    problem: str, compiler: Compiler, package: PackageTexts, model: str = "", file: Path | None = None
) -> list[Diagnostic]:
    """Return findings for a compiler's text about `model`, a name below the package, with the files that people know.

    `file` is that of a model of the user's outside of the package.
    """
    path = f"{model.replace('.', '/')}.mo"
    users_file = str(package.folder / path) if path in package.texts and path not in package.owners else ""
    users_file = str(file) if file else users_file
    if (balance := _BALANCE.search(problem)) and balance[1] != balance[2]:
        equations, unknowns = (int(number.replace(",", "")) for number in balance.groups())
        lacking = abs(equations - unknowns)
        # without the name of the model, since the models around it lack as many, which need not be said again
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
    """Return warnings for a compiler's text about a model that compiles, those about files of the package."""
    complaints = dict.fromkeys(compiler.complaints(text))
    own = [complaint for complaint in complaints if Path(complaint.file).is_relative_to(package.folder)]
    findings = [_diagnostic(complaint, package, complaint.code) for complaint in own]
    return [msgspec.structs.replace(finding, severity=Severity.WARNING) for finding in findings]


def _diagnostic(complaint: Complaint, package: PackageTexts, code: str) -> Diagnostic:
    """Return the finding of a complaint; if the compiler gives no place, perhaps it is in the edited file."""
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
