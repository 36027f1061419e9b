"""JSON documents (docs/json.md): results as plain data, under the names of their fields and properties.

A class of results may list the fields and properties for documents in `KEYS`. Other structs are written with all
fields. `urdfsync schema` prints schemas of the same types.
"""

from __future__ import annotations

import functools
import math
import types
import typing
from collections.abc import Mapping, Sequence
from typing import Any, Generic, Literal, TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic

Item = TypeVar("Item")
JSON_VERSION: Literal[3] = 3
"""Version of the JSON documents and events; the number grows if a key is removed or changes its meaning."""


class Document(msgspec.Struct, Generic[Item], kw_only=True):
    """The document that each command writes with `--format json`; `Item` is None for a command without results."""

    version: Literal[3] = JSON_VERSION
    command: str
    """Empty if the arguments name no command."""
    exit: int
    results: Sequence[Item]
    """One result for each finished robot."""
    diagnostics: Sequence[Diagnostic]
    """Diagnostics that belong to no robot."""


def plain(value: Any) -> Any:
    """Return a value as plain data; infinity and NaN become None."""
    match value:
        case msgspec.Struct():
            return {name: plain(getattr(value, name)) for name in _keys(type(value))}
        case Mapping():
            return {str(key): plain(item) for key, item in value.items()}
        case list() | tuple():
            return list(map(plain, value))
        case float():
            return value if math.isfinite(value) else None
        case str() | int() | None:
            return value
    return str(value)  # of a path


@functools.cache
def document_type(kind: Any) -> Any:
    """Return the type of a value in documents, for the schemas of msgspec."""
    if kind is float:
        return float | None
    if not isinstance(kind, type):  # such as `Sequence[Action]`
        origin, parts = typing.get_origin(kind), tuple(map(document_type, typing.get_args(kind)))
        origin = typing.Union if origin is types.UnionType else origin
        return origin[parts] if origin and parts else kind
    if issubclass(kind, tuple):
        return document_type(*kind.__orig_bases__)  # type: ignore[attr-defined]
    if not issubclass(kind, msgspec.Struct):
        return kind
    hints = typing.get_type_hints(kind)
    fields = [(name, document_type(hints.get(name) or _property_type(kind, name))) for name in _keys(kind)]
    return kind if dict(fields) == hints else msgspec.defstruct(kind.__name__, fields)


def _property_type(kind: type, name: str) -> Any:
    return typing.get_type_hints(getattr(kind, name).fget)["return"]


def _keys(kind: type[msgspec.Struct]) -> Sequence[str]:
    return getattr(kind, "KEYS", kind.__struct_fields__)
