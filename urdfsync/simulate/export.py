"""Exports a model with the package of a robot as FMU, by OpenModelica."""

from __future__ import annotations

import io
import re
import time
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import msgspec

from urdfsync import __version__
from urdfsync.check import compilers
from urdfsync.check.cache import UserCache
from urdfsync.check.compilation import explain
from urdfsync.check.compilers.compiler import CompileResult, CompileTask, Export
from urdfsync.check.jobs import Jobs
from urdfsync.check.libraries import Libraries
from urdfsync.check.process import limits_of
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import Progress
from urdfsync.simulate.models import Input, Model
from urdfsync.simulate.motion import read_motion
from urdfsync.simulate.package import SimulatedPackage, check_compiler, find_with_libraries, read_package
from urdfsync.simulate.results import STOP, SimulateOptions
from urdfsync.simulate.values import find_unknown, modifiers, read_values

TOLERANCE = 1e-10
"""Of the integration inside of an FMU for co-simulation, which whoever imports it can't change."""
_DESCRIPTION = "modelDescription.xml"
_BY_URDFSYNC = "exported by urdfsync"
_BEGINNING = 2**16
"""Bytes of a description that have the attributes of its root element, where that stands."""
_MOST_BYTES = 2**28
"""Of an FMU whose list of contents is read; such a list may be nearly all of a file."""
_HIGHER_DERIVATIVE = re.compile(rb'(?<=name=")((?:der\(){2,})([^"()]*)\)+(?=")')
_MODEL_EXCHANGE = re.compile(rb"[ \t]*<ModelExchange\b[^>]*?(?:/>|>.*?</ModelExchange>)\s*", re.DOTALL)


class Exported(msgspec.Struct, frozen=True):
    """An FMU, and what it was made of."""

    content: bytes
    model: str
    """Full name of the model."""
    name: str
    """The model's name in the FMU."""
    inputs: tuple[Input, ...]
    """Those that a trial drives; none if there will be none."""
    stop: float
    step: float
    tolerance: float
    tool: str
    """The compiler with its version."""
    diagnostics: tuple[Diagnostic, ...]
    seconds: float


class _Experiment(NamedTuple):
    stop: float
    step: float
    tolerance: float


def export(
    config: Config,
    robot: RobotConfig,
    options: SimulateOptions,
    kind: Export,
    progress: Progress,
    *,
    for_trial: bool = False,
) -> Exported:
    """Export a model as FMU. Writes nothing but the cache.

    Raises UrdfsyncError for whatever is wrong with the model or the compiler, and with `for_trial` for inputs that no
    motion could drive; OSError for what can't be read.
    """
    begin = time.monotonic()
    check_compiler(options)
    package = read_package(config, robot, options)
    name = options.model or package.bench.run or package.bench.test
    if not name:
        message = f"the package of robot `{robot.name}` has no model that can be exported"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-model", message, hint="name one of yours with `--model`"))
    model, needed = find_with_libraries(config, robot, options, name, package)
    settings, values = model.settings(), read_values(options.values)
    inputs = tuple(model.inputs()) if for_trial else ()
    if for_trial and options.motion:
        read_motion(options.motion, inputs)  # what is wrong with it is said before the export, which takes minutes
    stop = options.stop or settings.get("StopTime", STOP)
    experiment = _Experiment(stop, model.step(stop, options.step), options.tolerance or TOLERANCE)
    fmu_name = re.sub(r"\W", "_", model.name)
    fmu_name = f"{fmu_name}_FMU" if fmu_name == model.name else fmu_name  # a model can't extend one of its name
    plain = CompileTask(fmu_name, _text(fmu_name, model.name, [], experiment), title=model.name)
    task = msgspec.structs.replace(
        plain,
        source=_text(fmu_name, model.name, modifiers(values), experiment),
        # of co-simulation alone OpenModelica 1.27 reduces the index in another way, and fails with floating bases
        export=msgspec.structs.replace(kind, kind="me_cs") if kind.kind == "cs" else kind,
    )

    def tell() -> None:
        progress(f"{robot.name}: compiling, {time.monotonic() - begin:.0f} s", 0, 1)

    result = _compile(robot, options, package, needed, model, (task, plain), tuple(values), tell)
    note = compilers.find_untried(options.tool, result.version)
    return Exported(
        content=_corrected(result.fmu, with_model_exchange=kind.kind != "cs"),
        model=model.name,
        name=fmu_name,
        inputs=inputs,
        **experiment._asdict(),
        tool=f"{compilers.COMPILERS[options.tool.name].TITLE} {result.version}".rstrip(),
        diagnostics=robot.without_ignored([*package.warnings, *([note] if note else [])]),
        seconds=time.monotonic() - begin,
    )


