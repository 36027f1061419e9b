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
    "null": "nothing",
}


class WrongValueError(Exception):
    """A value is not of its key's type; the message names key, allowed and given value."""


def convert(key: str, value: Any, kind: Any) -> Any:
    """The value of a key as its type. Raises WrongValueError."""
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        raise WrongValueError(_in_words(key, value, kind, str(error))) from None


def choices(kind: Any) -> tuple[Any, ...]:
    """The values that a Literal type allows, or those in a list of it, or in a union with it; empty for other types."""
    if is_list(kind):
        kind = get_args(kind)[0]
    if _is_union(kind):
        return next((get_args(part) for part in get_args(kind) if get_origin(part) is Literal), ())
    return get_args(kind) if get_origin(kind) is Literal else ()


def is_list(kind: Any) -> bool:
    """Whether a type stands for a list."""
    return get_origin(kind) is tuple


def may_be_list(kind: Any) -> bool:
    """Whether a type stands for a list among other things."""
    return _is_union(kind) and any(map(is_list, get_args(kind)))


def _is_union(kind: Any) -> bool:
    return get_origin(kind) in (Union, UnionType)  # `Literal[…] | tuple[…]` is the former, `tuple[…] | None` the latter


def _in_words(key: str, value: Any, kind: Any, error: str) -> str:
    allowed = [_as_written(choice) for choice in choices(kind)]
    if allowed and is_list(kind):
        wrong = next((item for item in value if item not in choices(kind)), None) if isinstance(value, list) else None
        but = f"not {_as_written(value)}" if wrong is None else f"and {_as_written(wrong)} is none of these"
        return f"`{key}` must be a list of {' and '.join(allowed)}, {but}"
    if allowed and not (may_be_list(kind) and isinstance(value, list)):
        listed = " or a list" if may_be_list(kind) else ""
        return f"`{key}` must be {' or '.join(allowed)}{listed}, not {_as_written(value)}"
    match = _EXPECTED.match(error)
    if match is None:
        return f"`{key}`: {error[0].lower()}{error[1:]}"
    names = [_WORDS.get(name.strip(), name.strip()) for name in match["type"].split("|") if name.strip() != "null"]
    got = f", not {_WORDS.get(match['got'], match['got'])}" if match["got"] else ""
    return f"`{key}`{match['at'] or ''} must be {' or '.join(names)}{got}"


def _as_written(value: Any) -> str:
    """A value as TOML writes it; of a list or table only the kind."""
    if isinstance(value, dict | list):
        return _WORDS["object" if isinstance(value, dict) else "array"]
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str | bool) else str(value)
