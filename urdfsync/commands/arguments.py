"""Arguments that several commands share."""

from __future__ import annotations

import argparse
import itertools
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple, NoReturn, TypeAlias, TypeVar, get_args

import msgspec

from urdfsync.api import load
from urdfsync.commands.overview import CODES
from urdfsync.common import system
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.remembered import remember_configuration
from urdfsync.output.console import PURPOSES, Console, Format
from urdfsync.project.config import Config, RobotConfig

DRIVER_ERROR = 255
"""Exit code of a failed merge driver; git reads lower codes as numbers of conflicts."""


class UsageError(UrdfsyncError):
    """Wrong arguments; `usage` lists the right arguments."""

    def __init__(self, parser: argparse.ArgumentParser, message: str, hint: str = "") -> None:
        super().__init__(Diagnostic(Severity.ERROR, "usage", message, hint=hint or f"`{parser.prog} --help` says more"))
        self.usage = parser.format_usage()


class CommandParser(argparse.ArgumentParser):
    """A parser that raises UsageError for bad arguments."""

    def __init__(self, **options: Any) -> None:
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str) -> NoReturn:
        """Raise UsageError."""
        raise UsageError(self, message)

    def options(self) -> list[str]:
        """Return the names of all options."""
        return [name for action in self._actions for name in action.option_strings]


Returned = TypeVar("Returned")
Commands: TypeAlias = "argparse._SubParsersAction[CommandParser]"


def count(text: str) -> int:
    """Return a number of processes or robots."""
    if not text.isascii() or not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of 1 or more")
    return int(text)


def seed(text: str) -> int:
    """Return the seed of random numbers."""
    if not text.isascii() or not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is no seed; give a whole number, 0 or more")
    return int(text)


def revision(text: str) -> str:
    """Return the name of a revision."""
    if not text.strip():
        raise argparse.ArgumentTypeError("an empty text is no revision; give one such as HEAD~1")
    return text


def amount(text: str) -> float:
    """Return a number greater than 0."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"{text!r} is no amount; give a number greater than 0")
    return number


_SHARED: Mapping[str, dict[str, Any]] = {
    "robots": {
        "nargs": "*",
        "metavar": "ROBOT",
        "help": "robots of urdfsync.toml, their sources or outputs (default: all)",
    },
    "--set": {
        "dest": "values",
        "action": "append",
        "metavar": "NAME=VALUE",
        "default": [],
        "help": "give a parameter a value; may be repeated",
    },
    "--wait": {"type": float, "default": 60, "metavar": "S", "help": "seconds to wait for another build (default: 60)"},
    "--trust": {
        "dest": "trusted",
        "action": "store_true",
        "help": "allow the configuration to write outside of its folder, to run a robot's `command`, and to choose "
        "OpenModelica or its program (`omc`)",
    },
    "--jobs": {"type": count, "metavar": "N", "help": "processes for many robots (default: one per core)"},
    "--timeout": {
        "type": amount,
        "metavar": "S",
        "default": 600.0,
        "help": "processor time for each robot in s (default: 600)",
    },
    "--memory": {"type": amount, "metavar": "GB", "help": "memory for all processes (default: most of what is free)"},
    "--column": {
        "dest": "columns",
        "action": "append",
        "metavar": "JOINT.QUANTITY=NAME",
        "default": [],
        "help": "a column of the log: elbow.effort=current3, or with a factor =current3*21.5; may be repeated",
    },
    "--topic": {
        "metavar": "NAME",
        "default": "",
        "help": "the topic of a recording of ROS 2 (default: the only one with joint states)",
    },
    "--motor-side": {
        "action": "store_true",
        "help": "the log has positions and efforts of motors: the gears of the source turn them into those of joints",
    },
}
"""Arguments and options that several commands take."""


def add_command(
    commands: Commands, name: str, shared: str = "", *, formats: bool = False, **texts: Any
) -> CommandParser:
    """Add the parser of a command, with some of `_SHARED` and with the options that every command has.

    With `formats`, the command can write its result in each `Format`.
    """
    texts["epilog"] += "" if "exit codes" in texts["epilog"] else f"\n\n{CODES}"
    parser = commands.add_parser(name, **texts)
    for option in shared.split():
        parser.add_argument(option, **_SHARED[option])
    parser.set_defaults(parser=parser)
    group = parser.add_argument_group("common options")
    group.add_argument("--config", type=Path, metavar="PATH", help="default: urdfsync.toml, here or in a folder above")
    choices = get_args(Format) if formats else ("text", "json")
    words = "; " + ", ".join(f"{name} {purpose}" for name, purpose in PURPOSES.items()) if formats else ""
    words = f"json: one JSON document on the standard output{words} (default: text)"
    group.add_argument("--format", choices=choices, default="text", help=words)
    group.add_argument("-q", "--quiet", action="store_true", help="only errors and conflicts")
    group.add_argument("-v", "--verbose", action="store_true", help="all warnings and changes, and the files concerned")
    return parser


def wants_json(given: Sequence[str]) -> bool:
    """Return whether arguments ask for JSON, even if no parser accepts them."""
    return "--format=json" in given or ("--format", "json") in itertools.pairwise(given)


def add_dry_run(container: argparse._ActionsContainer) -> None:
    """Add the option for a run that writes nothing."""
    container.add_argument("-n", "--dry-run", action="store_true", help="show what would be done, write nothing")


def add_tool(parser: CommandParser, titles: Mapping[str, str]) -> None:
    """Add the option `--tool`; `titles` has the compiler's name for each of its values."""
    *names, last = (name if name == title else f"{name} for {title}" for name, title in titles.items())
    which = f"the compiler: {', '.join(names)}, or {last}"
    what = f"{which} (default: as configured, else {names[0]})"
    parser.add_argument("--tool", choices=tuple(titles), type=partial(_tool_name, titles), help=what)


