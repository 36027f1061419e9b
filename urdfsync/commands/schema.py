"""`urdfsync schema`: prints the JSON schema of the configuration, for editors."""

from __future__ import annotations

import argparse
import sys

from urdfsync.commands import arguments
from urdfsync.config import schema
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "schema",
        help="print a JSON schema, for editors and programs",
        description="Print the JSON schema of urdfsync.toml. `urdfsync init` puts it to .urdfsync/schema.json, and "
        "names it in the configuration, so that editors complete and check that.",
        epilog="example: urdfsync schema config > .urdfsync/schema.json",
    )
    parser.add_argument("name", choices=("config",), nargs="?", default="config", help="what it is about")


def run(_args: argparse.Namespace, _console: Console) -> int:
    """Print the schema."""
    sys.stdout.write(schema.text())
    return Exit.IN_STEP
