"""`urdfsync status`: says of each file whether it is in step, from the plan of a build that writes nothing."""

from __future__ import annotations

import argparse

from urdfsync.api import status
from urdfsync.commands import arguments
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result, exit_code
from urdfsync.output.console import Console
from urdfsync.output.repeated import show_findings
from urdfsync.output.results import robot_document
from urdfsync.output.status import lines


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    arguments.add_command(
        commands,
        "status",
        "robots --robot --wait",
        help="say which files are stale, edited, missing or in conflict",
        description="Say of each file whether it is in step, stale, edited, missing, an orphan or in conflict. "
        "Nothing is written.",
        epilog="example: urdfsync status arm --verbose",
    )


def run(args: argparse.Namespace, console: Console) -> int:
    """Show how each robot's package stands."""

    def show(result: Result) -> None:
        if console.is_document:
            console.add_result(robot_document(result))
            return
        show_findings(console, result, result.diagnostics)
        console.stop_progress()
        if not console.quiet or result.conflicts or result.is_broken:
            console.print(lines(result, verbose=console.verbose), error=result.failed)

    results = arguments.call(status, BuildOptions, args, console, on_result=show)
    return console.end(exit_code(results, check=True))
