"""JSON documents (docs/json.md): results as plain data, under the names of their fields and properties.

A class of results may list the fields and properties for documents in `KEYS`. Other structs are written with all
fields. `urdfsync schema` prints schemas of the same types, with the docstrings of these fields and properties.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import msgspec

from urdfsync.common.diagnostics import Diagnostic

_PATHS = ("against", "file", "folder", "source")
"""The fields with texts of paths."""
JSON_VERSION: Literal[3] = 3
"""Version of the JSON documents and events; the number grows if a key is removed or changes its meaning."""


class Document(msgspec.Struct, kw_only=True):
    """The document that each command writes with `--format json`."""

    version: Literal[3] = JSON_VERSION
    command: str
    """Empty if the arguments name no command."""
    exit: int
    results: Sequence[Any]
    """One result for each finished robot."""
    diagnostics: Sequence[Diagnostic]
    """Diagnostics that belong to no robot."""


def plain(value: Any) -> Any:
    """Return a value as plain data; infinity and NaN become None."""
    match value:
        case msgspec.Struct():
            fields = ((name, getattr(value, name)) for name in document_keys(type(value)))
            return {name: plain(with_slashes(field) if name in _PATHS else field) for name, field in fields}
        case Mapping():
            return {str(key): plain(item) for key, item in value.items()}
        case list() | tuple():
            return list(map(plain, value))
        case float():
            return value if math.isfinite(value) else None
        case str() | int() | None:
            return value
    return Path(value).as_posix()


def with_slashes(path: Any) -> Any:
    """Return the text of a path as it is on each system; other values, such as lists of files, as they are."""
    return path.replace(os.sep, "/") if isinstance(path, str) else path


def document_keys(kind: type[msgspec.Struct]) -> Sequence[str]:
    """Return the fields and properties that documents have."""
    return getattr(kind, "KEYS", kind.__struct_fields__)
