"""The command line: arguments to calls to an exit code."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Sequence

from urdfsync import __version__, profiling, streams, uptodate
from urdfsync.commands import common
from urdfsync.dependencies import mark_incomplete, record_dependencies
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.outcome import Exit
from urdfsync.report import Report, unwritten

_COMMANDS = ("init", "build", "diff", "status", "watch", "check", "resolve", "record", "hook", "library")
"""In the order of the help. Each is a module of `commands`, loaded if it may be the one."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; returns the exit code. Whatever a user can cause is one line, never a traceback."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    started = uptodate.PROGRAM_START if arguments is None else uptodate.read_clocks()
    config_file = uptodate.find_config(given) if given and given[0] in uptodate.COMMANDS else None
    if config_file is None or not (sys.stdout and sys.stderr):
        return _run(given)
    key, transcript = uptodate.answer_key(given, config_file), streams.Transcript()
    with record_dependencies() as dependencies:
        code = _run(given, transcript)
    if code == 0:
        answer = [text for entry in transcript if entry[1] for text in entry]
        uptodate.save_answer(config_file, key, answer, dependencies, started)
    return code


def _run(arguments: list[str], transcript: streams.Transcript | None = None) -> int:
    with streams.SafeStreams(transcript) as output:
        code = _main(arguments)
        return unwritten(output) if output.trouble else code


def _main(arguments: list[str]) -> int:
    try:
        options = _parser(arguments).parse_args(arguments)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else Exit.ERROR
    except common.UsageError as error:
        command = next((argument for argument in arguments if argument in _COMMANDS), "")
        found = Diagnostic(Severity.ERROR, "usage", str(error), hint=f"`{error.program} --help` says more")
        Report("--json" in arguments).bad_usage(command, error.usage, found)
        return Exit.ERROR
    explain = getattr(options, "explain", False)
    report = Report(options.json, options.quiet, options.verbose, explain, str(options.config or ""))
    try:
        if getattr(options, "profile", False):
            return _profiled(arguments, lambda: int(options.run(options, report)))
        return int(options.run(options, report))
    except UrdfsyncError as error:
        report.problems(options.command, error.diagnostics)
        return Exit.ERROR
    except OSError as error:
        found = Diagnostic(Severity.ERROR, "system", error.strerror or str(error), str(error.filename or ""))
        report.problems(options.command, [found])
        return Exit.ERROR
    except KeyboardInterrupt:
        found = Diagnostic(Severity.ERROR, "interrupted", "interrupted; run the command again to finish the work")
        report.problems(options.command, [found], Exit.INTERRUPTED)
        return Exit.INTERRUPTED


def _profiled(arguments: Sequence[str], run: Callable[[], int]) -> int:
    """Run a command, and measure it; also how long a stamp takes that would have answered."""
    mark_incomplete()  # times can't be said again
    with profiling.measured(since=uptodate.PROGRAM_START[0]) as profile:
        with profiling.stage("stamp"):
            plain = [argument for argument in arguments if argument != "--profile"]
            profile.stamp = uptodate.has_answer(plain) if plain[0] in uptodate.COMMANDS else None
        return run()


def _parser(arguments: Sequence[str]) -> common.Parser:
    """The parser of a command, if one comes first; else that of all."""
    names = arguments[:1] if arguments and arguments[0] in _COMMANDS else _COMMANDS
    parser = common.Parser(
        prog="urdfsync",
        description="Keeps Modelica models in step with URDF files, and leaves alone what you edited.",
        epilog=f"Begin with `urdfsync init robot.urdf`, then `urdfsync build`.\n\n{common.CODES}",
    )
    parser.add_argument("--version", action="version", version=f"urdfsync {__version__}")
    commands = parser.add_subparsers(title="commands", dest="command", metavar="COMMAND", required=True)
    for name in names:
        importlib.import_module(f"urdfsync.commands.{name}").add(commands)
    return parser
