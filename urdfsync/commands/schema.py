"""`urdfsync schema`: prints the JSON schema of the configuration, or of the document that a command writes."""

from __future__ import annotations

import argparse
import datetime
import json
import sys
from typing import Any, Literal

import msgspec

from urdfsync.api import WholeRecord
from urdfsync.checks.results import CheckResult
from urdfsync.commands import arguments
from urdfsync.commands.init import Guess
from urdfsync.commands.library import LibraryDocument
from urdfsync.commands.report import PageDocument
from urdfsync.config import schema
from urdfsync.engine.edits import RobotEdits
from urdfsync.engine.result import Exit, Result
from urdfsync.identification.results import Excitation, Identification
from urdfsync.output.console import Console
from urdfsync.output.documents import Document, document_type
from urdfsync.simulation.fmu import WrittenFmu
from urdfsync.simulation.outcomes import Study
from urdfsync.simulation.results import SimulateResult
from urdfsync.versions.comparison import Comparison

_RESULTS: dict[str, tuple[Any, ...]] = {
    **dict.fromkeys(("build", "status", "resolve", "remove", "adopt", "hook"), (Result,)),
    **dict.fromkeys(("init", "add"), (Guess,)),
    "diff": (Comparison, RobotEdits),
    "report": (PageDocument,),
    "check": (CheckResult,),
    "simulate": (SimulateResult, Study),
    "identify": (Identification, Excitation),
    "fmu": (WrittenFmu,),
    "record": (WholeRecord,),
    "library": (LibraryDocument,),
    **dict.fromkeys(("merge-driver", "watch"), (None,)),
}
"""Types of the results in the documents of commands; `watch` writes a document only if it ends with an error."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "schema",
        help="print a JSON schema, for editors and programs",
        description="Print the JSON schema of urdfsync.toml, or of what a command writes with --format json. "
        "`urdfsync init` writes the schema of urdfsync.toml to .urdfsync/schema.json and names it in the "
        "configuration. Editors then complete and check the configuration.",
        epilog="examples: urdfsync schema > .urdfsync/schema.json\n          urdfsync schema build",
    )
    names = ("config", *sorted(_RESULTS))
    parser.add_argument("name", choices=names, nargs="?", default="config", metavar="NAME", help=", ".join(names))


def run(args: argparse.Namespace, _console: Console) -> int:
    """Print the schema."""
    text = schema.text() if args.name == "config" else json.dumps(document_schema(args.name), indent=2) + "\n"
    sys.stdout.write(text)
    return Exit.IN_STEP


def document_schema(name: str) -> dict[str, Any]:
    """Return the schema of a command's document; for `watch`, that of a line of output."""
    kinds: list[Any] = [Document[document_type(kind)] for kind in _RESULTS[name]]  # type: ignore[misc]
    if name == "watch":
        from urdfsync.watch.events import Event, RobotEvent  # other commands need no events

        for kind in (*Event.__subclasses__(), *RobotEvent.__subclasses__()):
            head = {"version": Literal[3], "event": Literal[kind.__struct_config__.tag], "time": datetime.datetime}
            fields = {field.name: field.type for field in msgspec.structs.fields(document_type(kind))}
            kinds.append(msgspec.defstruct(kind.__name__, (head | fields).items()))
    schemas, parts = msgspec.json.schema_components(
        kinds, schema_hook=lambda _: {"type": "string"}, ref_template="#/$defs/{name}"
    )
    return {"$schema": schema.DRAFT, "title": name, "anyOf": [*schemas], "$defs": parts}
