"""`urdfsync report`: writes a page with a robot in 3D, its diagram, and what changed."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.analysis.simulation.files import default_file, input_files, write_file
from urdfsync.api import load
from urdfsync.commands import arguments
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console, line
from urdfsync.project.config import working_folder


class PageDocument(msgspec.Struct):
    """A page that was written."""

    robot: str
    file: str
    bytes: int
    summary: str


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "report",
        "--wait",
        help="write a page with a robot in 3D, and what changed",
        description="Write one HTML file that needs no other file. It shows the robot in 3D with joints that you "
        "can move, its tree and diagram, the changes since the last build or another version, your edits and the "
        "conflicts.",
        epilog="examples: urdfsync report arm\n          urdfsync report arm --against HEAD~1 -o review.html",
    )
    option = parser.add_argument
    option("robots", nargs="*", metavar="ROBOT", help="the robot, if the project has several")
    option("--against", metavar="VERSION", help="the older version: git revision, else file (default: the last build)")
    option("-o", "--output", type=Path, metavar="FILE.html", help="the page's file (default: the robot's name, here)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Write the page of one robot, and show its path."""
    from urdfsync.analysis.checks.robot import known_check
    from urdfsync.analysis.pages.page import is_page  # takes 50 ms with Jinja, which `urdfsync --help` saves

    configuration, robot = arguments.select_robot(args, console)
    file = args.output or default_file(f"{robot.name}.html", is_page)
    written = prepare_page(args, console, file, against=args.against)(check=known_check(configuration, robot))
    console.add(written)
    console.tell([line((robot.name, "bold"), (f": {written.summary}", "")), line((f"  page: {written.file}", ""))])
    return console.end(Exit.IN_STEP)


def prepare_page(
    args: argparse.Namespace, console: Console, file: Path, *, against: str | None = None, motion: Path | None = None
) -> Callable[..., PageDocument]:
    """Return a function that writes the page of one robot; like `page`, it takes a simulation and a check.

    `against` is the older version; `motion` is an input file that the page must not replace. Raises an error for an
    unwritable file, before the work for the page begins.
    """
    from urdfsync.analysis.pages.content import gather  # see above
    from urdfsync.analysis.pages.page import check_page, page

    configuration = load(args.config)
    robot = configuration.select_one(args.robots, args.command, getattr(args, "model", ""))
    check_page(file, input_files(configuration, robot, motion))

    def write(**results: Any) -> PageDocument:
        try:
            content = gather(configuration, robot, against, arguments.request(args, console), working_folder())
        except UrdfsyncError as error:
            message = "this page was not written: it shows an older version"
            old = Diagnostic(Severity.WARNING, "old-page", message, shown(file))
            raise UrdfsyncError(*error.diagnostics, *([old] if file.exists() else [])) from error
        text = page(content, **results)
        write_file(file, text)
        return PageDocument(robot.name, shown(file), len(text), content.section.summary)

    return write
