"""Simulates one model with the package of one robot on disk."""

from __future__ import annotations

import fnmatch
import math
import re
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers import rumoca
from urdfsync.analysis.checks.compilers.compiler import CompileTask, Simulation, SimulationResult, one_line
from urdfsync.analysis.checks.fingerprint import result_key
from urdfsync.analysis.simulation import joints
from urdfsync.analysis.simulation.models import Model
from urdfsync.analysis.simulation.motion import ModelicaMotion, at_rest, find_overshoots, in_modelica, read_motion
from urdfsync.analysis.simulation.package import Prepared, extension, prepare, run_task
from urdfsync.analysis.simulation.results import (
    STOP,
    TOLERANCE,
    JointResult,
    PassedLimit,
    SimulateOptions,
    SimulateResult,
)
from urdfsync.analysis.simulation.values import modifiers
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig

_LATER = 1.5
"""Seconds of compiling after which the cache is trimmed."""
_LONGEST_MESSAGE = 200
_MOST_POINTS = 10_000_000
"""The greatest number of instants with results: for a small robot, they take some gigabytes of memory."""
_ROUNDING = 1e-9
"""The error that a quotient of two times may have."""
_TIME = re.compile(r"\bt(?:ime)?(?: ?= ?| )([-+.\deE]*\d)")
_LONG = 60
"""The processor time in s from which on it is told before."""
_OWN = r"[^.]+"
"""Matches the variables of a model itself, its inputs and outputs among them."""


def simulate(config: Config, robot: RobotConfig, options: SimulateOptions, progress: Progress) -> SimulateResult:
    """Simulate a model with the package of a robot. Writes nothing but the cache.

    Raises UrdfsyncError for faults of the model, its inputs or the compiler, OSError for unreadable files.
    """
    return simulate_prepared(robot, prepare(config, robot, options), options, progress)


def simulate_prepared(
    robot: RobotConfig, prepared: Prepared, options: SimulateOptions, progress: Progress
) -> SimulateResult:
    """Simulate a prepared model, as `simulate` does."""
    begin = time.monotonic()
    layouts, model = prepared.bench.layouts, prepared.model
    simulation, run, is_known = _run(options, prepared, progress)
    results = joints.joint_results(layouts, simulation.values, simulation.parameters)
    diagnostics = [
        *prepared.warnings,
        *_end(model, options, simulation),
        *_unmatched(options.variables, simulation),
        *(find_overshoots(read_motion(options.motion, model.inputs()), options.motion) if options.motion else ()),
        *(_warning(joint, passed) for joint in results for passed in joint.passed),
    ]
    if not results and any(layouts):
        message = f"`{model.name}` has no joint of {robot.target.package}, so none is shown"
        diagnostics.append(Diagnostic(Severity.NOTE, "no-joints", message))
    return SimulateResult(
        robot=robot.name,
        model=model.name,
        stop=run.stop,
        step=run.step,
        tolerance=run.tolerance or TOLERANCE,
        joints=tuple(results),
        series=simulation.values,
        diagnostics=robot.without_ignored(diagnostics),
        seconds=time.monotonic() - begin,
        is_known=is_known,
        loops=tuple(joints.loop_results(prepared.bench, simulation.values)),
    )


def _run(options: SimulateOptions, prepared: Prepared, progress: Progress) -> tuple[SimulationResult, Simulation, bool]:
    """Return a simulation, its settings, and whether it was remembered. Raises UrdfsyncError."""
    cache, begin, package, model = UserCache.default(), time.monotonic(), prepared.package, prepared.model
    task, plain, changed = simulation_task(options, prepared)
    (run,) = task.runs
    facts = task, *(sorted(files.items()) for files in (package.files.texts, package.around, changed))
    key = result_key(package.robot, [options.tool], prepared.needed, *facts)
    if key and (earlier := cache.load(key, SimulationResult)):
        return earlier, run, True
    later = threading.Timer(_LATER, cache.trim)  # trimming takes 200 ms, so it is done while the compiler is busy
    later.daemon = True
    later.start()

    progress(f"{package.robot.name}: {_beginning(prepared, options)}", 0, 1)

    def tell() -> None:
        progress(f"{package.robot.name}: compiling and integrating, {time.monotonic() - begin:.0f} s", 0, 1)

    (simulation,) = run_task(prepared, options, "simulation", task, plain, tell, changed).runs
    if shorter := _until(run, simulation):  # compilers return no result of a run that stops
        part_task = msgspec.structs.replace(task, runs=(shorter,))
        (part,) = run_task(prepared, options, "simulation", part_task, plain, tell, changed).runs
        simulation = msgspec.structs.replace(part, problem=simulation.problem)
    if not simulation.values:
        raise UrdfsyncError(*_end(model, options, simulation))
    is_same = key == result_key(package.robot, [options.tool], prepared.needed, *facts)  # if not, a file was saved
    if key and is_same:
        cache.save(key, None if simulation.problem else simulation)
    return simulation, run, False


