"""Compiles and moves versions of one robot's package, each a copy in a folder where the compiler finds it."""

from __future__ import annotations

import os
import re
import shutil
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.check import compilers
from urdfsync.check.cache import UserCache, cache_errors
from urdfsync.check.compilers.compiler import (
    CompileJob,
    Compiler,
    CompileResult,
    CompileTask,
    Complaint,
    Simulation,
    compile_task,
)
from urdfsync.check.package import CheckedPackage, PackageTexts, write_package
from urdfsync.check.results import (
    MOST_SINGLE_EDITS,
    CheckOptions,
    CheckResult,
    CheckStep,
    CompiledModel,
    EditEffect,
    agrees,
    listed,
)
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.domain import Deviation, Experiment
from urdfsync.files import shown
from urdfsync.output.phrases import counted

_MOST_DIAGNOSTICS = 5
_LONGEST_MESSAGE = 300
_BALANCE = re.compile(r"([\d,]+) equations?(?:\(s\))?(?:,| and| for) ([\d,]+) (?:unknown|variable)")


_Job: TypeAlias = tuple[Mapping[str, bytes], Sequence[CompileTask]]
"""The texts of a version of the package, and what is done with it."""
_Series: TypeAlias = Mapping[str, Sequence[float]]


class CheckProgress:
    """Tells the steps of a check, also from several threads; `total` is how many there will be, as far as is known."""

    def __init__(self, robot: str, tell: Callable[[CheckStep], None]) -> None:
        self._robot, self._tell = robot, tell
        self._lock = threading.Lock()  # steps of several compilers must not mix
        self._begun, self.total = 0, 6

    def begin(self, what: str) -> None:
        """Tell what is done next."""
        with self._lock:
            done = min(self._begun / self.total, 1.0)
            self._begun += 1
            self._tell(CheckStep(f"{self._robot}: {what}", done))


class Compilation:
    """The compiling of one check: what it finds goes into the result."""

    def __init__(
        self,
        package: CheckedPackage,
        options: CheckOptions,
        result: CheckResult,
        progress: CheckProgress,
        folder: Path,
        standard: tuple[Path, Mapping[str, Path]],
        libraries: Mapping[str, Path],
    ) -> None:
        """`folder` is for copies of the package.

        `standard` is the folder with a copy of the Modelica Standard Library, and what it is a copy of; `libraries` are
        needed besides.
        """
        self._package, self._options, self._result, self._progress = package, options, result, progress
        self._folder, (self._standard, parts), self._libraries = folder, standard, libraries
        self._originals = {str(self._standard / name): path for name, path in parts.items() if path.suffix != ".mo"}
        self._compiler = compilers.COMPILERS[options.compiler]
        self._users_models = package.files.models_not_in(package.generated)

    def compile_all(self) -> None:
        """Compile all models, in as many processes as may work at the same time."""
        jobs = self._model_jobs(max(1, min(self._options.compilers, len(self._package.models))))
        self._note_models(jobs, self._run_all(jobs))

    def compare(self) -> None:
        """Compile all models, and move the main one: as it is generated against the reference, edited against that."""
        package, result = self._package, self._result
        try:
            experiment = self._experiment(complete=True)
            plain = self._experiment(complete=False) if package.edits else None
        except UrdfsyncError as error:
            result.add(error.diagnostics)
            self.compile_all()
            return
        result.notes, result.reference = experiment.notes, experiment.reference
        result.unchecked += experiment.unchecked
        if package.on_disk and not package.in_step:
            result.unchecked += ("what edits do was not measured: the package is not in step with its source",)
        is_same = experiment.content == package.rendering.content
        completed = package.generated if is_same else package.rendering.package(experiment.content)
        models = self._model_jobs(1)
        jobs = {**models, "completed": (completed, [_moving_task(experiment)])}
        if plain:  # the edited package, the generated one, and this one with each of the edits
            move, files = [_moving_task(plain)], package.edits
            jobs["edited"] = package.files.texts, move
            if not is_same:
                jobs["generated"] = package.generated, move
            own = {path: content for path, content in package.on_disk.items() if path not in package.generated}
            for file in files if 1 < len(files) <= MOST_SINGLE_EDITS else ():
                jobs[file] = {**package.generated, **own, file: package.on_disk[file]}, move
        done = self._run_all(jobs)
        self._note_models(models, done)
        moved, said = self._series(done["completed"])
        result.add(said)
        if moved is not None:
            result.deviations = tuple(experiment.compare(moved))
        if plain:
            if not is_same:
                moved, said = self._series(done["generated"])
                result.add(said)
            edited, faults = self._series(done["edited"])
            if faults:  # no fault of an edited package
                result.gaps += (f"what edits do was not measured: {faults[0].message}",)
            if edited is None or moved is None:
                return
            alone = {file: self._series(done[file])[0] for file in package.edits if file in done}
            single = {file: plain.compare(one, moved) for file, one in alone.items() if one is not None}
            whole = plain.compare(edited, moved)
            result.effects = tuple(edit_effects(package.edits, package.files.owners, whole, single))

    def _model_jobs(self, count: int) -> dict[str, _Job]:
        """Jobs that compile all models, in `count` parts."""
        tasks = []
        for model in (*self._package.models, *self._users_models):
            task = compile_task(f"{self._package.robot.target.package}.{model}")
            tasks.append(msgspec.structs.replace(task, title=model))
        return {f"models{number}": (self._package.files.texts, tasks[number::count]) for number in range(count)}

    def _note_models(self, jobs: Mapping[str, _Job], done: Mapping[str, Sequence[CompileResult]]) -> None:
        """Take note of the models that were compiled by themselves."""
        for label, (_, tasks) in jobs.items():
            for task, one in zip(tasks, done[label], strict=False):
                if one.problem:
                    said = explain(one.problem, self._compiler, self._package.files, task.title)
                    if task.title in self._users_models:  # it may be meant to be a part of something
                        said = [msgspec.structs.replace(each, severity=Severity.WARNING) for each in said]
                    self._result.add(said)
                elif task.title not in self._users_models:
                    self._result.compiled += (CompiledModel(task.title, one.unknowns, one.states),)

    def _experiment(self, *, complete: bool) -> Experiment:
        """The experiment for the package, with the source as it is, or `complete`. Raises UrdfsyncError without one."""
        robot, content = self._package.robot, self._package.rendering.content
        found = self._package.domain.experiment(content, shown(robot.source), robot.target, robot.options, complete)
        if found is None:
            message = "nothing can be compared: there is no reference for this package"
            raise OutputError(Diagnostic(Severity.ERROR, "no-reference", message, hint="check without `--physics`"))
        return found

    def _run_all(self, jobs: Mapping[str, _Job]) -> dict[str, list[CompileResult]]:
        """Do jobs, some at the same time. Of one in which the compiler breaks down there are no results."""
        self._progress.total = 2 + len(jobs)
        done: dict[str, list[CompileResult]] = {}
        with ThreadPoolExecutor(self._options.compilers) as pool:
            futures = {label: pool.submit(self._run, label, *job) for label, job in jobs.items()}
            for label, future in futures.items():
                try:
                    done[label] = future.result()
                except (UrdfsyncError, OSError) as error:
                    done[label] = []
                    self._result.add(findings_of(error))
        return done

    def _run(self, label: str, texts: Mapping[str, bytes], tasks: Sequence[CompileTask]) -> list[CompileResult]:
        """Do tasks with a package in a process. Problems name the files that people know, and not their copies."""
        robot, cache, folder = self._package.robot, UserCache.default(), self._folder / label.replace("/", "-")
        with cache_errors(cache.folder):
            top = write_package(folder, robot, texts, self._package.around)
            roots = [_readable(path, folder / ".libraries") for path in self._libraries.values()]
        originals = {**self._originals, str(top): robot.output / top.name}
        with_imports = []  # of libraries, behind the first line of each text: rumoca loads no others
        for task in tasks:
            first, _, rest = task.source.partition("\n")
            imports = "".join(f"  import {name};\n" for name in self._libraries if f"import {name};" not in rest)
            with_imports.append(msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}"))
        job = CompileJob((str(self._standard), *roots, str(top)), tuple(with_imports))
        self._progress.begin(f"loading libraries, then compiling {listed([task.title for task in tasks])}")
        results = []
        for one in compilers.run_job(self._options.compiler, job, cache):
            problem = one.problem
            for copy, original in originals.items():
                problem = problem.replace(copy, str(original))
            results.append(msgspec.structs.replace(one, problem=problem))
        return results

    def _series(self, results: Sequence[CompileResult]) -> tuple[_Series | None, list[Diagnostic]]:
        """The one simulation of a job; None, and why, if there is none."""
        if not results:
            return None, []
        (result,) = results
        if result.problem:
            return None, explain(result.problem, self._compiler, self._package.files)
        (run,) = result.runs
        if run.problem:
            message = f"the robot can't be simulated: {' '.join(run.problem.split())[:200]}"
            return None, [Diagnostic(Severity.ERROR, "no-simulation", message)]
        return run.values, []


