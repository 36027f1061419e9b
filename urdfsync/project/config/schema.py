"""Makes the JSON schema of `urdfsync.toml`, for editors, from the types that read it.

A schema can't compare tables or paths. So it misses clashing packages, one name for two elements, and an output in
`.urdfsync`. `load` reports these.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import msgspec

from urdfsync.common.diagnostics import IGNORABLE, OF_SOURCES
from urdfsync.domain import registry
from urdfsync.project.config.names import CLASS_PATTERN, LAST_PATTERN, PACKAGE_PATTERN, ROBOT_PATTERN
from urdfsync.project.config.paths import explained
from urdfsync.project.config.settings import DEFAULT_DOMAIN, DEFAULT_OUTPUT, OWN_KEYS, CheckConfig, Keys

DRAFT = "https://json-schema.org/draft/2020-12/schema"
SCHEMA_FILE = "schema.json"
"""The name of the schema's file in the state folder."""
_NO_CONTROL = "^[^\\u0000-\\u001f\\u007f]*$"
_PATH = {"type": "string", "minLength": 1}
_GIVEN = {"type": "array", "minItems": 1}


def config_schema() -> dict[str, Any]:
    """Return the schema of a configuration, with the options of all domains that are installed."""
    domains = {name: registry.domain(name) for name in registry.names()}
    kinds = Keys, CheckConfig, *(domain.options for domain in domains.values())
    places, parts = msgspec.json.schema_components(
        kinds, schema_hook=lambda _: dict(_PATH), ref_template="#/$defs/{name}"
    )
    keys, check, *options = (parts.pop(place["$ref"].rpartition("/")[2])["properties"] for place in places)
    keys["domain"]["enum"] = [*domains]
    for key, codes in (("ignore", IGNORABLE), ("refuse", OF_SOURCES)):
        keys[key]["items"] = {"enum": sorted(codes.union(*(domain.warnings for domain in domains.values())))}
    keys["package"]["pattern"], keys["class"]["pattern"] = PACKAGE_PATTERN, f"^$|{CLASS_PATTERN}"
    keys["output"]["default"] = DEFAULT_OUTPUT
    meanings = {key: cells[1] for key, cells in explained("configuration.md") if len(cells) == 2}
    for properties in (keys, check, *options):
        for key, described in properties.items():
            described["description"] = meanings.get(key, "")
    robots = {}
    for name, own in zip(domains, options, strict=True):
        robots[name] = _robot({**keys, "domain": keys["domain"] | {"enum": [name]}, **own})
    inherited = {key: described for own in (keys, *options) for key, described in own.items() if key not in OWN_KEYS}
    robot: dict[str, Any] = {"$ref": f"#/$defs/{DEFAULT_DOMAIN}"}
    for name in domains:  # `if`, since editors then show the faulty key; with `anyOf` they only say that no choice fits
        named = {"properties": {"domain": {"const": name}}, "required": ["domain"]}
        if name != DEFAULT_DOMAIN:
            robot = {"if": named, "then": {"$ref": f"#/$defs/{name}"}, "else": robot}
    schema = {
        "$schema": DRAFT,
        "title": "urdfsync.toml",
        "type": "object",
        "properties": {
            "defaults": _closed(inherited),
            "check": _closed(check),
            "robots": {
                "type": "object",
                "propertyNames": {"pattern": ROBOT_PATTERN},
                "additionalProperties": robot,
            },
        },
        "additionalProperties": False,
        "$defs": {**robots, **parts},
    }
    _refuse_control_characters(schema)
    return schema


def text() -> str:
    """Return the schema as the text of its file."""
    return json.dumps(config_schema(), indent=2) + "\n"


def _closed(properties: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _robot(properties: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of a robot, with the rules for keys that go together."""
    command, inputs = {"properties": {"command": _GIVEN}, "required": ["command"]}, {"command_inputs": _GIVEN}
    chosen = {"properties": {"class": {"minLength": 1}}, "required": ["class"]}
    return {
        **_closed(properties),
        "required": ["source", "package"],
        "allOf": [
            {"if": command, "then": {"properties": {"arguments": False}}},
            {"if": {"properties": inputs, "required": ["command_inputs"]}, "then": command},
            {"if": {"not": chosen}, "then": {"properties": {"package": {"pattern": LAST_PATTERN}}}},
        ],
    }


def _refuse_control_characters(schema: Any) -> None:
    """Forbid control characters in all strings and keys of a schema."""
    for part in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ():
        _refuse_control_characters(part)
    if isinstance(schema, dict) and schema.get("type") == "string":
        if schema.setdefault("pattern", _NO_CONTROL) != _NO_CONTROL:
            schema["allOf"] = [{"pattern": _NO_CONTROL}]
    elif isinstance(schema, dict) and isinstance(schema.get("additionalProperties"), dict):
        schema.setdefault("propertyNames", {"pattern": _NO_CONTROL})
