"""rumoca, the embedded compiler: does jobs, and reads the compiler's messages.

rumoca puts all complaints into one text, in lines or after semicolons. Each has a place in brackets, or a frame around
the source.
"""

from __future__ import annotations

import importlib.util
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.analysis.checks.compilers.compiler import (
    CompileJob,
    CompileResult,
    CompileTask,
    Complaint,
    Simulation,
    SimulationResult,
    one_line,
)
from urdfsync.common.extras import install_command

if TYPE_CHECKING:
    import rumoca

TITLE = "rumoca"
MODULES: tuple[str, ...] = ("rumoca",)
INSTALL = install_command("check")
METHODS: tuple[str, ...] = ("auto", "bdf", "rk-like")
HAS_STANDARD_LIBRARY = False
REUSES_MODELS = True
STARTS_PROGRAMS = False

_FILE = "Task.mo"  # always the same name, so that a new text replaces the last one in the compiler's memory
_UNKNOWN = frozenset(("state", "algebraic", "output", "discrete_real", "discrete_value"))
_SEARCH = re.compile(r"event iteration (at t=\S+) cycles ")
_STUCK = (
    "rumoca finds no state of joints with the friction law stiction that slide together, {}: "
    'choose `friction = "lugre"`, or OpenModelica with `--tool`'
)
"""The message about two joints with stiction; rumoca's own message does not name the cause."""
_SPAN = re.compile(r" @ Span \{[^{}]*\}")

_SHADOW = "variability violation: "
"""If a model has any error, rumoca 0.10.2 also reports this error about models of the Modelica Standard Library."""
_COLOURS = re.compile(r"\x1b\[[0-9;]*m")
_FRAMED = re.compile(
    r"^[ \t]*×(?P<words>(?:[^╭\n]|\n(?![ \t]*×))*+)╭─+\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)\]", re.MULTILINE
)
_PIECES = re.compile(r"\n|; (?=\S)")
_PREFIXES = re.compile(
    r"^(?:- <[^>]*> \[\w+\]: |\w+ failed: |[\w.]+ failed in \w+: |[\w.]+ could not be compiled: |Failed to [^:]*: )+"
)
_PLACE = re.compile(r" \[(?P<file>[^\[\]]*):(?P<line>\d+):(?P<column>\d+)\]$")


def program(named: str) -> str:  # noqa: ARG001 - see `Compiler`
    """See `Compiler`: rumoca is a module of Python and has no program."""
    return ""


def state(named: str) -> tuple[str, list[Path]]:  # noqa: ARG001 - see `Compiler`
    """See `Compiler`: the folder of the module, whose contents include the version."""
    spec = importlib.util.find_spec("rumoca")
    return "", [Path(spec.origin).parent] if spec and spec.origin else []


def environment(cache: str, folder: str) -> dict[str, str]:  # noqa: ARG001 - see `Compiler`
    """See `Compiler`. rumoca would look for missing classes on MODELICAPATH, so the variable is removed."""
    return {"XDG_CACHE_HOME": str(Path(cache).parent), "MODELICAPATH": ""}  # rumoca adds its name to XDG_CACHE_HOME


def complaints(problem: str) -> list[Complaint]:
    """See `Compiler`. A complaint that only follows from another complaint is left out."""
    text = _COLOURS.sub("", problem).strip()
    result = [_placed(match["words"].replace("│", " "), match) for match in _FRAMED.finditer(text)]
    for piece in () if result else _PIECES.split(text):
        words = _PREFIXES.sub("", piece.strip())
        if not words or words[-1] == ":":  # a heading
            continue
        if place := _PLACE.search(words):
            result.append(_placed(words[: place.start()], place))
        else:
            result.append(Complaint(one_line(words)))
    if not result and text:
        result.append(Complaint(one_line(text)))
    return [complaint for complaint in result if not complaint.message.startswith(_SHADOW)] or result[:1]


def _placed(words: str, place: re.Match[str]) -> Complaint:
    return Complaint(one_line(words), file=place["file"], line=int(place["line"]), column=int(place["column"]))


def work(job: CompileJob) -> Iterator[CompileResult]:
    """Do all tasks with one session, in order. Raises ImportError without the compiler.

    Consecutive tasks that differ only in their runs share the compiled model.
    """
    import rumoca  # an optional extra

    session = rumoca.Session(roots=list(job.roots))
    last, model, answer = None, None, CompileResult()
    for task in job.tasks:
        text = msgspec.structs.replace(task, runs=())
        if text != last:
            last, (model, answer) = text, _compile(session, task)
        runs = tuple(_simulate(model, run, task) for run in task.runs) if model else ()
        yield msgspec.structs.replace(answer, runs=runs, version=rumoca.version())


