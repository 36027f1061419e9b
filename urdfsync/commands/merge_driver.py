"""`urdfsync merge-driver`: lets git merge Modelica files by the elements of their classes."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from pathlib import Path

from urdfsync.commands import arguments
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.common.files import put, shown
from urdfsync.common.spelling import counted
from urdfsync.engine.result import Exit
from urdfsync.output.console import Console, line
from urdfsync.project import git
from urdfsync.project.git.unmerged import has_driver

_MARKER_SIZE = 7
"""The default length of markers."""
_ATTRIBUTE = b"*.mo merge=urdfsync\n"
"""The line that names the driver's files."""
_DRIVER = """\
try() {{
  case $(command -v "$1") in /* | ?:*) ;; *) return ;; esac
  "$@" merge-driver --path=%P --marker-size=%L --ours=%X --theirs=%Y %O %A %B && exit
  grep -q "^<<<<<<<" %A && exit 1
}}
try urdfsync
try {python} -P -m urdfsync
git merge-file -q --marker-size=%L -L %X -L base -L %Y %A %O %B"""
"""The driver, which git gives to a shell at the top of the clone.

A program that is missing or fails must not leave our version without markers: then git merges by lines.
Without -P, Python would import a folder `urdfsync` of the clone, and a relative path may lead into the clone.
"""


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "merge-driver",
        help="let git merge Modelica files by their elements",
        description="Let git merge Modelica files by the elements of their classes, in merges, rebases and "
        "cherry-picks. With --install, set the driver up in this clone, and name the files in .gitattributes of the "
        "working folder. Git then calls the driver with three files: it merges the changes from BASE to OTHER into "
        "MINE, and puts contradictions between markers.",
        epilog="example: urdfsync merge-driver --install\n\nexit codes: 0 merged or installed, "
        "1 conflicts, 255 error (2 by --install)",
    )
    parser.add_argument("--install", action="store_true", help="set the driver up in the clone of the working folder")
    for name, words in (
        ("base", "the common ancestor (%%O of git)"),
        ("mine", "the version of this side, to which the result is written (%%A)"),
        ("other", "the version of the other side (%%B)"),
    ):
        parser.add_argument(name, metavar=name.upper(), type=Path, nargs="?", help=words)
    parser.add_argument("--path", metavar="PATH", type=Path, help="name of the file in messages (%%P)")
    parser.add_argument("--ours", metavar="LABEL", default="", help="name of MINE in markers (%%X)")
    parser.add_argument("--theirs", metavar="LABEL", default="", help="name of OTHER in markers (%%Y)")
    size = "length of markers (%%L; default: 7)"
    parser.add_argument("--marker-size", metavar="N", type=int, default=_MARKER_SIZE, help=size)


def run(args: argparse.Namespace, console: Console) -> int:
    """Merge the files, or tell git to use this command."""
    if args.install == bool(args.other):
        raise arguments.UsageError(args.parser, "either --install or BASE MINE OTHER is needed")
    if args.install:
        install(Path.cwd(), console)
        return console.end(Exit.IN_STEP)
    conflict = _merge(args)
    return console.end(1 if conflict else 0, conflict)


def can_install(folder: Path) -> bool:
    """Return whether a folder is in a clone without the driver."""
    try:
        git.run("-C", str(folder), "rev-parse", "--show-toplevel")
    except git.GitError:
        return False
    return not (_is_named(folder) and has_driver(folder))


def _is_named(folder: Path) -> bool:
    """Return whether git's attributes of `.mo` files name the driver. Raises GitError."""
    return git.run("-C", str(folder), "check-attr", "-z", "merge", "--", "any.mo").split("\0")[2] == "urdfsync"


