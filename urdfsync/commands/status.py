"""`urdfsync status`: shows which files are in step, from the plan of a build that writes nothing."""

from __future__ import annotations

import argparse

from urdfsync.commands import arguments
from urdfsync.engine.build import build
from urdfsync.engine.result import Result, exit_code
from urdfsync.output.build_section import show
from urdfsync.output.console import Console
from urdfsync.output.status import status_section


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    arguments.add_command(
        commands,
        "status",
        "robots --wait",
        help="show which files are stale, edited, missing or in conflict",
        description="Show which files are in step, stale, edited, missing, orphans or in conflict. Nothing is written.",
        epilog="example: urdfsync status arm --verbose",
    )


def run(args: argparse.Namespace, console: Console) -> int:
    """Show the files of each robot's package."""
    configured, results = arguments.load_robots(args, console), list[Result]()
    for result in build(configured.config, configured.robots, arguments.request(args, console, dry=True)):
        show(console, result, status_section, result)
        results.append(result)
    arguments.remember(configured, console)
    return console.end(exit_code(results, check=True))
