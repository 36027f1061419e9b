"""`urdfsync check`: compiles the packages, and compares them with an independent reference."""

from __future__ import annotations

import argparse
import functools
import math
import os

from urdfsync import advice, config
from urdfsync.check.results import CheckOptions
from urdfsync.commands import common
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.outcome import Exit
from urdfsync.report import Report

_DEFAULTS = CheckOptions()
_CHECK_OPTIONS = ("robot", "physics", "strict", "tool", "jobs", "timeout", "memory", "wait")
"""What only a check has a use for."""


def add(commands: common.Commands) -> None:
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
    common.add_robots(parser)
    parser.add_argument("--physics", action="store_true", help="compare poses, torques and masses with a reference")
    parser.add_argument(
        "--strict", action="store_true", help="what comes from an edit, or could not be checked, counts as a difference"
    )
    parser.add_argument(
        "--tool",
        choices=("rumoca", "omc"),
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
    parser.add_argument("--clear-cache", action="store_true", help="empty the user's cache of checks, and do no more")
    common.add_wait(parser)
    parser.set_defaults(run=functools.partial(_run, parser))
    common.add_common(parser)


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


def _run(parser: common.Parser, options: argparse.Namespace, report: Report) -> int:
    if options.clear_cache:
        return _clear_cache(parser, options, report)
    from urdfsync.check.results import exit_code
    from urdfsync.check.run import check_robots  # not at the top: no other command needs it

    configuration = common.configuration(options)
    robots = configuration.select([*options.robots, *(options.robot or [])])
    report.warnings(advice.warnings(configuration, robots))
    check_options = CheckOptions(
        physics=options.physics,
        strict=options.strict,
        compiler=options.tool,
        jobs=options.jobs,
        timeout=options.timeout,
        memory=options.memory,
        wait=options.wait,
        package_paths=config.ros_package_path(os.environ),
    )
    names = [robot.name for robot in robots]
    results = []
    for result in check_robots(configuration, robots, check_options, report.progress):
        report.check_result(result, options.strict, names)
        results.append(result)
    code = exit_code(results, options.strict)
    report.finish("check", code)
    return code


def _clear_cache(parser: common.Parser, options: argparse.Namespace, report: Report) -> int:
    """Empty the cache. Nothing else may be asked for: a check fills it again."""
    if options.robots or any(getattr(options, name) != parser.get_default(name) for name in _CHECK_OPTIONS):
        error = Diagnostic(
            Severity.ERROR,
            "usage",
            "--clear-cache goes without robots and without options of a check",
            hint="it empties the cache of all robots, and checks none",
        )
        report.bad_usage("check", parser.format_usage(), error)
        return Exit.ERROR
    from urdfsync.check.cache import UserCache

    report.waiting("emptying the cache")
    report.cleared(UserCache.default().clear())
    return Exit.IN_STEP