def install(folder: Path, console: Console) -> None:
    """Write the command to the clone's settings, and the attribute to the folder's `.gitattributes` if it is missing.

    Raises UrdfsyncError if writing fails.
    """
    driver = _DRIVER.format(python=shlex.quote(Path(sys.executable).as_posix()).replace("%", "%%"))
    inside, file = ("-C", str(folder)), folder / ".gitattributes"
    try:
        top = git.run(*inside, "rev-parse", "--show-toplevel").removesuffix("\n")
        git.run(*inside, "config", "--local", "merge.urdfsync.name", "Modelica by elements")
        git.run(*inside, "config", "--local", "merge.urdfsync.driver", driver)
        is_named = _is_named(folder)
    except git.GitError as error:
        raise UrdfsyncError.of("git", str(error), hint="run it in a clone") from None
    console.tell([line((f"git merges with urdfsync in {Path(top)}", ""))])
    if not is_named:
        try:
            old = file.read_bytes() if os.path.lexists(file) else b""
            put(file, (old if old.endswith(b"\n") or not old else old + b"\n") + _ATTRIBUTE)
        except OSError as error:
            message = f"`{_ATTRIBUTE.decode().strip()}` can't be added: {error.strerror}"
            raise UrdfsyncError.of("git", message, shown(file), hint="add this line, and commit it") from None
        console.tell([line((f"{shown(file)} written: commit it", ""))])


def _merge(args: argparse.Namespace) -> list[Diagnostic]:
    """Write the merge, and return a warning if there are conflicts. Raises OSError."""
    file = shown(args.path or args.mine)
    contents = [path.read_bytes() for path in (args.base, args.mine, args.other)]
    try:
        base, mine, other = (content.decode() for content in contents)
    except UnicodeDecodeError:
        message, hint = "the file is not UTF-8, so it can't be merged", "this side's text stays: settle it by hand"
        return [Diagnostic(Severity.WARNING, "conflict", message, file, hint=hint)]
    size = args.marker_size if args.marker_size > 0 else _MARKER_SIZE  # as git does
    labels = _label(args.ours, "ours"), _label(args.theirs, "theirs")
    markers = f"{'<' * size} {labels[0]}", "=" * size, f"{'>' * size} {labels[1]}"
    merged, message, hint = _merge_texts(base, mine, other, markers)
    if merged.encode() != contents[1]:
        args.mine.write_bytes(merged.encode())  # a temporary file of git's
    return [Diagnostic(Severity.WARNING, "conflict", message, file, hint=hint)] if message else []


def _merge_texts(base: str, mine: str, other: str, markers: tuple[str, str, str]) -> tuple[str, str, str]:
    """Return the merge of two versions of a file, and for conflicts their message and hint, else empty texts."""
    from urdfsync.engine.inspect.package_files import text_hash
    from urdfsync.merge.texts import merge_branches  # the other commands seldom merge
    from urdfsync.modelica.stamp import split, stamped

    first, middle, last = markers
    (bare_base, before), (bare, stamp), (bare_other, others) = map(split, (base, mine, other))
    by_build = "resolve the source first, then run `urdfsync build`: it writes this file anew, or asks about edits"
    if stamp and others and stamp.id != others.id:  # the build merges each version with those of its own part
        message = "the two versions are of different parts, so both stand between markers"
        return f"{first}\n{_ended(mine)}{middle}\n{_ended(other)}{last}\n", message, by_build
    unedited = [side and side.base == text_hash(text) for text, side in ((bare, stamp), (bare_other, others))]
    found = merge_branches(bare_base, bare, bare_other, [(first, "mine"), (middle, "generated"), (last, "")])
    if stamp and all(unedited) and not found.contradictions:
        stamp = stamp._replace(base=text_hash(found.proposal))  # nobody has edited the file
    elif stamp == before:  # if both sides exported the part, the next build takes our stamp as it is
        stamp = others
    merged = stamped(found.proposal, stamp) if stamp else found.proposal
    if not (count := len(found.contradictions)):
        return merged, "", ""
    hint = by_build if any(unedited) else "settle them in the file"
    return merged, f"{counted(count, 'conflict')} between markers", hint


def _ended(text: str) -> str:
    return text if text.endswith("\n") else f"{text}\n"


def _label(given: str, default: str) -> str:
    """Return the label that git gives a version, as one line; git before 2.44 passes the placeholder unchanged."""
    return default if given in ("", "%X", "%Y") else " ".join(given.split())
