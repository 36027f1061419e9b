"""The check of one robot: files and names, then compiling and balance, then the comparison with a reference."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib.metadata
import importlib.util
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import msgspec

from urdfsync import __version__
from urdfsync.check import errors, files, layout, libraries, names
from urdfsync.check.cache import UserCache
from urdfsync.check.collector import ResultCollector, Step
from urdfsync.check.compilation import PackageCompiler, PackageVersion
from urdfsync.check.compilers.compiler import CompileResult, compile_task
from urdfsync.check.libraries import StandardLibrary
from urdfsync.check.package import CheckedPackage
from urdfsync.check.physics import PhysicsCheck
from urdfsync.check.results import CheckOptions, CheckResult, CompiledModel, from_text, to_text
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.options import BuildOptions
from urdfsync.files import put

_MODULES = {"pin": "pinocchio"}  # by distribution, where that has another name


def check_robot(config: Config, robot: RobotConfig, options: CheckOptions, tell: Callable[[Step], None]) -> CheckResult:
    """Check one robot; `tell` gets the result as it grows."""
    collector = ResultCollector(robot.name, robot.target.package, tell)
    collector.expect(6)  # until more is known
    with collector.errors():
        with collector.step("reading the source and the package"):
            request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
            package = CheckedPackage(config, robot, request)
        collector.set(built=package.is_built, in_step=package.in_step, conflicting=bool(package.build_result.conflicts))
        collector.add(diagnostics=package.source_diagnostics())
        with collector.step("checking files and names"):
            reason = _check_texts(package, collector)
        if reason:
            collector.add(gaps=[f"nothing was compiled, since {reason}"])
        else:
            _check_models(package, options, collector)
    return collector.result


def _check_texts(package: CheckedPackage, collector: ResultCollector) -> str:
    """Check files and names; why nothing can be compiled, empty if it can."""
    robot = package.robot
    found = list(layout.check_layout(package.files))
    found += layout.check_around({robot.output / path: content for path, content in package.around.items()})
    if package.is_built:
        message, hint = "this is no regular file, so it was not looked at", "put the file itself here, or take it away"
        for path in files.irregular_files(robot.folder):
            found.append(Diagnostic(Severity.WARNING, "no-file", message, shown(path), hint=hint))
        found += package.missing_resources()
    collector.add(diagnostics=found)
    if any(one.severity is Severity.ERROR and one.code != "missing-resource" for one in found):
        return "the files are not in order"
    own, others = names.check_names(package)
    collector.add(diagnostics=[*own, *others])
    return "names in the package mean nothing" if any(one.severity is Severity.ERROR for one in own) else ""


def _check_models(package: CheckedPackage, options: CheckOptions, collector: ResultCollector) -> None:
    """Compile the package, and compare it if that is wanted; without the MSL say why that is not done."""
    configured = package.config.check.library
    try:
        standard = libraries.find_standard_library(os.environ, configured)
    except libraries.LibraryError as error:
        (missing,) = error.diagnostics
        if configured is not None or options.physics:
            collector.add(diagnostics=[missing])
        collector.add(gaps=[f"nothing was compiled: {missing.message}; {missing.hint}"])
        return
    cache = UserCache.default()
    name = hashlib.sha256(f"{package.config.file}\0{package.robot.name}".encode()).hexdigest()[:16]
    with cache.workspace(name) as folder:
        compiler = PackageCompiler(package, standard, options.compiler, cache, folder)
        with collector.step("looking for libraries"):
            version = compiler.put("package", package.texts)
        file = cache.results / f"{_models_key(package, standard, version, options)}.json"
        if not _take_known_result(file, collector):
            before = collector.result
            _Models(package, compiler, version, options, collector).check()
            _keep_result(file, before, collector.result)


# Checking an unchanged package again would compile it again: 20 s for a six-axis arm, minutes for a humanoid.


def _models_key(
    package: CheckedPackage, standard: StandardLibrary, version: PackageVersion, options: CheckOptions
) -> str:
    """SHA-256 (hex) over all that compiling and comparing a package rests on."""
    robot, paths = package.robot, {**standard.parts, **version.libraries}
    programs = [name for name in ("rumoca", "OMPython", "pin") if importlib.util.find_spec(_MODULES.get(name, name))]
    facts = (
        *(__version__, [importlib.metadata.version(name) for name in programs], options.physics, options.compiler),
        *(robot.target, robot.options, package.in_step, package.models, package.rendering.content),
        [(name, str(path), libraries.library_state(path)) for name, path in sorted(paths.items())],
        *(sorted(texts.items()) for texts in (package.texts, package.generated, package.around)),
    )
    return hashlib.sha256(repr(facts).encode(errors="surrogateescape")).hexdigest()


def _take_known_result(file: Path, collector: ResultCollector) -> bool:
    """Take what an earlier check of the same found; whether there was one."""
    try:
        known = from_text(file.read_bytes(), CheckResult)
    except (OSError, ValueError):
        return False
    for name in ("compiled", "deviations", "effects", "notes", "reference", "megabytes"):
        collector.set(**{name: getattr(known, name)})
    collector.add(unchecked=known.unchecked, diagnostics=known.diagnostics)
    return True


def _keep_result(file: Path, before: CheckResult, result: CheckResult) -> None:
    """Keep what was found, unless anything is wrong or was not checked: that is looked at again."""
    if result.failed or result.gaps or result.differs:
        return
    new = tuple(one for one in result.diagnostics if one not in before.diagnostics)
    with contextlib.suppress(OSError):  # a cache that can't be written to is none
        file.parent.mkdir(exist_ok=True)
        put(file, to_text(msgspec.structs.replace(result, diagnostics=new)).encode())


class _Models:
    """What a compiler has to do for one robot."""

    def __init__(
        self,
        package: CheckedPackage,
        compiler: PackageCompiler,
        version: PackageVersion,
        options: CheckOptions,
        collector: ResultCollector,
    ) -> None:
        self._package, self._compiler, self._version = package, compiler, version
        self._options, self._collector = options, collector

    def check(self) -> None:
        """Compile, and compare if that is wanted."""
        models, collector = list(self._package.models), self._collector
        users_models = self._package.files.models_not_in(self._package.generated)
        collector.expect(len(models) + len(users_models) + self._options.physics)
        if self._options.physics and self._options.compiler == "rumoca":
            physics = PhysicsCheck(self._package, self._compiler, self._version, collector)
            self._do([*physics.first_jobs(), *self._compile_jobs(models[1:], processes=1)])
            self._do(physics.second_jobs())
            with collector.errors():
                physics.find_effects()
            if models[0] not in [one.model for one in collector.result.compiled]:
                self._do(self._compile_jobs(models[:1], processes=1))
        else:
            if self._options.physics:
                reason = f"`--tool {self._options.compiler}` only compiles"
                collector.add(gaps=[f"poses and efforts were not compared: {reason}"])
            else:
                collector.add(unchecked=["poses and efforts were not compared: `--physics` does that"])
            self._do(self._compile_jobs(models, self._options.compilers))
        if users_models:
            self._do([functools.partial(self._compile_users_models, users_models)])
        compiled = collector.result.compiled
        collector.set(compiled=tuple(sorted(compiled, key=lambda one: models.index(one.model))))

    def _compile_jobs(self, models: Sequence[str], processes: int) -> list[Callable[[], None]]:
        """The models by themselves, in as many processes as may work."""
        count = max(1, min(processes, len(models)))
        return [functools.partial(self._compile_models, models[k::count]) for k in range(count) if models[k::count]]

    def _compile_models(self, models: Sequence[str]) -> None:
        for model, result in self._compile(models):
            if result.problem:
                self._collector.add(diagnostics=self._explain(model, result))
            else:
                self._collector.add(compiled=[CompiledModel(model, result.unknowns, result.states)])

    def _compile_users_models(self, models: Sequence[str]) -> None:
        """Models that no other need contain: what does not compile by itself may be meant so."""
        for model, result in self._compile(models):
            if result.problem:
                found = self._explain(model, result)
                warnings = (msgspec.structs.replace(one, severity=Severity.WARNING) for one in found)
                self._collector.add(diagnostics=warnings)

    def _compile(self, models: Sequence[str]) -> Iterator[tuple[str, CompileResult]]:
        """Compile models one after the other in one process."""
        tasks = [compile_task(f"{self._package.robot.target.package}.{model}") for model in models]
        with contextlib.closing(self._compiler.run(self._version, tasks)) as results:
            for number, model in enumerate(models):
                with self._collector.step(f"{'' if number else 'loading libraries, then '}compiling {model}"):
                    result = next(results)
                self._collector.add_memory(result.megabytes)
                yield model, result

    def _explain(self, model: str, result: CompileResult) -> Sequence[Diagnostic]:
        folders = self._compiler.known_folders(self._version)
        said = self._collector.result.diagnostics
        return errors.explain(result.problem, self._package.files, folders, said, model)

    def _do(self, jobs: Sequence[Callable[[], None]]) -> None:
        """Do jobs, some at the same time; what goes wrong with one is a finding."""

        def do(job: Callable[[], None]) -> None:
            with self._collector.errors():
                job()

        with ThreadPoolExecutor(self._options.compilers) as pool:
            list(pool.map(do, jobs))
