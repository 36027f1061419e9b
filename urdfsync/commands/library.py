"""`urdfsync library`: prints the folder of the Modelica library."""

from __future__ import annotations

import argparse
import os
import shlex
import sys

import msgspec

from urdfsync.commands import arguments
from urdfsync.common.system import IS_WINDOWS
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console, line
from urdfsync.project import config


class LibraryDocument(msgspec.Struct):
    """The library's folder, and a line for the shell that puts this folder on MODELICAPATH."""

    folder: str
    line: str


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "library",
        help="print where the Modelica library is",
        description="Print the folder of the Modelica library, and the line that puts this folder on MODELICAPATH. "
        "A pipe or a file gets only the line.",
        epilog='examples: eval "$(urdfsync library)"\n'
        "          urdfsync library --shell powershell | Invoke-Expression",
    )
    words = "the shell that reads the line (default: powershell on Windows, else sh)"
    parser.add_argument(
        "--shell", choices=("cmd", "powershell", "sh"), default="powershell" if IS_WINDOWS else "sh", help=words
    )


def run(args: argparse.Namespace, console: Console) -> int:
    """Print the folder and the line for the shell; a pipe gets only the line."""
    folder = str(config.library_folder())
    command = _line(args.shell, folder)
    if not console.is_document and sys.stdout.isatty():
        console.print([line((folder, "")), line((command, ""))])
    elif not console.is_document:
        sys.stdout.write(f"{command}\n")  # without styles: a shell reads the line
    console.add(LibraryDocument(folder, command))
    return console.end(Exit.IN_STEP)


def _line(shell: str, folder: str) -> str:
    """Return the line for a shell that puts a folder before those on MODELICAPATH."""
    if shell == "cmd":
        others = f'set "MODELICAPATH={folder};%MODELICAPATH%"'
        return f'if defined MODELICAPATH ({others}) else set "MODELICAPATH={folder}"'
    if shell == "powershell":
        others = f"$(if ($env:MODELICAPATH) {{ '{os.pathsep}' + $env:MODELICAPATH }})"
        quoted = folder.replace("'", "''")
        return f"$env:MODELICAPATH = '{quoted}' + {others}"
    return f'export MODELICAPATH={shlex.quote(folder)}"${{MODELICAPATH:+{os.pathsep}$MODELICAPATH}}"'
