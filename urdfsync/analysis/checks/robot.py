"""The check of one robot: files, numbers, names, then compiling and balance, then the comparison with a reference."""

from __future__ import annotations

import functools
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import msgspec

from urdfsync.analysis.checks import compilers, process, texts
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilation import Compilation
from urdfsync.analysis.checks.contents import content_hash
from urdfsync.analysis.checks.fingerprint import fingerprint
from urdfsync.analysis.checks.libraries import Libraries, find_libraries
from urdfsync.analysis.checks.names import check_names
from urdfsync.analysis.checks.package import RobotPackage, read_package, users_models
from urdfsync.analysis.checks.process import Limits, limits_of
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, ToolResult, listed
from urdfsync.analysis.checks.two_tools import run_both
from urdfsync.common.dependencies.reads import read_file
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError, findings_of
from urdfsync.common.files import shown
from urdfsync.common.processes.workers import tell
from urdfsync.domain import registry
from urdfsync.domain.experiment import Checks, Experiment, Mismatch, MissingReferenceError, Numbers, Sample
from urdfsync.engine.judgements import judge
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.sources.expansion import SourceFiles, compare
from urdfsync.engine.sources.translators import find_translator
from urdfsync.project.config import Config, RobotConfig

_STEP = 0.04
"""Seconds between two points of a curve."""


def known_check(config: Config, robot: RobotConfig) -> CheckResult | None:
    """Return an earlier check of the present package, preferably with physics; None if there is none.

    Only results of the embedded compiler without faults are remembered.
    """
    hashed = functools.cache(content_hash)
    found = (recall_check(config, robot, CheckOptions(physics=physics), hashed) for physics in (True, False))
    return next(filter(None, found), None)


def recall_check(
    config: Config, robot: RobotConfig, options: CheckOptions, hashed: Callable[..., str] = content_hash
) -> CheckResult | None:
    """Return the remembered check of a robot; None if the robot has to be checked. `hashed` as in `result_key`."""
    begin = time.monotonic()
    if options.fresh or not (key := fingerprint(config, robot, options, hashed)):
        return None
    result = UserCache.default().load(key, CheckResult)
    if result is None or (options.curves and result.reference and not result.curves):
        return None
    try:
        package = _read(config, robot, options)
        return _complete(result, package, options, begin) if package.in_step else None
    except Exception:  # noqa: BLE001 - the check meets this error, too, and reports it
        return None


def check_robot(config: Config, robot: RobotConfig, options: CheckOptions, folder: Path | None = None) -> CheckResult:
    """Check one robot; copies of its package go to `folder`, or to a temporary folder for None.

    A check of a package in step and without faults is remembered.
    """
    begin, key = time.monotonic(), fingerprint(config, robot, options)
    result = CheckResult(robot.name, robot.target.package, strict=options.strict)
    limits = limits_of(f"the check of robot `{robot.name}`", options.timeout, options.memory)
    try:
        tell(f"{robot.name}: reading the source and the package")
        package = _read(config, robot, options)
        with tempfile.TemporaryDirectory(prefix="urdfsync-", dir=folder, ignore_cleanup_errors=True) as place:
            _check(config, package, options, result, limits, Path(place))
        is_same = key == fingerprint(config, robot, options)  # if not, a file was saved meanwhile
        if key and package.in_step and is_same:
            UserCache.default().save(key, None if result.failed or result.differs else result)
        return _complete(result, package, options, begin)
    except Exception as error:  # noqa: BLE001 - only this robot fails
        result.add(findings_of(error))
    result.diagnostics = robot.without_ignored(result.diagnostics)
    result.seconds = time.monotonic() - begin
    return result


def _read(config: Config, robot: RobotConfig, options: CheckOptions) -> RobotPackage:
    request = BuildOptions(dry=True, package_paths=options.package_paths, wait=options.wait, jobs=1)
    return read_package(config, robot, request)


