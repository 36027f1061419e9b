"""`urdfsync report`: writes a page with a robot in 3D, its diagram, and what changed."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.commands import arguments
from urdfsync.config import working_folder
from urdfsync.engine.result import Exit
from urdfsync.files import shown
from urdfsync.output.console import Console, line
from urdfsync.simulation.files import input_files, not_writable, write_file


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
        "--robot --wait",
        help="write a page with a robot in 3D, and what changed",
        description="Write one HTML file that needs nothing else: the robot in 3D with its axes to move, its tree and "
        "its diagram, what changed since the last build or another version, your edits and the conflicts.",
        epilog="examples: urdfsync report arm\n          urdfsync report arm --against HEAD~1 --output review.html",
    )
    option = parser.add_argument
    option("robots", nargs="*", metavar="ROBOT", help="the robot, if there is more than one")
    option("--against", metavar="VERSION", help="the older version: a file or a git revision (default: the last build)")
    option("--output", type=Path, metavar="FILE.html", help="where to write it (default: the robot's name, here)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Write the page of one robot, and say where it is."""
    from urdfsync.checks.robot import known_check
    from urdfsync.pages.content import gather  # with numpy 100 ms, which `urdfsync --help` does without
    from urdfsync.pages.page import check_page, is_page, page

    configuration, robot = arguments.select_robot(args, console)
    file = args.output or working_folder() / f"{robot.name}.html"
    if args.output is None and (file.is_symlink() or (file.exists() and not is_page(file))):
        hint = "name a file with `--output`, this one to replace it"
        raise not_writable(file, "it is there, and urdfsync did not write it", hint)
    check_page(file, input_files(configuration, robot, None))
    content = gather(configuration, robot, args.against, arguments.request(args, console), working_folder())
    text = page(content, check=known_check(configuration, robot))
    write_file(file, text)
    section, place = content.section, shown(file)
    console.add(PageDocument(robot.name, place, len(text), section.summary))
    console.tell([line((robot.name, "bold"), (f": {section.summary}", "")), line((f"  page: {place}", ""))])
    return console.end(Exit.IN_STEP)


def prepare_report(args: argparse.Namespace, console: Console, motion: Path | None = None) -> Callable[..., None]:
    """Return a function that writes the `--report` of a command with its results, as `page` takes them.

    Raises an error for one that can't be written, before what it shows is worked out.
    """
    from urdfsync.pages.content import gather  # see above
    from urdfsync.pages.page import check_page, page

    configuration = arguments.configuration(args)
    robot = configuration.select_one([*args.robots, *(args.robot or [])], args.command)
    check_page(args.report, input_files(configuration, robot, motion))

    def write(**results: Any) -> None:
        content = gather(configuration, robot, None, arguments.request(args, console), working_folder())
        write_file(args.report, page(content, **results))

    return write
