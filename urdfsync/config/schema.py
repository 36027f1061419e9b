"""`urdfsync.toml` as a JSON schema, for editors: from the types and the names by which it is read.

No schema can compare tables, or paths with the folder that they are in: packages of two robots that clash, two elements
that get one name, an output in `.urdfsync`. `load` reports these.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync import registry
from urdfsync.config.names import CLASS_PATTERN, LAST_PATTERN, PACKAGE_PATTERN, ROBOT_PATTERN
from urdfsync.config.paths import explained
from urdfsync.config.settings import DEFAULT_DOMAIN, OWN_KEYS, CheckConfig, Keys
from urdfsync.diagnostics import IGNORABLE

SCHEMA_FILE = "schema.json"
"""Its name in the state folder."""
_NO_CONTROL = "^[^\\u0000-\\u001f\\u007f]*$"
_GIVEN = {"type": "array", "minItems": 1}


def config_schema() -> dict[str, Any]:
    """Return the schema of a configuration, with the options of all domains that are installed."""
    domains = registry.names()
    meanings = _meanings()
    options = {name: registry.domain(name).options for name in domains}
    parts: dict[str, Any] = {}
    keys = {
        name: {**_properties(Keys, meanings, parts), **_properties(options[name], meanings, parts)} for name in domains
    }
    codes = IGNORABLE.union(*(registry.domain(name).warnings for name in domains))
    for name, properties in keys.items():
        properties["domain"]["enum"] = [name]
        properties["ignore"]["items"] = {"enum": sorted(codes)}
        properties["package"]["pattern"] = PACKAGE_PATTERN
        properties["class"]["pattern"] = f"^$|{CLASS_PATTERN}"
    inherited = {key: value for properties in keys.values() for key, value in properties.items() if key not in OWN_KEYS}
    inherited |= {"domain": inherited["domain"] | {"enum": domains}}
    robot: dict[str, Any] = {"properties": {"domain": {"enum": domains}}}
    if len(domains) == 1:  # without conditions editors say what is wrong, and where
        robot = {"$ref": f"#/$defs/{domains[0]}"}
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "urdfsync.toml",
        "type": "object",
        "properties": {
            "defaults": _closed(inherited),
            "check": _closed(_properties(CheckConfig, meanings, parts)),
            "robots": {"type": "object", "propertyNames": {"pattern": ROBOT_PATTERN}, "additionalProperties": robot},
        },
        "additionalProperties": False,
        **({"allOf": [_by_default(domain, domains) for domain in domains]} if len(domains) > 1 else {}),
        "$defs": {**{name: _robot(properties) for name, properties in keys.items()}, **parts},
    }
    _refuse_control_characters(schema)
    return schema


def text() -> str:
    """Return the schema as the text of its file."""
    return json.dumps(config_schema(), indent=2) + "\n"


def _properties(
    struct: type[msgspec.Struct], meanings: Mapping[str, str], definitions: dict[str, Any]
) -> dict[str, Any]:
    """Return the keys of a table by the types by which they are read, one by one, as `load` does.

    Types of tables within them are added to `definitions`.
    """
    properties = {}
    for field in msgspec.structs.fields(struct):
        (schema,), tables = msgspec.json.schema_components(
            [field.type], schema_hook=lambda _: {"type": "string"}, ref_template="#/$defs/{name}"
        )
        definitions.update(tables)
        if field.type in (Path, Path | None):
            schema = {"type": "string", "minLength": 1}
        if field.encode_name in meanings:
            schema["description"] = meanings[field.encode_name]
        if field.default not in (msgspec.NODEFAULT, None):
            schema["default"] = msgspec.to_builtins(field.default, enc_hook=str)
        properties[field.encode_name] = schema
    return properties


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


def _by_default(default: str, domains: Sequence[str]) -> dict[str, Any]:
    """Return what the robots are if `[defaults]` has this domain; of one domain there is no such case."""
    robots = [{"if": _has_domain(name, name == default), "then": {"$ref": f"#/$defs/{name}"}} for name in domains]
    tables = {"properties": {"defaults": _has_domain(default, default == DEFAULT_DOMAIN)}}
    return {
        "if": tables if default == DEFAULT_DOMAIN else tables | {"required": ["defaults"]},
        "then": {"properties": {"robots": {"additionalProperties": {"allOf": robots}}}},
    }


def _has_domain(name: str, may_be_left_out: bool) -> dict[str, Any]:
    return {"properties": {"domain": {"const": name}}} | ({} if may_be_left_out else {"required": ["domain"]})


def _refuse_control_characters(schema: Any) -> None:
    """Let no string and no key in a schema have control characters."""
    for part in schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else ():
        _refuse_control_characters(part)
    if isinstance(schema, dict) and schema.get("type") == "string":
        schema.setdefault("pattern", _NO_CONTROL)
    elif isinstance(schema, dict) and isinstance(schema.get("additionalProperties"), dict):
        schema.setdefault("propertyNames", {"pattern": _NO_CONTROL})


def _meanings() -> dict[str, str]:
    """Return what the keys mean, as docs/configuration.md says it."""
    return {key: cells[1] for key, cells in explained("configuration.md") if len(cells) == 2}