def _compile(session: rumoca.Session, task: CompileTask) -> tuple[rumoca.Model | None, CompileResult]:
    """Return a model and its number of unknowns; or no model, and the reason."""
    import rumoca

    try:
        model = session.loads(task.source, model=task.model, filename=_FILE)
    except rumoca.RumocaError as error:
        return None, CompileResult(_words(error))
    names = *task.parameters, *task.varied
    if not set(names).issubset(model.parameters.names):
        return None, CompileResult(parameters=tuple(model.parameters.names))
    if unused := _without_effect(model, names):
        return None, CompileResult(without_effect=unused)
    if fixed := _structural(model, task.varied):
        return None, CompileResult(structural=fixed)
    return model, CompileResult(unknowns=_unknowns(model))


def _structural(model: rumoca.Model, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the parameters among `names` that are no single real number, or that the compiler has evaluated."""
    if not names:
        return ()
    storage = msgspec.json.decode(model.to_json("dae"), type=_Equations).storage
    types = {variable.name: storage.value_types[variable.value_type] for variable in storage.variables}
    can_change = {
        parameter.name
        for parameter in model.parameters
        if parameter.kind == "tunable" and types[parameter.name] == _Type("real", [])
    }
    return tuple(name for name in names if name not in can_change)


class _Type(msgspec.Struct):
    scalar: str
    dimensions: list[int]


class _Attributes(msgspec.Struct):
    binding: int | None


class _Variable(msgspec.Struct):
    name: str
    role: str
    value_type: int
    attributes: _Attributes


class _Expressions(msgspec.Struct):
    nodes: list[dict[str, Any]]


class _Storage(msgspec.Struct):
    value_types: list[_Type]
    variables: list[_Variable]
    expressions: _Expressions


class _Equations(msgspec.Struct):
    """The compiler's equations of a model: its variables, and the expressions that mention them."""

    storage: _Storage


def _unknowns(model: rumoca.Model) -> int:
    """Count the scalar unknowns as the compiler does for its message about an unbalanced model."""
    storage = msgspec.json.decode(model.to_json("dae"), type=_Equations).storage
    sizes = [math.prod(value_type.dimensions) for value_type in storage.value_types]
    return sum(sizes[variable.value_type] for variable in storage.variables if variable.role in _UNKNOWN)


def _without_effect(model: rumoca.Model, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the parameters among `names` that no equation uses, neither directly nor through a binding.

    If a model passes on a whole record, rumoca 0.10.2 accepts a modifier of a part of this record, but ignores the
    modifier.
    """
    if not names:
        return ()
    storage = msgspec.json.decode(model.to_json("dae"), type=_Equations).storage
    bound = {variable.attributes.binding: number for number, variable in enumerate(storage.variables)}
    uses: dict[int, list[int]] = {}
    for place, node in enumerate(storage.expressions.nodes):
        match node:
            case {"coordinate": {"parameter": int(number)}}:
                uses.setdefault(number, []).append(place)
    numbers = {variable.name: number for number, variable in enumerate(storage.variables)}
    structural = {parameter.name for parameter in model.parameters if parameter.kind == "structural"}

    def is_used(number: int, above: frozenset[int] = frozenset()) -> bool:
        # rumoca evaluates structural parameters, so no equation names them; it does not mark sizes as structural
        variable = storage.variables[number]
        if variable.name in structural or storage.value_types[variable.value_type].scalar != "real":
            return True
        places = uses.get(number, [])
        return any(place not in bound for place in places) or any(
            is_used(bound[place], above | {number}) for place in places if bound[place] not in above
        )

    return tuple(name for name in names if name in numbers and not is_used(numbers[name]))


def _simulate(model: rumoca.Model, run: Simulation, task: CompileTask) -> SimulationResult:
    """Simulate a compiled model. If a run stops, rumoca returns no results."""
    import rumoca

    tolerance, method = run.tolerance, run.method or None
    config = rumoca.SimConfig(dt=run.step, rtol=tolerance, atol=tolerance, solver=method)
    try:
        result = model.simulate((0, run.stop), config=config, params=dict(run.parameters) or None)
        wanted = re.compile(task.pattern)
        others = (name for name in result.names if wanted.fullmatch(name) and name[0] != "$")  # without internal names
        series = {name: tuple(result[name].tolist()) for name in dict.fromkeys((*task.values, *others))}
    except (rumoca.RumocaError, LookupError, ValueError) as error:
        return SimulationResult(problem=_words(error))
    values = {"time": tuple(result.time.tolist()), **series}  # rumoca reports an error for numbers that are not finite
    parameters = {
        parameter.name: parameter.value
        for parameter in model.parameters
        if parameter.value is not None and wanted.fullmatch(parameter.name)
    }
    parameters |= {name: value for name, value in run.parameters.items() if wanted.fullmatch(name)}
    return SimulationResult(values, termination=result.termination or "", parameters=parameters)


def _words(error: Exception) -> str:
    """Return the compiler's message without places in its own notation."""
    words = _SPAN.sub("", str(error.args[0] if error.args else error))
    search = _SEARCH.search(words)
    is_stuck = search is not None and " which the mode search " in words[search.end() :]
    return _STUCK.format(search[1]) if search and is_stuck else words
