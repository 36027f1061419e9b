"""Values of a table as their types want them, and faults of others in words."""

from __future__ import annotations

import json
import re
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin

import msgspec

_EXPECTED = re.compile(r"Expected `(?P<type>[^`]+)`(?:, got `(?P<got>\w+)`)?(?: - at `\$(?P<at>[^`]*)`)?")
"""The messages of msgspec's ValidationError."""
_WORDS = {
    "str": "a string",
    "int": "an integer",
    "float": "a number",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
}


def convert(key: str, value: Any, kind: Any) -> Any:
    """The value of a key as its type. Raises ValueError, whose message names key, allowed and given value."""
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        raise ValueError(_in_words(key, value, kind, str(error))) from None


def choices(kind: Any) -> tuple[Any, ...]:
    """The values that a Literal type allows, or those in a list of it, or in a union with it; empty for other types."""
    if get_origin(kind) is Literal:
        return get_args(kind)
    parts = get_args(kind)[:1] if is_list(kind) else get_args(kind) if _is_union(kind) else ()
    return next((found for part in parts if not is_list(part) and (found := choices(part))), ())


def is_list(kind: Any) -> bool:
    """Whether a type stands for a list."""
    return get_origin(kind) is tuple


def may_be_list(kind: Any) -> bool:
    """Whether a type stands for a list among other things."""
    return _is_union(kind) and any(map(is_list, get_args(kind)))


def _is_union(kind: Any) -> bool:
    return get_origin(kind) in (Union, UnionType)  # `Literal[…] | tuple[…]` is the former, `tuple[…] | None` the latter


def _in_words(key: str, value: Any, kind: Any, error: str) -> str:
    allowed = list(map(json.dumps, choices(kind)))
    given = json.dumps(value, ensure_ascii=False, default=str)
    if isinstance(value, dict | list):
        given = _WORDS["object" if isinstance(value, dict) else "array"]
    if allowed and is_list(kind):
        wrong = [item for item in value if item not in choices(kind)] if isinstance(value, list) else []
        but = f"and {json.dumps(wrong[0], default=str)} is none of these" if wrong else f"not {given}"
        return f"`{key}` must be a list of {' and '.join(allowed)}, {but}"
    if allowed and not (may_be_list(kind) and isinstance(value, list)):
        return f"`{key}` must be {' or '.join(allowed)}{' or a list' if may_be_list(kind) else ''}, not {given}"
    match = _EXPECTED.match(error)
    if match is None:
        return f"`{key}`: {error[0].lower()}{error[1:]}"
    names = [_WORDS.get(name, name) for name in match["type"].split(" | ") if name != "null"]
    got = f", not {_WORDS.get(match['got'], match['got'])}" if match["got"] else ""
    return f"`{key}`{match['at'] or ''} must be {' or '.join(names)}{got}"
