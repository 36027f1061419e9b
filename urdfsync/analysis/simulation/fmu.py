"""Tries an FMU out: FMPy validates and simulates the FMU, and the trajectory is compared with that of `simulate`."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.analysis.checks import process
from urdfsync.analysis.checks.compilers.compiler import Export, one_line
from urdfsync.analysis.checks.process import Limits, limits_of
from urdfsync.analysis.simulation.export import Exported
from urdfsync.analysis.simulation.motion import at_rest, read_motion, sampled
from urdfsync.analysis.simulation.results import Series, SimulateOptions
from urdfsync.analysis.simulation.run import simulate
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.common.extras import install_command
from urdfsync.common.files import shown
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig

AGREEMENT = 1e-6
"""The greatest difference that counts as agreement, relative to a variable's greatest value or 1."""
_REFERENCE_TOLERANCE = 1e-10
_TOLERANCES = (1e-10, 1e-8, 1e-6)
"""Tolerances of FMPy's integration of model exchange; the first successful integration counts."""
_SAME_TIME = 1e-9
_LONGEST_MESSAGE = 300
KINDS = {"me": "ModelExchange", "cs": "CoSimulation"}
"""FMPy's words for kinds of FMUs."""


class FmuTrial(msgspec.Struct, frozen=True):
    """The findings of FMPy about an FMU."""

    findings: tuple[str, ...]
    """Findings of FMPy's validation."""
    agreement: Mapping[str, float]
    """For each kind that was simulated, the greatest relative difference of a variable from `simulate`."""
    worst: Mapping[str, str]
    """For each kind, the variable with this difference."""
    compared: int
    """Number of compared variables."""
    problems: Mapping[str, str] = {}
    """For each kind that FMPy can't simulate, the reason."""


class WrittenFmu(msgspec.Struct, frozen=True):
    """An FMU that was written to a file."""

    robot: str
    exported: Exported
    kind: Export
    file: Path
    trial: FmuTrial | None
    """None if the FMU was not tried out."""
    diagnostics: tuple[Diagnostic, ...]
    """All findings, of the export and of the trial."""


def find_faults(trial: FmuTrial, file: Path) -> list[Diagnostic]:
    """Return the findings of a trial, as warnings."""
    warnings = [
        Diagnostic(Severity.WARNING, "fmu-not-valid", f"FMPy: {words}", shown(file)) for words in trial.findings
    ]
    for kind, problem in trial.problems.items():
        message = f"{KINDS[kind]}: FMPy can't simulate the FMU: {problem}"
        warnings.append(Diagnostic(Severity.WARNING, "fmu-not-simulated", message, shown(file)))
    for kind, difference in trial.agreement.items():
        if not difference <= AGREEMENT:
            message = f"{KINDS[kind]}: `{trial.worst[kind]}` differs from `simulate` by {difference:.1e} of its size"
            hint = "try a smaller `--tolerance`"
            warnings.append(Diagnostic(Severity.WARNING, "fmu-differs", message, shown(file), hint=hint))
    return warnings


class _Request(msgspec.Struct, frozen=True):
    """The task for FMPy."""

    file: str
    kinds: Sequence[str]
    stop: float
    step: float
    tolerance: float
    names: Sequence[str]
    times: Sequence[float]
    inputs: Mapping[str, list[float]]


class _Examined(msgspec.Struct):
    findings: list[str]
    series: dict[str, dict[str, list[float]]]
    """The series of each variable, by kind."""
    problems: dict[str, str]


def try_out(
    config: Config,
    robot: RobotConfig,
    options: SimulateOptions,
    exported: Exported,
    kinds: Sequence[str],
    progress: Progress,
) -> FmuTrial:
    """Validate and simulate an FMU, with the motion of the options or with inputs that stay at 0.

    A motion drives only co-simulation, whose inputs change at each step: FMPy's integration of model exchange misses
    changes within its own steps. Raises UrdfsyncError.
    """
    motion = read_motion(options.motion, exported.inputs) if options.motion else at_rest(exported.inputs, exported.stop)
    stop = motion.times[-1]
    wanted = msgspec.structs.replace(
        options, model=exported.model, stop=stop, step=exported.step, tolerance=_REFERENCE_TOLERANCE, as_exported=True
    )
    reference = simulate(config, robot, wanted, progress)
    if any(finding.severity is Severity.ERROR for finding in reference.diagnostics):
        raise UrdfsyncError(*reference.diagnostics)
    times = [index * exported.step for index in range(round(stop / exported.step) + 2)]
    request = _Request(
        file=f"{exported.name}.fmu",
        kinds=[kind for kind in kinds if kind == "cs" or not options.motion],
        stop=stop,
        step=exported.step,
        tolerance=exported.tolerance,
        names=list(reference.series),
        times=times,
        inputs=sampled(motion, times),
    )
    limits = limits_of(f"the trial of `{exported.model}`", options.timeout, options.memory)
    answer = _ask(request, exported.content, limits, lambda: progress(f"{robot.name}: FMPy is at work", 0, 1))
    return _judge(answer, reference.series)


