"""`urdfsync merge-driver`: git merges Modelica files with it, by the elements of their classes."""

from __future__ import annotations

import argparse
import shlex
import sys
from pathlib import Path

from urdfsync import git
from urdfsync.commands import arguments
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.result import Exit
from urdfsync.files import shown
from urdfsync.output.console import Console, line
from urdfsync.spelling import counted

_MARKER_SIZE = 7
"""Length of markers, unless another one is given."""
_PLACEHOLDERS = "--path=%P --marker-size=%L --ours=%X --theirs=%Y %O %A %B"


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "merge-driver",
        help="let git merge Modelica files by their elements",
        description="Let git merge Modelica files by the elements of their classes, in merges, rebases and "
        "cherry-picks. With --install, tell git in this clone. Without, git calls it: what changed from BASE to OTHER "
        "is brought into MINE, and what both changed is put between markers.",
        epilog="example: urdfsync merge-driver --install\n\nexit codes: 0 merged or installed, "
        "1 conflicts, 255 error (2 by --install)",
    )
    parser.add_argument("--install", action="store_true", help="enter it into the settings of the clone around")
    for name, words in (
        ("base", "the common ancestor (%%O of git)"),
        ("mine", "the version of this side, to which the result is written (%%A)"),
        ("other", "the version of the other side (%%B)"),
    ):
        parser.add_argument(name, metavar=name.upper(), type=Path, nargs="?", help=words)
    parser.add_argument("--path", metavar="PATH", type=Path, help="what messages call the file (%%P)")
    parser.add_argument("--ours", metavar="LABEL", default="", help="what MINE is called in markers (%%X)")
    parser.add_argument("--theirs", metavar="LABEL", default="", help="what OTHER is called in markers (%%Y)")
    size = "length of markers (%%L; default: 7)"
    parser.add_argument("--marker-size", metavar="N", type=int, default=_MARKER_SIZE, help=size)


def run(args: argparse.Namespace, console: Console) -> int:
    """Merge the files, or tell git to use this command."""
    if args.install == bool(args.other):
        raise arguments.UsageError(args.parser, "either --install or BASE MINE OTHER is needed")
    if args.install:
        return _install(console)
    conflict = _merge(args)
    return console.end(1 if conflict else 0, conflict)


def _install(console: Console) -> int:
    """Enter the command into the settings of the clone, and say which line `.gitattributes` needs, if it does.

    Raises UrdfsyncError if that can't be.
    """
    # git starts it in the top folder of the clone: without -P, Python would import a folder `urdfsync` from there
    command = f"{shlex.quote(sys.executable)} -P -m urdfsync merge-driver".replace("%", "%%")
    try:
        top = git.run("rev-parse", "--show-toplevel").removesuffix("\n")
        git.run("config", "--local", "merge.urdfsync.name", "Modelica by elements")
        git.run("config", "--local", "merge.urdfsync.driver", f"{command} {_PLACEHOLDERS}")
        attribute = git.run("check-attr", "-z", "merge", "--", "any.mo").split("\0")[2]
    except git.GitError as error:
        raise UrdfsyncError.of("git", str(error), hint="run it in a clone") from None
    console.tell([line((f"git merges with urdfsync in {top}", ""))])
    hint, file = "add the line `*.mo merge=urdfsync` to it, and commit it", shown(Path(top, ".gitattributes"))
    note = Diagnostic(Severity.NOTE, "no-attribute", "it does not say which files these are", file, hint=hint)
    return console.end(Exit.IN_STEP, [note] if attribute != "urdfsync" else [])


def _merge(args: argparse.Namespace) -> list[Diagnostic]:
    """Write the merge, and return a warning if there are conflicts. Raises OSError."""
    from urdfsync.merge.texts import merge_file  # the other commands seldom merge

    size = args.marker_size if args.marker_size > 0 else _MARKER_SIZE  # as git does
    labels = _label(args.ours, "ours"), _label(args.theirs, "theirs")
    markers = [(f"{'<' * size} {labels[0]}", "mine"), (f"{'=' * size}", "generated"), (f"{'>' * size} {labels[1]}", "")]
    file = shown(args.path or args.mine)
    contents = [path.read_bytes() for path in (args.base, args.mine, args.other)]
    try:
        base, mine, other = (content.decode() for content in contents)
    except UnicodeDecodeError:
        message, hint = "it is not UTF-8, so it can't be merged", "it stays as this side has it: settle it by hand"
        return [Diagnostic(Severity.WARNING, "conflict", message, file, hint=hint)]
    merged, conflicts = merge_file(base, mine, other, markers)
    if merged != mine:
        args.mine.write_bytes(merged.encode())  # a temporary file of git's
    message, hint = f"{counted(len(conflicts), 'conflict')} between markers", "settle them in the file"
    return [Diagnostic(Severity.WARNING, "conflict", message, file, hint=hint)] if conflicts else []


def _label(given: str, default: str) -> str:
    """Return a label of git's as one line; git before 2.44 gives its placeholder as it is."""
    return default if given in ("", "%X", "%Y") else " ".join(given.split())
