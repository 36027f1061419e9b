"""`urdfsync resolve`: settles conflicts as the user says, file by file or all at once, and builds what waited."""

from __future__ import annotations

import argparse
import difflib
import os
import shutil
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path, PurePosixPath

from urdfsync import config
from urdfsync.commands import arguments, editor
from urdfsync.commands.build import build_and_check
from urdfsync.commands.edits import edit_lines
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Kind, Reason
from urdfsync.engine.build import build
from urdfsync.engine.conflicts import BOTH_SIDES, MERGES, Conflict
from urdfsync.engine.edits import find_edited
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import encode, key_of
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.files import shown
from urdfsync.merge.texts import find_flaw
from urdfsync.modelica.parser import parse
from urdfsync.output.conflicts import DisputedFile, describe, find_conflicts, saved_texts, shown_path
from urdfsync.output.console import Console, first_lines, line
from urdfsync.output.results import file_line, show_result, show_results
from urdfsync.state.record import Choice

_LINES = 20
"""So many files are listed at most, without --verbose."""
_MEANINGS = {
    Choice.KEEP: "your file as it is",
    Choice.TAKE: "the generated file",
    Choice.MERGE: "both sides' changes",
    Choice.MERGE_MINE: "both sides' changes, yours in doubt",
    Choice.MERGE_GENERATED: "both sides' changes, generated in doubt",
    Choice.EDIT: "as you edited it",
    Choice.UNDO: "as you had it before",
}
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
        "exit codes: 0 no conflict left, 1 you said no, 2 error, 3 conflicts left, 4 another build is running, "
        "130 interrupted",
    )
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file, or a folder for all conflicts below it")
    parser.add_argument("--all", action="store_true", help="all conflicts; with --merge, those that can be merged")
    choice = parser.add_mutually_exclusive_group()
    kinds = {
        Choice.KEEP: "leave your file as it is, until something new is generated",
        Choice.TAKE: "replace your file by the generated one",
        Choice.MERGE: "take both sides' changes, if they do not contradict each other",
        Choice.EDIT: "make one text of both sides in the editor of $VISUAL or $EDITOR",
        Choice.UNDO: "bring back what you had before a file was merged, replaced or deleted",
    }
    for kind, words in kinds.items():
        choice.add_argument(f"--{kind}", dest="choice", action="store_const", const=kind, help=words)
    parser.add_argument(
        "--prefer",
        choices=["mine", "generated"],
        help="with --merge: which side counts where both changed the same",
    )
    words = "give names in your own models the new ones that the next build brings, or that an earlier one brought"
    parser.add_argument("--rename-uses", nargs="*", metavar="OLD=NEW", help=words)
    parser.add_argument("--yes", action="store_true", help="with --rename-uses: write without asking")
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Find the files that the user means, and build their robots with the user's choice."""
    if args.rename_uses is not None:
        if args.paths or args.all or args.choice:
            raise arguments.UsageError(args.parser, "--rename-uses goes without paths, --all and choices")
        from urdfsync.commands import rename_uses  # the parser takes a while to load

        return rename_uses.run(args, console)
    loaded = arguments.configuration(args)
    found = list(build(loaded, loaded.select(args.robot or []), arguments.request(args, console, dry=True)))
    choice = _choice(args, find_conflicts(found))
    targets, unknown = _targets(args, console, found, loaded.root, choice)
    if unknown:
        return _refuse(console, found, unknown)
    concerned = {target.result.robot for target in targets}
    if args.all:
        concerned |= {result.robot for result in found if result.failed or result.conflicts}
    robots = [robot for robot in loaded.robots if robot.name in concerned]
    choices = {(target.action.path, target.action.sides): choice for target in targets}
    planned = arguments.request(args, console, dry=True, choices=choices)
    if choice is Choice.TAKE and not console.json and not console.quiet:
        _show_losses(loaded, robots, targets, planned, console)
    if choice is Choice.UNDO:
        _refuse_undo(targets, build(loaded, robots, planned))
    edited = _edit(targets, list(build(loaded, robots, planned))) if choice is Choice.EDIT else {}
    texts = {key: file.read_bytes().decode() for key, file in edited.items()}
    request = arguments.request(args, console, dry=args.dry_run, choices=choices, edited=texts)
    results = show_results(console, build_and_check(loaded, robots, request))
    actions = {one.path: one for result in results for one in result.actions if not result.failed}
    now = [(target, actions[target.action.path]) for target in targets if target.action.path in actions]
    accepted = [one for target, one in now if one.sides == target.action.sides and one.kind is not Kind.CONFLICT]
    changed = [_changed(target) for target, one in now if one.sides != target.action.sides]
    taken = set() if args.dry_run else {action.path for action in accepted}
    left = [file for (path, _), file in edited.items() if path not in taken]
    for file in set(edited.values()).difference(left):
        shutil.rmtree(file.parent)
    if not (args.dry_run or console.json or console.quiet):
        lines = [file_line(shown(loaded.root / one.path), "accepted", "green", _meaning(one)) for one in accepted]
        console.print(first_lines(lines, _LINES, "file", verbose=console.verbose))
    code = exit_code(results)
    code = Exit.CONFLICT if changed and code is Exit.IN_STEP else code
    console.end("resolve", code, [*changed, *map(_left, left)])
    return code