def _readable(path: Path, folder: Path) -> str:
    """A library where the compiler can read it, which takes paths in UTF-8 only: else a copy in `folder`."""
    try:
        str(path).encode()
    except UnicodeEncodeError:
        copy = folder / path.name
        folder.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if path.is_dir() else shutil.copyfile)(path, copy)
        return str(copy)
    return str(path)


def _moving_task(experiment: Experiment) -> CompileTask:
    """The task that moves a package as the experiment wants."""
    probe = experiment.probe
    run = Simulation(probe.stop, probe.step)
    return CompileTask(probe.model, probe.source, (run,), probe.values, title="the comparison")


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


def explain(problem: str, compiler: Compiler, package: PackageTexts, model: str = "") -> list[Diagnostic]:
    """Diagnostics for a compiler's text about `model`, a name below the package; it has the files that people know."""
    if (balance := _BALANCE.search(problem)) and balance[1] != balance[2]:
        equations, unknowns = (int(number.replace(",", "")) for number in balance.groups())
        lacking = abs(equations - unknowns)
        # without the name of the model, since the models around it lack as many, which need not be said again
        message = f"there {'is' if lacking == 1 else 'are'} {counted(lacking, 'equation')} too "
        message += "many" if equations > unknowns else "few"
        path = f"{model.replace('.', '/')}.mo"
        is_users = path in package.texts and path not in package.owners
        return [_diagnostic(Complaint(message, str(package.folder / path) if is_users else ""), package, "unbalanced")]
    complaints = compiler.complaints(problem)
    own = [one for one in complaints if Path(one.file).is_relative_to(package.folder)]
    found = dict.fromkeys(_diagnostic(one, package, "does-not-compile") for one in own or complaints)
    return list(found)[:_MOST_DIAGNOSTICS]


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


def findings_of(error: UrdfsyncError | OSError) -> tuple[Diagnostic, ...]:
    """What an error says, that of the system included, as findings."""
    if isinstance(error, UrdfsyncError):
        return error.diagnostics
    place = os.fsdecode(error.filename or "")
    return (Diagnostic(Severity.ERROR, "system", error.strerror or str(error), place),)
