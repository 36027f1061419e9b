"""`urdfsync status`: says of each file whether it is in step, from the plan of a build that writes nothing."""

from __future__ import annotations

import argparse

from urdfsync.api import status
from urdfsync.commands import arguments
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result, exit_code
from urdfsync.output.build_section import build_section
from urdfsync.output.console import Console
from urdfsync.output.results import show_lines
from urdfsync.output.status import lines


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    arguments.add_command(
        commands,
        "status",
        "robots --wait",
        help="say which files are stale, edited, missing or in conflict",
        description="Say of each file whether it is in step, stale, edited, missing, an orphan or in conflict. "
        "Nothing is written.",
        epilog="example: urdfsync status arm --verbose",
    )


def run(args: argparse.Namespace, console: Console) -> int:
    """Show how each robot's package stands."""

    def show(result: Result) -> None:
        console.add(result, build_section)
        show_lines(console, result, lines(result, verbose=console.verbose), result.diagnostics)

    results = arguments.call(status, BuildOptions, args, console, on_result=show)
    return console.end(exit_code(results, check=True))