def _changed(target: DisputedFile) -> Diagnostic:
    """A file that was saved, or generated anew, after the choice was made."""
    message = "it has changed since it was looked at, so your choice does not count for it"
    hint = "look at it, then choose again"
    return Diagnostic(Severity.WARNING, "changed-meanwhile", message, target.shown, hint=hint)


def _meaning(action: Action) -> str:
    """What a choice makes of a file."""
    words = _MEANINGS[action.choice] if action.choice else "your file has both sides' changes already"
    if action.generated is None and action.choice is not Choice.UNDO:
        words = "deleted" if action.reason is Reason.DELETE else "yours from now on"
    return f"{words}, once the other conflicts are resolved" if action.held else words


def _choice(args: argparse.Namespace, conflicts: Sequence[DisputedFile]) -> Choice:
    """The choice that the arguments make. Raises UsageError."""
    wrong = "" if args.all or args.paths else "name files or folders, or use --all"
    wrong = "--all goes without paths" if args.all and args.paths else wrong
    wrong = "--undo goes with paths, not with --all" if args.all and args.choice is Choice.UNDO else wrong
    wrong = "--prefer goes with --merge" if args.prefer and args.choice is not Choice.MERGE else wrong
    wrong = "one of --keep, --take, --merge, --edit and --undo is needed" if args.choice is None else wrong
    if wrong:
        raise arguments.UsageError(args.parser, wrong, _listed(conflicts) or "nothing is in conflict")
    return Choice(f"{args.choice}-{args.prefer}") if args.prefer else args.choice


def _listed(conflicts: Sequence[DisputedFile]) -> str:
    names = [target.shown for target in conflicts]
    more = f" and {len(names) - _FEW} more" if len(names) > _FEW else ""
    return f"in conflict: {', '.join(names[:_FEW])}{more}" if names else ""


def _targets(
    args: argparse.Namespace, console: Console, found: Sequence[Result], root: Path, choice: Choice
) -> tuple[list[DisputedFile], list[str]]:
    """The files that the arguments mean, and the paths that mean none. Raises UrdfsyncError for what can't be had."""
    if args.all:
        targets = find_conflicts(found)
        if not targets and not any(result.failed for result in found):
            console.warnings([Diagnostic(Severity.NOTE, "no-conflict", "nothing is in conflict")])
        return [target for target in targets if not any(_problems(target, choice))], []
    targets, unknown = _find_targets(found, args.paths, root, choice)
    problems = [] if unknown else [problem for target in targets for problem in _problems(target, choice)]
    if problems:
        raise UrdfsyncError(*problems)
    return targets, unknown


def _refuse(console: Console, found: Sequence[Result], unknown: Sequence[str]) -> Exit:
    """Say that paths mean no file that could be resolved."""
    failed = [result for result in found if result.failed]
    for result in failed:
        show_result(console, result)
    named, have = " and ".join(f"`{path}`" for path in unknown), "has" if len(unknown) == 1 else "have"
    hint = _listed(find_conflicts(found)) or "no file is in conflict"
    code = exit_code(failed) if failed else Exit.ERROR
    console.end("resolve", code, [Diagnostic(Severity.ERROR, "no-conflict", f"{named} {have} no conflict", hint=hint)])
    return code


def _refuse_undo(targets: Sequence[DisputedFile], planned: Iterable[Result]) -> None:
    """Raise UrdfsyncError for files of which nothing can be given back."""
    undone = {one.path for result in planned for one in result.actions if one.reason is Reason.UNDO}
    message = "nothing to undo: no build has merged, replaced or deleted your text here, or you saved the file since"
    hint = "--keep, --take and --merge settle conflicts"
    found = [
        Diagnostic(Severity.ERROR, "no-undo", message, target.shown, hint=hint)
        for target in targets
        if target.action.path not in undone
    ]
    if found:
        raise UrdfsyncError(*found)


def _edit(targets: Sequence[DisputedFile], planned: Sequence[Result]) -> dict[tuple[str, str], Path]:
    """Let the user edit each file; where its text is then, by key and `Action.sides`.

    Raises UrdfsyncError if one can't be used; it names those that could, too.
    """
    texts = {one.path: one for result in planned for one in result.conflict_texts}
    edited = dict[tuple[str, str], Path]()
    try:
        for target in targets:
            path = target.action.path
            if path in texts:  # else it has changed since
                edited[path, target.action.sides] = _edit_one(texts[path], target.shown)
    except UrdfsyncError as error:
        raise UrdfsyncError(*error.diagnostics, *map(_left, edited.values())) from error
    return edited