def _compile(
    robot: RobotConfig,
    options: SimulateOptions,
    package: SimulatedPackage,
    needed: Libraries,
    model: Model,
    tasks: tuple[CompileTask, CompileTask],
    values: tuple[str, ...],
    progress: Callable[[], None],
) -> CompileResult:
    """Do the first of two tasks; the second is without the changes of `values`. Raises UrdfsyncError."""
    limits = limits_of(f"the export of `{model.name}`", options.timeout, options.memory)
    cache, (task, plain), texts = UserCache.default(), tasks, package.texts.texts
    cache.prepare()
    with cache.workspace() as folder:
        every = [*texts.values(), *package.around.values()]
        jobs = Jobs(robot, package.around, needed, every, options.tool, limits, folder, progress)
        (result,) = jobs.run("export", texts, [task])
        if result.problem and values:  # perhaps since there is no such parameter
            (found,) = jobs.run("plain", texts, [msgspec.structs.replace(plain, parameters=values)])
            if unknown := find_unknown(model.name, values, found.parameters):
                raise UrdfsyncError(*unknown)
    if result.problem:
        file, compiler = Path(model.node.file), compilers.COMPILERS[options.tool.name]
        outside = None if package.texts.folder in file.parents else file
        raise UrdfsyncError(*explain(result.problem, compiler, package.texts, file=outside))
    return result


def _text(name: str, model: str, changes: list[str], experiment: _Experiment) -> str:
    """Return a model of its own, since the tolerance inside of an FMU is that of the annotation."""
    changed = f"({', '.join(changes)})" if changes else ""
    times = f"StopTime = {experiment.stop!r}, Interval = {experiment.step!r}, Tolerance = {experiment.tolerance!r}"
    return (
        f'model {name} "{model}, {_BY_URDFSYNC} {__version__}"\n'
        f"  extends {model}{changed};\n  annotation (experiment({times}));\nend {name};\n"
    )


def _corrected(content: bytes, *, with_model_exchange: bool) -> bytes:
    """Write higher derivatives as FMI has them, `der(x,2)`, where OpenModelica 1.27 has `der(der(x))`."""
    corrected = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as found, zipfile.ZipFile(corrected, "w", zipfile.ZIP_DEFLATED) as fmu:
        for one in found.infolist():
            data = found.read(one)
            if one.filename == _DESCRIPTION:
                data = _HIGHER_DERIVATIVE.sub(lambda name: b"der(%b,%d)" % (name[2], name[1].count(b"(")), data)
                data = data if with_model_exchange else _MODEL_EXCHANGE.sub(b"", data, count=1)
            fmu.writestr(one, data)
    return corrected.getvalue()


def is_exported(file: Path) -> bool:
    """Whether a file is an FMU that urdfsync exported.

    It may be a stranger's: no more is read than the beginning of its description, whatever that unpacks to.
    """
    try:
        if not file.is_file() or file.stat().st_size > _MOST_BYTES:
            return False
        with zipfile.ZipFile(file) as fmu:
            if fmu.getinfo(_DESCRIPTION).compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                return False  # as others unpack whole blocks
            with fmu.open(_DESCRIPTION) as description:
                return _BY_URDFSYNC.encode() in description.read(_BEGINNING)
    except (OSError, KeyError, ValueError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error):
        return False
