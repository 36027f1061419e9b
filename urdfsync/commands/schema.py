"""`urdfsync schema`: prints the JSON schema of the configuration, or of the document that a command writes."""

from __future__ import annotations

import argparse
import importlib
import json
import sys
from typing import Any, TypedDict

import msgspec

from urdfsync.commands import arguments
from urdfsync.config import schema
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.result import Exit, Result
from urdfsync.output.console import JSON_VERSION, Console
from urdfsync.output.results import RobotDocument


class Written(TypedDict):
    """What `init` and `add` write."""

    config: str


class Library(TypedDict):
    """Where the Modelica library is."""

    folder: str
    line: str


Record = TypedDict("Record", {"class": str, "within": str, "file": str, "written": bool, "text": str})
"""What `record` writes: a file, or its text."""


class Nothing(TypedDict):
    """No values of its own."""


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
_VALUES: dict[str, Any] = {"init": Written, "add": Written, "record": Record, "library": Library}
"""Likewise, other values; a document of a command that failed has none."""


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
    places = (place.split(":") for place in _ROBOTS.get(command, "").split())
    kinds = [getattr(importlib.import_module(f"urdfsync.{module}"), name) for module, name in places]
    events = _events() if command == "watch" else []
    fields = [field for event in events for field in msgspec.structs.fields(event)]
    types = [RobotDocument if field.type is Result else field.type for field in fields]
    everything = [Diagnostic, _VALUES.get(command, Nothing), *kinds, *types]
    (finding, values, *schemas), parts = msgspec.json.schema_components(
        everything, ref_template="#/$defs/{name}", schema_hook=lambda _: {"type": "string"}
    )
    properties = {
        "version": {"const": JSON_VERSION},
        "command": {"enum": [command, ""]},
        "exit": {"type": "integer"},
        "robots": {"type": "array", "items": {"anyOf": schemas[: len(kinds)]} if kinds else False},
        "diagnostics": {"type": "array", "items": finding},
        **parts[values["$ref"].rpartition("/")[2]]["properties"],
    }
    document = {"type": "object", "properties": properties, "required": ["version", "command", "exit", "diagnostics"]}
    lines, rest = [document], iter(schemas[len(kinds) :])
    for event in events:
        own = {field.name: next(rest) for field in msgspec.structs.fields(event)}
        result = own.pop("result", None)
        own = {"robot": {"type": "string"}, **parts["RobotDocument"]["properties"], **own} if result else own
        own |= {"version": properties["version"], "event": {"const": event.__struct_config__.tag}}
        own["time"] = {"type": "string", "format": "date-time"}
        lines.append({"type": "object", "properties": own, "required": [*own]})
    top = {"anyOf": lines} if events else document
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": command, **top, "$defs": parts}


def _events() -> list[type[msgspec.Struct]]:
    """Return the events of `watch`."""
    from urdfsync.watch.events import Event, RobotEvent  # the other commands do without

    return [*(kind for kind in Event.__subclasses__() if kind is not RobotEvent), *RobotEvent.__subclasses__()]