def _complete(result: CheckResult, package: RobotPackage, options: CheckOptions, begin: float) -> CheckResult:
    """Complete a result, which may be remembered, for this command, and return it; `begin` is its start (s)."""
    robot = package.robot
    result.robot = robot.name  # another robot may have the same inputs
    result.folder, result.strict = shown(robot.folder), options.strict  # a saved check may have other values
    result.add(texts.missing_resources(package))  # the fingerprint does not cover these files
    if options.strict:
        made, file = package.generation, shown(robot.source)
        judged = judge(package.inputs.domain, made.now, made.reading, file)
        result.add(robot.without_ignored(map(package.inputs.source.locate, judged)))
    result.diagnostics = robot.without_ignored(result.diagnostics)
    result.seconds = time.monotonic() - begin
    return result


def _check(
    config: Config, package: RobotPackage, options: CheckOptions, result: CheckResult, limits: Limits, folder: Path
) -> None:
    """Check a package as far as this machine can; add all findings to the result."""
    robot, inputs = package.robot, package.inputs
    result.built, result.in_step, result.conflicting = bool(package.on_disk), package.in_step, package.conflicting
    result.edited = package.changed
    checks = inputs.domain.checks
    result.freedoms = checks.freedoms(package.generation.now.snapshot, robot.options) if checks else None
    tell(f"{robot.name}: checking files and names")
    result.add(package.errors)
    faults = [*texts.check_layout(package.files), *texts.check_around(robot.output, package.around)]
    result.add(faults)
    if any(finding.severity is Severity.ERROR for finding in faults):
        result.gaps = ("nothing was compiled, since files have errors",)
        return
    if checks:
        _compare_numbers(checks, package, result)
    _compare_translation(config, package, result)
    contents = [*package.files.texts.values(), *package.generated.values(), *package.around.values()]
    uses = [name for name, _ in inputs.domain.uses(robot.options)]
    needed = find_libraries(config, robot, contents, uses)
    names = check_names(package, needed.standard)
    result.add([*names.package, *names.users])
    if any(finding.severity is Severity.ERROR for finding in names.package):
        result.gaps = ("nothing was compiled, since the package uses missing names",)
        return
    if problem := _find_missing(config, options, needed, result):
        result.gaps = (f"nothing was compiled: {problem.message}; {problem.hint}",)
        return
    users = users_models(robot, {**package.own_files, **names.users_files}, names.uses)
    if users.left_out:
        files = listed([shown(path) for path in users.left_out])
        result.gaps += (f"{files} outside of the package: nothing there was compiled",)
    every = find_libraries(config, robot, [*contents, *names.users_files.values()], uses)
    every = msgspec.structs.replace(every, others={**every.others, **users.libraries})
    try:
        experiment = _experiment(package, options, result, limits)
    except MissingReferenceError as error:  # told before minutes of compiling
        (problem,) = error.diagnostics
        result.gaps = (f"nothing was compiled: {problem.message}; {problem.hint}, or check without `--physics`",)
        return
    answers = [result] if len(options.tools) == 1 else [ToolResult() for _ in options.tools]
    compilations = [
        Compilation(package, tool, needed, users, every, limits, folder / tool.name, options.compilers, answer)
        for tool, answer in zip(options.tools, answers, strict=True)
    ]
    if len(compilations) == 1:
        compilations[0].run(experiment)
    else:
        first, second = compilations
        run_both(first, second, experiment, result)


def _compare_numbers(checks: Checks, package: RobotPackage, result: CheckResult) -> None:
    """Compare the numbers of a package with its source; write `numbers`, `gaps` and `unchecked` of the result.

    A difference only on disk is the user's edit.
    """
    tell(f"{package.robot.name}: reading the source again")
    source, snapshot = package.inputs.source, package.generation.now.snapshot
    on_disk = package.on_disk if package.in_step else package.generated
    try:
        generated, present = checks.numbers(_sample(package), snapshot, package.generated, on_disk)
    except UrdfsyncError as error:
        result.gaps += (f"numbers were not compared: {error.diagnostics[0].message}",)
        return

    def located(differences: Iterable[Mismatch]) -> Iterator[Mismatch]:
        for each in differences:
            place = source.locate(Diagnostic(Severity.NOTE, "", "", each.source, each.source_line))
            yield msgspec.structs.replace(each, source=place.file, source_line=place.line)

    faults = {(each.file, each.element, each.quantity) for each in generated.differences}
    edits = (each for each in present.differences if (each.file, each.element, each.quantity) not in faults)
    result.numbers = msgspec.structs.replace(
        present, differences=tuple(located(generated.differences)), edits=tuple(located(edits))
    )
    result.unchecked += present.uncompared
    if package.robot.templates is not None:
        result.unchecked += ("the models of your own `templates`, except their motion with `--physics`",)


