"""rumoca, the embedded compiler: jobs done with it, and its messages.

rumoca says everything in one text: complaints in lines or after semicolons, some with a place in brackets, some drawn
with a frame around the source.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync.check.compilers.compiler import (
    CompileJob,
    CompileResult,
    CompileTask,
    Complaint,
    Simulation,
    SimulationResult,
    one_line,
)
from urdfsync.extras import install_command

if TYPE_CHECKING:
    import rumoca

TITLE = "the compiler"
MODULES: tuple[str, ...] = ("rumoca",)
INSTALL = install_command("check")
REPORT = "report it to the authors of rumoca"
SIMULATES = True

_FILE = "Task.mo"  # always the same, so that a text takes the place of the one before in the compiler's memory
_UNKNOWN = frozenset(("state", "algebraic", "output", "discrete_real", "discrete_value"))
_SPAN = re.compile(r" @ Span \{.*?\) \}")

_SHADOW = "variability violation: "
"""rumoca 0.10.2 says this of sound models of the Modelica Standard Library as soon as something else is wrong."""
_COLOURS = re.compile(r"\x1b\[[0-9;]*m")
_FRAMED = re.compile(r"×(?P<words>[^╭]*?)\n\s*╭─+\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)\]")
_PIECES = re.compile(r"\n|; (?=\S)")
_PREFIXES = re.compile(
    r"^(?:- <[^>]*> \[\w+\]: |\w+ failed: |[\w.]+ failed in \w+: |[\w.]+ could not be compiled: |Failed to [^:]*: )+"
)
_PLACE = re.compile(r" \[(?P<file>[^\[\]]*):(?P<line>\d+):(?P<column>\d+)\]$")


def program() -> str:
    """See `Compiler`: all of it is in the module."""
    return ""


def environment(cache: str, folder: str) -> dict[str, str]:  # noqa: ARG001 - see `Compiler`
    """See `Compiler`. rumoca looks at MODELICAPATH for whatever the roots do not have, so that goes."""
    return {"XDG_CACHE_HOME": str(Path(cache).parent), "MODELICAPATH": ""}  # it adds its own name to the first


def complaints(problem: str) -> list[Complaint]:
    """See `Compiler`. A complaint that only follows from another one is left out."""
    text = _COLOURS.sub("", problem).strip()
    found = [_placed(one["words"].replace("│", " "), one) for one in _FRAMED.finditer(text)]
    for piece in () if found else _PIECES.split(text):
        words = _PREFIXES.sub("", piece.strip())
        if not words or words[-1] == ":":  # a heading
            continue
        if place := _PLACE.search(words):
            found.append(_placed(words[: place.start()], place))
        else:
            found.append(Complaint(one_line(words)))
    if not found and text:
        found.append(Complaint(one_line(text)))
    return [one for one in found if not one.message.startswith(_SHADOW)] or found[:1]


def _placed(words: str, place: re.Match[str]) -> Complaint:
    return Complaint(one_line(words), file=place["file"], line=int(place["line"]), column=int(place["column"]))


def work(job: CompileJob) -> Iterator[CompileResult]:
    """Do all tasks with one session, in order. Raises ImportError without the compiler."""
    import rumoca  # an optional extra

    session = rumoca.Session(roots=list(job.roots))
    for task in job.tasks:
        yield _compile(session, task)


def _compile(session: rumoca.Session, task: CompileTask) -> CompileResult:
    import rumoca

    try:
        model = session.loads(task.source, model=task.model, filename=_FILE)
    except rumoca.RumocaError as error:
        return CompileResult(_words(error))
    unknowns, states = _counts(model)
    runs = tuple(_simulate(model, run, task.values) for run in task.runs)
    return CompileResult(unknowns=unknowns, states=states, runs=runs)


class _Type(msgspec.Struct):
    dimensions: list[int]


class _Variable(msgspec.Struct):
    role: str
    value_type: int


class _Storage(msgspec.Struct):
    value_types: list[_Type]
    variables: list[_Variable]


class _Equations(msgspec.Struct):
    """The part of the compiler's own form of a model that says how many variables there are."""

    storage: _Storage


def _counts(model: rumoca.Model) -> tuple[int, int]:
    """Scalar unknowns and states, counted as the compiler does when it finds a model unbalanced."""
    storage = msgspec.json.decode(model.to_json("dae"), type=_Equations).storage
    sizes = [math.prod(one.dimensions) for one in storage.value_types]
    unknowns = sum(sizes[one.value_type] for one in storage.variables if one.role in _UNKNOWN)
    return unknowns, sum(sizes[one.value_type] for one in storage.variables if one.role == "state")


def _simulate(model: rumoca.Model, run: Simulation, values: tuple[str, ...]) -> SimulationResult:
    import rumoca

    try:
        config = rumoca.SimConfig(dt=run.step, rtol=run.tolerance, atol=run.tolerance)
        result = model.simulate((0, run.stop), config=config, params=dict(run.parameters) or None)
        series = {name: tuple(result[name].tolist()) for name in values}
    except (rumoca.RumocaError, LookupError, ValueError) as error:
        return SimulationResult(problem=_words(error))
    return SimulationResult({"time": tuple(result.time.tolist()), **series})  # all finite, or it says so itself


def _words(error: Exception) -> str:
    """What the compiler says, without places in its own notation."""
    return _SPAN.sub("", str(error.args[0] if error.args else error))