def _tool_name(titles: Mapping[str, str], text: str) -> str:
    """Return the value of `--tool` for a value or a title in any case: `omc` for `OpenModelica`."""
    by_title = {title.lower(): name for name, title in titles.items()}
    return by_title.get(text.lower(), text)


def select_robots(args: argparse.Namespace, configuration: Config, console: Console) -> Sequence[RobotConfig]:
    """Return the robots that the arguments name, or all; warn of settings without effect."""
    from urdfsync.project.config import warnings

    robots = configuration.select(args.robots)
    console.warnings(warnings.find_warnings(configuration, robots))
    console.announce(len(robots))
    return robots


class Configured(NamedTuple):
    """The configuration of a command, with the robots that its arguments name."""

    config: Config
    robots: Sequence[RobotConfig]
    reads: Reads
    """The files of the configuration."""


def load_robots(args: argparse.Namespace, console: Console) -> Configured:
    """Load the configuration, and select the robots that the arguments name; warn of settings without effect."""
    with Reads() as reads:
        config = load(args.config)
        return Configured(config, select_robots(args, config, console), reads)


def remember(configured: Configured, console: Console) -> None:
    """Let the next command skip this configuration, unless the command told something about it, or left robots out."""
    if configured.robots == configured.config.robots and not console.has_warned:
        remember_configuration(configured.config, configured.reads)


def select_robot(args: argparse.Namespace, console: Console) -> tuple[Config, RobotConfig]:
    """Return the configuration and the one robot that the arguments name; warn of settings without effect."""
    loaded = load(args.config)
    robots = select_robots(args, loaded, console)
    return loaded, loaded.select_one([robot.name for robot in robots], args.command, getattr(args, "model", ""))


def call(
    function: Callable[..., Returned],
    kind: type[msgspec.Struct],
    args: argparse.Namespace,
    console: Console,
    **given: Any,
) -> Returned:
    """Warn of settings without effect, then call a function of the API for the chosen robot.

    The fields of `kind` are set by arguments of the same names, or by `given`.
    """
    loaded = load(args.config)
    robots = select_robots(args, loaded, console)
    given = {"progress": console.progress, **chosen(kind, args), **given, "config": loaded}
    return function(*(robot.name for robot in robots), **given)


def request(args: argparse.Namespace, console: Console, **options: Any) -> BuildOptions:
    """Return how to build, as the arguments and `options` say."""
    return BuildOptions(progress=console.progress, **{**chosen(BuildOptions, args), **options})


def chosen(kind: type[msgspec.Struct], args: argparse.Namespace) -> dict[str, Any]:
    """Return the arguments that have the name of a field of `kind`."""
    given = {name: value for name, value in vars(args).items() if name in kind.__struct_fields__}
    return {name: tuple(value) if isinstance(value, list) else value for name, value in given.items()}


def split_sources(texts: Sequence[str], parser: argparse.ArgumentParser) -> list[tuple[Path, dict[str, str]]]:
    """Return each source with the arguments of xacro, `NAME:=VALUE`, after it; the first also has those before it."""
    sources, values = list[tuple[Path, dict[str, str]]](), dict[str, str]()
    for text in texts:
        name, is_argument, value = text.partition(":=")
        if is_argument and name.isidentifier():
            values[name] = value
        else:
            values = {} if sources else values
            sources.extend((Path(path), values) for path in system.expand(text))
    if values and not sources:
        raise UsageError(parser, f"`{next(iter(values))}:=` is an argument of xacro, and no source is named")
    for source, given in sources:
        if given and not _takes_arguments(source):
            raise UsageError(parser, f"`{next(iter(given))}:=` is an argument of xacro, and {source} is no xacro")
    return sources


def _takes_arguments(source: Path) -> bool:
    """Return whether a source looks like xacro or another format with arguments; its reader reports a faulty one."""
    from urdfsync.engine.sources.translators import find_translator

    try:
        return find_translator("urdf", source, read_unrecorded(source)) is not None
    except OSError:
        return True


def can_ask(console: Console) -> bool:
    """Return whether a person can answer a question."""
    return not console.is_document and sys.stdin is not None and sys.stdin.isatty()


def is_confirmed(question: str, done: str, console: Console) -> bool:
    """Ask the user to confirm; `done` is the action as a participle. Raises UrdfsyncError without a terminal."""
    if not can_ask(console):
        message, hint = f"nothing was {done}: there is no terminal to ask on", "look at what is shown, then give --yes"
        raise UrdfsyncError.of("not-confirmed", message, hint=hint)
    sys.stdout.write(f"{question} [y/N] ")
    sys.stdout.flush()
    return sys.stdin.readline().strip().lower() in ("y", "yes")
