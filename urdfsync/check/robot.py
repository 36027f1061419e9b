"""The check of one robot: files, then names, then compiling and balance, then the comparison with a reference."""

from __future__ import annotations

import contextlib
import time
from pathlib import Path

import msgspec
import psutil

from urdfsync.check import compilers, libraries, texts
from urdfsync.check.cache import UserCache
from urdfsync.check.compilation import Compilation
from urdfsync.check.fingerprint import fingerprint
from urdfsync.check.package import CheckedPackage, read_package, users_models
from urdfsync.check.process import Limits
from urdfsync.check.results import CheckOptions, CheckResult, listed
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Severity, UrdfsyncError, findings_of
from urdfsync.engine.options import BuildOptions
from urdfsync.files import shown
from urdfsync.workers import tell


def check_robot(config: Config, robot: RobotConfig, options: CheckOptions, folder: Path | None = None) -> CheckResult:
    """Check one robot; copies of its package are made in `folder`, or where there is place if that is None.

    A package in step that was right is not checked again until its fingerprint is another one.
    """
    begin, cache = time.monotonic(), UserCache.default()
    memory = options.memory * 1e9 if options.memory else psutil.virtual_memory().available
    result = CheckResult(robot.name, robot.target.package)
    limits = Limits(f"the check of robot `{robot.name}`", options.timeout, memory)
    try:
        tell(f"{robot.name}: reading the source and the package")
        key = fingerprint(config, robot, options)
        request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
        package = read_package(config, robot, request)
        known = cache.load(key, CheckResult) if key and package.in_step and not options.fresh else None
        if known is None:
            _check(config, package, options, result, limits, folder)
            result.megabytes = limits.peak / 1e6
            is_same = key == fingerprint(config, robot, options)  # else somebody has saved meanwhile
            if key and package.in_step and is_same:
                cache.save(key, None if result.failed or result.differs else result)
        result = known or result
        result.add(texts.missing_resources(package))  # files that no fingerprint knows of
    except (UrdfsyncError, OSError) as error:
        result.add(findings_of(error))
    result.diagnostics = robot.without_ignored(result.diagnostics)
    result.seconds = time.monotonic() - begin
    return result


def _check(
    config: Config,
    package: CheckedPackage,
    options: CheckOptions,
    result: CheckResult,
    limits: Limits,
    folder: Path | None,
) -> None:
    """Check a package as far as this machine can; all that is found goes into the result."""
    robot = package.robot
    result.built, result.in_step, result.conflicting = bool(package.on_disk), package.in_step, package.conflicting
    bench = package.domain.bench(package.rendering.snapshot, robot.target, robot.options)
    result.freedoms = bench.freedoms if bench else None
    tell(f"{robot.name}: checking files and names")
    result.add(package.source_diagnostics)
    found = package.domain.cross_check(package.rendering.content, shown(robot.source))
    result.add(map(package.rendering.source.locate, found))
    contents = [*package.files.texts.values(), *package.generated.values(), *package.around.values()]
    uses = [name for name, _ in package.domain.uses(robot.options)]
    needed, missing = libraries.find_libraries(config, robot, contents, uses), compilers.find_missing(options.compiler)
    if reason := _check_texts(package, needed, result):
        result.gaps = (f"nothing was compiled, since {reason}",)
    elif problem := missing or needed.problem:
        is_wanted = options.physics or (options.compiler != CheckOptions().compiler if missing else config.library)
        if is_wanted:
            result.add([problem])
        result.gaps = (f"nothing was compiled: {problem.message}; {problem.hint}",)
    else:
        with contextlib.nullcontext(folder) if folder else UserCache.default().workspace() as place:
            users = users_models(robot, package.users_files)
            if users.left_out:
                files = listed([shown(path) for path in users.left_out])
                result.gaps += (f"{files} outside of the package: nothing there was compiled",)
            every = libraries.find_libraries(config, robot, [*contents, *package.users_files.values()], uses)
            every = msgspec.structs.replace(every, others={**every.others, **users.libraries})
            compilation = Compilation(package, options, result, limits, place / robot.name, needed, users, every)
            compilation.run(contents)


def _check_texts(package: CheckedPackage, needed: libraries.Libraries, result: CheckResult) -> str:
    """Check files and names; returns why nothing can be compiled, empty if it can."""
    found = texts.check_layout(package.files)
    found += texts.check_around(package.robot.output, package.around)
    result.add(found)
    if any(one.severity is Severity.ERROR for one in found):
        return "files have errors"
    own, others = texts.check_names(package, needed.standard)
    result.add([*own, *others])
    return "names in the package do not exist" if any(one.severity is Severity.ERROR for one in own) else ""
