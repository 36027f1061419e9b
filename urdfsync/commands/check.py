"""`urdfsync check`: compiles the packages, and compares them with an independent reference."""

from __future__ import annotations

import argparse
import functools
import math
import os
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from urdfsync import config
from urdfsync.checking.wishes import Wishes
from urdfsync.commands import arguments
from urdfsync.outcome import Exit
from urdfsync.output.console import Console, line, rich_console
from urdfsync.output.json_values import finding_values
from urdfsync.output.phrases import byte_size

if TYPE_CHECKING:
    from urdfsync.checking.verdict import Verdict
    from urdfsync.domain import Deviation

_DEFAULTS = Wishes()
_WISHES = ("robot", "physics", "strict", "tool", "jobs", "timeout", "memory", "wait")
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
        "--tool", choices=("rumoca", "omc"), default=_DEFAULTS.tool, help="what compiles (rumoca); omc: OpenModelica"
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
    from urdfsync.checking import checker  # not at the top: no other command needs it
    from urdfsync.checking.verdict import exit_code

    configuration = arguments.configuration(args)
    robots = arguments.select_robots(args, configuration, console)
    wishes = Wishes(
        physics=args.physics,
        strict=args.strict,
        tool=args.tool,
        jobs=args.jobs,
        timeout=args.timeout,
        memory=args.memory,
        wait=args.wait,
        package_paths=config.ros_package_path(os.environ),
    )
    names = [robot.name for robot in robots]
    found = checker.check(configuration, robots, wishes, console.progress)
    verdicts = show_verdicts(console, found, names, args.strict)
    code = exit_code(verdicts, args.strict)
    console.end("check", code)
    return code


def show_verdicts(console: Console, found: Iterable[Verdict], robots: Sequence[str], strict: bool) -> list[Verdict]:
    """Show each verdict as it comes, then what holds for all, as far as the command comes; returns them."""
    from urdfsync.views import checks

    look = checks.Look(strict=strict, verbose=console.verbose, quiet=console.quiet)
    view = checks.Checks(rich_console(sys.stdout), robots, look)
    verdicts: list[Verdict] = []
    try:
        for verdict in found:
            verdicts.append(verdict)
            if console.json:
                console.add_robot(_values(verdict, strict))
            else:
                console.print(view.lines(verdict))
                console.findings(verdict.diagnostics)
    finally:
        if verdicts and not console.json:
            console.print(view.end())
    return verdicts


def _values(found: Verdict, strict: bool) -> dict[str, Any]:
    """What was checked of a robot as plain data; with `strict`, what an edit does is a difference as well."""
    from urdfsync.checking import words
    from urdfsync.checking.verdict import TOLERANCE

    return {
        "name": found.robot,
        "package": found.package,
        "standing": found.standing(strict),
        "failed": found.failed,
        "built": found.built,
        "in_step": found.in_step,
        "conflicting": found.conflicting,
        "summary": words.summary(found, strict),
        "compiled": [
            {"model": one.model, "unknowns": one.unknowns or None, "states": one.states if one.unknowns else None}
            for one in found.compiled
        ],
        "reference": found.reference,
        "tolerance": TOLERANCE,
        "agrees": found.generated.agrees if found.generated else None,
        "deviations": [_deviation_values(one) for one in found.generated.deviations] if found.generated else [],
        "edits": [
            {
                "files": list(one.files),
                "owners": list(one.owners),
                "deviations": [_deviation_values(each) for each in one.deviations],
            }
            for one in found.effects
        ],
        "notes": list(found.notes),
        "unchecked": list(found.unchecked),
        "gaps": list(found.gaps),
        "seconds": found.seconds,
        "megabytes": found.megabytes,
        "diagnostics": [finding_values(diagnostic) for diagnostic in found.diagnostics],
    }


def _deviation_values(found: Deviation) -> dict[str, Any]:
    """How far a quantity of an element is from the reference; JSON has no words for what is no number."""
    numbers = {name: getattr(found, name) for name in ("difference", "relative", "value", "size")}
    finite = {name: number if math.isfinite(number) else None for name, number in numbers.items()}
    reason = "" if finite["difference"] is not None else "the simulation gave no number"
    return {"quantity": found.quantity, "element": found.element, **finite, "unit": found.unit, "reason": reason}


def _clear_cache(parser: arguments.Parser, args: argparse.Namespace, console: Console) -> Exit:
    """Empty the cache. Nothing else may be asked for: a check fills it again."""
    if args.robots or any(getattr(args, name) != parser.get_default(name) for name in _WISHES):
        message = "--clear-cache goes without robots and without options of a check"
        raise arguments.UsageError(parser, message, "it empties the cache of all robots, and checks none")
    from urdfsync.checking.cache import Cache

    console.waiting("emptying the cache")
    freed = Cache.of_user().clear()
    console.stop_progress()
    if console.json:
        console.write_json("check", Exit.IN_STEP, {"freed": freed})
    elif not console.quiet:
        console.print([line((f"cache emptied, {byte_size(freed)} freed" if freed else "the cache was empty", ""))])
    return Exit.IN_STEP
