"""`urdfsync resolve`: settles the conflict in one file, or all conflicts, as the user chooses."""

from __future__ import annotations

import argparse
import os
import shutil
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.api import build_and_check, load
from urdfsync.commands import arguments, editor
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.domain import Role
from urdfsync.engine.actions import USERS, Action, Choice, Reason, UsersChoice
from urdfsync.engine.build import build
from urdfsync.engine.decide.conflicts import PREFERENCES
from urdfsync.engine.inspect.package_files import key_of
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.output.build_section import show_result
from urdfsync.output.conflicts import settle_hint
from urdfsync.output.console import Console
from urdfsync.project import config


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "resolve",
        "--wait --trust",
        help="settle conflicts between your edits and the generated files",
        description="Settle conflicts between your edits and the generated files. "
        "Then write the files that waited for the choice.",
        epilog="You can also name an orphan, an edited file that no build generates any more: --keep makes it yours, "
        "--take deletes it.\n\nexample: urdfsync resolve modelica/Arm/Links/Elbow.mo --merge",
    )
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file; a folder or a robot for all conflicts in it")
    parser.add_argument("--all", action="store_true", help="all conflicts")
    choice = parser.add_mutually_exclusive_group(required=True)
    kinds = {
        Choice.KEEP: "leave your file as it is, until something new is generated",
        Choice.TAKE: "replace your file by the generated one",
        Choice.MERGE: "take both sides' changes, if they do not contradict each other",
        Choice.EDIT: "make one text of both sides in the editor of $VISUAL or $EDITOR",
        Choice.UNDO: "bring back what you had before a file was merged, replaced or deleted",
    }
    for kind, words in kinds.items():
        choice.add_argument(f"--{kind}", dest="choice", action="store_const", const=kind, help=words)
    words = "move your edit to the element that is now called NAME, by default the likely one"
    choice.add_argument("--moved", nargs="?", const="", metavar="NAME", help=words)
    words = "with --merge: the side that counts where both sides changed the same text"
    sides = [str(each).removeprefix("merge-") for each in PREFERENCES]
    parser.add_argument("--prefer", choices=sides, help=words)
    arguments.add_dry_run(parser)


def run(args: argparse.Namespace, console: Console) -> int:
    """Find the named files, and build their robots with the user's choice."""
    choice = _choice(args)
    configuration = load(args.config)
    names = {robot.name for robot in configuration.robots if choice is not Choice.UNDO}.intersection(args.paths)
    selected = configuration.select(args.paths if names.issuperset(args.paths) else [])
    planned = list(build(configuration, selected, arguments.request(args, console, dry=True)))
    named = {text: list(_find_named(planned, text, choice)) for text in args.paths if text not in names}
    if unknown := [text for text, targets in named.items() if not targets]:
        return _refuse(console, planned, unknown, choice)
    whole = [result for result in planned if args.all or result.robot in names]
    named |= {"": [(result, each.action) for result in whole for each in result.conflicts]}
    targets = {action.path: (result, action) for pairs in named.values() for result, action in pairs}
    if not targets and not any(result.failed for result in planned):
        console.warnings([Diagnostic(Severity.NOTE, "no-conflict", "nothing is in conflict")])
    # a choice holds for the texts of this plan: if the user saves a file from now on, its choice is not applied
    choices = {action.path: UsersChoice(choice, action.sides, args.moved) for _, action in targets.values()}
    folder, edited = _edit(planned, targets) if choice is Choice.EDIT else (None, {})
    choices |= {path: msgspec.structs.replace(choices[path], text=text) for path, text in edited.items()}
    concerned = {result.robot for result, _ in targets.values()}
    concerned |= {result.robot for result in whole if not result.in_step}
    robots = [robot for robot in configuration.robots if robot.name in concerned]
    results = []
    for result in build_and_check(
        configuration, robots, arguments.request(args, console, dry=args.dry_run, choices=choices)
    ):
        show_result(console, result, named=targets)
        results.append(result)
    accepted, problems = _compare(targets, results, choice)
    code = exit_code(results)
    if problems and code is Exit.IN_STEP:
        code = Exit.CONFLICT
    if folder and not args.dry_run and edited.keys() <= accepted:
        shutil.rmtree(folder)
    elif folder:
        hint = "copy your text from this folder into your file, or edit again"
        message = "some files were not replaced by your edited text"
        problems.append(Diagnostic(Severity.NOTE, "edit-left", message, shown(folder), hint=hint))
    return console.end(code, problems)


def _edit(planned: Iterable[Result], targets: Container[str]) -> tuple[Path | None, Mapping[str, str]]:
    """Let the user edit the conflicts of these files; return the folder of the texts, and the edited texts by path."""
    conflicts = ((result, one) for result in planned for one in result.conflicts if one.action.path in targets)
    disputed = [
        (one.texts, result.shown(one.action.path), one.versions.edited) for result, one in conflicts if one.texts
    ]
    return editor.edit(disputed) if disputed else (None, {})


