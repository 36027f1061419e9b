"""Values of a table as their types want them, and types in words."""

from __future__ import annotations

import json
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin

import msgspec

_WORDS = {str: "a string", int: "an integer", float: "a number", bool: "true or false", dict: "a table"}


def convert(key: str, value: Any, kind: Any) -> Any:
    """The value of a key as its type. Raises ValueError, whose message names key, allowed and given value."""
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError:
        given = json.dumps(value, ensure_ascii=False, default=str)
        raise ValueError(f"`{key}` must be {in_words(kind)}, not {given}") from None


def in_words(kind: Any) -> str:
    """What a value may be: `a string`, `"fixed" or "floating"`, `a list of strings`."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is Literal:
        return " or ".join(map(json.dumps, arguments))
    if origin in (Union, UnionType):  # `Literal[…] | tuple[…]` is the former, `tuple[…] | None` the latter
        return " or ".join(in_words(part) for part in arguments if part is not NoneType)
    if origin in (tuple, list):
        return f"a list of {'strings' if arguments[0] is str else in_words(arguments[0])}"
    return _WORDS.get(kind, f"of the type {kind}")
