"""`urdfsync schema`: prints the JSON schema of the configuration, or of the document that a command writes."""

from __future__ import annotations

import argparse
import importlib
import json
import sys
from collections.abc import Mapping
from typing import Any

import msgspec

from urdfsync.commands import arguments
from urdfsync.config import schema
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.result import Exit, Result
from urdfsync.output.console import JSON_VERSION, Console
from urdfsync.output.results import RobotDocument

_ROBOTS = {
    **dict.fromkeys(("build", "status", "resolve", "remove", "adopt", "hook"), "output.results:RobotDocument"),
    "diff": "versions.report:ComparisonDocument output.edits:EditsDocument",
    "report": "commands.report:PageDocument",
    "check": "checks.report:CheckDocument",
    "simulate": "simulation.report:SimulationDocument",
    "fmu": "simulation.report:FmuDocument",
    **dict.fromkeys(("init", "add"), "commands.init:Guess"),
}
"""By commands, the types of robots in their documents: they take long to load."""
_VALUES: Mapping[str, Mapping[str, Any]] = {
    **{name: {"config": str} for name in ("init", "add")},
    "record": {"class": str, "within": str, "file": str, "written": bool, "text": str},
    "library": {"folder": str, "line": str},
}
"""Likewise, the types of other values; a document of a command that failed has none."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "schema",
        help="print a JSON schema, for editors and programs",
        description="Print the JSON schema of urdfsync.toml, or of what a command writes with --json. `urdfsync init` "
        "puts the former to .urdfsync/schema.json, and names it in the configuration, so that editors complete and "
        "check that.",
        epilog="examples: urdfsync schema > .urdfsync/schema.json\n          urdfsync schema build",
    )
    names = ("config", *sorted({*_ROBOTS, *_VALUES, "merge-driver", "watch"}))
    parser.add_argument("name", choices=names, nargs="?", default="config", metavar="NAME", help=", ".join(names))


def run(args: argparse.Namespace, _console: Console) -> int:
    """Print the schema."""
    text = schema.text() if args.name == "config" else json.dumps(document_schema(args.name), indent=2) + "\n"
    sys.stdout.write(text)
    return Exit.IN_STEP


def document_schema(command: str) -> dict[str, Any]:
    """Return the schema of a command's document, of `watch` that of each line."""
    parts: dict[str, Any] = {}

    def schema_of(kind: Any) -> dict[str, Any]:
        (described,), more = msgspec.json.schema_components(
            [kind], ref_template="#/$defs/{name}", schema_hook=lambda _: {"type": "string"}
        )
        parts.update(more)
        return described

    places = (place.split(":") for place in _ROBOTS.get(command, "").split())
    robots = [schema_of(getattr(importlib.import_module(f"urdfsync.{module}"), name)) for module, name in places]
    properties = {
        "version": {"const": JSON_VERSION},
        "command": {"enum": [command, ""]},
        "exit": {"type": "integer"},
        "robots": {"type": "array", "items": {"anyOf": robots} if robots else False},
        "diagnostics": {"type": "array", "items": schema_of(Diagnostic)},
        **{name: schema_of(kind) for name, kind in _VALUES.get(command, {}).items()},
    }
    document = {"type": "object", "properties": properties, "required": ["version", "command", "exit", "diagnostics"]}
    lines = [document]
    for event in _events() if command == "watch" else ():
        own = {
            "version": properties["version"],
            "event": {"const": event.__struct_config__.tag},
            "time": {"type": "string", "format": "date-time"},
        }
        for field in msgspec.structs.fields(event):
            own[field.name] = schema_of(RobotDocument if field.type is Result else field.type)
        if own.pop("result", None):
            own = {"robot": {"type": "string"}, **parts["RobotDocument"]["properties"], **own}
        lines.append({"type": "object", "properties": own, "required": [*own]})
    top = {"anyOf": lines} if len(lines) > 1 else document
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": command, **top, "$defs": parts}


def _events() -> list[type[msgspec.Struct]]:
    """Return the events of `watch`."""
    from urdfsync.watch.events import Event, RobotEvent  # the other commands do without

    return [*(kind for kind in Event.__subclasses__() if kind is not RobotEvent), *RobotEvent.__subclasses__()]
