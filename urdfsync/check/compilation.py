"""Compiles and moves versions of one robot's package, each a copy in a folder where the compiler finds it."""

from __future__ import annotations

import contextlib
import os
import shutil
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.check import compilers, errors, physics
from urdfsync.check.cache import UserCache, cache_errors
from urdfsync.check.compilers.compiler import CompileJob, CompileResult, CompileTask, compile_task
from urdfsync.check.libraries import StandardLibrary
from urdfsync.check.package import CheckedPackage, write_package
from urdfsync.check.results import (
    MOST_SINGLE_EDITS,
    CheckOptions,
    CheckResult,
    CheckStep,
    CompiledModel,
    EditEffect,
)
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

Job: TypeAlias = tuple[Mapping[str, bytes], Sequence[CompileTask]]
"""The files of a package, and the tasks to do with it in one process."""


class _Outcome(msgspec.Struct):
    """What became of a job."""

    results: list[CompileResult]
    """Of the tasks, in their order; fewer if the compiler broke down."""
    folders: Mapping[Path, Path]
    """Folders that the compiler reads, and those that people know instead."""
    diagnostics: tuple[Diagnostic, ...] = ()
    """Why there are fewer."""


class CheckProgress:
    """Tells the steps of a check, also from several threads; `total` is how many there will be, as far as is known."""

    def __init__(self, result: CheckResult, tell: Callable[[CheckStep], None]) -> None:
        self._result, self._tell = result, tell
        self._lock = threading.Lock()  # steps of several compilers must not mix
        self._begun, self.total = 0, 6

    def begin(self, what: str) -> None:
        """Tell what is done next."""
        with self._lock:
            done = min(self._begun / self.total, 1.0)
            self._begun += 1
            self._tell(CheckStep(f"{self._result.robot}: {what}", done, self._result))


