"""The check of one robot: files, then names, then compiling and balance, then the comparison with a reference.

As a program it takes the order for one robot from stdin, and writes a line with each step to stdout.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

from urdfsync import __version__, processes
from urdfsync.check import compilers, libraries, texts
from urdfsync.check.cache import UserCache, fingerprint
from urdfsync.check.compilation import CheckProgress, Compilation, findings_of
from urdfsync.check.package import CheckedPackage, read_package
from urdfsync.check.results import CheckOptions, CheckResult, CheckStep, from_text, listed, to_text
from urdfsync.check.run import RobotOrder
from urdfsync.config import Config, RobotConfig, find_own_library, load
from urdfsync.diagnostics import Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions
from urdfsync.files import shown
from urdfsync.modelica.names import LIBRARY


def check_robot(
    config: Config, robot: RobotConfig, options: CheckOptions, tell: Callable[[CheckStep], None], folder: Path
) -> CheckResult:
    """Check one robot; `tell` gets each step before it is done, `folder` is an empty one for copies of the package."""
    result, begin = CheckResult(robot.name, robot.target.package), time.monotonic()
    progress = CheckProgress(robot.name, tell)
    try:
        progress.begin("reading the source and the package")
        request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
        package = read_package(config, robot, request)
        result.built, result.in_step, result.conflicting = bool(package.on_disk), package.in_step, package.conflicting
        result.diagnostics = package.source_diagnostics
        progress.begin("checking files and names")
        contents = [*package.files.texts.values(), *package.generated.values(), *package.around.values()]
        uses = [name for name, _ in package.domain.uses(robot.options)]
        needed = libraries.find_libraries(config, robot, contents, uses)
        if reason := _check_texts(package, needed, result):
            result.gaps = (f"nothing was compiled, since {reason}",)
        elif needed.problem is not None:
            if config.check.library is not None or options.physics:
                result.add([needed.problem])
            result.gaps = (f"nothing was compiled: {needed.problem.message}; {needed.problem.hint}",)
        else:
            result.take(_check_models(package, options, needed, contents, progress, folder))
    except (UrdfsyncError, OSError) as error:
        result.add(findings_of(error))
    result.seconds = time.monotonic() - begin
    return result


def _check_models(
    package: CheckedPackage,
    options: CheckOptions,
    needed: libraries.Libraries,
    contents: list[bytes],
    progress: CheckProgress,
    folder: Path,
) -> CheckResult:
    """Compile the package, and compare it if that is wanted; returns what came of that, perhaps from an earlier check.

    It takes 20 s for a six-axis arm, minutes for a humanoid. `contents` are all texts of the package.
    """
    robot, cache = package.robot, UserCache.default()
    key = fingerprint(  # all that compiling and comparing rests on
        *(__version__, compilers.installed_version(options.compiler, "pin"), options.physics, options.compiler),
        *(robot.target, robot.options, package.in_step, package.models, package.rendering.content),
        shown(robot.folder),  # findings name files as they are seen from the working folder
        needed.state(),
        *(sorted(files.items()) for files in (package.files.texts, package.generated, package.around)),
    )
    if known := cache.load(key, CheckResult):
        return known
    result, own = CheckResult(robot.name, robot.target.package), find_own_library(LIBRARY, robot.target.package)
    contents += [text for path in needed.others.values() for text in libraries.library_texts(path).values()]
    copy = libraries.standard_library_copy(needed.standard, contents, cache)
    used = {**({LIBRARY: own} if own else {}), **needed.others}
    compilation = Compilation(package, options, result, progress, folder, (copy, needed.standard), used)
    if options.physics and compilers.COMPILERS[options.compiler].SIMULATES:
        compilation.compare()
    else:
        if options.physics:
            result.gaps = (f"poses and efforts were not compared: `--tool {options.compiler}` only compiles",)
        else:
            result.unchecked = ("poses and efforts were not compared: `--physics` does that",)
        compilation.compile_all()
    result.compiled = tuple(sorted(result.compiled, key=lambda one: package.models.index(one.model)))
    if not (result.failed or result.gaps or result.differs):  # what is wrong or missing is looked at again
        cache.save(key, result)
    return result


def _check_texts(package: CheckedPackage, needed: libraries.Libraries, result: CheckResult) -> str:
    """Check files and names; returns why nothing can be compiled, empty if it can."""
    found = texts.check_layout(package.files)
    found += texts.check_around(package.robot.output, package.around)
    found += texts.missing_resources(package)
    result.add(found)
    if package.users_files:
        files = listed([shown(path) for path in sorted(package.users_files)])
        result.unchecked = (f"{files} outside of the package: names were checked, but nothing there was compiled",)
    if any(one.severity is Severity.ERROR and one.code != "missing-resource" for one in found):
        return "the files are not in order"
    own, others = texts.check_names(package, needed.standard)
    result.add([*own, *others])
    return "names in the package mean nothing" if any(one.severity is Severity.ERROR for one in own) else ""


def main() -> None:
    """Check the robot that is ordered."""
    answers = processes.reserve_stdout()
    order = from_text(sys.stdin.buffer.readline(), RobotOrder)
    processes.end_with_parent()

    def answer(step: CheckStep) -> None:
        answers.write(to_text(step).encode() + b"\n")
        answers.flush()

    os.chdir(order.folder)
    try:
        config = load(Path(order.config))
        (robot,) = config.select([order.robot])
    except UrdfsyncError as error:  # the configuration has changed since
        result = CheckResult(order.robot, "", diagnostics=error.diagnostics)
    else:
        result = check_robot(config, robot, order.options, answer, Path(order.workspace))
    answer(CheckStep("", 1.0, result))


if __name__ == "__main__":
    main()
