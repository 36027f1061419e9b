"""Simulates one model with the package of one robot, as it is on disk."""

from __future__ import annotations

import fnmatch
import re
import threading
import time
from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec

from urdfsync.check import compilers, libraries
from urdfsync.check.cache import UserCache
from urdfsync.check.compilation import explain
from urdfsync.check.compilers.compiler import CompileResult, CompileTask, Simulation, SimulationResult, one_line
from urdfsync.check.fingerprint import result_key
from urdfsync.check.jobs import Jobs
from urdfsync.check.package import PackageTexts
from urdfsync.check.process import limits_of
from urdfsync.check.texts import check_around, check_layout
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import Progress
from urdfsync.files import shown
from urdfsync.simulate import joints
from urdfsync.simulate.motion import ModelicaMotion, at_rest, course, read_motion
from urdfsync.simulate.package import SimulatedPackage, check_compiler, find_with_libraries, read_package
from urdfsync.simulate.results import (
    STOP,
    TOLERANCE,
    JointResult,
    PassedLimit,
    SimulateOptions,
    SimulateResult,
)
from urdfsync.simulate.values import find_unknown, modifiers, read_values

_LATER = 1.5
"""Seconds until the compiler is at work."""
_LONGEST_MESSAGE = 200
_TIME = re.compile(r"\bt(?:ime)?(?: ?= ?| )([-+.\deE]*\d)")
_OWN = r"[^.]+"
"""Matches the variables of a model itself, its inputs and outputs among them."""


class _Work(msgspec.Struct):
    """What the compiler is to do."""

    model: str
    task: CompileTask
    plain: CompileTask
    """The same model without other values of parameters."""
    texts: Mapping[str, bytes]
    around: Mapping[str, bytes]
    changed: Mapping[Path, bytes]
    """Files of libraries with another content."""
    needed: libraries.Libraries
    file: Path
    """The file of the model."""
    is_reference: bool
    """Whether an FMU is compared with it, by a command that chooses no method."""


def simulate(config: Config, robot: RobotConfig, options: SimulateOptions, progress: Progress) -> SimulateResult:
    """Simulate a model with the package of a robot. Writes nothing but the cache.

    Raises UrdfsyncError for whatever is wrong with the model, its inputs or the compiler, OSError for what can't be
    read.
    """
    begin = time.monotonic()
    check_compiler(options)
    package = read_package(config, robot, options)
    work = _prepare(config, robot, options, package)
    simulation, is_known = _run(robot, options, package.texts, work, progress)
    (run,) = work.task.runs
    found = joints.joint_results(package.bench.layouts, simulation.values, simulation.parameters)
    diagnostics = [
        *package.warnings,
        *_end(work, simulation),
        *(_warning(joint, one) for joint in found for one in joint.passed),
    ]
    if not found and any(package.bench.layouts):
        message = f"`{work.model}` has no joint of {robot.target.package}, so none is shown"
        diagnostics.append(Diagnostic(Severity.NOTE, "no-joints", message))
    return SimulateResult(
        robot=robot.name,
        model=work.model,
        stop=run.stop,
        step=run.step,
        tolerance=run.tolerance or TOLERANCE,
        joints=tuple(found),
        series=simulation.values,
        diagnostics=robot.without_ignored(diagnostics),
        seconds=time.monotonic() - begin,
        is_known=is_known,
    )


