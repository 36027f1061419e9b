"""The check of one robot: files, then names, then compiling and balance, then the comparison with a reference."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import msgspec

from urdfsync import __version__
from urdfsync.check import compilers, layout, libraries, names
from urdfsync.check.cache import UserCache, fingerprint
from urdfsync.check.compilation import CheckProgress, Compilation, findings_of
from urdfsync.check.package import CheckedPackage, missing_resources, read_package
from urdfsync.check.results import CheckOptions, CheckResult, CheckStep, listed
from urdfsync.config import Config, RobotConfig, library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions
from urdfsync.modelica.names import LIBRARY

_COMPILED_FIELDS = ("compiled", "deviations", "effects", "notes", "reference", "megabytes")
"""Fields of the result that follow from compiling alone."""


def check_robot(
    config: Config, robot: RobotConfig, options: CheckOptions, tell: Callable[[CheckStep], None], folder: Path
) -> CheckResult:
    """Check one robot; `tell` gets the result as it grows, `folder` is an empty one for copies of the package."""
    result, begin = CheckResult(robot.name, robot.target.package), time.monotonic()
    progress = CheckProgress(result, tell)
    try:
        progress.begin("reading the source and the package")
        request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
        package = read_package(config, robot, request)
        result.built, result.in_step, result.conflicting = bool(package.on_disk), package.in_step, package.conflicting
        result.diagnostics = package.source_diagnostics
        progress.begin("checking files and names")
        if reason := _check_texts(package, result):
            result.gaps = (f"nothing was compiled, since {reason}",)
        else:
            _check_models(package, options, result, progress, folder)
    except (UrdfsyncError, OSError) as error:
        result.add(findings_of(error))
    result.seconds = time.monotonic() - begin
    return result


def _check_texts(package: CheckedPackage, result: CheckResult) -> str:
    """Check files and names; returns why nothing can be compiled, empty if it can."""
    robot = package.robot
    found = layout.check_layout(package.files)
    found += layout.check_around({robot.output / path: content for path, content in package.around.items()})
    message, hint = "this is no regular file, so it was not looked at", "put the file itself here, or take it away"
    found += [Diagnostic(Severity.WARNING, "no-file", message, shown(path), hint=hint) for path in package.irregular]
    found += missing_resources(package)
    result.add(found)
    if package.users_files:
        files = listed([shown(path) for path in sorted(package.users_files)])
        result.unchecked = (f"{files} outside of the package: names were checked, but nothing there was compiled",)
    if any(one.severity is Severity.ERROR and one.code != "missing-resource" for one in found):
        return "the files are not in order"
    own, others = names.check_names(package)
    result.add([*own, *others])
    return "names in the package mean nothing" if any(one.severity is Severity.ERROR for one in own) else ""


def _check_models(
    package: CheckedPackage, options: CheckOptions, result: CheckResult, progress: CheckProgress, folder: Path
) -> None:
    """Compile the package, and compare it if that is wanted; without the MSL say why that is not done."""
    robot, configured = package.robot, package.config.check.library
    try:
        standard = libraries.find_standard_library(os.environ, configured)
    except libraries.LibraryError as error:
        (missing,) = error.diagnostics
        if configured is not None or options.physics:
            result.add([missing])
        result.gaps = (f"nothing was compiled: {missing.message}; {missing.hint}",)
        return
    progress.begin("looking for libraries")
    cache, top = UserCache.default(), robot.target.package.partition(".")[0]
    texts = [*package.files.texts.values(), *package.generated.values(), *package.around.values()]
    uses = [name for name, _ in package.domain.uses(robot.options)]
    others = libraries.needed_libraries(texts, top, libraries.search_path(robot), uses)
    key = _result_key(package, options, {**standard.parts, **others})
    if known := cache.load(key, CheckResult):  # compiling takes 20 s for a six-axis arm, minutes for a humanoid
        for name in _COMPILED_FIELDS:
            setattr(result, name, getattr(known, name))
        result.unchecked += known.unchecked
        result.add(known.diagnostics)
        return
    texts += [text for path in others.values() for text in libraries.library_texts(path).values()]
    copy = libraries.standard_library_copy(standard, texts, cache)
    used = {**({LIBRARY: library_folder() / LIBRARY} if top != LIBRARY else {}), **others}
    before, said = result.diagnostics, result.unchecked
    compilation = Compilation(package, options, result, progress, cache, folder, standard, copy, used)
    if options.physics and compilation.compiler.SIMULATES:
        compilation.compare()
    else:
        if options.physics:
            result.gaps = (f"poses and efforts were not compared: `--tool {options.compiler}` only compiles",)
        else:
            result.unchecked += ("poses and efforts were not compared: `--physics` does that",)
        compilation.compile_all()
    result.compiled = tuple(sorted(result.compiled, key=lambda one: package.models.index(one.model)))
    if not (result.failed or result.gaps or result.differs):  # what is wrong or missing is looked at again
        new = tuple(one for one in result.diagnostics if one not in before)
        added = result.unchecked[len(said) :]
        cache.save(key, msgspec.structs.replace(result, diagnostics=new, unchecked=added))


def _result_key(package: CheckedPackage, options: CheckOptions, paths: Mapping[str, Path]) -> str:
    """SHA-256 (hex) over all that compiling and comparing a package rests on; `paths` are those of its libraries."""
    robot = package.robot
    return fingerprint(
        *(__version__, compilers.installed_version(options.compiler, "pin"), options.physics, options.compiler),
        *(robot.target, robot.options, package.in_step, package.models, package.rendering.content),
        [(name, str(path), libraries.library_state(path)) for name, path in sorted(paths.items())],
        *(sorted(texts.items()) for texts in (package.files.texts, package.generated, package.around)),
    )
