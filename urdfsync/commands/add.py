"""`urdfsync add`: adds robots to a configuration that exists."""

from __future__ import annotations

import argparse
import itertools
from pathlib import Path

from urdfsync.api import load
from urdfsync.commands import arguments
from urdfsync.commands.init import (
    Guess,
    guess_robots,
    robot_table,
    show_guesses,
    write_errors,
    write_schema,
    write_templates,
)
from urdfsync.common.diagnostics import ConfigError
from urdfsync.common.files import shown
from urdfsync.domain import registry
from urdfsync.output.console import Console
from urdfsync.project import config
from urdfsync.project.state.transaction import save


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "add",
        help="add a robot to urdfsync.toml",
        description="Add a table to urdfsync.toml for each source, with guesses and their reasons. Existing tables "
        "stay unchanged.",
        epilog="examples: urdfsync add cad/gripper.urdf\n"
        "          urdfsync add ur.urdf.xacro name:=ur10e ur_type:=ur10e",
    )
    sources = "the sources of the new robots; of xacro with arguments NAME:=VALUE"
    parser.add_argument("sources", nargs="+", metavar="SOURCE", help=sources)
    parser.add_argument("--domain", default="urdf", metavar="NAME", help="format of the sources (default: %(default)s)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Append the new tables, and show the guesses. Raises ConfigError, SourceError."""
    loaded, domain = load(args.config), registry.domain(args.domain)
    known = [
        Guess(robot.name, str(robot.source), robot.arguments or {}, robot.target.package) for robot in loaded.robots
    ]
    named = arguments.split_sources(args.sources, args.parser)
    guesses, warnings = guess_robots(args.command, domain, loaded.root, named, known)
    for guess, one in itertools.product(guesses, known):
        if Path(one.source).resolve() == (loaded.root / guess.source).resolve() and one.arguments == guess.arguments:
            message = f"{guess.source} is the source of `{one.robot}` already"
            hint = "give xacro other arguments, or write a table by hand for a second package"
            raise ConfigError.of("source-in-use", message, shown(loaded.file), hint=hint)
    content = loaded.file.read_bytes()
    text = content.decode()
    tables = "".join(f"\n{robot_table(guess, domain)}" for guess in guesses)
    ending = "\r\n" if "\r\n" in text else "\n"
    new = f"{text}{'' if text.endswith(chr(10)) else ending}{tables.replace(chr(10), ending)}"
    plain = new.removeprefix("\ufeff").replace("\r\n", "\n")
    config.parse(plain, loaded.file, shown(loaded.file))  # refuses contradictory settings
    with write_errors(loaded.file):
        write_schema(loaded.root)  # first: if writing fails, the configuration stays as it is
        write_templates(loaded.root, guesses)
        save(loaded.file, content, new.encode())
    return show_guesses(console, loaded.file, "extended", guesses, warnings)
