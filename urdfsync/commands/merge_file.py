"""`urdfsync merge-file`: merges three versions of a file, as `git merge-file` does; git calls it as a merge driver."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from urdfsync.commands import arguments
from urdfsync.diagnostics import Diagnostic, Severity, SourceError, UrdfsyncError, findings_of
from urdfsync.files import shown
from urdfsync.output.console import Console
from urdfsync.output.phrases import counted

_MOST = 127
"""The greatest number of conflicts that an exit code tells, as in git."""
_MARKER_SIZE = 7
"""Length of markers, unless another one is given."""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "merge-file",
        run,
        help="merge three versions of a file, as git's merge driver",
        description="Bring what changed from BASE to OTHER into MINE, with the arguments and exit codes of "
        "git merge-file. Classes of Modelica merge by their elements, other texts by lines. What both changed is put "
        "between markers.",
        epilog="as git's merge driver: "
        "urdfsync merge-file --path %P --marker-size %L -L ours -L base -L theirs %A %O %B\n\n"
        "exit codes: 0 merged, 1 to 127 conflicts, 255 error",
    )
    for name, words in (
        ("mine", "your version; the result is written to it"),
        ("base", "the common ancestor"),
        ("other", "the other version"),
    ):
        parser.add_argument(name, metavar=name.upper(), type=Path, help=words)
    parser.add_argument("-p", "--stdout", action="store_true", help="print the result, leave MINE as it is")
    parser.add_argument("-L", dest="labels", metavar="LABEL", action="append", help="names of MINE, BASE and OTHER")
    parser.add_argument("--diff3", action="store_true", help="show what BASE has in a conflict, too")
    parser.add_argument(
        "--path", metavar="PATH", type=Path, help="what messages call MINE, which git gives as a temporary file"
    )
    parser.add_argument(
        "--marker-size", metavar="N", type=int, default=_MARKER_SIZE, help="length of markers (default: 7)"
    )


def run(args: argparse.Namespace, console: Console) -> int:
    """Merge the files; the exit code is the number of conflicts."""
    if args.stdout and args.json:
        raise arguments.UsageError(args.parser, "--stdout and --json both write to the standard output")
    try:
        conflicts = _merge(args)
    except (UrdfsyncError, OSError) as error:
        console.end("merge-file", arguments.DRIVER_ERROR, findings_of(error))
        return arguments.DRIVER_ERROR
    message, hint = f"{counted(conflicts, 'conflict')} between markers", "settle them in the file"
    warning = Diagnostic(Severity.WARNING, "conflict", message, shown(args.path or args.mine), hint=hint)
    found = [warning] if conflicts else []
    console.end("merge-file", min(conflicts, _MOST), found)
    return min(conflicts, _MOST)


def _merge(args: argparse.Namespace) -> int:
    """Write the merge, and return the number of conflicts. Raises SourceError for what is no text, and OSError."""
    from urdfsync.merge.texts import merge_file  # the other commands seldom merge

    files = args.mine, args.base, args.other
    mine, base, other = map(_text, files)
    named, size = args.labels or [], args.marker_size if args.marker_size > 0 else _MARKER_SIZE  # as git does
    labels = [*named, *map(str, files[len(named) :])]
    markers = [(f"{'<' * size} {labels[0]}", "mine"), (f"{'=' * size}", "generated"), (f"{'>' * size} {labels[2]}", "")]
    if args.diff3:
        markers.insert(1, (f"{'|' * size} {labels[1]}", "base"))
    merged, conflicts = merge_file(base, mine, other, markers)
    if args.stdout:
        sys.stdout.write(merged)
    elif merged != mine:
        args.mine.write_bytes(merged.encode())
    return conflicts


def _text(file: Path) -> str:
    try:
        return file.read_bytes().decode()
    except UnicodeDecodeError:
        raise SourceError(Diagnostic(Severity.ERROR, "no-text", "it is not UTF-8", shown(file))) from None
