"""`urdfsync build`: brings packages in step with their sources."""

from __future__ import annotations

import argparse

from urdfsync import advice
from urdfsync.commands import common
from urdfsync.commands.building import built
from urdfsync.outcome import exit_code
from urdfsync.report import Report


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "build",
        help="bring the packages in step with their sources",
        description="Bring Modelica packages in step with their sources. Files that you edited are never overwritten.",
        epilog=f"example: urdfsync build arm --dry-run --explain\n\n{common.CODES}",
    )
    common.add_robots(parser)
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")
    mode.add_argument("--check", action="store_true", help="write nothing; exit with 1 if out of step")
    mode.add_argument("--svg", action="store_true", help="also draw each robot's diagram, to .urdfsync/svg/")
    common.add_wait(parser)
    common.add_jobs(parser)
    common.add_profile(parser)
    parser.add_argument("--full", action="store_true", help="render and compare everything, even if nothing changed")
    parser.add_argument("--repair", action="store_true", help="make a state again that has merge markers or is damaged")
    parser.add_argument("--explain", action="store_true", help="list each file, what happens to it and why")
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(options: argparse.Namespace, report: Report) -> int:
    configuration = common.configuration(options)
    robots = configuration.select([*options.robots, *(options.robot or [])])
    report.warnings(advice.warnings(configuration, robots))
    dry = options.dry_run or options.check
    request = common.request(options, report, full=options.full, dry=dry, draw=options.svg, repair=options.repair)
    results = []
    for result in built(configuration, robots, request):
        report.result(result)
        results.append(result)
    code = exit_code(results, options.check)
    report.finish("build", code)
    return code
