"""The package of a robot as it is on disk, and a model of it or of the user that is simulated or exported."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync.check import compilers, libraries
from urdfsync.check.package import PackageTexts, files_around, package_texts, users_files
from urdfsync.config import Config, RobotConfig, find_own_library
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.domain import Bench
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.rendering import Rendering
from urdfsync.files import shown
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.names import STANDARD_LIBRARIES
from urdfsync.modelica.scopes import Scopes
from urdfsync.simulate.models import Model, find_model
from urdfsync.simulate.results import SimulateOptions
from urdfsync.spelling import nearest


class SimulatedPackage(msgspec.Struct):
    """The package of a robot on disk, and what is around it."""

    bench: Bench
    """Empty if the domain does not say how a package is simulated."""
    texts: PackageTexts
    around: Mapping[str, bytes]
    warnings: tuple[Diagnostic, ...]


def check_compiler(options: SimulateOptions) -> None:
    """Raise ConfigError for a compiler that can't do this, UrdfsyncError for one that is not there."""
    compiler = compilers.COMPILERS[options.tool.name]
    if missing := compilers.find_missing(options.tool):
        raise UrdfsyncError(missing)
    if options.method and options.method not in compiler.METHODS:
        near = nearest(options.method, compiler.METHODS)
        hint = f"did you mean `{near}`?" if near else f"it has {', '.join(compiler.METHODS)}"
        message = f"{compiler.TITLE} has no method `{options.method}`"
        raise ConfigError(Diagnostic(Severity.ERROR, "method", message, hint=hint))


def read_package(config: Config, robot: RobotConfig, options: SimulateOptions) -> SimulatedPackage:
    """Read the package of a robot. Raises UrdfsyncError if there is none."""
    request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
    (built,) = build(config, [robot], request)
    if built.failed:
        raise UrdfsyncError(*built.diagnostics)
    texts = package_texts(robot.folder)
    if not texts:
        message, hint = f"the package of robot `{robot.name}` is not built", "run `urdfsync build`"
        raise ConfigError(Diagnostic(Severity.ERROR, "not-built", message, shown(robot.folder), hint=hint))
    rendering = Rendering(config, robot, request)
    bench = rendering.domain.bench(rendering.snapshot, robot.target, robot.options) or Bench("", "", ())
    package = PackageTexts(robot.target.package, robot.folder, texts)
    around = files_around(config, robot, texts)
    message, hint = "the package is out of step with its source; it is taken as it is", "run `urdfsync build`"
    late = Diagnostic(Severity.WARNING, "out-of-step", message, shown(robot.folder), hint=hint)
    return SimulatedPackage(bench, package, around, () if built.are_files_in_step else (late,))


def find_with_libraries(
    config: Config, robot: RobotConfig, options: SimulateOptions, name: str, package: SimulatedPackage
) -> tuple[Model, libraries.Libraries]:
    """Return the model of a name, and the libraries that it and the package need. Raises UrdfsyncError."""
    needed = libraries.find_libraries(config, robot, [*package.texts.texts.values(), *package.around.values()])
    if needed.problem and not compilers.COMPILERS[options.tool.name].HAS_STANDARD_LIBRARY:
        raise UrdfsyncError(needed.problem)
    texts, top = package.texts.texts, robot.target.package.partition(".")[0]
    around = {robot.output / path: content for path, content in package.around.items() if path.endswith(".mo")}
    is_own = f"{name.replace('.', '/')}.mo" in texts or name.startswith(f"{robot.target.package}.")
    files = {} if is_own else users_files(config, robot)
    places = [robot.output, config.root, *robot.users, *libraries.library_folders(os.environ)]

    def find(library: str) -> Path | None:
        if own := find_own_library(library, robot.target.package):
            return own
        return needed.standard.get(library) or libraries.find_library(library, places)

    sources = StoredClasses(robot.target.package, robot.folder, texts, {**around, **files}, find)
    contents = {robot.folder / path: content for path, content in texts.items()} | around | files
    decoded = {str(path): content.decode("utf-8-sig", "replace") for path, content in contents.items()}
    model = find_model(Scopes(sources), robot.target.package, name, decoded)
    library = model.name.partition(".")[0]
    if library != top and library not in STANDARD_LIBRARIES:
        file = Path(model.node.file)
        every = [*texts.values(), *package.around.values(), *([files[file]] if file in files else [])]
        found = libraries.needed_libraries(every, top, places, [library])
        if library not in found and find_own_library(library, robot.target.package) is None:
            found[library] = file  # a file of another name than its class
        needed = msgspec.structs.replace(needed, others={**needed.others, **found})
    return model, needed
