"""Writes values as Modelica: literals that tools read as the same value, and text that can't end a string."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import msgspec

INFINITY = "Modelica.Constants.inf"

_ESCAPES = str.maketrans({"\\": "\\\\", '"': '\\"', "\n": "\\n", "\r": "\\r", "\t": "\\t"})
_CONTROLS = "[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufeff\ufffe\uffff]"
"""Characters that end lines, reverse the direction of text, or have no UTF-8."""
_LITERAL = r"""(?xs)
    (?<!\\)"(?:[^"\\]|\\.)*+"                # a string
    | (?:[-+]\s*)?(?:
        Modelica\.Constants\.inf\b           # stands for a limit that is absent
        | (?<![\w.])\d++(?:\.\d*+)?(?:[eE][-+]?\d+)?
      )
    """
_LARGEST_INTEGER = 2**31 - 1  # every Modelica tool accepts this without a decimal point


class Expression(msgspec.Struct, frozen=True):
    """Modelica code as a value of a modifier; never a text of a source."""

    code: str


def real(value: float | None, absent: str = INFINITY) -> str:
    """Return the shortest Modelica Real literal with the value of the number; for None, return `absent`.

    Zero gets no sign. Raises ValueError for numbers that have no literal.
    """
    if value is None:
        return absent
    if -_LARGEST_INTEGER <= value <= _LARGEST_INTEGER:
        whole = int(value)
        return str(whole) if whole == value else repr(float(value))
    if not math.isfinite(value):
        raise ValueError(f"{value} has no Modelica literal")
    return repr(float(value))


def vector(values: Iterable[float]) -> str:
    """Return a Modelica array constructor. Raises ValueError for an empty array, since `{}` is not Modelica."""
    items = ", ".join(map(real, values))
    if not items:
        raise ValueError("an empty array has no Modelica literal")
    return f"{{{items}}}"


def matrix(rows: Sequence[Sequence[float]], columns: int) -> str:
    """Return a Modelica matrix `[a, b; c, d]`, or an empty matrix with `columns` columns."""
    if not rows:
        return f"fill(0, 0, {columns})"
    return "[" + "; ".join(", ".join(map(real, row)) for row in rows) + "]"


def string(value: str) -> str:
    """Return a Modelica string literal, quotes included; control characters become spaces."""
    if value.isprintable():
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return f'"{escaped}"'
    return f'"{re.sub(_CONTROLS, " ", value.translate(_ESCAPES))}"'


def modifiers(values: Mapping[str, Any], indent: int = 4) -> str:
    """Return the modifiers of a component, one to a line; a mapping gives nested ones.

    Values are strings, numbers, vectors of numbers, or an `Expression`. Raises ValueError as `real` and `vector`.
    """
    pad = " " * indent
    return ",\n".join(f"{pad}{name}{_modifier(value, indent)}" for name, value in values.items())


def _modifier(value: Any, indent: int) -> str:
    match value:
        case Mapping():
            return f"(\n{modifiers(value, indent + 2)})"
        case Expression():
            return f" = {value.code}"
        case bool():
            return f" = {'true' if value else 'false'}"
        case str():
            return f" = {string(value)}"
        case int() | float():
            return f" = {real(value)}"
    return f" = {vector(value)}"


def html(value: str) -> str:
    """Return text for the inside of an HTML documentation string."""
    replaced = value.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")
    return string(replaced)[1:-1]


def capitalize_first(value: str) -> str:
    """Return the text with its first letter as a capital."""
    return value[:1].upper() + value[1:]


def numbers_only(old: str, new: str) -> bool:
    """Whether two texts are equal except for the values of number and string literals."""
    return without_literals(old) == without_literals(new)


def without_literals(text: str) -> str:
    """Return a text with `""` for each string, and `0` for each number."""
    return re.sub(_LITERAL, lambda match: '""' if match[0].startswith('"') else "0", text.replace("\r\n", "\n"))
