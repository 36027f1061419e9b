"""`urdfsync resolve`: settles conflicts as the user says, file by file or all at once, and builds what waited."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.commands.build import build_and_check
from urdfsync.commands.edits import edit_lines
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.build import build
from urdfsync.engine.conflicts import MERGES
from urdfsync.engine.edits import find_edited
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.output.conflicts import DisputedFile, describe, find_conflicts, saved_texts, shown_path
from urdfsync.output.console import Console, line
from urdfsync.output.results import show_result, show_results
from urdfsync.state.record import Choice

_FEW = 5
"""So many conflicts are named in a message; of more, only the first ones and their number."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "resolve",
        run,
        "--robot --wait --trust",
        help="settle conflicts between your edits and what is generated",
        description="Settle conflicts between your edits and what is generated. "
        "Then the files that waited for that are written.",
        epilog="A file that you edited and that is no longer generated can be named too: --keep makes it yours, "
        "--take deletes it.\n\nexample: urdfsync resolve modelica/Arm/Links/Elbow.mo --merge\n\n"
        "exit codes: 0 no conflict left, 2 error, 3 conflicts left, 4 another build is running, 130 interrupted",
    )
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file, or a folder for all conflicts below it")
    parser.add_argument("--all", action="store_true", help="all conflicts; with --merge, those that can be merged")
    choice = parser.add_mutually_exclusive_group()
    kinds = {
        Choice.KEEP: "leave your file as it is, until something new is generated",
        Choice.TAKE: "replace your file by the generated one",
        Choice.MERGE: "take both sides' changes, if they do not contradict each other",
    }
    for kind, words in kinds.items():
        choice.add_argument(f"--{kind}", dest="choice", action="store_const", const=kind, help=words)
    parser.add_argument(
        "--prefer",
        choices=["mine", "generated"],
        help="with --merge: which side counts where both changed the same",
    )
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Find the files that the user means, and build their robots with the user's choice."""
    configuration = arguments.configuration(args)
    robots = configuration.select(args.robot or [])
    found = list(build(configuration, robots, arguments.request(args, console, dry=True)))
    names = [target.shown for target in find_conflicts(found)]
    listed = ", ".join(names[:_FEW]) + (f" and {len(names) - _FEW} more" if len(names) > _FEW else "")
    wrong = "" if args.all or args.paths else "name files or folders, or use --all"
    wrong = "--all goes without paths" if args.all and args.paths else wrong
    wrong = "--prefer goes with --merge" if args.prefer and args.choice is not Choice.MERGE else wrong
    wrong = "one of --keep, --take and --merge is needed" if args.choice is None else wrong
    if wrong:
        raise arguments.UsageError(args.parser, wrong, f"in conflict: {listed}" if listed else "nothing is in conflict")
    choice = Choice(f"{args.choice}-{args.prefer}") if args.prefer else args.choice
    concerned = set()
    if args.all:
        targets = find_conflicts(found)
        concerned = {target.result.robot for target in targets} | {result.robot for result in found if result.failed}
        if not concerned:
            console.warnings([Diagnostic(Severity.NOTE, "no-conflict", "nothing is in conflict")])
        targets = [target for target in targets if not any(_problems(target, choice))]
    else:
        targets, unknown = _find_targets(found, args.paths, configuration.root, choice)
        if unknown:
            failed = [result for result in found if result.failed]
            for result in failed:
                show_result(console, result)
            named, have = " and ".join(f"`{path}`" for path in unknown), "has" if len(unknown) == 1 else "have"
            hint = f"in conflict: {listed}" if listed else "no file is in conflict"
            code = exit_code(failed) if failed else Exit.ERROR
            no_conflict = Diagnostic(Severity.ERROR, "no-conflict", f"{named} {have} no conflict", hint=hint)
            console.end("resolve", code, [no_conflict])
            return code
        if problems := [problem for target in targets for problem in _problems(target, choice)]:
            raise UrdfsyncError(*problems)
        concerned = {target.result.robot for target in targets}
    choices = {target.action.path: choice for target in targets}
    again = [robot for robot in configuration.robots if robot.name in concerned]
    if choice is Choice.TAKE and not console.json and not console.quiet:
        _show_losses(configuration, again, targets, arguments.request(args, console, dry=True), console)
    request = arguments.request(args, console, dry=args.dry_run, choices=choices)
    code = exit_code(show_results(console, build_and_check(configuration, again, request)))
    console.end("resolve", code)
    return code


def _show_losses(
    configuration: Config,
    robots: Sequence[RobotConfig],
    targets: Sequence[DisputedFile],
    request: BuildOptions,
    console: Console,
) -> None:
    """Show the edits that go with the files that are taken."""
    taken = {target.action.origin or target.action.path for target in targets}
    for robot in robots:
        for file in find_edited(configuration, robot, request):
            if file.path in taken:
                lines = edit_lines(file, configuration.root, console.verbose)
                console.print([line(("your edits go:", "bold red")), *lines])


def _find_targets(
    results: Sequence[Result], typed: Sequence[str], root: Path, choice: Choice
) -> tuple[list[DisputedFile], list[str]]:
    """The files that paths mean, and the paths that mean none.

    An edited file need not conflict to be taken. A folder stands for all conflicts below it; any other file has to be
    named itself. A file is known by where the user's is, and by where it is to go.
    """
    by_place: dict[Path, list[DisputedFile]] = {}
    for target in find_conflicts(results):
        for file in _places(target.action, root):
            for place in (file, *file.parents):
                by_place.setdefault(place, []).append(target)
    for target in (DisputedFile(result, action) for result in results for action in result.actions.decided):
        takes = choice is Choice.TAKE and target.action.kind is Kind.KEEP
        if target.action.kind is Kind.ORPHAN or target.is_decided or takes:
            for file in _places(target.action, root):
                by_place.setdefault(file, []).append(target)
    chosen: dict[str, DisputedFile] = {}
    unknown = []
    for text in typed:
        path = Path(os.path.normpath(config.working_folder() / text))
        real, real_root = Path(os.path.realpath(path)), Path(os.path.realpath(root))
        # links may lead to a file of the configuration's folder
        places = [path, *([root / real.relative_to(real_root)] if real.is_relative_to(real_root) else [])]
        found = [target for place in places if text for target in by_place.get(place, ())]
        chosen |= {target.action.path: target for target in found}
        unknown += [] if found else [text]
    return list(chosen.values()), unknown


def _places(action: Action, root: Path) -> set[Path]:
    return {Path(os.path.normpath(root / path)) for path in (action.origin or action.path, action.path)}


def _problems(target: DisputedFile, choice: Choice) -> Iterator[Diagnostic]:
    """Why the choice can't be had for a file."""
    if choice is Choice.TAKE and not target.replaceable:
        message, hint = f"it can't be replaced: {describe(target)}", "move it away, then build"
    elif choice in MERGES and target.action.kind is Kind.ORPHAN:
        message = "it is no longer generated: there is nothing to merge"
        hint = "--keep makes it yours, --take deletes it"
    elif choice in MERGES and not target.offers(choice):
        message = f"it can't be merged: {describe(target)}"
        hint = "use --keep or --take" if target.replaceable else "use --keep"
        if target.offers(Choice.MERGE_MINE):
            hint = "`--prefer mine` or `--prefer generated` says which side counts there"
        elif merge := saved_texts(target).get("merge"):
            hint = f"put what you want of {shown_path(target.result, merge)} into your file, then use --keep"
    else:
        return
    yield Diagnostic(
        Severity.ERROR, "no-merge" if choice in MERGES else f"no-{choice}", message, target.shown, hint=hint
    )
