"""`urdfsync check`: compiles the packages, and compares them with an independent reference."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

from urdfsync.checks import run as run_checks
from urdfsync.checks.compilers import COMPILERS
from urdfsync.checks.report import closing_lines, robot_lines, to_json, to_section
from urdfsync.checks.results import CheckOptions, CheckResult, CheckStatus, exit_code
from urdfsync.checks.tools import BOTH, chosen_tools
from urdfsync.commands import arguments
from urdfsync.output.console import Console, Format, has_marks


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "check",
        "robots --robot --wait --trust --executor --timeout --memory",
        formats=True,
        help="compile the packages, and compare them with an independent reference",
        description="Check packages as they are on disk: their syntax and layout, and whether their models compile and "
        "are balanced. With --physics poses, torques and masses are compared with an independent reference that reads "
        "the same source. Nothing is written. What your edits change is reported, and is no error.",
        epilog="examples: urdfsync check arm --physics\n"
        "          urdfsync check --physics --strict --timeout 60 --json",
    )
    option = parser.add_argument
    option("--physics", action="store_true", help="compare poses, torques and masses with a reference")
    option("--strict", action="store_true", help="what comes from an edit, or was not checked, counts as a difference")
    arguments.add_tool(parser, (*COMPILERS, BOTH))
    jobs = "robots at the same time (default: as cores and memory allow)"
    option("--jobs", type=arguments.count, metavar="N", help=jobs)


def run(args: argparse.Namespace, console: Console) -> int:
    """Check the packages of the robots, and show each as soon as it is checked."""
    configuration = arguments.configuration(args)
    robots = arguments.select_robots(args, configuration, console)
    tools = chosen_tools(configuration, args.tool, trusted=args.trusted)
    options = arguments.options_of(args, CheckOptions, tools=tools)
    checks = run_checks.check_robots(configuration, robots, options, console.progress)
    results = show_results(console, checks, args.strict)
    return console.end(exit_code(results, args.strict))


def show_results(console: Console, checks: Iterable[CheckResult], strict: bool) -> list[CheckResult]:
    """Show each result as it comes, then what holds for all, as far as the command comes; returns them."""
    results: list[CheckResult] = []
    marks = has_marks(sys.stdout)
    try:
        for result in checks:
            results.append(result)
            if console.format is Format.JSON:
                console.add_robot(to_json(result, strict))
            elif console.json:
                console.add_section(to_section(result, strict))
            elif not console.quiet or result.status(strict) is not CheckStatus.RIGHT:
                console.print(robot_lines(result, strict=strict, verbose=console.verbose, marks=marks))
            console.findings(result.diagnostics)
    finally:
        console.tell(closing_lines(results, strict=strict))
    return results
