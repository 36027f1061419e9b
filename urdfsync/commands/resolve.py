"""`urdfsync resolve`: settles conflicts as the user says, file by file or all at once, and builds what waited."""

from __future__ import annotations

import argparse
import functools
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.commands.build import build_and_check
from urdfsync.config import Config
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.build import build
from urdfsync.outcome import Exit, Result, exit_code
from urdfsync.output.conflicts import NOT_HERE, Target, describe, find_conflicts, saved_texts, shown_path
from urdfsync.output.console import Console
from urdfsync.output.results import show_result, show_results
from urdfsync.state.record import Choice

_FEW = 5
"""So many conflicts are named in a message; of more, only the first ones and their number."""


class TypedPath(msgspec.Struct, frozen=True):
    """A path that the user typed, and the absolute places that it may stand for."""

    typed: str
    places: tuple[Path, ...]


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = commands.add_parser(
        "resolve",
        help="settle conflicts between your edits and what is generated",
        description="Settle conflicts between your edits and what is generated. What waited for that is then built.",
        epilog="A file that you edited and that is no longer generated can be named too: --keep makes it yours, "
        f"--take deletes it.\n\nexample: urdfsync resolve modelica/Arm/Links/Elbow.mo --merge\n\n{arguments.CODES}",
    )
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file, or a folder for all conflicts below it")
    parser.add_argument("--all", action="store_true", help="all conflicts; with --merge, those that can be merged")
    arguments.add_robot_option(parser)
    choice = parser.add_mutually_exclusive_group()
    kinds = {
        Choice.KEEP: "leave your file as it is, until something new is generated",
        Choice.TAKE: "replace your file by the generated one",
        Choice.MERGE: "take both sides' changes, if they do not contradict each other",
    }
    for kind, words in kinds.items():
        choice.add_argument(f"--{kind}", dest="choice", action="store_const", const=kind, help=words)
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")
    arguments.add_wait(parser)
    arguments.add_trust(parser)
    arguments.add_common(parser)
    parser.set_defaults(run=functools.partial(run, parser))


def run(parser: arguments.Parser, args: argparse.Namespace, console: Console) -> Exit:
    """Find the files that the user means, and build their robots with the user's choice."""
    configuration = arguments.configuration(args)
    robots = configuration.select(args.robot or [])
    found = list(build(configuration, robots, arguments.request(args, console, dry=True)))
    if wrong := _misuse(args):
        names = list_conflicts(found)
        raise arguments.UsageError(parser, wrong, f"in conflict: {names}" if names else "nothing is in conflict")
    if args.all:
        targets = find_conflicts(found)
        choices = possible_choices(targets, args.choice)
        concerned = {target.result.robot for target in targets} | {result.robot for result in found if result.failed}
        if not concerned:
            console.warnings([Diagnostic(Severity.NOTE, "no-conflict", "nothing is in conflict")])
    else:
        targets, missing = find_targets(found, [typed_path(path, configuration.root) for path in args.paths])
        if missing:
            return _refuse(found, missing, console)
        choices = check_choices(targets, args.choice)
        concerned = {target.result.robot for target in targets}
    return _build(configuration, concerned, args, console, choices)


def _build(
    configuration: Config, concerned: set[str], args: argparse.Namespace, console: Console, choices: dict[str, Choice]
) -> Exit:
    robots = [robot for robot in configuration.robots if robot.name in concerned]
    request = arguments.request(args, console, dry=args.dry_run, choices=choices)
    code = exit_code(show_results(console, build_and_check(configuration, robots, request)))
    console.end("resolve", code)
    return code


def _misuse(args: argparse.Namespace) -> str:
    """What is wrong with the arguments; empty if nothing is."""
    if args.choice is None:
        return "one of --keep, --take and --merge is needed"
    if args.all and args.paths:
        return "--all goes without paths"
    return "" if args.all or args.paths else "name files or folders, or use --all"


def _refuse(found: Sequence[Result], missing: Sequence[TypedPath], console: Console) -> Exit:
    """Say which paths are no conflicts, and which robots could not even be planned."""
    failed = [result for result in found if result.failed]
    for result in failed:
        show_result(console, result)
    code = exit_code(failed) if failed else Exit.ERROR
    console.fail("resolve", [unknown_paths(found, missing)], code)
    return code


