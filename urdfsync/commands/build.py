"""`urdfsync build`: brings packages in step with their sources."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from urdfsync.api import build_and_check
from urdfsync.commands import arguments
from urdfsync.common.files import shown
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.output.build_section import show_result
from urdfsync.output.console import Console, StyledLine, line

_NEXT_COMMANDS = {
    "library": "prints how these tools find the library UrdfSync",
    "watch": "builds whenever a source changes",
    "check": "compiles the package",
}


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "build",
        "robots --wait --trust --jobs",
        formats=True,
        help="bring the packages in step with their sources",
        description="Bring Modelica packages in step with their sources. Files that you edited are never overwritten.",
        epilog="example: urdfsync build arm --dry-run --verbose",
    )
    mode = parser.add_mutually_exclusive_group()
    arguments.add_dry_run(mode)
    mode.add_argument("--check", action="store_true", help="write nothing; exit with 1 if out of step")
    svg = "also draw each robot's diagram, to .urdfsync/svg/"
    mode.add_argument("--svg", dest="draw", action="store_true", help=svg)
    merge = "merge changes into files that you edited, unless they contradict your edits"
    parser.add_argument("--merge", action="store_true", help=merge)
    parser.add_argument("--full", action="store_true", help="render and compare everything, even if nothing changed")


def run(args: argparse.Namespace, console: Console) -> int:
    """Build the robots one by one, and show each result at once."""
    configured, results = arguments.load_robots(args, console), list[Result]()
    request = arguments.request(args, console, dry=args.dry_run or args.check, merges=args.merge)
    for result in build_and_check(configured.config, configured.robots, request):
        show_result(console, result)
        results.append(result)
    arguments.remember(configured, console)
    console.count_robots()
    console.tell(_next_steps(results))
    code = exit_code(results, args.check)
    is_late = code is Exit.OUT_OF_STEP and any(result.writes for result in results)
    if args.check and is_late and not console.is_document:
        console.print([line(("out of step: run `urdfsync build`, then commit what it writes", ""))])
    return console.end(code)


def _next_steps(results: Sequence[Result]) -> Iterator[StyledLine]:
    """Yield the next steps for packages that were built for the first time."""
    new = [result for result in results if result.is_first and not result.dry and not result.failed]
    if not new:
        return
    # a Modelica tool opens the outermost package around the robot's
    tops = (Path(result.folder, *[".."] * result.package.count("."), "package.mo") for result in new[:3])
    files = " or ".join(dict.fromkeys(shown(Path(os.path.normpath(top))) for top in tops))
    yield line(("", ""))
    yield line(("What to do next:", "bold"))
    yield line(("  open ", ""), (files, "bold"), (" in OMEdit or Dymola", ""))
    for command, what in _NEXT_COMMANDS.items():
        yield line((f"  urdfsync {command:<9}", "bold"), (what, ""))
