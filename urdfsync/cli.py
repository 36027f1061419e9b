"""The command line: arguments to calls to an exit code."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeAlias

from urdfsync import __version__, streams
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.outcome import Exit, exit_code
from urdfsync.report import Report

_CODES = "exit codes: 0 in step, 1 out of step (--check), 2 error, 3 conflict, 4 locked, 130 interrupted"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; returns the exit code. Whatever a user can cause is one line, never a traceback."""
    with streams.guarded() as output:
        code = _main(sys.argv[1:] if arguments is None else list(arguments))
        if output.trouble:
            found = Diagnostic(Severity.ERROR, "output", f"the output can't be written: {output.trouble}")
            Report().problems("", [found])
            code = Exit.ERROR
    return code


def _main(arguments: list[str]) -> int:
    try:
        options = _parser().parse_args(arguments)
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else Exit.ERROR
    except _UsageError as error:
        command = error.program.partition(" ")[2]
        found = Diagnostic(Severity.ERROR, "usage", str(error), hint=f"`{error.program} --help` says more")
        Report("--json" in arguments).bad_usage(command, error.usage, found)
        return Exit.ERROR
    report = Report(options.json, options.quiet, options.verbose, getattr(options, "explain", False))
    try:
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


def _build(options: argparse.Namespace, report: Report) -> int:
    from urdfsync import advice, config
    from urdfsync.build import Request, build

    folder = config.working_folder()
    configuration = config.load(options.config or config.find(folder))
    robots = configuration.select([*options.robots, *(options.robot or [])])
    report.warnings(advice.warnings(configuration, robots))
    request = Request(
        full=options.full,
        dry=options.dry_run or options.check,
        draw=options.svg,
        package_paths=config.ros_package_path(os.environ),
        progress=report.progress,
        wait=options.wait,
    )
    results = []
    for result in build(configuration, robots, request):
        report.result(result)
        results.append(result)
    code = exit_code(results, options.check)
    report.finish("build", code)
    return code


def _init(options: argparse.Namespace, report: Report) -> int:
    from urdfsync import config, init

    file = config.working_folder() / (options.config or config.FILE_NAME)
    draft = init.draft(file, options.sources, options.domain)
    init.write(draft)
    report.draft(draft)
    return Exit.IN_STEP


def _library(_options: argparse.Namespace, report: Report) -> int:
    from urdfsync import config

    report.library(config.library_folder())
    return Exit.IN_STEP


class _UsageError(Exception):
    """Arguments that no command takes."""

    def __init__(self, message: str, usage: str, program: str) -> None:
        super().__init__(message)
        self.usage, self.program = usage, program


class _Parser(argparse.ArgumentParser):
    """A parser that leaves to `Report` what to say of bad arguments."""

    def __init__(self, **options: Any) -> None:
        super().__init__(allow_abbrev=False, **options)

    def error(self, message: str) -> NoReturn:
        raise _UsageError(message, self.format_usage(), self.prog)


def _parser() -> _Parser:
    parser = _Parser(
        prog="urdfsync",
        description="Keeps Modelica models in step with URDF files, and leaves alone what you edited.",
        epilog=f"Begin with `urdfsync init robot.urdf`, then `urdfsync build`.\n\n{_CODES}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"urdfsync {__version__}")
    commands = parser.add_subparsers(title="commands", dest="command", metavar="COMMAND", required=True)
    _add_init(commands)
    _add_build(commands)
    _add_library(commands)
    return parser


Commands: TypeAlias = "argparse._SubParsersAction[_Parser]"


def _add_init(commands: Commands) -> None:
    init = commands.add_parser(
        "init",
        help="write a commented urdfsync.toml",
        description="Write a commented urdfsync.toml for some sources, with guesses and their reasons.",
        epilog="example: urdfsync init cad/arm.urdf cad/gripper.urdf",
    )
    init.add_argument("sources", nargs="*", type=Path, metavar="SOURCE", help="default: all below this folder")
    init.add_argument("--domain", default="urdf", metavar="NAME", help="what the sources are (default: %(default)s)")
    init.set_defaults(run=_init)
    _add_common(init)


def _add_build(commands: Commands) -> None:
    build = commands.add_parser(
        "build",
        help="bring the packages in step with their sources",
        description="Bring Modelica packages in step with their sources. Files that you edited are never overwritten.",
        epilog=f"example: urdfsync build arm --dry-run --explain\n\n{_CODES}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    build.add_argument("robots", nargs="*", metavar="ROBOT", help="robots of urdfsync.toml (default: all)")
    build.add_argument("--robot", action="append", metavar="ROBOT", help="the same as an option; may be repeated")
    mode = build.add_mutually_exclusive_group()
    mode.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")
    mode.add_argument("--check", action="store_true", help="write nothing; exit with 1 if out of step")
    mode.add_argument("--svg", action="store_true", help="also draw each robot's diagram, to .urdfsync/svg/")
    build.add_argument("--wait", type=float, default=60, metavar="S", help="seconds to wait for another build (60)")
    build.add_argument("--full", action="store_true", help="render and compare everything, even if nothing changed")
    build.add_argument("--explain", action="store_true", help="list each file, what happens to it and why")
    build.set_defaults(run=_build)
    _add_common(build)


def _add_library(commands: Commands) -> None:
    library = commands.add_parser(
        "library",
        help="print where the Modelica library is",
        description="Print the folder of the Modelica library, and the line that puts it on MODELICAPATH. "
        "Into a pipe or a file goes the line alone.",
        epilog='example: eval "$(urdfsync library)"',
    )
    library.set_defaults(run=_library)
    _add_common(library)


def _add_common(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("common options")
    group.add_argument("--config", type=Path, metavar="PATH", help="default: urdfsync.toml, here or in a folder above")
    group.add_argument("--json", action="store_true", help="one JSON document on the standard output")
    group.add_argument("-q", "--quiet", action="store_true", help="only errors and conflicts")
    group.add_argument(
        "-v", "--verbose", action="store_true", help="all warnings, and files that are not just unchanged"
    )
