"""Tables of a TOML file to typed values: unknown keys, missing keys and wrong types in words."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.spelling import nearest

_EXPECTED = re.compile(r"Expected `(?P<type>[^`]+)`(?:, got `(?P<got>\w+)`)?(?: - at `\$(?P<at>[^`]*)`)?")
_WORDS = {
    "str": "a string",
    "int": "an integer",
    "float": "a number",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
    "null": "nothing",
}


class Table(msgspec.Struct, frozen=True):
    """A table to be checked: its `values`, how messages call it, and where its keys stand."""

    values: Mapping[str, Any]
    name: str
    file: str
    line: Callable[[str], int]
    """Line of a key; of the table itself for `""`."""

    def problem(self, code: str, key: str, message: str, hint: str = "") -> Diagnostic:
        """An error about one key of this table, or about the table for `""`."""
        return Diagnostic(Severity.ERROR, code, message, self.file, self.line(key), hint=hint)


def unknown(table: Table, known: Iterable[str]) -> list[Diagnostic]:
    """An error for every key that is not among `known`, with the nearest that is."""
    known = sorted(known)
    found = []
    for key in table.values:
        if key not in known:
            near = nearest(key, known)
            hint = f"did you mean `{near}`?" if near else f"known keys are {', '.join(known)}"
            found.append(table.problem("unknown-key", key, f"unknown key `{key}` in {table.name}", hint))
    return found


def read(table: Table, struct: type[Any]) -> tuple[Any, list[Diagnostic]]:
    """The keys of `table` that `struct` (a msgspec.Struct) has, as its instance, or None and what is wrong.

    Keys that the structure does not have are left alone: see `unknown`.
    """
    values, found = {}, []
    for field in msgspec.structs.fields(struct):
        key = field.encode_name
        if key in table.values:
            try:
                values[field.name] = msgspec.convert(table.values[key], field.type)
            except msgspec.ValidationError as error:
                message = _in_words(key, table.values[key], field.type, str(error))
                found.append(table.problem("wrong-value", key, message))
        elif field.required:
            found.append(table.problem("missing-key", "", f"{table.name} has no `{key}`", f"add a line `{key} = …`"))
    if found:
        return None, found
    try:
        return struct(**values), []
    except (TypeError, ValueError) as error:
        return None, [table.problem("wrong-value", "", f"{table.name}: {error}")]


def choices(kind: Any) -> tuple[Any, ...]:
    """The values that a Literal type allows, or those of which a tuple type takes any number; empty for other types.

    Of a union, those of the Literal type in it.
    """
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
    allowed = [f'"{choice}"' if isinstance(choice, str) else str(choice) for choice in choices(kind)]
    if allowed and is_list(kind):
        return f"`{key}` must be a list of {' and '.join(allowed)}, {_but(value, choices(kind))}"
    if allowed and not (may_be_list(kind) and isinstance(value, list)):
        listed = " or a list" if may_be_list(kind) else ""
        return f"`{key}` must be {' or '.join(allowed)}{listed}, not {_as_written(value)}"
    match = _EXPECTED.match(error)
    if match is None:
        return f"`{key}`: {error[0].lower()}{error[1:]}"
    names = [_WORDS.get(name.strip(), name.strip()) for name in match["type"].split("|") if name.strip() != "null"]
    got = f", not {_WORDS.get(match['got'], match['got'])}" if match["got"] else ""
    return f"`{key}`{match['at'] or ''} must be {' or '.join(names)}{got}"


def _but(value: Any, allowed: tuple[Any, ...]) -> str:
    """What stands where a list of these should be, or the first of its items that is none of them."""
    if isinstance(value, list):
        return f"and {next(_as_written(item) for item in value if item not in allowed)} is none of these"
    return f"not {_as_written(value)}"


def _as_written(value: Any) -> str:
    """A value as TOML writes it, or what it is if it is no short one."""
    if isinstance(value, dict | list):
        return _WORDS["object" if isinstance(value, dict) else "array"]
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str | bool) else str(value)
