"""Values in few characters: numbers with the digits that tell two of them apart, texts where they differ."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

_WIDTH = 40
"""Characters of a text that are shown."""
_CONTEXT = 12
"""Characters of a long text before the place where it differs."""
_SHORT = 32
"""Longer texts are no help in telling what something is."""
_DIGITS = 6
"""Numbers with so many characters are not rounded."""
_HASH = re.compile(r"[0-9a-f]{64}")


def pair(old: Any, new: Any, *, everything: bool = False) -> tuple[str, str]:
    """Both values, numbers with as many digits as it takes to see the difference; with `everything`, whole."""
    if is_number(old) and is_number(new):
        if everything:
            return repr(old), repr(new)
        decimals = max(_decimals(abs(new - old), 2), _decimals(abs(old), 3), _decimals(abs(new), 3))
        return _number(old, decimals), _number(new, decimals)
    if isinstance(old, str) and isinstance(new, str):
        if _HASH.fullmatch(old) and _HASH.fullmatch(new):
            return old[:8], new[:8]
        return (old, new) if everything else _differing(old, new)
    return one(old), one(new)


def vectors(old: Sequence[Any], new: Sequence[Any], mark: str = "") -> tuple[str, str]:
    """Two vectors of the same length; their components have the same decimals."""
    decimals = max(_decimals(math.dist(old, new), 2), _decimals(max(map(abs, (*old, *new))), 3))
    before, after = (", ".join(f"{_number(value, decimals)}{mark}" for value in vector) for vector in (old, new))
    return f"({before})", f"({after})"


def one(value: Any) -> str:
    """A value alone."""
    if is_number(value):
        return _number(value, _decimals(abs(value), 3))
    if is_vector(value):
        return f"({', '.join(map(one, value))})"
    return _cut(value if isinstance(value, str) else json.dumps(value, ensure_ascii=False))


def coming(verb: str, value: Any) -> str:
    """What is said of something that comes or goes, with the little that tells what it is."""
    if isinstance(value, Mapping):
        details = _cut(", ".join(_details(value)), 2 * _WIDTH)
    elif isinstance(value, str):
        details = "" if value.startswith("<") else _cut(value)
    else:
        details = one(value) if is_vector(value) or isinstance(value, int | float) else ""
    return f"{verb}: {details}" if details else verb


def percent(old: Any, new: Any) -> str:
    """How a number stands to an older one, if that says anything: not with another sign."""
    if not (is_number(old) and is_number(new)) or old == 0 or new / old < 0:
        return ""
    percent = 100 * (new - old) / abs(old)
    if abs(percent) >= 1000:
        return f"× {new / old:.3g}"
    if 0 < abs(percent) < 0.001:
        return "< 0.001 %"
    digits = max(0, 2 - math.floor(math.log10(abs(percent)))) if percent else 0
    text = f"{percent:+.{digits}f}"
    return f"{text.rstrip('0').rstrip('.') if '.' in text else text} %"


def with_unit(text: str, unit: str) -> str:
    """A value that is in words already, with its unit if it has one."""
    return f"{text} {unit}".rstrip()


def is_number(value: object) -> bool:
    """Whether a value is a number, and no truth value."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def is_vector(value: object) -> bool:
    """Whether a value is a list of numbers."""
    return isinstance(value, list | tuple) and bool(value) and all(map(is_number, value))


def _details(value: Mapping[str, Any], depth: int = 2) -> Iterator[str]:
    """Names and values that tell a thing from others: texts and numbers, of what it consists of texts only."""
    for key, item in value.items():
        if isinstance(item, Mapping) and depth > 1:
            texts = {name: text for name, text in item.items() if isinstance(text, str)}
            yield from (f"{key} {detail}" for detail in _details(texts, depth - 1))
        elif isinstance(item, str | int | float) and item != "":
            yield key if isinstance(item, str) and len(item) > _SHORT else f"{key} {one(item)}"


def _differing(old: str, new: str) -> tuple[str, str]:
    """Two texts; of long ones the part that differs."""
    if max(len(old), len(new)) <= _WIDTH:
        return old or '""', new or '""'
    same = next((k for k, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    begin = max(0, same - _CONTEXT)
    lead = "…" if begin else ""
    return tuple(_cut(lead + " ".join(text[begin:].split())) for text in (old, new))  # type: ignore[return-value]


def _decimals(size: float, digits: int) -> int:
    """So many decimals show a number of this size down to as many digits after its first one."""
    return max(0, digits - math.floor(math.log10(size))) if 0 < size < math.inf else 0


def _number(value: float, decimals: int) -> str:
    """A number with so many decimals, but with no digit more than it has, or than ten; with all if they are few."""
    exact = f"{value:.10g}"
    if len(exact.lstrip("-")) <= _DIGITS or not math.isfinite(value):
        return exact
    return f"{round(value, decimals) + 0.0:.10g}"


def _cut(text: str, width: int = _WIDTH) -> str:
    return text if len(text) <= width else f"{text[: width - 1]}…"
