"""Compiles and moves versions of one robot's package, each a copy in a folder where the compiler finds it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.check import compilers, libraries
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
from urdfsync.check.package import CheckedPackage, PackageTexts, UsersModels
from urdfsync.check.process import Limits
from urdfsync.check.results import (
    MOST_SINGLE_EDITS,
    CheckResult,
    CompiledModel,
    EditEffect,
    agrees,
    listed,
)
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError, findings_of
from urdfsync.domain import Compared, Deviation, Experiment
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
    """The compiling of one package by one compiler: what it finds goes into the result."""

    def __init__(
        self,
        package: CheckedPackage,
        tool: Tool,
        processes: int,
        result: CheckResult,
        limits: Limits,
        folder: Path,
        needed: libraries.Libraries,
        users: UsersModels,
        needed_by_users: libraries.Libraries,
    ) -> None:
        """So many `processes` may compile at a time; `folder` is for copies of the package.

        `users` are models outside of the package, and need more libraries. Raises CacheError.
        """
        self._package, self._processes, self._result = package, processes, result
        texts = [*package.files.texts.values(), *package.generated.values(), *package.around.values()]
        self._jobs = Jobs(package.robot, package.around, needed, texts, tool, limits, folder)
        self._users, self._users_jobs = users, self._jobs
        if users.files:
            # of their own: what can't be read of the user's files would keep the package from being compiled
            texts += package.users_files.values()
            self._users_jobs = Jobs(package.robot, package.around, needed_by_users, texts, tool, limits, folder)
        self._compiler = compilers.COMPILERS[tool.name]
        result.tool = self._compiler.TITLE
        self._users_models = package.files.models_not_in(package.generated.keys() | package.written)
        self.version = ""
        """Of the compiler; empty until it has said something."""
        self.generated: Series | None = None
        """How the package moves as it is generated, completed for the comparison; None if it does not."""
        self.edited: Series | None = None
        """How the package on disk moves, if it is edited; None if it does not."""

    def run(self, experiment: Experiment | None) -> None:
        """Compile the package, and compare it by an experiment: 20 s for a six-axis arm, minutes for a humanoid."""
        if experiment is None:
            self._compile_all()
        else:
            self._compare(experiment)
        order = [*self._package.models, *self._users.files]
        self._result.compiled = tuple(sorted(self._result.compiled, key=lambda one: order.index(one.model)))

    def _compile_all(self) -> None:
        """Compile all models, in as many processes as may work at the same time."""
        jobs = self._model_jobs(max(1, min(self._processes, len(self._package.models))))
        self._note_models(jobs, self._run_all(jobs))

    def _compare(self, experiment: Experiment) -> None:
        """Compile all models, and move the main one: as it is generated against the reference, edited against that."""
        package, result = self._package, self._result
        is_same = experiment.content == package.rendering.content
        completed = package.generated if is_same else package.rendering.package(experiment.content)
        probe, models = experiment.probe, self._model_jobs(1)
        run = Simulation(probe.stop, probe.step)
        move = [CompileTask(probe.model, probe.source, (run,), probe.values, title="the comparison")]
        jobs = {**models, "completed": (completed, move)}
        if package.edits:  # the edited package, the generated one, and this one with each of the edits
            files = package.edits
            jobs["edited"] = package.files.texts, move
            if not is_same:
                jobs["generated"] = package.generated, move
            own = {path: content for path, content in package.on_disk.items() if path not in package.generated}
            for file in files if 1 < len(files) <= MOST_SINGLE_EDITS else ():
                jobs[file] = {**package.generated, **own, file: package.on_disk[file]}, move
        done = self._run_all(jobs)
        self._note_models(models, done)
        self.generated, said = self._series(done["completed"])
        result.add(said)
        if self.generated is not None:
            result.deviations = compare(experiment.compared, self.generated, experiment.expected)
        if package.edits:
            without_edits = self.generated
            if not is_same:
                without_edits, said = self._series(done["generated"])
                result.add(said)
            self.edited, faults = self._series(done["edited"])
            if faults:  # no fault of an edited package
                result.gaps += (f"the effect of your edits was not measured: {faults[0].message}",)
            if self.edited is None or without_edits is None:
                return
            alone = {file: self._series(done[file])[0] for file in package.edits if file in done}
            moved = {file: one for file, one in alone.items() if one is not None}
            single = {file: compare(experiment.compared, one, without_edits) for file, one in moved.items()}
            whole = compare(experiment.compared, self.edited, without_edits)
            result.effects = tuple(edit_effects(package.edits, package.files.owners, whole, single))

    def _model_jobs(self, count: int) -> dict[str, _Job]:
        """Jobs that compile all models, in `count` parts."""
        tasks = []
        for model in (*self._package.models, *self._users_models):
            task = compile_task(f"{self._package.robot.target.package}.{model}")
            tasks.append(msgspec.structs.replace(task, title=model))
        texts, own = self._package.files.texts, self._package.robot.target.package.partition(".")[0]
        jobs: dict[str, _Job] = {f"models{number}": (texts, tasks[number::count]) for number in range(count)}
        if self._users.files:
            jobs[_USERS] = texts, [compile_task(model, ("Modelica", "UrdfSync", own)) for model in self._users.files]
        return jobs

    def _note_models(self, jobs: Mapping[str, _Job], done: Mapping[str, Sequence[CompileResult]]) -> None:
        """Take note of the models that were compiled by themselves."""
        for label, (_, tasks) in jobs.items():
            for task, one in zip(tasks, done[label], strict=False):
                self._note_version(one)
                if one.problem:
                    file = self._users.files.get(task.title) if label == _USERS else None
                    said = explain(one.problem, self._compiler, self._package.files, task.title, file)
                    if label == _USERS or task.title in self._users_models:  # it may be meant to be a part of something
                        said = [msgspec.structs.replace(each, severity=Severity.WARNING) for each in said]
                    self._result.add(said)
                    self._result.failing += (task.title,) if label == _USERS else ()
                    continue
                told = {(known.file, known.line, known.code) for known in self._result.diagnostics}
                said = explain_warnings(one.warnings, self._compiler, self._package.files)
                # another model with the same part has it under another name
                self._result.add(each for each in said if (each.file, each.line, each.code) not in told)
                if label == _USERS or task.title not in self._users_models:
                    self._result.compiled += (CompiledModel(task.title, one.unknowns, label == _USERS),)

    def _note_version(self, one: CompileResult) -> None:
        if one.version:
            self.version, self._result.tool = one.version, f"{self._compiler.TITLE} {one.version}"

    def _run_all(self, jobs: Mapping[str, _Job]) -> dict[str, list[CompileResult]]:
        """Do jobs, some at the same time. Of one in which the compiler breaks down there are no results."""
        done: dict[str, list[CompileResult]] = {}
        with ThreadPoolExecutor(self._processes) as pool:
            futures = {label: pool.submit(self._run, label, *job) for label, job in jobs.items()}
            for label, future in futures.items():
                try:
                    done[label] = future.result()
                except (UrdfsyncError, OSError) as error:
                    done[label] = []
                    found = findings_of(error)
                    if label == _USERS:  # the package itself may be right
                        self._result.gaps += (
                            f"your models outside of the package were not compiled: {found[0].message}",
                        )
                    else:
                        self._result.add(found)
        return done

    def _run(self, label: str, texts: Mapping[str, bytes], tasks: Sequence[CompileTask]) -> list[CompileResult]:
        tell(f"{self._package.robot.name}: loading libraries, then compiling {listed([task.title for task in tasks])}")
        return (self._users_jobs if label == _USERS else self._jobs).run(label, texts, tasks)

    def _series(self, results: Sequence[CompileResult]) -> tuple[Series | None, list[Diagnostic]]:
        """The one simulation of a job; None, and why, if there is none."""
        if not results:
            return None, []
        (result,) = results
        self._note_version(result)
        if result.problem:
            return None, explain(result.problem, self._compiler, self._package.files)
        (run,) = result.runs
        if run.problem:
            message = f"the robot can't be simulated: {' '.join(run.problem.split())[:200]}"
            return None, [Diagnostic(Severity.ERROR, "no-simulation", message)]
        return run.values, []


def compare(compared: Iterable[Compared], found: Series, expected: Series) -> tuple[Deviation, ...]:
    """How far values are from those expected, at the beginning and at the end; what is no number is infinitely far."""
    deviations: list[Deviation] = []
    for one in compared:
        places = [(name, instant) for name in one.values for instant in (0, -1)]
        pairs = [(_number(found, *place), _number(expected, *place)) for place in places]
        differences = [abs(value - other) for value, other in pairs]
        greatest = math.inf if any(map(math.isnan, differences)) else max(differences)
        value = max((abs(other) for _, other in pairs if math.isfinite(other)), default=0.0)
        deviations.append(Deviation(one.quantity, one.element, greatest, value, 0.0, one.unit))
    sizes: dict[tuple[str, str], float] = {}
    for one_found in deviations:
        kind = one_found.quantity, one_found.unit
        sizes[kind] = max(sizes.get(kind, 0.0), one_found.value)
    return tuple(msgspec.structs.replace(one, size=sizes[one.quantity, one.unit]) for one in deviations)


def _number(series: Series, name: str, instant: int) -> float:
    numbers = series.get(name)
    return numbers[instant] if numbers else math.nan


def edit_effects(
    files: Sequence[str],
    owners: Mapping[str, str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
) -> Iterator[EditEffect]:
    """What the edits in `files` do, each apart where that can be told; what no single one does, the others do together.

    Deviations are from the generated package: `whole` of the one on disk, `single` of those with one edit each.
    """

    def effect(files: Sequence[str], found: Sequence[Deviation]) -> EditEffect:
        return EditEffect(tuple(files), tuple(found), tuple(dict.fromkeys(owners[file] for file in files)))

    changes = [one for one in whole if not agrees(one)]
    apart = {file: [one for one in found if not agrees(one)] for file, found in single.items()}
    told = {(one.quantity, one.element, one.unit) for found in apart.values() for one in found}
    rest = [one for one in changes if (one.quantity, one.element, one.unit) not in told]
    quiet = [file for file in files if not apart.get(file)]
    yield from (effect([file], found) for file, found in apart.items() if found)
    if rest or quiet:
        yield effect(quiet or files, rest)


def explain(
    problem: str, compiler: Compiler, package: PackageTexts, model: str = "", file: Path | None = None
) -> list[Diagnostic]:
    """Diagnostics for a compiler's text about `model`, a name below the package; it has the files that people know.

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
    said = compiler.complaints(problem) or [Complaint(one_line(problem))] * bool(problem.strip())
    complaints = [one for one in said if one.code == "does-not-compile"] or said
    own = [one for one in complaints if Path(one.file).is_relative_to(package.folder)]
    placed = [msgspec.structs.replace(one, file=one.file or users_file) for one in own or complaints]
    found = dict.fromkeys(_diagnostic(one, package, "does-not-compile") for one in placed)
    return list(found)[:_MOST_DIAGNOSTICS]


def explain_warnings(text: str, compiler: Compiler, package: PackageTexts) -> list[Diagnostic]:
    """Warnings for a compiler's text about a model that compiles, as far as they are about files of the package."""
    complaints = dict.fromkeys(compiler.complaints(text))
    own = [one for one in complaints if Path(one.file).is_relative_to(package.folder)]
    found = [_diagnostic(one, package, one.code) for one in own]
    return [msgspec.structs.replace(one, severity=Severity.WARNING) for one in found]


def _diagnostic(complaint: Complaint, package: PackageTexts, code: str) -> Diagnostic:
    """One complaint; where the compiler does not say where it is, perhaps in the edited file, if there is one."""
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
