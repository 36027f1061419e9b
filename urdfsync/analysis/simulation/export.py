"""Exports a model that uses a robot's package as an FMU, by OpenModelica."""

from __future__ import annotations

import io
import re
import time
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.compilers.compiler import CompileTask, Export
from urdfsync.analysis.simulation.models import Input
from urdfsync.analysis.simulation.motion import read_motion
from urdfsync.analysis.simulation.package import extension, prepare, run_task
from urdfsync.analysis.simulation.results import STOP, SimulateOptions
from urdfsync.analysis.simulation.values import modifiers
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.version import __version__
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig

TOLERANCE = 1e-10
"""The tolerance of an FMU's integration for co-simulation; importers can't change it."""
_DESCRIPTION = "modelDescription.xml"
_BY_URDFSYNC = "exported by urdfsync"
_BEGINNING = 2**16
"""The first bytes of a description, so many of them, contain the attributes of its root element."""
_MOST_BYTES = 2**28
"""The greatest number of bytes of an FMU that is opened: its list of contents may be nearly the whole file."""
_HIGHER_DERIVATIVE = re.compile(rb'(?<=name=")((?:der\(){2,})([^"()]*)\)+(?=")')
_MODEL_EXCHANGE = re.compile(
    rb"(?<![ \t])[ \t]*+<ModelExchange\b[^<>]*+>(?:(?<=/>)|(?:(?!<ModelExchange\b).)*?</ModelExchange>)\s*+", re.DOTALL
)


class Exported(msgspec.Struct, frozen=True):
    """An FMU, and its inputs."""

    KEYS = ("model", "tool", "tolerance", "bytes", "seconds")

    content: bytes
    model: str
    """The full name of the model."""
    name: str
    """The model's name in the FMU."""
    inputs: tuple[Input, ...]
    """The driven inputs of a trial; none without a trial."""
    stop: float
    step: float
    tolerance: float
    tool: str
    """The compiler with its version."""
    diagnostics: tuple[Diagnostic, ...]
    seconds: float

    @property
    def bytes(self) -> int:
        """Size of the FMU."""
        return len(self.content)


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

    Raises OSError for unreadable files, UrdfsyncError for faults of the model or the compiler. With `for_trial`, inputs
    that no motion can drive are faults, too.
    """
    begin = time.monotonic()
    prepared = prepare(config, robot, options, for_export=True)
    model = prepared.model
    inputs = tuple(model.inputs()) if for_trial else ()
    if for_trial and options.motion:
        read_motion(options.motion, inputs)  # report the motion's faults before the export, which takes minutes
    stop = options.stop or model.settings.get("StopTime", STOP)
    step, tolerance = model.step(stop, options.step), options.tolerance or TOLERANCE
    name = re.sub(r"\W", "_", model.name)
    name = f"{name}_FMU" if name == model.name else name  # a model can't extend a model of the same name

    def text(changes: Sequence[str]) -> str:
        # a separate model: an FMU takes its tolerance from the annotation
        times = f"StopTime = {stop!r}, Interval = {step!r}, Tolerance = {tolerance!r}"
        description = f"{model.name}, {_BY_URDFSYNC} {__version__}"
        return extension(name, model.name, changes, [f"  annotation (experiment({times}));"], description)

    def tell() -> None:
        progress(f"{robot.name}: compiling, {time.monotonic() - begin:.0f} s", 0, 1)

    task = CompileTask(
        name,
        text(modifiers(prepared.values)),
        parameters=tuple(prepared.values),
        title=model.name,
        # for co-simulation alone, OpenModelica 1.27 reduces the index differently and fails with floating bases
        export=msgspec.structs.replace(kind, kind="me_cs") if kind.kind == "cs" else kind,
    )
    result = run_task(prepared, options, "export", task, text([]), tell)
    return Exported(
        content=_corrected(result.fmu, with_model_exchange=kind.kind != "cs"),
        model=model.name,
        name=name,
        inputs=inputs,
        stop=stop,
        step=step,
        tolerance=tolerance,
        tool=f"{compilers.COMPILERS[options.tool.name].TITLE} {result.version}".rstrip(),
        diagnostics=robot.without_ignored(prepared.warnings),
        seconds=time.monotonic() - begin,
    )


def _corrected(content: bytes, *, with_model_exchange: bool) -> bytes:
    """Write higher derivatives as FMI does, `der(x,2)`, instead of OpenModelica 1.27's `der(der(x))`."""
    corrected = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as exported, zipfile.ZipFile(corrected, "w", zipfile.ZIP_DEFLATED) as fmu:
        for member in exported.infolist():
            data = exported.read(member)
            if member.filename == _DESCRIPTION:
                data = _HIGHER_DERIVATIVE.sub(lambda name: b"der(%b,%d)" % (name[2], name[1].count(b"(")), data)
                data = data if with_model_exchange else _MODEL_EXCHANGE.sub(b"", data, count=1)
            fmu.writestr(member, data)
    return corrected.getvalue()


def is_exported(file: Path) -> bool:
    """Whether a file is an FMU that urdfsync exported.

    The file may be a stranger's, so only the beginning of its description is unpacked.
    """
    try:
        if not file.is_file() or file.stat().st_size > _MOST_BYTES:
            return False
        with zipfile.ZipFile(file) as fmu:
            if fmu.getinfo(_DESCRIPTION).compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                return False  # the readers of other methods unpack whole blocks
            with fmu.open(_DESCRIPTION) as description:
                return _BY_URDFSYNC.encode() in description.read(_BEGINNING)
    except (OSError, KeyError, ValueError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error):
        return False
