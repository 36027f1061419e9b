"""`urdfsync schema`: prints the JSON schema of the configuration, or of the document that a command writes."""

from __future__ import annotations

import argparse
import ast
import datetime
import functools
import inspect
import itertools
import json
import sys
import textwrap
import types
import typing
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

import msgspec

from urdfsync.analysis.checks.results import CheckResult
from urdfsync.analysis.identification.results import Excitation, Identification
from urdfsync.analysis.simulation.fmu import WrittenFmu
from urdfsync.analysis.simulation.outcomes import Study
from urdfsync.analysis.simulation.results import SimulateResult
from urdfsync.analysis.versions.comparison import Comparison
from urdfsync.api import WholeRecord
from urdfsync.commands import arguments
from urdfsync.commands.init import Guess
from urdfsync.commands.library import LibraryDocument
from urdfsync.commands.report import PageDocument
from urdfsync.engine.edits import RobotEdits
from urdfsync.engine.result import Exit, Result
from urdfsync.output.console import Console
from urdfsync.output.documents import Document, document_keys
from urdfsync.project.config import schema

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
    fields = typing.get_type_hints(_document_type(Document), include_extras=True)
    items = [_document_type(kind) for kind in _RESULTS[name]]
    kinds = [_struct(f"Document{n}", fields | {"results": Sequence[item]}, Document) for n, item in enumerate(items, 1)]  # type: ignore[valid-type]
    if name == "watch":
        from urdfsync.watch.events import Event, RobotEvent  # other commands need no events

        for kind in (*Event.__subclasses__(), *RobotEvent.__subclasses__()):
            head = {"version": Literal[3], "event": Literal[kind.__struct_config__.tag], "time": datetime.datetime}
            fields = typing.get_type_hints(_document_type(kind), include_extras=True)
            kinds.append(_struct(kind.__name__, head | fields, kind))
    schemas, parts = msgspec.json.schema_components(
        kinds, schema_hook=lambda _: {"type": "string"}, ref_template="#/$defs/{name}"
    )
    return {"$schema": schema.DRAFT, "title": name, "anyOf": [*schemas], "$defs": parts}


@functools.cache
def _document_type(kind: Any) -> Any:
    """Return the type of a value in documents, with the docstrings of its fields, for the schemas of msgspec."""
    if kind is float:
        return float | None
    if not isinstance(kind, type):  # such as `Sequence[Action]`
        origin, parts = typing.get_origin(kind), tuple(map(_document_type, typing.get_args(kind)))
        origin = typing.Union if origin is types.UnionType else origin
        return origin[parts] if origin and parts else kind
    if issubclass(kind, tuple):
        return _document_type(*kind.__orig_bases__)  # type: ignore[attr-defined]
    if not issubclass(kind, msgspec.Struct):
        return kind
    hints, texts, fields = typing.get_type_hints(kind), _docstrings(kind), dict[str, Any]()
    for name in document_keys(kind):
        field = _document_type(hints.get(name) or typing.get_type_hints(getattr(kind, name).fget)["return"])
        fields[name] = Annotated[field, msgspec.Meta(description=texts[name])] if name in texts else field
    return _struct(kind.__name__, fields, kind)


def _struct(name: str, fields: Mapping[str, Any], described: type) -> Any:
    """Return a struct with another struct's docstring."""
    return msgspec.defstruct(name, fields.items(), namespace={"__doc__": described.__doc__})


def _docstrings(kind: type) -> dict[str, str]:
    """Return the docstrings of a struct's fields and properties."""
    texts = dict[str, str]()
    for base in reversed(kind.__mro__[: kind.__mro__.index(msgspec.Struct)]):
        definition = typing.cast("ast.ClassDef", ast.parse(textwrap.dedent(inspect.getsource(base))).body[0])
        for part, following in itertools.pairwise([*definition.body, ast.Pass()]):
            match part, following:
                case ast.FunctionDef(name), _:
                    texts[name] = ast.get_docstring(part) or ""
                case ast.AnnAssign(ast.Name(name)), ast.Expr(ast.Constant(str(text))):
                    texts[name] = inspect.cleandoc(text)
    return texts
