"""The types of JSON documents and their parts (docs/json.md); `urdfsync schema` prints their schemas."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Generic, Literal, TypeVar

import msgspec

from urdfsync.diagnostics import Diagnostic

Item = TypeVar("Item")
Part = TypeVar("Part", bound=msgspec.Struct)
JSON_VERSION: Literal[3] = 3
"""Version of the JSON documents and events; raised when a key changes its meaning or goes away."""

KEYS = {
    "change_class": "class",
    "is_built": "built",
    "is_broken": "broken",
    "is_known": "known",
    "stale": "not_expanded",
}
"""Keys of documents by the names of fields that are called otherwise."""


class Document(msgspec.Struct, Generic[Item], kw_only=True):
    """What every command writes with `--json`; of None for one without results."""

    version: Literal[3] = JSON_VERSION
    command: str
    """Empty if the arguments name none."""
    exit: int
    results: Sequence[Item]
    """One for each robot, as far as the command came."""
    diagnostics: Sequence[Diagnostic]
    """Those about no robot."""


def fill(kind: type[Part], source: object, /, **given: Any) -> Part:
    """Return a part of a document: its fields are `given`, or they are attributes of these names of `source`."""
    fields = kind.__struct_fields__, kind.__struct_encode_fields__
    values = {key: given[name] if name in given else getattr(source, name) for name, key in zip(*fields, strict=True)}
    return msgspec.convert(values, kind, from_attributes=True)