def _beginning(prepared: Prepared, options: SimulateOptions) -> str:
    """Return what begins, in words; for a large model of a package also how long it takes, and what is quicker."""
    bench, name, target = prepared.bench, prepared.model.name, prepared.package.robot.target.package
    tool, axes = compilers.COMPILERS[options.tool.name], len(bench.layouts[0]) if bench.layouts else 0
    words = f"compiling {name} with {tool.TITLE}"
    # fitted to chains of 6 to 43 axes, of 60 by record, by rumoca 0.10.2: tests/benchmarks/axes.py, docs/speed.md
    seconds, gigabytes, by_record = 8 + 0.075 * axes**2.3, 0.2 + 0.005 * axes**2, 7 + 0.023 * axes**2
    is_package = name in (f"{target}.{bench.test}", f"{target}.{bench.run}") and bench.test != bench.generic
    if tool is not rumoca or not is_package or seconds < _LONG:
        return words
    generic = f"`--model {bench.generic}`" if bench.generic else "the generic robot (`approach`)"
    most = "much more than" if bench.loops else "some"
    words += f", {axes} axes: {most} {seconds:.0f} s of processor time and {gigabytes:.1f} GB of memory"
    if bench.loops:  # which the generic robot does not close
        return f"{words}; `--tool openmodelica` takes less time"
    return f"{words}; {generic} takes some {by_record:.0f} s, `--tool openmodelica` less time as well"


def _until(run: Simulation, simulation: SimulationResult) -> Simulation | None:
    """Return a run until the last result of a simulation that stopped; None if it did not, or at an unknown time."""
    moment = _TIME.search(simulation.problem)
    if simulation.values or moment is None:
        return None
    last = run.step * (math.ceil(float(moment[1]) / run.step - _ROUNDING) - 1)
    return msgspec.structs.replace(run, stop=last) if 0 < last < run.stop else None


def simulation_task(options: SimulateOptions, prepared: Prepared) -> tuple[CompileTask, str, Mapping[Path, bytes]]:
    """Return the compiler's task, its text without changed parameters, and the changed contents of files."""
    robot, model, values = prepared.package.robot, prepared.model, prepared.values
    inputs, changes, changed = model.inputs(), modifiers(values), dict[Path, bytes]()
    stop = options.stop or model.settings.get("StopTime", STOP)
    course = ModelicaMotion()
    if options.motion or (inputs and options.as_exported):
        motion = read_motion(options.motion, inputs) if options.motion else at_rest(inputs, stop)
        if options.motion and options.stop and options.stop > motion.times[-1]:
            message = f"the motion ends at {motion.times[-1]:g} s, before the stop time, {options.stop:g} s"
            raise ConfigError.of("motion", message, shown(options.motion))
        stop, course = options.stop or motion.times[-1], in_modelica(motion)
        if options.motion and options.as_exported:
            course = course.held(motion, model.step(stop, options.step))
        driven = model.driven(robot.target.package)
        changed = dict(driven.changed)
        if not options.as_exported:
            changes = [
                *(modifier for modifier in driven.modifiers if modifier.partition("(")[0] not in values),
                *changes,
            ]
    elif inputs:
        names = ",".join(["time", *(signal.name for signal in inputs)])
        hint = f"give a CSV file with `--input`; its first line is {names}"
        raise ConfigError.of("inputs", f"`{model.name}` has inputs", hint=hint)
    step = model.step(stop, options.step)
    if stop / step > _MOST_POINTS:  # OpenModelica would crash, and rumoca would blame the tolerance
        message = f"{stop:g} s in steps of {step:g} s are more than {_MOST_POINTS} instants"
        raise ConfigError.of("step", message, hint="give a greater `--step`, or a smaller `--stop`")
    tolerance = options.tolerance or model.settings.get("Tolerance", TOLERANCE)
    wanted = [_OWN, joints.pattern(prepared.bench), *(_glob(variable) for variable in options.variables)]
    if not (any(prepared.bench.layouts) or options.variables):  # without joints, all variables are of interest
        wanted.append(".*")
    task = CompileTask(
        "Probe_.Probe",
        _probe(robot, model.name, course, changes),
        (Simulation(stop, step, tolerance=tolerance, method=options.method),),
        pattern="|".join(f"(?:{pattern})" for pattern in wanted if pattern),
        parameters=tuple(values),
        title=model.name,
    )
    return task, _probe(robot, model.name, course, []), changed


