"""`urdfsync diff`: shows what changed since the last build, or between two versions of a source."""

from __future__ import annotations

import argparse

from urdfsync.api import diff
from urdfsync.commands import arguments
from urdfsync.engine.findings import CONNECTORS
from urdfsync.output.console import Console
from urdfsync.output.results import show_lines
from urdfsync.versions.comparison import Comparison, exit_code
from urdfsync.versions.report import robot_lines, to_document, to_section


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "diff",
        "--robot --wait",
        formats=True,
        help="show what changed in the sources since the last build",
        description="Show what changed in a source since the last build, or since another version of it: by element, "
        "with what follows for the whole model and for the files of the package. Nothing is written.",
        epilog="examples: urdfsync diff cad/arm.urdf\n"
        "          urdfsync diff arm --against HEAD~1\n"
        "          urdfsync diff cad/arm.urdf --against old/arm.urdf\n"
        "          urdfsync diff --edits modelica/Arm/Links",
    )
    parser.add_argument(
        "sources", nargs="*", metavar="SOURCE", help="sources or robots, with --edits also outputs (default: all)"
    )
    other = parser.add_mutually_exclusive_group()
    other.add_argument("--against", metavar="VERSION", help="the older version: a file or a git revision")
    other.add_argument("--edits", action="store_true", help="show what you edited in the packages instead")


def run(args: argparse.Namespace, console: Console) -> int:
    """Show what changed in each source."""
    if args.edits:
        from urdfsync.commands import edits  # the merge takes a while to load

        return edits.run(args, console)

    def show(compared: Comparison) -> None:
        console.add(compared, to_document, to_section)
        told = [diagnostic for diagnostic in compared.result.diagnostics if diagnostic.code != CONNECTORS]
        show_lines(console, compared.result, robot_lines(compared, verbose=console.verbose), told)

    options = {"config": args.config, "wait": args.wait, "progress": console.progress, "on_result": show}
    return console.end(exit_code(diff(*args.sources, robots=args.robot or (), against=args.against, **options)))
