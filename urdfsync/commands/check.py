"""`urdfsync check`: compiles the packages, and compares them with an independent reference."""

from __future__ import annotations

import argparse
from pathlib import Path

from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.compilers import BOTH, COMPILERS
from urdfsync.analysis.checks.report import closing_lines, to_section
from urdfsync.analysis.checks.results import CheckOptions, CheckResult, CheckStatus, Judgement, exit_code
from urdfsync.analysis.checks.run import check_robots
from urdfsync.commands import arguments
from urdfsync.commands.report import prepare_page
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.output.console import Console, line
from urdfsync.output.terminal import text


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "check",
        "robots --wait --trust --timeout --memory --column --topic --motor-side",
        formats=True,
        help="compile the packages, and compare them with an independent reference",
        description="Check packages as they are on disk: their syntax and layout, and whether their models compile and "
        "are balanced. With --physics poses, torques and masses are compared with an independent reference that reads "
        "the same source. Nothing is written. The command reports effects of your edits, which are no errors.",
        epilog="examples: urdfsync check arm --physics\n"
        "          urdfsync check --physics --strict --timeout 60 --format json",
    )
    option = parser.add_argument
    option("--physics", action="store_true", help="compare poses, torques and masses with a reference")
    option("--report", type=Path, metavar="FILE.html", help="write a page with the result of one robot")
    option(
        "--log",
        type=Path,
        metavar="FILE",
        help="tell how far one robot is from a log of its joints: CSV, Parquet, or a recording of ROS 2",
    )
    option("--strict", action="store_true", help="effects of edits, doubtful sources and unchecked robots fail")
    arguments.add_tool(parser, {name: compiler.TITLE for name, compiler in COMPILERS.items()} | {BOTH: BOTH})
    jobs = "robots at the same time (default: as cores and memory allow)"
    option("--jobs", type=arguments.count, metavar="N", help=jobs)


def run(args: argparse.Namespace, console: Console) -> int:
    """Check the robots, and show each result at once; at the end show the findings about all robots."""
    if (args.columns or args.topic or args.motor_side) and not args.log:
        raise arguments.UsageError(args.parser, "`--column`, `--topic` and `--motor-side` need `--log`")
    write_report = prepare_page(args, console, args.report) if args.report else None
    judgement, fault = _judge(args, console) if args.log else (None, None)
    configured, results = arguments.load_robots(args, console), list[CheckResult]()
    tools = compilers.choose(configured.config, args.tool, trusted=args.trusted)
    chosen = arguments.chosen(CheckOptions, args) | {"tools": tools, "curves": args.report is not None}
    options = CheckOptions(**chosen)
    try:
        progress = console.telling("compiling")
        for result in check_robots(configured.config, configured.robots, options, progress):
            if judgement:
                result.log = judgement
                result.diagnostics = (*result.diagnostics, *judgement.diagnostics)
            results.append(result)
            show_result(console, result)
    finally:
        console.tell(closing_lines(results))
    if write_report:
        write_report(check=results[0])
        console.tell([line((f"  report: {args.report}", ""))])
    if fault:
        raise fault
    return console.end(exit_code(results))


def _judge(args: argparse.Namespace, console: Console) -> tuple[Judgement | None, UrdfsyncError | None]:
    """Compare the one robot with a log; return the fault of a log that can't be used, to be told after the check."""
    from urdfsync.analysis.identification import run  # loads numpy
    from urdfsync.analysis.identification.results import IdentifyOptions

    given = {"columns": tuple(args.columns), "topic": args.topic, "motor_side": args.motor_side}
    options = IdentifyOptions(**given, wait=args.wait)
    chosen = arguments.select_robot(args, console)
    try:
        return run.judge(*chosen, args.log, options, console.progress), None
    except UrdfsyncError as fault:
        return None, fault


def show_result(console: Console, result: CheckResult) -> None:
    """Show the result of one robot."""
    if console.is_document:
        console.add(result, to_section)
    elif not console.quiet or result.status is not CheckStatus.RIGHT:
        console.print(text(to_section(result, verbose=console.verbose)))
    console.findings(result.diagnostics)
