"""`urdfsync resolve`: settles conflicts as the user says, file by file or all at once, and builds what waited."""

from __future__ import annotations

import argparse
import difflib
import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

import msgspec

from urdfsync import config
from urdfsync.commands import arguments, editor
from urdfsync.commands.build import build_and_check
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.domain import Role
from urdfsync.engine.actions import USERS, Action, Kind, Reason
from urdfsync.engine.build import build
from urdfsync.engine.conflicts import Conflict
from urdfsync.engine.package_files import encode, key_of
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.files import shown
from urdfsync.merge.texts import find_flaw
from urdfsync.modelica.parser import parse
from urdfsync.output.conflicts import find_conflicts
from urdfsync.output.console import Console, first_lines
from urdfsync.output.results import file_line, show_result, show_results
from urdfsync.state.record import Choice, UsersChoice

_LINES = 20
"""So many files are listed at most, without --verbose."""
_FEW = 5
"""So many conflicts are named in a message; of more, only the first ones and their number."""
_MEANINGS = {
    Choice.KEEP: "your file as it is",
    Choice.TAKE: "the generated file; --undo brings your edits back",
    Choice.MERGE: "both sides' changes",
    Choice.MERGE_MINE: "both sides' changes, yours where they contradict",
    Choice.MERGE_GENERATED: "both sides' changes, the generated ones where they contradict",
    Choice.EDIT: "as you edited it",
    Choice.UNDO: "as you had it before",
}


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "resolve",
        "--robot --wait --trust",
        help="settle conflicts between your edits and what is generated",
        description="Settle conflicts between your edits and what is generated. "
        "Then the files that waited for that are written.",
        epilog="A file that you edited and that is no longer generated can be named too: --keep makes it yours, "
        "--take deletes it.\n\nexample: urdfsync resolve modelica/Arm/Links/Elbow.mo --merge",
    )
    parser.add_argument("paths", nargs="*", metavar="PATH", help="a file, or a folder for all conflicts below it")
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
    words = "give names in your own models the new ones that the next build brings, or that an earlier one brought"
    choice.add_argument("--rename-uses", nargs="*", metavar="OLD=NEW", help=words)
    words = "with --merge: which side counts where both changed the same"
    parser.add_argument("--prefer", choices=["mine", "generated"], help=words)
    parser.add_argument("--yes", action="store_true", help="with --rename-uses: write without asking")
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")


def run(args: argparse.Namespace, console: Console) -> int:
    """Find the files that the user means, and build their robots with the user's choice."""
    if args.rename_uses is not None:
        if args.paths or args.all:
            raise arguments.UsageError(args.parser, "--rename-uses goes without paths and --all")
        from urdfsync.commands import rename_uses  # the parser takes a while to load

        return rename_uses.run(args, console)
    choice = _choice(args)
    configuration = arguments.configuration(args)
    selected = configuration.select(args.robot or [])
    planned = list(build(configuration, selected, arguments.request(args, console, dry=True)))
    named = {text: list(_find_named(planned, text, choice)) for text in args.paths}
    if unknown := [text for text, targets in named.items() if not targets]:
        return _refuse(console, planned, unknown)
    if args.all:
        named = {"": [(result, action) for result in planned for action in result.conflicts]}
    targets = {action.path: (result, action) for pairs in named.values() for result, action in pairs}
    concerned = {result.robot for result, _ in targets.values()}
    concerned |= {result.robot for result in planned if args.all and result.failed}
    if not concerned:
        console.warnings([Diagnostic(Severity.NOTE, "no-conflict", "nothing is in conflict")])
    robots = [robot for robot in configuration.robots if robot.name in concerned]
    # a choice belongs to the texts that this plan has seen: a file that is saved from now on stays as it is
    choices = {action.path: UsersChoice(choice, action.sides) for _, action in targets.values()}
    files: dict[str, Path] = {}
    if choice is Choice.EDIT:  # this plan has the texts of files that wait after another choice, too
        again = build(configuration, robots, arguments.request(args, console, dry=True, choices=choices))
        files = _edit([texts for result in again for texts in result.conflict_texts if texts.path in targets])
    for path, file in files.items():
        choices[path] = msgspec.structs.replace(choices[path], text=file.read_bytes().decode())
    request = arguments.request(args, console, dry=args.dry_run, choices=choices)
    results = show_results(console, build_and_check(configuration, robots, request))
    accepted, problems = _compare(targets, results, choice)
    remaining = {path: file for path, file in files.items() if args.dry_run or path not in accepted}
    for path in files.keys() - remaining.keys():
        shutil.rmtree(files[path].parent)
    if not args.dry_run:
        lines = [
            file_line(shown(configuration.root / path), "accepted", "green", _meaning(action))
            for path, action in accepted.items()
        ]
        console.tell(first_lines(lines, _LINES, "file", verbose=console.verbose))
    code = exit_code(results)
    if problems and code is Exit.IN_STEP:
        is_error = any(one.severity is Severity.ERROR for one in problems)
        code = Exit.ERROR if is_error else Exit.CONFLICT
    return console.end(code, [*problems, *map(_remains, remaining.values())])


