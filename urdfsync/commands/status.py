"""`urdfsync status`: says how packages stand, file by file, and writes nothing."""

from __future__ import annotations

import argparse

from urdfsync import advice, status
from urdfsync.commands import common
from urdfsync.config import shown
from urdfsync.engine.build import build
from urdfsync.outcome import exit_code
from urdfsync.report import Report


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "status",
        help="say which files are stale, edited, missing or in conflict",
        description="Say of each file whether it is in step, stale, edited, missing, an orphan or in conflict. "
        "Nothing is written.",
        epilog="example: urdfsync status arm --verbose\n\n"
        "exit codes: 0 it is told, in step or not; 2 error, 3 conflict, 4 locked, 130 interrupted",
    )
    common.add_robots(parser)
    common.add_wait(parser)
    common.add_profile(parser)
    parser.set_defaults(run=_run)
    common.add_common(parser)


def _run(options: argparse.Namespace, report: Report) -> int:
    configuration = common.configuration(options)
    robots = configuration.select([*options.robots, *(options.robot or [])])
    report.warnings(advice.warnings(configuration, robots))
    sources = {robot.name: shown(robot.source) for robot in robots}
    results = []
    for result in build(configuration, robots, common.request(options, report, dry=True)):
        report.status(status.of(result, sources[result.robot]))
        results.append(result)
    code = exit_code(results)
    report.finish("status", code)
    return code
