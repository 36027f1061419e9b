"""`urdfsync library`: prints the folder of the Modelica library."""

from __future__ import annotations

import argparse
import os
import shlex
import sys

import msgspec

from urdfsync.commands import arguments
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console, line
from urdfsync.project import config


class LibraryDocument(msgspec.Struct):
    """The library's folder, and a line for the shell that puts this folder on MODELICAPATH."""

    folder: str
    line: str


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    arguments.add_command(
        commands,
        "library",
        help="print where the Modelica library is",
        description="Print the folder of the Modelica library, and the line that puts this folder on MODELICAPATH. "
        "A pipe or a file gets only the line.",
        epilog='example: eval "$(urdfsync library)"',
    )


def run(_args: argparse.Namespace, console: Console) -> int:
    """Print the folder and the line for the shell; a pipe gets only the line."""
    folder = str(config.library_folder())
    if os.name == "nt":
        command = f"set MODELICAPATH={folder};%MODELICAPATH%"
    else:
        command = f'export MODELICAPATH={shlex.quote(folder)}"${{MODELICAPATH:+:$MODELICAPATH}}"'
    if not console.is_document and sys.stdout.isatty():
        console.print([line((folder, "")), line((command, ""))])
    elif not console.is_document:
        sys.stdout.write(f"{command}\n")  # without styles: a shell reads the line
    console.add(LibraryDocument(folder, command))
    return console.end(Exit.IN_STEP)