def _choice(args: argparse.Namespace) -> Choice:
    """Return the choice that the arguments make. Raises UsageError."""
    wrong = "" if args.all or args.paths else "name files or folders, or use --all"
    wrong = "--all goes without paths" if args.all and args.paths else wrong
    wrong = "--undo goes with paths, not with --all" if args.all and args.choice is Choice.UNDO else wrong
    wrong = "--prefer goes with --merge" if args.prefer and args.choice is not Choice.MERGE else wrong
    if wrong:
        raise arguments.UsageError(args.parser, wrong, "see `urdfsync status` for the conflicts")
    return Choice(f"{args.choice}-{args.prefer}") if args.prefer else args.choice


def _find_named(planned: Sequence[Result], text: str, choice: Choice) -> Iterator[tuple[Result, Action]]:
    """Yield the files that a path means: itself if it can be decided about, or all conflicts below it.

    A file is known by where the user's is, and by where it is to go.
    """
    path = Path(os.path.normpath(config.working_folder() / text))
    for result in planned if text else ():
        root, real, real_root = result.root, Path(os.path.realpath(path)), Path(os.path.realpath(result.root))
        # links may lead to a file of the configuration's folder
        places = {path, root / real.relative_to(real_root)} if real.is_relative_to(real_root) else {path}
        is_found = False
        for action in result.actions:
            files = {Path(os.path.normpath(root / key)) for key in (action.origin or action.path, action.path)}
            is_user = action.kind is Kind.CONFLICT or action.reason in USERS or action.choice is not None
            is_named = not places.isdisjoint(files) and (is_user or choice is Choice.UNDO)
            is_below = action.kind is Kind.CONFLICT and any(not places.isdisjoint(file.parents) for file in files)
            if is_named or is_below:
                is_found = True
                yield result, action
        if choice is Choice.UNDO and not is_found and not os.path.lexists(path) and path.is_relative_to(result.folder):
            yield result, Action(key_of(path, root), Reason.FORGET, Role.MODEL)  # which a build may have deleted


def _refuse(console: Console, planned: Sequence[Result], unknown: Sequence[str]) -> int:
    """Say that paths mean no file that could be resolved."""
    failed = [result for result in planned if result.failed]
    for result in failed:
        show_result(console, result)
    subject = f"{' and '.join(f'`{path}`' for path in unknown)} {'has' if len(unknown) == 1 else 'have'}"
    names = [target.shown for target in find_conflicts(planned)]
    more = f" and {len(names) - _FEW} more" if len(names) > _FEW else ""
    hint = "correct the errors first" if failed else "no file is in conflict"
    hint = f"in conflict: {', '.join(names[:_FEW])}{more}" if names else hint
    code = exit_code(failed) if failed else Exit.ERROR
    return console.end(code, [Diagnostic(Severity.ERROR, "no-conflict", f"{subject} no conflict", hint=hint)])