def _probe(robot: RobotConfig, model: str, course: ModelicaMotion, changes: list[str]) -> str:
    """Return a package with a model that extends another one; its imports name the libraries for rumoca."""
    names = dict.fromkeys(("Modelica", robot.target.package.partition(".")[0], model.partition(".")[0]))
    imports = "".join(f"  import {name};\n" for name in names)
    lines = [*course.declarations, *(("equation", *course.equations) if course.equations else ())]
    return f"package Probe_\n{imports}{course.functions}{extension('Probe', model, changes, lines)}end Probe_;\n"


def _glob(text: str) -> str:
    """Return a regular expression for a pattern of variables with Modelica's brackets."""
    return fnmatch.translate(text.replace("[", "[[]"))


def _unmatched(patterns: Sequence[str], simulation: SimulationResult) -> Iterator[Diagnostic]:
    """Yield a warning for each pattern of `--variable` that no variable matches."""
    for pattern in patterns:
        if not any(map(re.compile(_glob(pattern)).fullmatch, simulation.values)):
            message, hint = f"no variable has the name `{pattern}`", "`--variable '*'` adds all variables"
            yield Diagnostic(Severity.WARNING, "no-variable", message, hint=hint)


def _end(model: Model, options: SimulateOptions, run: SimulationResult) -> Iterator[Diagnostic]:
    """Yield the reasons why a simulation did not reach its end."""
    file = shown(Path(model.node.file))
    if run.termination:
        message = f"`{model.name}` ends the simulation at {run.values['time'][-1]:g} s: {_shortened(run.termination)}"
        yield Diagnostic(Severity.NOTE, "terminated", message, file)
    if run.problem:
        words = _shortened(run.problem)
        moment = _TIME.search(words)
        what = f"stops at {float(moment[1]):g} s" if moment else "stops before its end"
        if "initial" in words or (moment and float(moment[1]) == 0):
            what = "does not initialise"
        part = f"; results until {run.values['time'][-1]:g} s are kept" if run.values else ""
        # `fmu --check` has no option for the method
        hint = "" if options.as_exported else "try another `--method` or `--tolerance`"
        message = f"the simulation of `{model.name}` {what}: {words}{part}"
        yield Diagnostic(Severity.ERROR, "no-simulation", message, file, hint=hint)


def _shortened(text: str) -> str:
    return one_line(text)[:_LONGEST_MESSAGE]


def _warning(joint: JointResult, passed: PassedLimit) -> Diagnostic:
    where = "" if joint.robot in ("", "robot") else f"{joint.robot}: "
    unit = getattr(joint, passed.quantity).unit
    message = f"{where}{joint.element}: {passed.quantity} passes its limit, {passed.limit:.4g} {unit}, "
    message += f"at {passed.time:.4g} s; by up to {passed.excess:.3g} {unit}, for {passed.seconds:.3g} s"
    return Diagnostic(Severity.WARNING, "limit-passed", message)
