"""The command line: turns arguments into the call of a command, and its outcome into an exit code."""

from __future__ import annotations

import argparse
import contextlib
import importlib
import signal
import sys
import threading
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, get_args

from urdfsync.commands import arguments, overview
from urdfsync.common import streams, system
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError, findings_of
from urdfsync.common.spelling import nearest
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console, Format

_COMMANDS = (
    "init add remove adopt build diff report status watch check simulate identify fmu resolve record hook merge-driver "
    "library schema completion"
).split()
"""The commands in the order of the help. Each command is a module of `commands`; other commands' modules are not
loaded."""


def main(given: Sequence[str] | None = None) -> int:
    """Run a command; returns the exit code. An internal error is one line that names a file with the traceback."""
    given = sys.argv[1:] if given is None else list(given)
    with streams.SafeStreams() as output, _terminated_as_interrupted():
        code = _main(given)
        trouble = output.trouble
        return _for_git(given, tell_unwritten(trouble)) if trouble else code


def tell_unwritten(trouble: str) -> int:
    """Report that the output is incomplete; returns the exit code."""
    problem = Diagnostic(Severity.ERROR, "output", f"the output can't be written: {trouble}")
    return Console().end(Exit.ERROR, [problem])


def _main(given: list[str]) -> int:
    """Run a command. Only this function turns exceptions into exit codes."""
    command = _command(given)
    console = Console(command, format="json" if arguments.wants_json(given) else "text")
    try:
        args = _arguments(given)
        config = str(args.config or "")
        console = Console(command, format=args.format, quiet=args.quiet, verbose=args.verbose, config=config)
        return _call(args, console)
    except SystemExit as stop:  # --help and --version
        return stop.code if isinstance(stop.code, int) else Exit.ERROR
    except arguments.UsageError as error:
        if not console.is_document:
            sys.stderr.write(error.usage)
        problems, code = error.diagnostics, Exit.ERROR
    except UrdfsyncError as error:
        problems, code = error.diagnostics, Exit.LOCKED if error.is_locked else Exit.ERROR
    except KeyboardInterrupt as interruption:
        kept = f"; {interruption}" if interruption.args else ""
        message = f"interrupted{kept}; run the command again to finish the work"
        problems, code = (Diagnostic(Severity.ERROR, "interrupted", message),), Exit.INTERRUPTED
    except Exception as error:  # noqa: BLE001 - Python would exit with 1, the code for a package out of step
        problems, code = findings_of(error), Exit.ERROR
    return console.end(_for_git(given, code), problems)


def _arguments(given: list[str]) -> argparse.Namespace:
    """Return the arguments of a command. Raises UsageError; its hint has the most similar valid word."""
    parser = _parser(given)
    if given and not (given[0].startswith("-") or given[0] in _COMMANDS):
        raise arguments.UsageError(parser, f"no command `{given[0]}`", _meant(given[0], _COMMANDS))
    args, unknown = parser.parse_known_args(given)
    if unknown:  # argparse's own usage would lack the command's options
        name = unknown[0].partition("=")[0]
        is_format = "format" in args and name[2:] in get_args(Format)
        hint = f"write --format {name[2:]}" if is_format else _meant(name, args.parser.options())
        raise arguments.UsageError(args.parser, f"unrecognized arguments: {' '.join(unknown)}", hint)
    return args


def _meant(name: str, known: Iterable[str]) -> str:
    near = nearest(name, known)
    return f"did you mean `{near}`?" if near else ""


def _call(args: argparse.Namespace, console: Console) -> int:
    """Run the command. After Ctrl-C, an error of the clean-up counts as Ctrl-C."""
    try:
        return int(_module(args.command).run(args, console))
    except Exception as error:
        cause = error.__context__
        while cause is not None and not isinstance(cause, KeyboardInterrupt):
            cause = cause.__context__
        if cause is not None:
            raise KeyboardInterrupt from error
        raise


def _for_git(given: Sequence[str], error: int) -> int:
    """Return the exit code of an error; for the merge driver, a large one: git takes small codes for conflicts."""
    return arguments.DRIVER_ERROR if _command(given) == "merge-driver" and "--install" not in given else error


def _command(given: Sequence[str]) -> str:
    return next((argument for argument in given if argument in _COMMANDS), "")


@contextlib.contextmanager
def _terminated_as_interrupted() -> Iterator[None]:
    """Let SIGTERM, or Ctrl-Break, end a command as Ctrl-C does, with clean-up; `watch` has handlers of its own."""
    is_main = threading.current_thread() is threading.main_thread()
    signals = [one for one in system.ending_signals() if is_main and signal.getsignal(one) == signal.SIG_DFL]
    for number in signals:
        signal.signal(number, signal.default_int_handler)
    try:
        yield
    finally:
        for number in signals:
            signal.signal(number, signal.SIG_DFL)


class _ProgramParser(arguments.CommandParser):
    """The parser of the arguments before a command."""

    def format_help(self) -> str:
        return overview.help_text()


def _parser(given: Sequence[str]) -> arguments.CommandParser:
    """Return the parser of a command, if a command comes first; else the parser of all commands."""
    names = given[:1] if given and given[0] in _COMMANDS else _COMMANDS
    parser = _ProgramParser(prog="urdfsync")
    parser.add_argument("--version", action="version", version=overview.VERSION)
    commands = parser.add_subparsers(
        title="commands", dest="command", metavar="COMMAND", required=True, parser_class=arguments.CommandParser
    )
    for name in names:
        _module(name).add(commands)
    return parser


def _module(command: str) -> Any:
    return importlib.import_module(f"urdfsync.commands.{command.replace('-', '_')}")