def _ask(request: _Request, content: bytes, limits: Limits, progress: Callable[[], None]) -> _Examined:
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        file = Path(folder, request.file)
        file.write_bytes(content)
        request = msgspec.structs.replace(request, file=str(file))
        environment = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder)
        try:
            (answer,) = process.run(_examine, request, limits=limits, environment=environment, progress=progress)
        except ImportError as error:
            message, hint = f"FMPy does not start: {error}", install_command("fmu")
            raise UrdfsyncError.of("no-fmpy", message, hint=hint) from None
        except process.BrokenProcessError as error:
            message = f"FMPy crashed with the FMU: {error}"
            raise UrdfsyncError.of("fmu-crashed", message) from error
        return answer


def _judge(answer: _Examined, reference: Series) -> FmuTrial:
    """Compare the trajectories of an FMU with that of `simulate`."""
    end, problems = reference["time"][-1], dict(answer.problems)
    agreement, worst, compared = dict[str, float](), dict[str, str](), 0
    for kind, series in answer.series.items():
        if series["time"][-1] < end - _SAME_TIME:
            problems[kind] = f"the FMU ends at {series['time'][-1]:g} s, not at {end:g} s"
        elif len(series) == 1:
            problems[kind] = "the FMU has no variable of the model"
        if differences := _differences(series, reference):
            worst[kind] = max(differences, key=lambda name: differences[name])
            agreement[kind] = differences[worst[kind]]
            compared = max(compared, len(differences))
    return FmuTrial(tuple(answer.findings), agreement, worst, compared, problems)


def _examine(request: _Request) -> Iterator[_Examined]:
    """Yield FMPy's answer, in a process of its own: an FMU is native code."""
    import numpy as np
    from fmpy import read_model_description, simulate_fmu
    from fmpy.validation import validate_fmu

    findings = [one_line(str(problem))[:_LONGEST_MESSAGE] for problem in validate_fmu(request.file)]
    description: Any = read_model_description(request.file, validate=False)
    variables = {variable.name for variable in description.modelVariables}
    names = [name for name in request.names if name in variables]
    signals: Any = None
    if request.inputs:
        columns = [("time", float), *((name, float) for name in request.inputs)]
        signals = np.array(list(zip(request.times, *request.inputs.values(), strict=True)), dtype=columns)
    series, problems = {}, {}
    for kind in request.kinds:
        # in model exchange, stiff contacts stop FMPy's solver: try again with a greater tolerance
        for tolerance in _TOLERANCES if kind == "me" else (request.tolerance,):
            try:
                result: Any = simulate_fmu(
                    request.file,
                    validate=False,
                    stop_time=request.stop,
                    output_interval=request.step,
                    relative_tolerance=tolerance,
                    record_events=False,
                    input=signals,
                    output=names,
                    fmi_type=KINDS[kind],
                )
            except Exception as error:  # noqa: BLE001 - FMPy raises plain Exception
                problems[kind] = one_line(str(error))[:_LONGEST_MESSAGE]
            else:
                series[kind] = {name: result[name].tolist() for name in ("time", *names)}
                problems.pop(kind, None)
                break
    yield _Examined(findings, series, problems)


def _differences(series: Series, reference: Series) -> dict[str, float]:
    """Return the greatest difference of each common variable, relative to its greatest value or 1.

    If the reference has several results at one time, at an event, the nearest counts.
    """
    import numpy as np

    times, expected_times = np.array(series["time"]), np.array(reference["time"])
    first = np.searchsorted(expected_times, times - _SAME_TIME)
    last = np.searchsorted(expected_times, times + _SAME_TIME, side="right")
    differences = {}
    for name, values in series.items():
        if name != "time":
            expected = np.array(reference[name])
            pairs = zip(values, first, last, strict=True)
            nearest = [np.abs(expected[begin:end] - value).min() for value, begin, end in pairs if begin < end]
            relative = float(np.max(nearest)) / max(1.0, float(np.abs(expected).max())) if nearest else math.nan
            differences[name] = math.inf if math.isnan(relative) else relative
    return differences
