"""`urdfsync adopt`: takes over an existing package; its differences from the generated package become edits."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from urdfsync.api import load
from urdfsync.commands import arguments
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.edits import RobotEdits, find_edited
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inspect.inputs import inspect
from urdfsync.engine.inspect.package_files import key_of
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result, exit_code
from urdfsync.modelica.files import modelica_files
from urdfsync.output.build_section import show_result
from urdfsync.output.console import Console, StyledLine
from urdfsync.output.edits import to_section
from urdfsync.output.terminal import details, file_line
from urdfsync.project.config import Config, RobotConfig

_EDITS = 5
"""The greatest number of edits of a file that are listed without --verbose."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "adopt",
        "--wait --trust",
        help="take over packages that exist already; differences count as your edits",
        description="Build robots whose packages exist already: another tool wrote them, or urdfsync's recorded state "
        "is lost. A file that differs from the generated one counts as edited by you: it stays, and is listed. Missing "
        "files are written. Later exports merge with these files as with any edit.",
        epilog="example: urdfsync adopt arm --dry-run",
    )
    parser.add_argument("robots", nargs="+", metavar="ROBOT", help="robots of urdfsync.toml")
    arguments.add_dry_run(parser)


def run(args: argparse.Namespace, console: Console) -> int:
    """Build the robots for the first time, and show what differs from the generated package."""
    configuration = load(args.config)
    robots = {robot.name: robot for robot in configuration.select(args.robots)}
    request = arguments.request(args, console, dry=args.dry_run, adopts=True)
    looking = arguments.request(args, console, dry=True, adopts=args.dry_run)
    results = []
    for result in build(configuration, list(robots.values()), request):
        results.append(result)
        show_result(console, result)
        if not (result.failed or result.conflicts):
            console.tell(_lines(configuration, robots[result.robot], result, looking, verbose=console.verbose))
    return console.end(exit_code(results))


def _lines(
    configuration: Config, robot: RobotConfig, result: Result, looking: BuildOptions, *, verbose: bool
) -> Iterator[StyledLine]:
    """Yield the edited files with their edits, then the files that no build generates."""
    inputs = inspect(configuration, robot, looking)
    files = tuple(find_edited(inputs, generate_robot(inputs)))
    edits = to_section(RobotEdits(robot.name, result.root, files), verbose=verbose, most=_EDITS)
    yield from details(edits, verbose=verbose)
    generated = {action.path for action in result.actions if action.reason is not Reason.UNKNOWN}
    for place in sorted(modelica_files(result.folder)):
        path = key_of(Path(place), result.root)
        if path not in generated:
            yield file_line(result.shown(path), "unknown", "yours: no export changes it")