def _edit_one(conflict: Conflict, place: str) -> Path:
    proposal = conflict.merge.proposal if conflict.merge else _both(conflict.mine, conflict.generated)
    file = editor.edit(PurePosixPath(conflict.path).name, encode(proposal))
    if flaw := _flaw(file.read_bytes(), conflict):
        message, hint = f"the edited text {flaw}; nothing was changed", f"it stays in {file}; --edit begins anew"
        raise UrdfsyncError(Diagnostic(Severity.ERROR, "no-edit", message, place, hint=hint))
    return file


def _both(mine: str, generated: str) -> str:
    """Return both texts as one, with markers around what differs: there is no base to merge with."""
    sides = [text.replace("\r\n", "\n").splitlines() for text in (mine, generated)]
    lines: list[str] = []
    for what, *places in difflib.SequenceMatcher(a=sides[0], b=sides[1], autojunk=False).get_opcodes():
        own, new = sides[0][places[0] : places[1]], sides[1][places[2] : places[3]]
        lines += own if what == "equal" else ["<<<<<<< mine", *own, "=======", *new, ">>>>>>> generated"]
    return ("\r\n" if "\r\n" in mine else "\n").join([*lines, ""])


def _flaw(content: bytes, conflict: Conflict) -> str:
    """Why an edited text can't be used, as the end of a sentence; empty if it can."""
    try:
        text = content.decode()
    except UnicodeDecodeError:
        return "is not UTF-8"
    wanted, found = ([str(one.name) for one in parse(one).classes] for one in (conflict.generated, text))
    if flaw := find_flaw(text, (conflict.mine, conflict.generated)):
        return flaw
    return "" if found == wanted else f"is not one class called {' and '.join(f'`{name}`' for name in wanted)}"


def _left(file: Path) -> Diagnostic:
    message = "this edited text was not taken over"
    hint = "put what you want of it into your file, or edit again"
    return Diagnostic(Severity.NOTE, "edit-left", message, shown(file), hint=hint)


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
        for file in find_edited(generate_robot(inspect(configuration, robot, request))):
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
    for target in (DisputedFile(result, action) for result in results for action in result.actions):
        action = target.action
        takes = choice is Choice.TAKE and action.reason is Reason.KEEP
        is_known = action.reason is Reason.ORPHAN or target.is_decided
        if is_known or takes or (choice is Choice.UNDO and action.mine):
            for file in _places(target.action, root):
                by_place.setdefault(file, []).append(target)
    chosen: dict[str, DisputedFile] = {}
    unknown = []
    robots = results if choice is Choice.UNDO else ()
    for text in typed:
        path = Path(os.path.normpath(config.working_folder() / text))
        real, real_root = Path(os.path.realpath(path)), Path(os.path.realpath(root))
        # links may lead to a file of the configuration's folder
        places = [path, *([root / real.relative_to(real_root)] if real.is_relative_to(real_root) else [])]
        found = [target for place in places if text for target in by_place.get(place) or _deleted_files(robots, place)]
        chosen |= {target.action.path: target for target in found}
        unknown += [] if found else [text]
    return list(chosen.values()), unknown


def _deleted_files(results: Sequence[Result], place: Path) -> list[DisputedFile]:
    """Return a file that is not there, and that a build may have deleted."""
    robots = (one for one in results if place.is_relative_to(one.folder) and not os.path.lexists(place))
    return [DisputedFile(one, Action(key_of(place, one.root), Reason.FORGET, Role.MODEL)) for one in robots]


def _places(action: Action, root: Path) -> set[Path]:
    return {Path(os.path.normpath(root / path)) for path in (action.origin or action.path, action.path)}


def _problems(target: DisputedFile, choice: Choice) -> Iterator[Diagnostic]:
    """Why the choice can't be had for a file."""
    if choice is Choice.TAKE and not target.is_on_disk:
        message, hint = f"it can't be replaced: {describe(target)}", "move it away, then build"
    elif choice in BOTH_SIDES and target.action.reason is Reason.ORPHAN:
        message = "it is no longer generated: there is nothing to merge"
        hint = "--keep makes it yours, --take deletes it"
    elif choice is Choice.EDIT and not (target.is_on_disk and (target.texts or target.is_decided)):
        message, hint = f"it can't be edited: {describe(target)}", "use --keep or --take"
    elif choice in MERGES and not target.offers(choice):
        message = f"it can't be merged: {describe(target)}"
        hint = "use --keep or --take" if target.is_on_disk else "use --keep"
        if target.offers(Choice.MERGE_MINE):
            hint = "`--prefer mine` or `--prefer generated` says which side counts there"
        elif merge := saved_texts(target).get("merge"):
            hint = f"put what you want of {shown_path(target.result, merge)} into your file, then use --keep"
    else:
        return
    yield Diagnostic(
        Severity.ERROR, "no-merge" if choice in MERGES else f"no-{choice}", message, target.shown, hint=hint
    )
