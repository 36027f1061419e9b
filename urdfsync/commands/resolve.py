"""`urdfsync resolve`: settles conflicts as the user says, file by file or all at once."""

from __future__ import annotations

import argparse
import functools
import os
from collections.abc import Sequence
from pathlib import Path

from urdfsync import config, resolution
from urdfsync.commands import common
from urdfsync.commands.building import built
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.build import build
from urdfsync.outcome import Exit, Result, exit_code
from urdfsync.report import Report
from urdfsync.resolution import Target, Wish
from urdfsync.state.record import Choice


def add(commands: common.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "resolve",
        help="settle conflicts between your edits and what is generated",
        description="Settle conflicts between your edits and what is generated. What waited for that is then built.",
        epilog="A file that you edited and that is no longer generated can be named too: --keep makes it yours, "
        f"--take deletes it.\n\nexample: urdfsync resolve modelica/Arm/Links/Elbow.mo --merge\n\n{common.CODES}",
    )
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file, or a folder for all conflicts below it")
    parser.add_argument("--all", action="store_true", help="all conflicts; with --merge, those that can be merged")
    common.add_robot_option(parser)
    choice = parser.add_mutually_exclusive_group()
    kinds = {
        Choice.KEEP: "leave your file as it is, until something new is generated",
        Choice.TAKE: "replace your file by the generated one",
        Choice.MERGE: "take both sides' changes, if they do not contradict each other",
    }
    for kind, words in kinds.items():
        choice.add_argument(f"--{kind}", dest="choice", action="store_const", const=kind, help=words)
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")
    common.add_wait(parser)
    common.add_common(parser)
    parser.set_defaults(run=functools.partial(_run, parser))


def _run(parser: common.Parser, options: argparse.Namespace, report: Report) -> int:
    configuration = common.configuration(options)
    robots = configuration.select(options.robot or [])
    found = list(build(configuration, robots, common.request(options, report, dry=True)))
    if wrong := _misuse(options):
        names = resolution.listing(found, config.shown)
        hint = f"in conflict: {names}" if names else "nothing is in conflict"
        error = Diagnostic(Severity.ERROR, "usage", wrong, hint=hint)
        report.bad_usage("resolve", parser.format_usage(), error)
        return Exit.ERROR
    if options.all:
        return _resolve_all(configuration, found, options, report)
    targets, missing = resolution.targets(found, [_wish(path, configuration.root) for path in options.paths])
    if missing:
        return _refuse(found, missing, report)
    choices = resolution.choices(targets, options.choice, config.shown)
    return _build(configuration, _concerned(targets), choices, options, report)


def _misuse(options: argparse.Namespace) -> str:
    """What is wrong with the arguments; empty if nothing is."""
    if options.choice is None:
        return "one of --keep, --take and --merge is needed"
    if options.all and options.paths:
        return "--all goes without paths"
    return "" if options.all or options.paths else "name files or folders, or use --all"


def _wish(typed: str, root: Path) -> Wish:
    """What a typed path may stand for: itself, and the place below the configuration that links lead it to."""
    if not typed:
        return Wish(typed, ())
    path = Path(os.path.normpath(config.working_folder() / typed))
    real, real_root = (Path(os.path.realpath(place)) for place in (path, root))
    within = (root / real.relative_to(real_root),) if real.is_relative_to(real_root) else ()
    return Wish(typed, (path, *within))


def _concerned(targets: Sequence[Target]) -> set[str]:
    return {target.result.robot for target in targets}


def _refuse(found: Sequence[Result], missing: Sequence[Wish], report: Report) -> int:
    """Say which paths are no conflicts, and which robots could not even be looked at."""
    failed = [result for result in found if result.failed]
    for result in failed:
        report.result(result)
    code = exit_code(failed) if failed else Exit.ERROR
    report.problems("resolve", [resolution.unknown(found, missing, config.shown)], code)
    return code


def _resolve_all(
    configuration: config.Config, found: Sequence[Result], options: argparse.Namespace, report: Report
) -> int:
    targets = resolution.conflicts(found)
    concerned = _concerned(targets) | {result.robot for result in found if result.failed}
    if not concerned:
        report.warnings([Diagnostic(Severity.NOTE, "no-conflict", "nothing is in conflict")])
    choices = resolution.possible(targets, options.choice)
    return _build(configuration, concerned, choices, options, report)


def _build(
    configuration: config.Config,
    concerned: set[str],
    choices: dict[str, Choice],
    options: argparse.Namespace,
    report: Report,
) -> int:
    """Build the robots that are concerned, with the user's choices."""
    robots = [robot for robot in configuration.robots if robot.name in concerned]
    request = common.request(options, report, dry=options.dry_run, choices=choices)
    results = []
    for result in built(configuration, robots, request):
        report.result(result)
        results.append(result)
    code = exit_code(results)
    report.finish("resolve", code)
    return code