def _compare_translation(config: Config, package: RobotPackage, result: CheckResult) -> None:
    """Compare a translated source with the reference of its own format; other sources have none."""
    robot, made = package.robot, package.inputs.source.expansion
    if made is None or robot.command:
        return
    try:
        translator = find_translator(robot.domain, robot.source, read_file(robot.source))
        if translator is None or not translator.compares:
            return
        inputs = SourceFiles(config.root, robot.source, robot.package_paths)
        answer = compare(inputs, robot.arguments or {}, made.text, translator)
    except (OSError, UrdfsyncError) as error:
        result.gaps += (f"the translation was not compared with its source: {error}",)
        return
    for difference in answer.differences:
        hint = "please report this, with the source: the translation is wrong"
        diagnostic = Diagnostic(Severity.ERROR, "translation-differs", difference, shown(robot.source), hint=hint)
        result.add([diagnostic])
    numbers, right = result.numbers or Numbers(), 0 if answer.differences else answer.compared
    result.numbers = msgspec.structs.replace(
        numbers, right=numbers.right + right, total=numbers.total + answer.compared
    )
    result.unchecked += answer.uncompared


def _sample(package: RobotPackage) -> Sample:
    robot, source, imports = package.robot, package.inputs.source, package.generation.now.imports or {}
    place = shown(robot.source)
    return Sample(source.content, place, robot.target, robot.options, imports, package.on_disk, source.companions)


def _find_missing(config: Config, options: CheckOptions, needed: Libraries, result: CheckResult) -> Diagnostic | None:
    """Return why nothing can be compiled; it is an error if the user named the missing part."""
    missing = next(filter(None, map(compilers.find_missing, options.tools)), None)
    has_library = all(compilers.COMPILERS[tool.name].HAS_STANDARD_LIBRARY for tool in options.tools)
    problem = missing or (None if has_library else needed.problem)
    is_wanted = options.tools != CheckOptions().tools if missing else config.check.library
    if problem and is_wanted:
        result.add([problem])
    return problem


def _experiment(package: RobotPackage, options: CheckOptions, result: CheckResult, limits: Limits) -> Experiment | None:
    """Return the experiment for the package; None if there is none, with the reason in the result.

    Raises MissingReferenceError.
    """
    robot = package.robot
    if registry.domain(robot.domain).checks is None:
        return None
    if not options.physics:
        result.unchecked += ("poses and efforts were not compared; `--physics` compares them",)
        return None
    tell(f"{robot.name}: asking the reference")
    try:
        sample = _sample(package)
        step = _STEP if options.curves else None
        (experiment,) = process.run(_experiments, robot.domain, sample, step, limits=limits)
    except MissingReferenceError:
        raise
    except UrdfsyncError as error:
        result.add(error.diagnostics)
        return None
    except process.BrokenProcessError as error:
        message, hint = f"the reference crashed: {error}", "check without `--physics`"
        result.add([Diagnostic(Severity.ERROR, "reference-crashed", message, shown(robot.source), hint=hint)])
        return None
    if not isinstance(experiment, Experiment):
        result.gaps += (f"poses, efforts and masses were not compared: {experiment}",)
        return None
    result.notes, result.reference = experiment.notes, experiment.reference
    result.unchecked += experiment.unchecked
    if package.edits and experiment.options != robot.options:
        result.gaps += ("the effect of your edits was not measured, since the compared package is simpler",)
    if package.on_disk and not package.in_step:
        result.unchecked += ("the effect of your edits was not measured: the package is not in step with its source",)
    return experiment


def _experiments(domain: str, sample: Sample, step: float | None) -> Iterator[Experiment | str]:
    """Yield the experiment of a domain, in a process of its own."""
    checks = registry.domain(domain).checks
    yield checks.experiment(sample, step) if checks else "there is no reference for packages of this domain"