def typed_path(typed: str, root: Path) -> TypedPath:
    """What a typed path may stand for: itself, and the place below the configuration that links lead it to."""
    if not typed:
        return TypedPath(typed, ())
    path = Path(os.path.normpath(config.working_folder() / typed))
    real, real_root = (Path(os.path.realpath(place)) for place in (path, root))
    inside = (root / real.relative_to(real_root),) if real.is_relative_to(real_root) else ()
    return TypedPath(typed, (path, *inside))


def find_targets(results: Iterable[Result], paths: Iterable[TypedPath]) -> tuple[list[Target], list[TypedPath]]:
    """The files that paths mean, and the paths that mean none.

    A folder stands for all conflicts below it; a file that does not conflict has to be named itself.
    """
    results = list(results)
    others = [Target(result, action) for result in results for action in result.actions.decided]
    others = [target for target in others if target.is_orphan or target.is_decided]
    conflicts = find_conflicts(results)
    chosen: dict[str, Target] = {}
    missing = []
    for path in paths:
        found = [target for target in conflicts if _lies_in(target, path.places)]
        found += [target for target in others if not _places(target).isdisjoint(path.places)]
        chosen |= {target.action.path: target for target in found}
        missing += [] if found else [path]
    return list(chosen.values()), missing


def _places(target: Target) -> set[Path]:
    """The absolute paths by which a file is known: where the user's is, and where it is to go."""
    return {Path(os.path.normpath(target.result.root / path)) for path in (target.place, target.action.path)}


def _lies_in(target: Target, places: Sequence[Path]) -> bool:
    return any(place in (path, *path.parents) for path in _places(target) for place in places)


def unknown_paths(results: Sequence[Result], missing: Sequence[TypedPath]) -> Diagnostic:
    """What to say of paths that mean no conflict."""
    names = " and ".join(f"`{path.typed}`" for path in missing)
    message = f"{names} {'is' if len(missing) == 1 else 'are'} not in conflict"
    held = [Target(result, action) for result in results for action in result.actions.decided if action.held]
    if len(missing) == 1 and any(not _places(target).isdisjoint(missing[0].places) for target in held):
        message += ", it only waits for the conflicts of its robot"
    names = list_conflicts(results)
    return Diagnostic(Severity.ERROR, "no-conflict", message, hint=f"these are: {names}" if names else "nothing is")


def list_conflicts(results: Iterable[Result]) -> str:
    """The conflicts that there are, in one line; empty if there are none."""
    names = [shown_path(target.result, target.place) for target in find_conflicts(results)]
    more = f" and {len(names) - _FEW} more" if len(names) > _FEW else ""
    return f"{', '.join(names[:_FEW])}{more}"


def check_choices(targets: Sequence[Target], choice: Choice) -> dict[str, Choice]:
    """The choice for every file, by its path. Raises UrdfsyncError if it is impossible for any of them."""
    if problems := [problem for target in targets for problem in _problems(target, choice)]:
        raise UrdfsyncError(*problems)
    return {target.action.path: choice for target in targets}


def possible_choices(targets: Iterable[Target], choice: Choice) -> dict[str, Choice]:
    """The choice for every file for which it is possible, by its path."""
    return {target.action.path: choice for target in targets if not any(_problems(target, choice))}


def _problems(target: Target, choice: Choice) -> Iterator[Diagnostic]:
    """Why the choice can't be had for a file."""
    name = shown_path(target.result, target.place)
    if choice is Choice.TAKE and not target.action.at_hand:
        message = f"it can't be taken: {NOT_HERE}"
        hint = f"bring it back, or keep yours with `urdfsync resolve {name} --keep`"
    elif choice is Choice.TAKE and not target.replaceable:
        message, hint = f"it can't be replaced: {describe(target)}", "move it away, then build"
    elif choice is Choice.MERGE and target.is_orphan:
        message = "it is no longer generated: there is nothing to merge"
        hint = "--keep makes it yours, --take deletes it"
    elif choice is Choice.MERGE and not target.merges:
        message = f"it can't be merged: {describe(target)}"
        hint = "use --keep or --take" if target.replaceable else "use --keep"
        if (saved := saved_texts(target)) and saved.merge:
            hint = f"put what you want of {shown_path(target.result, saved.merge)} into your file, then use --keep"
    else:
        return
    yield Diagnostic(Severity.ERROR, f"no-{choice}", message, name, hint=hint)