def _choice(args: argparse.Namespace) -> Choice:
    """Return the choice of the arguments. Raises UsageError."""
    wrong = "" if args.all or args.paths else "name files or folders, or use --all"
    wrong = "--all goes without paths" if args.all and args.paths else wrong
    wrong = "--undo goes with paths, not with --all" if args.all and args.choice is Choice.UNDO else wrong
    wrong = "--prefer goes with --merge" if args.prefer and args.choice is not Choice.MERGE else wrong
    if wrong:
        raise arguments.UsageError(args.parser, wrong, _how_to_name(args.choice))
    if args.moved is not None:
        return Choice.MOVED
    return Choice(f"{args.choice}-{args.prefer}") if args.prefer else args.choice


def _how_to_name(choice: Choice | None) -> str:
    """Return a hint that says where the user finds the paths for a choice."""
    if choice is Choice.UNDO:
        return "name each file as the last build or `resolve` listed it: urdfsync resolve FILE --undo"
    return "see `urdfsync status` for the conflicts"


def _find_named(planned: Sequence[Result], text: str, choice: Choice) -> Iterator[tuple[Result, Action]]:
    """Yield the file at a path if the choice is possible for that file, else all conflicts below the path.

    A renamed file is found by its old and by its new path, a class in a folder also by its `package.mo`.
    """
    path = Path(os.path.normpath(config.working_folder() / text))
    for result in planned if text else ():
        root, real, real_root = result.root, Path(os.path.realpath(path)), Path(os.path.realpath(result.root))
        # links may lead to a file of the configuration's folder
        places = {path, root / real.relative_to(real_root)} if real.is_relative_to(real_root) else {path}
        is_found, paths = False, {action.path for action in result.actions}
        for action in result.actions:
            keys = {action.origin or action.path, action.path}
            if choice is Choice.UNDO:  # the user means the file that is there now
                keys = {action.path, *(keys - paths)}
            keys |= set() if action.is_on_disk else {f"{key.removesuffix('.mo')}/package.mo" for key in keys}
            files = {Path(os.path.normpath(root / key)) for key in keys}
            is_user = action.is_conflict or action.reason in USERS or action.is_left_by_git or action.choice
            is_named = not places.isdisjoint(files) and (is_user or choice is Choice.UNDO)
            is_below = action.is_conflict and any(not places.isdisjoint(file.parents) for file in files)
            is_below = is_below and choice is not Choice.UNDO
            if is_named or is_below:
                is_found = True
                yield result, action
        if choice is Choice.UNDO and not is_found and not os.path.lexists(path) and path.is_relative_to(result.folder):
            yield result, Action(key_of(path, root), Reason.FORGET, Role.MODEL)  # a build may have deleted the file


def _refuse(console: Console, planned: Sequence[Result], unknown: Sequence[str], choice: Choice) -> int:
    """Report paths without a file to resolve."""
    failed = [result for result in planned if result.failed]
    for result in failed:
        show_result(console, result)
    hint = "correct the errors first" if failed else _how_to_name(choice)
    missing = [path for path in unknown if not failed and not os.path.lexists(path)]
    names = ", ".join(f"`{path}`" for path in missing or unknown)
    what = "to undo" if choice is Choice.UNDO else "conflicts"
    message = f"there is no file {names}" if missing else f"nothing {what} in {names}"
    problem = Diagnostic(Severity.ERROR, "no-conflict", message, hint=hint)
    return console.end(exit_code(failed) or Exit.ERROR, [problem])


def _compare(
    targets: Mapping[str, tuple[Result, Action]], results: Sequence[Result], choice: Choice
) -> tuple[set[str], list[Diagnostic]]:
    """Return the paths where the choice was applied, and for other paths the reasons why it was not.

    A conflict that the choice does not settle is shown with its reason.
    """
    actions = {action.path: action for result in results for action in result.actions}
    result_of = {result.robot: result for result in results}
    failed = {result.robot for result in results if result.failed}
    conflicts = {file.action.path: file for result, _ in targets.values() for file in result.conflicts}
    accepted, problems = set[str](), list[Diagnostic]()
    for path, (result, before) in targets.items():
        after, place = actions.get(path), result.shown(before.present)
        if result.robot in failed:
            continue
        if path in result_of[result.robot].settled:
            accepted.add(path)
        elif after is None or after.sides != before.sides:
            message = "the file or its generated text changed after they were read, so your choice was not applied"
            hint = "look at the file, then choose again"
            problems.append(Diagnostic(Severity.WARNING, "changed-meanwhile", message, place, hint=hint))
        elif choice in (Choice.MERGE, *PREFERENCES) and (file := conflicts.get(path)):
            refused = file.texts and (file.texts.refused.get(choice) or file.texts.rejected)
            message = f"not merged: {refused or file.relation}"
            problems.append(Diagnostic(Severity.WARNING, "no-merge", message, place, hint=settle_hint([file])))
    return accepted, problems