def _compare(
    targets: Mapping[str, tuple[Result, Action]], results: Sequence[Result], choice: Choice
) -> tuple[dict[str, Action], list[Diagnostic]]:
    """Return the actions that the choice led to, by path, and why others did not come about.

    A conflict that the choice does not settle is shown as such, with the reason.
    """
    actions = {one.path: one for result in results for one in result.actions}
    failed = {result.robot for result in results if result.failed}
    accepted, problems = dict[str, Action](), list[Diagnostic]()
    for path, (result, before) in targets.items():
        after, place = actions.get(path), shown(Path(os.path.normpath(result.root / (before.origin or path))))
        if result.robot in failed:
            continue
        if after is not None and after.sides != before.sides:
            message = "the file or its generated text changed after they were read, so your choice was not applied"
            hint = "look at it, then choose again"
            problems.append(Diagnostic(Severity.WARNING, "changed-meanwhile", message, place, hint=hint))
        elif after is None or (after.choice is not choice and before.kind is not Kind.CONFLICT):
            problems.append(_without_effect(choice, before, place))
        elif after.kind is not Kind.CONFLICT:
            accepted[path] = after
    return accepted, problems


def _without_effect(choice: Choice, action: Action, place: str) -> Diagnostic:
    """Return why a choice changes nothing about a file that does not conflict."""
    code, message, hint = "no-conflict", "the file has no conflict", "see `urdfsync status`"
    if choice is Choice.UNDO:
        code, hint = "no-undo", "to settle a conflict, use --keep, --take or --merge"
        message = "nothing to undo: no build has replaced your text here, or you saved the file since"
    elif action.reason is Reason.ORPHAN:
        code, message = "no-merge", "the file is no longer generated: there is nothing to merge"
        hint = "make it yours with --keep, or delete it with --take"
    return Diagnostic(Severity.ERROR, code, message, place, hint=hint)


def _meaning(action: Action) -> str:
    """Return what a choice makes of a file."""
    words = _MEANINGS[action.choice] if action.choice else "your file has both sides' changes already"
    if action.generated is None and action.choice is not Choice.UNDO:
        words = "deleted; --undo brings it back" if action.reason is Reason.DELETE else "yours from now on"
    return f"{words}, once the other conflicts are resolved" if action.held else words


# --- the user's editor --------------------------------------------------------------------------------------------


def _edit(conflicts: Sequence[Conflict]) -> dict[str, Path]:
    """Let the user edit each file; return where its text is then, by its path.

    Raises UrdfsyncError if one can't be used; it names those that could, too.
    """
    files = dict[str, Path]()
    try:
        for conflict in conflicts:
            files[conflict.path] = _edit_file(conflict)
    except UrdfsyncError as error:
        raise UrdfsyncError(*error.diagnostics, *map(_remains, files.values())) from error
    return files


def _edit_file(conflict: Conflict) -> Path:
    proposal = conflict.merge.proposal if conflict.merge else _both(conflict.mine, conflict.generated)
    file = editor.edit(PurePosixPath(conflict.path).name, encode(proposal))
    if flaw := _flaw(file.read_bytes(), conflict):
        message, hint = f"the edited text {flaw}; nothing was changed", f"it stays in {file}; --edit begins anew"
        raise UrdfsyncError.of("no-edit", message, conflict.path, hint=hint)
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
    """Return why an edited text can't be used, as the end of a sentence; empty if it can."""
    try:
        text = content.decode()
    except UnicodeDecodeError:
        return "is not UTF-8"
    wanted, given = ([str(one.name) for one in parse(one).classes] for one in (conflict.generated, text))
    if flaw := find_flaw(text, (conflict.mine, conflict.generated)):
        return flaw
    return "" if given == wanted else f"is not one class called {' and '.join(f'`{name}`' for name in wanted)}"


def _remains(file: Path) -> Diagnostic:
    message = "the text that you edited was not used"
    hint = "put what you want of it into your file, or edit again"
    return Diagnostic(Severity.NOTE, "edit-left", message, shown(file), hint=hint)
