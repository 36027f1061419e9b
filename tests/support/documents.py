"""Documents of `--format json` compared with the schema of their command, which must name all keys."""

from __future__ import annotations

import functools
from typing import Any

import jsonschema_rs

from urdfsync.commands.schema import document_schema


def is_described(document: Any, command: str) -> bool:
    """Whether a document obeys its schema, and has only keys that the schema names. Raises ValidationError."""
    _validator(command).validate(document)
    return True


@functools.cache
def _validator(command: str) -> jsonschema_rs.Validator:
    schema = document_schema(command)
    jsonschema_rs.meta.validate(schema)
    return jsonschema_rs.validator_for(_closed(schema))


def _closed(schema: Any) -> Any:
    """The schema, in which no object may have unnamed keys."""
    if isinstance(schema, list):
        return [_closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    closed = {key: _closed(part) for key, part in schema.items()}
    return {"additionalProperties": False, **closed} if "properties" in closed and "type" in closed else closed