class Compilation:
    """The compiling of one check: what it finds goes into the result."""

    def __init__(
        self,
        package: CheckedPackage,
        options: CheckOptions,
        result: CheckResult,
        progress: CheckProgress,
        cache: UserCache,
        folder: Path,
        standard: StandardLibrary,
        standard_copy: Path,
        libraries: Mapping[str, Path],
    ) -> None:
        """`folder` is for copies of the package; `libraries` are needed besides the Modelica Standard Library."""
        self.compiler = compilers.COMPILERS[options.compiler]
        self._package, self._options, self._result, self._progress = package, options, result, progress
        self._cache, self._folder, self._libraries = cache, folder, libraries
        self._standard, self._standard_copy = standard, standard_copy
        self._users_models = package.files.models_not_in(package.generated)
        models = (*package.models, *self._users_models)
        self._tasks = {model: compile_task(f"{package.robot.target.package}.{model}") for model in models}
        progress.total = 3 + len(models)

    def compile_all(self) -> None:
        """Compile all models, in as many processes as may work at the same time."""
        count = max(1, min(self._options.compilers, len(self._package.models)))
        parts = {f"package{k}": list(self._tasks)[k::count] for k in range(count)}
        outcomes = self._run_all({label: self._job(models) for label, models in parts.items()})
        for label, models in parts.items():
            self._take(models, outcomes[label])

    def compare(self) -> None:
        """Compile all models, and move the main one: as it is generated against the reference, edited against that."""
        package, result, (main, *others) = self._package, self._result, self._tasks
        files = package.meaningful_edits
        try:
            experiment = physics.experiment(package, complete=True)
            plain = physics.experiment(package, complete=False) if files else None
        except UrdfsyncError as error:
            result.add(error.diagnostics)
            self.compile_all()
            return
        result.notes, result.reference = experiment.notes, experiment.reference
        result.unchecked += experiment.unchecked
        if package.on_disk and not package.in_step:
            result.unchecked += ("what edits do was not measured: the package is not in step with its source",)
        is_same = experiment.content == package.rendering.content
        texts = package.generated if is_same else package.rendering.package(experiment.content)
        move = [physics.moving_task(plain)] if plain else []
        # Where the package is moved as it is on disk, its main model need not be compiled by itself.
        is_moved = bool(plain) or (is_same and package.in_step and not package.edits)
        models = others if is_moved else [main, *others]
        self._progress.total += 1 + len(move)
        moving = (texts, [physics.moving_task(experiment)])
        outcomes = self._run_all({"generated": moving, "package": self._job(models, move)})
        generated, said = self._series(outcomes["generated"])
        result.add(said)
        if generated is not None:
            result.deviations = tuple(experiment.compare(generated))
        edited, said = self._series(outcomes["package"]) if plain else (None, [])
        if said:  # no fault of an edited package
            result.gaps += (f"what edits do was not measured: {said[0].message}",)
        self._take(models, outcomes["package"], len(move))
        has_moved = is_moved and (edited if plain else generated) is not None

        # The second round: what the first one asks for.
        jobs = {"main": self._job([main])} if is_moved and not has_moved else {}
        if edited is not None and not is_same:
            jobs["baseline"] = (package.generated, move)
        if edited is not None and 1 < len(files) <= MOST_SINGLE_EDITS:
            own = {path: content for path, content in package.on_disk.items() if path not in package.generated}
            for file in files:
                jobs[file] = ({**package.generated, **own, file: package.on_disk[file]}, move)
        outcomes = self._run_all(jobs)
        if has_moved:
            result.compiled += (CompiledModel(main, 0, 0),)
        elif is_moved:
            self._take([main], outcomes["main"])
        baseline, said = self._series(outcomes["baseline"]) if "baseline" in jobs else (generated, [])
        result.add(said)
        owners = package.files.owners
        cosmetic = [file for file in package.edits if file not in files]
        result.effects = tuple(EditEffect((file,), (), (owners[file],)) for file in cosmetic)
        if plain and baseline is not None and edited is not None:
            moved = {file: self._series(outcomes[file])[0] for file in files if file in jobs}
            single = {file: series for file, series in moved.items() if series is not None}
            result.effects = (*physics.find_effects(package, plain, baseline, edited, single), *result.effects)

    def _job(self, models: Sequence[str], first: Sequence[CompileTask] = ()) -> Job:
        """A job on the package as it is checked: some tasks, then models by themselves."""
        return self._package.files.texts, [*first, *(self._tasks[model] for model in models)]

    def _run_all(self, jobs: Mapping[str, Job]) -> dict[str, _Outcome]:
        """Do jobs, some at the same time; both sides are by their labels."""
        with ThreadPoolExecutor(self._options.compilers) as pool:
            outcomes = dict(zip(jobs, pool.map(self._run, jobs, jobs.values()), strict=True))
        for outcome in outcomes.values():
            self._result.add(outcome.diagnostics)
            self._result.megabytes = max([self._result.megabytes, *(one.megabytes for one in outcome.results)])
        return outcomes

    def _run(self, label: str, job: Job) -> _Outcome:
        robot, parts, (texts, todo) = self._package.robot, self._standard.parts, job
        copies = {self._standard_copy / name: path for name, path in parts.items() if path.suffix != ".mo"}
        folder = self._folder / label.replace("/", "-")
        outcome = _Outcome([], copies)
        try:
            with cache_errors(self._cache.folder):
                top = write_package(folder, robot, texts, self._package.around)
                roots = [_readable(path, folder / ".libraries") for path in self._libraries.values()]
            outcome.folders = {**copies, top: robot.output / top.name}
            tasks = tuple(self._with_imports(task) for task in todo)
            whole = CompileJob((str(self._standard_copy), *roots, str(top)), tasks)
            with contextlib.closing(compilers.run_job(self._options.compiler, whole, self._cache)) as results:
                for number, task in enumerate(tasks):
                    what = task.title.removeprefix(f"{robot.target.package}.")
                    self._progress.begin(f"{'' if number else 'loading libraries, then '}compiling {what}")
                    outcome.results.append(next(results))
        except (UrdfsyncError, OSError) as error:
            outcome.diagnostics = findings_of(error)
        return outcome

    def _with_imports(self, task: CompileTask) -> CompileTask:
        """The task with imports of libraries behind the first line of its text: rumoca loads no others."""
        first, _, rest = task.source.partition("\n")
        imports = "".join(f"  import {name};\n" for name in self._libraries if f"import {name};" not in rest)
        return msgspec.structs.replace(task, source=f"{first}\n{imports}{rest}")

    def _take(self, models: Sequence[str], outcome: _Outcome, skip: int = 0) -> None:
        """Take note of models that were compiled by themselves, behind `skip` other tasks."""
        for model, one in zip(models, outcome.results[skip:], strict=False):
            is_users = model in self._users_models
            if one.problem:
                said = self._explain(one.problem, outcome, model)
                if is_users:  # what does not compile by itself may be meant to be a part of something
                    said = [msgspec.structs.replace(each, severity=Severity.WARNING) for each in said]
                self._result.add(said)
            elif not is_users:
                self._result.compiled += (CompiledModel(model, one.unknowns, one.states),)

    def _series(self, outcome: _Outcome) -> tuple[physics.Series | None, list[Diagnostic]]:
        """The simulation that a job begins with; None, and why, if there is none."""
        if not outcome.results:
            return None, []
        result = outcome.results[0]
        if result.problem:
            return None, self._explain(result.problem, outcome, "the comparison")
        (run,) = result.runs
        if run.problem:
            message = f"the robot can't be simulated: {' '.join(run.problem.split())[:200]}"
            return None, [Diagnostic(Severity.ERROR, "no-simulation", message)]
        return run.values, []

    def _explain(self, problem: str, outcome: _Outcome, model: str) -> list[Diagnostic]:
        complaints = self.compiler.complaints(problem)
        return errors.explain(problem, complaints, self._package.files, outcome.folders, model)


def findings_of(error: UrdfsyncError | OSError) -> tuple[Diagnostic, ...]:
    """What an error says, that of the system included, as findings."""
    if isinstance(error, UrdfsyncError):
        return error.diagnostics
    place = os.fsdecode(error.filename or "")
    return (Diagnostic(Severity.ERROR, "system", error.strerror or str(error), place),)


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
