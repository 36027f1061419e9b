"""`urdfsync check`: compiles the packages, and compares them with an independent reference."""

from __future__ import annotations

import argparse
import functools
import math
import os
import sys
from collections.abc import Iterable, Sequence

from urdfsync import config
from urdfsync.check import run as run_checks
from urdfsync.check.cache import UserCache
from urdfsync.check.compilers import COMPILERS
from urdfsync.check.report import CheckReport, to_json
from urdfsync.check.results import CheckOptions, CheckResult, exit_code
from urdfsync.commands import arguments
from urdfsync.outcome import Exit
from urdfsync.output.console import Console, line, rich_console
from urdfsync.output.phrases import byte_size

_DEFAULTS = CheckOptions()
_CHECK_OPTIONS = ("robot", "physics", "strict", "tool", "jobs", "timeout", "memory", "wait", "executor")
"""What only a check has a use for."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "check",
        help="compile the packages, and compare them with an independent reference",
        description="Check packages as they are on disk: their syntax and layout, and whether their models compile and "
        "are balanced. With --physics poses, torques and masses are compared with an independent reference that reads "
        "the same source. Nothing is written. What your edits change is told, and is no fault.",
        epilog="examples: urdfsync check arm --physics\n"
        "          urdfsync check --physics --strict --timeout 60 --json\n\n"
        "exit codes: 0 right, 1 differs, out of step or not built, 2 error, 130 interrupted",
    )
    arguments.add_robots(parser)
    parser.add_argument("--physics", action="store_true", help="compare poses, torques and masses with a reference")
    parser.add_argument(
        "--strict", action="store_true", help="what comes from an edit, or could not be checked, counts as a difference"
    )
    parser.add_argument(
        "--tool",
        choices=tuple(COMPILERS),
        default=_DEFAULTS.compiler,
        help="what compiles (rumoca); omc: OpenModelica",
    )
    limits = parser.add_argument_group("limits")
    limits.add_argument(
        "--jobs", type=_count, metavar="N", help="robots at the same time (default: as cores and memory allow)"
    )
    limits.add_argument(
        "--timeout",
        type=_amount,
        metavar="S",
        default=_DEFAULTS.timeout,
        help=f"seconds for a robot ({_DEFAULTS.timeout:g})",
    )
    limits.add_argument("--memory", type=_amount, metavar="GB", help="memory for all together (default: what is free)")
    arguments.add_executor(parser, "check")
    parser.add_argument("--clear-cache", action="store_true", help="empty the user's cache of checks, and do no more")
    arguments.add_wait(parser)
    parser.set_defaults(run=functools.partial(run, parser))
    arguments.add_common(parser)


def _count(text: str) -> int:
    if not text.isascii() or not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of robots; give 1 or more")
    return int(text)


def _amount(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"{text!r} is no limit; give a number greater than 0")
    return number


def run(parser: arguments.Parser, args: argparse.Namespace, console: Console) -> Exit:
    """Check the packages of the robots, and show each as soon as it is checked."""
    if args.clear_cache:
        return _clear_cache(parser, args, console)
    configuration = arguments.configuration(args)
    robots = arguments.select_robots(args, configuration, console)
    options = CheckOptions(
        physics=args.physics,
        strict=args.strict,
        compiler=args.tool,
        jobs=args.jobs,
        timeout=args.timeout,
        memory=args.memory,
        wait=args.wait,
        executor=args.executor,
        package_paths=config.ros_package_path(os.environ),
    )
    names = [robot.name for robot in robots]
    results = show_results(
        console, run_checks.check_robots(configuration, robots, options, console.progress), names, args.strict
    )
    code = exit_code(results, args.strict)
    console.end("check", code)
    return code


def show_results(
    console: Console, found: Iterable[CheckResult], robots: Sequence[str], strict: bool
) -> list[CheckResult]:
    """Show each result as it comes, then what holds for all, as far as the command comes; returns them."""
    report = CheckReport(rich_console(sys.stdout), robots, strict=strict, verbose=console.verbose, quiet=console.quiet)
    results: list[CheckResult] = []
    try:
        for result in found:
            results.append(result)
            if console.json:
                console.add_robot(to_json(result, strict))
            else:
                console.print(report.lines(result))
                console.findings(result.diagnostics)
    finally:
        if results and not console.json:
            console.print(report.end())
    return results


def _clear_cache(parser: arguments.Parser, args: argparse.Namespace, console: Console) -> Exit:
    """Empty the cache. Nothing else may be asked for: a check fills it again."""
    if args.robots or any(getattr(args, name) != parser.get_default(name) for name in _CHECK_OPTIONS):
        message = "--clear-cache goes without robots and without options of a check"
        raise arguments.UsageError(parser, message, "it empties the cache of all robots, and checks none")
    console.waiting("emptying the cache")
    freed = UserCache.default().clear()
    console.stop_progress()
    if console.json:
        console.write_json("check", Exit.IN_STEP, {"freed": freed})
    elif not console.quiet:
        console.print([line((f"cache emptied, {byte_size(freed)} freed" if freed else "the cache was empty", ""))])
    return Exit.IN_STEP