def _prepare(config: Config, robot: RobotConfig, options: SimulateOptions, package: SimulatedPackage) -> _Work:
    """Find the model and what it needs, and write the text that simulates it."""
    bench, texts, around = package.bench, package.texts.texts, package.around
    name = options.model or (bench.run if options.motion else bench.test)
    if not name:
        what = "has inputs" if options.motion else "can be simulated"
        message = f"the package of robot `{robot.name}` has no model that {what}"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-model", message, hint="name one of yours with `--model`"))
    model, needed = find_with_libraries(config, robot, options, name, package)
    settings, inputs, values = model.settings(), model.inputs(), read_values(options.values)
    stop, changed, motion = settings.get("StopTime", STOP), dict[Path, bytes](), None
    changes = modifiers(values)
    if options.motion or (inputs and options.as_exported):
        motion = read_motion(options.motion, inputs) if options.motion else at_rest(inputs, options.stop or stop)
        stop, driven = motion.times[-1], model.driven(robot.target.package)
        changed = {Path(file): text.encode() for file, text in driven.changed.items()}
        if not options.as_exported:
            changes = [*(one for one in driven.modifiers if one.partition("(")[0] not in values), *changes]
        if options.motion and options.stop and options.stop > stop:
            message = f"the motion ends at {stop:g} s, before the stop time, {options.stop:g} s"
            raise ConfigError(Diagnostic(Severity.ERROR, "motion", message, shown(options.motion)))
    elif inputs:
        names = ",".join(["time", *(one.name for one in inputs)])
        hint = f"give a CSV file with `--input`; its first line is {names}"
        raise ConfigError(Diagnostic(Severity.ERROR, "inputs", f"`{model.name}` has inputs", hint=hint))
    stop = options.stop or stop
    step = model.step(stop, options.step)
    tolerance = options.tolerance or settings.get("Tolerance", TOLERANCE)
    followed = course(motion) if motion else ModelicaMotion()
    if motion and options.motion and options.as_exported:
        followed = followed.held(motion, step)
    wanted = [_OWN, joints.pattern(bench.layouts), *(_glob(one) for one in options.variables)]
    plain = CompileTask(
        "Probe_.Probe",
        _probe(robot, model.name, followed, []),
        (Simulation(stop, step, tolerance=tolerance, method=options.method),),
        pattern="|".join(f"(?:{one})" for one in wanted if one),
        title=model.name,
    )
    source = _probe(robot, model.name, followed, changes)
    task = msgspec.structs.replace(plain, source=source, parameters=tuple(values))
    own = {path: changed.pop(robot.folder / path, content) for path, content in texts.items()}
    outside = {path: changed.pop(robot.output / path, content) for path, content in around.items()}
    return _Work(model.name, task, plain, own, outside, changed, needed, Path(model.node.file), options.as_exported)


def _probe(robot: RobotConfig, model: str, course: ModelicaMotion, changes: list[str]) -> str:
    """Return a package with a model that extends another one; it names the libraries, or rumoca loads none."""
    names = dict.fromkeys(("Modelica", robot.target.package.partition(".")[0], model.partition(".")[0]))
    imports = "".join(f"  import {name};\n" for name in names)
    changed = f"({', '.join(changes)})" if changes else ""
    lines = ["  equation", *(f"    {equation}" for equation in course.equations)] if course.equations else []
    lines = [*(f"    {one}" for one in course.declarations), *lines]
    body = "\n".join(["  model Probe", f"    extends {model}{changed};", *lines, "  end Probe;"])
    return f"package Probe_\n{imports}{course.functions}{body}\nend Probe_;\n"


def _glob(text: str) -> str:
    """Return a regular expression for a pattern of variables, in which brackets are those of Modelica."""
    return fnmatch.translate(text.replace("[", "[[]"))


