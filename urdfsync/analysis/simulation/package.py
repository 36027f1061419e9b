"""Prepares the simulated or exported model with the robot's package on disk, and runs the compiler."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.checks import compilers, libraries
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilation import explain
from urdfsync.analysis.checks.compilers.compiler import CompileResult, CompileTask
from urdfsync.analysis.checks.jobs import Jobs
from urdfsync.analysis.checks.package import RobotPackage, read_package
from urdfsync.analysis.checks.process import limits_of
from urdfsync.analysis.checks.texts import check_around, check_layout
from urdfsync.analysis.simulation.models import Model, find_model
from urdfsync.analysis.simulation.results import SimulateOptions
from urdfsync.analysis.simulation.values import find_unknown, read_values
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain.bench import Bench
from urdfsync.engine.options import BuildOptions
from urdfsync.modelica.names import STANDARD_LIBRARIES
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.stored import StoredClasses
from urdfsync.project.config import Config, RobotConfig, find_own_library


class Prepared(msgspec.Struct, frozen=True):
    """A model with its files and libraries."""

    package: RobotPackage
    bench: Bench
    """Empty if the domain has no models to simulate."""
    model: Model
    needed: libraries.Libraries
    values: Mapping[str, str]
    """Changed values of parameters, in Modelica."""
    warnings: tuple[Diagnostic, ...]


def prepare(config: Config, robot: RobotConfig, options: SimulateOptions, *, for_export: bool = False) -> Prepared:
    """Find the model, and read the package. Raises UrdfsyncError for faults of model, package or compiler."""
    _check_compiler(options)
    request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
    package = read_package(config, robot, request)
    place = shown(robot.folder)
    if not package.on_disk:
        message, hint = f"the package of robot `{robot.name}` is not built", "run `urdfsync build`"
        raise ConfigError.of("not-built", message, place, hint=hint)
    message, hint = "the package is out of step with its source, and is used as it is", "run `urdfsync build`"
    late = Diagnostic(Severity.WARNING, "out-of-step", message, place, hint=hint)
    benches = package.inputs.domain.simulation
    bench = benches.bench(package.generation.now.snapshot, robot.target, robot.options) if benches else None
    bench = bench or Bench("", "", ())
    name = options.model or (bench.run if for_export or options.motion else "")
    name = name or ("" if options.motion else bench.test)
    if not name:
        what = "has inputs" if options.motion else "can be simulated"
        message = f"the package of robot `{robot.name}` has no model that {what}"
        raise ConfigError.of("no-model", message, hint="name one of yours with `--model`")
    model, needed = _find_model(config, options, name, package)
    return Prepared(package, bench, model, needed, read_values(options.values), () if package.in_step else (late,))


def _check_compiler(options: SimulateOptions) -> None:
    """Raise ConfigError for an unsuitable compiler, UrdfsyncError for a missing one."""
    compiler = compilers.COMPILERS[options.tool.name]
    if missing := compilers.find_missing(options.tool):
        raise UrdfsyncError(missing)
    if options.method and options.method not in compiler.METHODS:
        near = nearest(options.method, compiler.METHODS)
        hint = f"did you mean `{near}`?" if near else f"use one of {', '.join(compiler.METHODS)}"
        message = f"{compiler.TITLE} has no method `{options.method}`"
        raise ConfigError.of("method", message, hint=hint)


def _find_model(
    config: Config, options: SimulateOptions, name: str, package: RobotPackage
) -> tuple[Model, libraries.Libraries]:
    """Return the model of a name, and the libraries that the model and the package need. Raises UrdfsyncError."""
    robot, texts = package.robot, package.files.texts
    needed = libraries.find_libraries(config, robot, [*texts.values(), *package.around.values()])
    if needed.problem and not compilers.COMPILERS[options.tool.name].HAS_STANDARD_LIBRARY:
        raise UrdfsyncError(needed.problem)
    target = robot.target.package
    around = {robot.output / path: content for path, content in package.around.items() if path.endswith(".mo")}
    places = list(dict.fromkeys([robot.output, config.root, *robot.users, *libraries.search_path(robot)]))
    find = libraries.class_finder(target, needed.standard, places)
    sources = StoredClasses(target, robot.folder, texts, {**around, **package.users_files}, find)
    model = find_model(Scopes(sources), target, name, sources.content)
    library, top = model.name.partition(".")[0], target.partition(".")[0]
    if library != top and library not in STANDARD_LIBRARIES:
        file = Path(model.node.file)
        own = [package.users_files[file]] if file in package.users_files else []
        others = libraries.needed_libraries([*texts.values(), *package.around.values(), *own], top, places, [library])
        if library not in others and find_own_library(library, target) is None:
            others[library] = file  # the file's name differs from the name of its class
        needed = msgspec.structs.replace(needed, others={**needed.others, **others})
    return model, needed


def extension(name: str, model: str, modifiers: Sequence[str], lines: Iterable[str] = (), description: str = "") -> str:
    """Return the text of a model that extends another one."""
    modified = f"({', '.join(modifiers)})" if modifiers else ""
    first = f'model {name} "{description}"' if description else f"model {name}"
    return "".join(f"{line}\n" for line in (first, f"  extends {model}{modified};", *lines, f"end {name};"))


def run_task(
    prepared: Prepared,
    options: SimulateOptions,
    kind: str,
    task: CompileTask,
    plain: str,
    progress: Callable[[], None],
    changed: Mapping[Path, bytes] | None = None,
) -> CompileResult:
    """Run a task, a simulation or an export; `plain` is the task's text without changed parameters.

    For `changed` see `Jobs.run`. Raises UrdfsyncError if the model does not compile, or lacks a parameter.
    """
    package, model = prepared.package, prepared.model
    limits = limits_of(f"the {kind} of `{model.name}`", options.timeout, options.memory)
    UserCache.default().prepare()
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        jobs = Jobs(package.robot, options.tool, prepared.needed, package.around, limits, Path(folder), progress)
        (result,) = jobs.run(kind, package.files.texts, [task], changed)
        if result.problem and task.parameters:  # perhaps the model lacks the parameter
            names = msgspec.structs.replace(task, source=plain, runs=(), export=None)
            (answer,) = jobs.run("plain", package.files.texts, [names], changed)
            result = result if answer.parameters is None else answer
    check_compiled(prepared, options, task, result)
    return result


def check_compiled(prepared: Prepared, options: SimulateOptions, task: CompileTask, result: CompileResult) -> None:
    """Raise UrdfsyncError if the model of a task does not compile, or if a parameter can't be changed."""
    package, model = prepared.package, prepared.model
    faults = find_unknown(model.name, (*task.parameters, *task.varied), result.parameters)
    for name in result.structural:
        message = f"`{name}` can't be varied: the compiler evaluates it, or it is no single real number"
        faults.append(Diagnostic(Severity.ERROR, "vary", message, hint=f"simulate once per value: `--set {name}=…`"))
    for name in result.without_effect:
        message = f"`{name}` can't be changed: nothing in the compiled model depends on it"
        faults.append(
            Diagnostic(Severity.ERROR, "set", message, hint="change the parameters that its value depends on")
        )
    if result.problem:
        # compilers say little about unreadable files; checking them first would take 0.2 s of each simulation
        unread = [*check_layout(package.files), *check_around(package.robot.output, package.around)]
        if errors := [finding for finding in unread if finding.severity is Severity.ERROR]:
            raise UrdfsyncError(*errors)
        file = Path(model.node.file)
        outside = None if package.files.folder in file.parents else file
        complaints = explain(result.problem, compilers.COMPILERS[options.tool.name], package.files, file=outside)
        if names_set := ", ".join(task.parameters):
            hint = f"check whether one of these is final, or has a value of the wrong type: {names_set}"
            complaints = [msgspec.structs.replace(finding, hint=hint) for finding in complaints]
        faults += complaints
    if faults:
        raise UrdfsyncError(*faults)
