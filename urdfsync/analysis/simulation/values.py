"""Changes parameters, `robot.elbow.parameters.dynamics.damping=4`, by modifiers of the model."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Mapping
from typing import Any, NoReturn

from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.spelling import nearest
from urdfsync.modelica.names import is_identifier

_LIKENESS = 0.8
_SCALAR = re.compile(
    r"""(?:-\s*)?(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|true|false|"(?:\\.|[^"\\])*+(?P<end>"|\\?\Z)""",
    re.ASCII | re.DOTALL,
)
"""A number, a truth value or a text; without `end`, the quotation mark of a text is missing."""
_VECTOR = re.compile(r"\{\s*0\s*(?:,\s*0\s*)*\}")
"""A vector in a text in which each scalar or inner vector is a 0."""


def read_values(given: Iterable[str]) -> dict[str, str]:
    """Return the value of each parameter, in Modelica. Raises ConfigError for a wrong name or value."""
    values: dict[str, str] = {}
    for assignment in given:
        name, is_assigned, value = (part.strip() for part in assignment.partition("="))
        if not is_assigned:
            hint = "write NAME=VALUE, such as `robot.elbow.parameters.dynamics.damping=4`"
            _refuse(f"`{assignment}` gives no value", hint)
        if not all(is_identifier(part) for part in name.split(".")):
            hint = "give the whole vector, as in `axis={0,1,0}`" if "[" in name else ""
            _refuse(f"`{name}` can't be a parameter", hint)
        if not _is_literal(value):
            _refuse(f"`{value}` is no value for `{name}`", 'give a number, true, false, a "text" or a vector: {0,1,0}')
        if name in values:
            _refuse(f"`{name}` gets two values", "give one of them")
        values[name] = value
    return values


def find_unknown(model: str, names: Iterable[str], parameters: Collection[str] | None) -> list[Diagnostic]:
    """Return an error for each unknown parameter of a model; none if its parameters are unknown (None)."""
    findings = list[Diagnostic]()
    if parameters is None:
        return findings
    for name in names:
        if name not in parameters:
            near = nearest_parameter(name, parameters)
            hint = f"did you mean `{near}`?" if near else ""
            findings.append(Diagnostic(Severity.ERROR, "set", f"`{model}` has no parameter `{name}`", hint=hint))
    return findings


def nearest_parameter(name: str, parameters: Iterable[str]) -> str:
    """Return the parameter that the user may have meant: its whole name or its last part resembles that of `name`.

    Of several parameters with this last part, the one that shares most other parts with `name` counts, then the
    shortest. Empty without such a parameter.
    """
    parameters = list(parameters)
    if near := nearest(name, parameters, _LIKENESS):
        return near
    *path, last = name.split(".")
    end = nearest(last, {parameter.rpartition(".")[2] for parameter in parameters}, _LIKENESS)
    alike = [parameter for parameter in parameters if parameter.rpartition(".")[2] == end]
    return min(
        alike,
        key=lambda parameter: (-sum(bool(nearest(part, parameter.split("."))) for part in path), len(parameter)),
        default="",
    )


def modifiers(values: Mapping[str, str]) -> list[str]:
    """Return modifiers that give the parameters of a model these values. Raises ConfigError for contradictions."""
    tree: dict[str, Any] = {}
    for name, value in values.items():
        *path, last = name.split(".")
        inside = tree
        for part in path:
            inside = inside.setdefault(part, {})
            if isinstance(inside, str):
                break
        if isinstance(inside, str) or last in inside:
            _refuse(f"`{name}` gets a value, and so does a part of it or the whole around it", "give one of them")
        inside[last] = value
    return [_modifier(name, value) for name, value in tree.items()]


def _modifier(name: str, value: str | dict[str, Any]) -> str:
    if isinstance(value, str):
        return f"{name} = {value}"
    return f"{name}({', '.join(_modifier(*item) for item in value.items())})"


def _is_literal(value: str) -> bool:
    """Whether a text is a finite number, a truth value, a text, or a vector of these."""
    numbers = [match["number"] for match in _SCALAR.finditer(value) if match["number"]]
    # a text without end becomes none, and yet matches: looking for its end at each quotation mark would take minutes
    rest, count = _SCALAR.sub(lambda scalar: "0" if scalar["end"] in (None, '"') else '"', value.strip()), 1
    while count:  # from the inside outwards
        rest, count = _VECTOR.subn("0", rest)
    return rest == "0" and all(math.isfinite(float(number)) for number in numbers)


def _refuse(message: str, hint: str = "") -> NoReturn:
    raise ConfigError.of("set", message, hint=hint)