def _run(
    robot: RobotConfig, options: SimulateOptions, package: PackageTexts, work: _Work, progress: Progress
) -> tuple[SimulationResult, bool]:
    """Return what a simulation gave, and whether it is that of an earlier one of the same. Raises UrdfsyncError."""
    cache, begin = UserCache.default(), time.monotonic()
    facts = work.task, *(sorted(one.items()) for one in (work.texts, work.around, work.changed))
    key = result_key(robot, [options.tool], work.needed, *facts)
    if key and (known := cache.load(key, SimulationResult)):
        return known, True
    cache.prepare()
    later = threading.Timer(_LATER, cache.trim)  # 200 ms, which go by while the compiler is at work
    later.daemon = True
    later.start()
    limits = limits_of(f"the simulation of `{work.model}`", options.timeout, options.memory)

    def tell() -> None:
        progress(f"{robot.name}: compiling and integrating, {time.monotonic() - begin:.0f} s", 0, 1)

    with cache.workspace() as folder:
        texts = [*work.texts.values(), *work.around.values()]
        jobs = Jobs(robot, work.around, work.needed, texts, options.tool, limits, folder, tell)
        (result,) = jobs.run("simulation", work.texts, [work.task], work.changed)
        if result.problem and work.task.parameters:  # perhaps since there is no such parameter
            check = msgspec.structs.replace(work.plain, runs=(), parameters=work.task.parameters)
            (plain,) = jobs.run("plain", work.texts, [check], work.changed)
            result = plain if plain.parameters else result
    simulation = _result(robot, result, options, package, work)
    is_same = key == result_key(robot, [options.tool], work.needed, *facts)  # else somebody has saved meanwhile
    if key and is_same:
        cache.save(key, None if simulation.problem else simulation)
    return simulation, False


def _result(
    robot: RobotConfig, result: CompileResult, options: SimulateOptions, package: PackageTexts, work: _Work
) -> SimulationResult:
    """Return the simulation of a result. Raises UrdfsyncError if there is none."""
    found = find_unknown(work.model, work.task.parameters, result.parameters)
    for name in result.without_effect:
        message = f"`{name}` can't be changed: nothing in the compiled model depends on it"
        found.append(Diagnostic(Severity.ERROR, "set", message, hint="change what its value is made from"))
    if result.problem:
        # of files that it can't read a compiler says little; to look at them first takes 0.2 s of each simulation
        faults = [*check_layout(package), *check_around(robot.output, work.around)]
        if errors := [one for one in faults if one.severity is Severity.ERROR]:
            raise UrdfsyncError(*errors)
        file = None if package.folder in work.file.parents else work.file
        said = explain(result.problem, compilers.COMPILERS[options.tool.name], package, file=file)
        if names := ", ".join(work.task.parameters):
            hint = f"perhaps one of these is final, or gets the wrong kind of value: {names}"
            said = [msgspec.structs.replace(one, hint=hint) for one in said]
        found += said
    found += [one for run in result.runs if not run.values for one in _end(work, run)]
    if found:
        raise UrdfsyncError(*found)
    (run,) = result.runs
    return run


def _end(work: _Work, run: SimulationResult) -> Iterator[Diagnostic]:
    """Yield why a simulation did not reach its end."""
    if run.termination:
        message = f"`{work.model}` ends the simulation at {run.values['time'][-1]:g} s: {_shortened(run.termination)}"
        yield Diagnostic(Severity.NOTE, "terminated", message, shown(work.file))
    if run.problem:
        words = _shortened(run.problem)
        moment = f"at {float(when[1]):g} s" if (when := _TIME.search(words)) else "before its end"
        begins = "initial" in words or (when is not None and float(when[1]) == 0)
        what = "does not initialise" if begins else f"stops {moment}"
        kept = f"; results until {run.values['time'][-1]:g} s are kept" if run.values else ""
        message, hint = f"the simulation of `{work.model}` {what}: {words}", ""
        if not work.is_reference:
            hint = "try another `--method` or `--tolerance`"
        yield Diagnostic(Severity.ERROR, "no-simulation", f"{message}{kept}", shown(work.file), hint=hint)


def _shortened(text: str) -> str:
    return one_line(text)[:_LONGEST_MESSAGE]


def _warning(joint: JointResult, passed: PassedLimit) -> Diagnostic:
    where = "" if joint.robot in ("", "robot") else f"{joint.robot}: "
    unit = {"position": joint.position, "speed": joint.speed, "effort": joint.effort}[passed.quantity]
    text = unit.unit if unit else ""
    message = f"{where}{joint.element}: {passed.quantity} passes its limit, {passed.limit:.4g} {text}, "
    message += f"at {passed.time:.4g} s; by up to {passed.excess:.3g} {text}, for {passed.seconds:.3g} s"
    return Diagnostic(Severity.WARNING, "limit-passed", message)
