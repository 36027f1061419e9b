"""`urdfsync remove`: takes a robot out of the configuration, with the unedited files of its package."""

from __future__ import annotations

import argparse

from urdfsync.api import load
from urdfsync.commands import arguments
from urdfsync.commands.init import write_errors
from urdfsync.config import Config, tomlfile
from urdfsync.diagnostics import ConfigError
from urdfsync.engine.actions import ORPHANS, Action, Reason
from urdfsync.engine.build import build
from urdfsync.engine.result import Result, exit_code
from urdfsync.files import shown
from urdfsync.output.build_section import show_result
from urdfsync.output.console import Console
from urdfsync.output.sections import Mark, Section, Table
from urdfsync.output.terminal import file_line, text
from urdfsync.state.transaction import save

_FILES = 20
"""The most deleted files that are listed without --verbose."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "remove",
        "--wait --trust",
        help="take a robot out of urdfsync.toml, with its package",
        description="Take a robot's table out of urdfsync.toml, with all files of its package that nobody edited, its "
        "line in the package.order around, and its recorded state. You see first what will be deleted. Files that you "
        "edited, and records that your own files need, stay.",
        epilog="example: urdfsync remove gripper --dry-run",
    )
    parser.add_argument("robot", metavar="ROBOT", help="the robot to remove")
    mode = parser.add_mutually_exclusive_group()
    arguments.add_dry_run(mode)
    mode.add_argument("--yes", action="store_true", help="do not ask")


def run(args: argparse.Namespace, console: Console) -> int:
    """Show what will be deleted, ask, and delete it: package and recorded state first, then the table."""
    configuration = load(args.config)
    robots = configuration.select([args.robot])
    if len(robots) > 1:
        raise arguments.UsageError(args.parser, f"{args.robot!r} means {len(robots)} robots: name one")
    name = robots[0].name
    _without_robot(configuration, name, configuration.file.read_bytes())  # refuses a table that can't be removed
    if not args.yes:
        (result,) = build(configuration, robots, arguments.request(args, console, dry=True, removes=True))
        _show(console, result, f"its table in {shown(configuration.file)} goes")
    if args.yes or not (args.dry_run or result.failed or not arguments.is_confirmed("Remove it?", "removed", console)):
        # the generator holds the build lock until the loop ends: no other build can write the package again meanwhile
        for result in build(configuration, robots, arguments.request(args, console, removes=True)):
            if not result.failed:
                _take_out(configuration, name)
            _show(console, result, "removed")
    return console.end(exit_code([result]))


def _show(console: Console, result: Result, words: str) -> None:
    """Show what was done, or would be done, with each file."""
    if console.is_document or result.failed:
        show_result(console, result)
        return
    console.findings(result.diagnostics)
    decided = [action for action in result.actions.decided if action.writes or action.reason in ORPHANS]
    rows = [(result.shown(action.path), str(action.reason), _reason(action)) for action in decided]
    files = Table("Files", ("File", "", "Why"), rows, file_line, _FILES, "file")
    section = Section(result.robot, "; ".join([words, *result.counts(ORPHANS)]), Mark.FINE, tables=[files])
    console.tell(text(section, verbose=console.verbose))


def _reason(action: Action) -> str:
    """Return why a file stays; empty if it does not."""
    if action.reason is Reason.ORPHAN and action.mine == action.base:
        return "it is recorded, but this machine did not generate it"
    return action.reason.text if action.reason in ORPHANS else ""


def _take_out(configuration: Config, robot: str) -> None:
    """Write the configuration without the robot. Raises UrdfsyncError, also if the user saved it meanwhile."""
    with write_errors(configuration.file):
        content = configuration.file.read_bytes()
        save(configuration.file, content, _without_robot(configuration, robot, content))


def _without_robot(configuration: Config, robot: str, content: bytes) -> bytes:
    """Return the configuration's content without the robot. Raises ConfigError if the robot has no table."""
    text = content.decode()
    mark = "\ufeff" if text.startswith("\ufeff") else ""
    plain, name = text.removeprefix(mark), shown(configuration.file)
    new = tomlfile.without_table(plain, "robots", robot)
    before, after = (tomlfile.parse(version.replace("\r\n", "\n"), name, ConfigError) for version in (plain, new))
    del before["robots"][robot]
    if {"robots": {}, **after} != before:
        message, hint = f"`{robot}` is no table `[robots.{robot}]`", "write it as one, then remove it"
        raise ConfigError.of("inline-robots", message, name, hint=hint)
    return f"{mark}{new}".encode()
