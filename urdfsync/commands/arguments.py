"""Arguments that several commands share."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

from urdfsync import config, profiling
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions
from urdfsync.output.console import Console

CODES = "exit codes: 0 in step, 1 out of step (diff, build --check), 2 error, 3 conflict, 4 locked, 130 interrupted"


class UsageError(UrdfsyncError):
    """Arguments that a command does not take; `usage` says which it takes."""

    def __init__(self, parser: argparse.ArgumentParser, message: str, hint: str = "") -> None:
        super().__init__(Diagnostic(Severity.ERROR, "usage", message, hint=hint or f"`{parser.prog} --help` says more"))
        self.usage = parser.format_usage()


class Parser(argparse.ArgumentParser):
    """A parser that raises UsageError for bad arguments."""

    def __init__(self, **options: Any) -> None:
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str) -> NoReturn:
        """Raise UsageError."""
        raise UsageError(self, message)


Commands: TypeAlias = "argparse._SubParsersAction[Parser]"


def add_common(parser: Parser) -> None:
    """The options that every command has."""
    group = parser.add_argument_group("common options")
    group.add_argument("--config", type=Path, metavar="PATH", help="default: urdfsync.toml, here or in a folder above")
    group.add_argument("--json", action="store_true", help="one JSON document on the standard output")
    group.add_argument("-q", "--quiet", action="store_true", help="only errors and conflicts")
    group.add_argument(
        "-v", "--verbose", action="store_true", help="all warnings, and files that are not just unchanged"
    )


def add_robots(parser: Parser) -> None:
    """The choice of robots, as arguments or options."""
    parser.add_argument("robots", nargs="*", metavar="ROBOT", help="robots of urdfsync.toml (default: all)")
    add_robot_option(parser)


def add_robot_option(parser: Parser) -> None:
    """The choice of robots by options alone."""
    parser.add_argument("--robot", action="append", metavar="ROBOT", help="only this robot; may be repeated")


def add_wait(parser: Parser) -> None:
    """How long to wait for another build."""
    parser.add_argument("--wait", type=float, default=60, metavar="S", help="seconds to wait for another build (60)")


def add_trust(parser: Parser) -> None:
    """Whether the user trusts the configuration."""
    parser.add_argument(
        "--trust", action="store_true", help="write to an `output` outside of the configuration's folder, too"
    )


def add_profile(parser: Parser) -> None:
    """Whether to measure."""
    parser.add_argument(
        "--profile", action="store_true", help="say where the time went; nothing is answered from memory"
    )


def add_executor(parser: Parser, verb: str) -> None:
    """A cluster that works instead of processes of this machine; never from the configuration, since it is trusted."""
    parser.add_argument(
        "--executor",
        default="",
        metavar="ADDRESS",
        help=f"have workers of a Dask scheduler {verb} the robots (tcp://HOST:PORT); it has to be one that you trust",
    )


def add_jobs(parser: Parser) -> None:
    """How many processes may work at once."""
    parser.add_argument("--jobs", type=_positive, metavar="N", help="processes for many robots (default: one per core)")


def _positive(text: str) -> int:
    if not text.isascii() or not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of processes; give 1 or more")
    return int(text)


@profiling.stage("configuration")
def configuration(args: argparse.Namespace) -> Config:
    """The configuration that the arguments name, or the nearest one. Raises ConfigError."""
    return config.load(args.config or config.find(config.working_folder()))


def select_robots(args: argparse.Namespace, configuration: Config, console: Console) -> Sequence[RobotConfig]:
    """The robots that the arguments name, or all; warns of what the configuration asks for in vain."""
    from urdfsync.config import warnings

    robots = configuration.select([*args.robots, *(args.robot or [])])
    console.warnings(warnings.find_warnings(configuration, robots))
    return robots


def request(args: argparse.Namespace, console: Console, **options: Any) -> BuildOptions:
    """How to build, with what is the same for all commands."""
    return BuildOptions(
        package_paths=config.ros_package_path(os.environ),
        progress=console.progress,
        wait=getattr(args, "wait", 60.0),
        trusted=getattr(args, "trust", False),
        jobs=getattr(args, "jobs", None),
        executor=getattr(args, "executor", ""),
        **options,
    )
