"""`urdfsync adopt`: takes a package that was there before for an edited one."""

from __future__ import annotations

import argparse
import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.commands import arguments
from urdfsync.commands.edits import edit_lines, edit_values
from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.edits import EditedFile, find_edited
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.package_files import key_of
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.modelica.files import modelica_files
from urdfsync.output.conflicts import shown_path
from urdfsync.output.console import Console, StyledLine, line
from urdfsync.output.repeated import show_findings
from urdfsync.output.results import file_line, headline, result_values, show_result

_EDITS = 5
"""So many edits of a file are listed at most, without --verbose."""
_STATUSES = {
    Reason.UNCHANGED: "same",
    Reason.ADOPT: "same",
    Reason.KEEP: "edited",
    Reason.CREATE: "new",
    Reason.RESTORE: "new",
}
"""How files stand to the generated ones, by what a build does; others in the package are `unknown`, and stay."""
_STYLES = {"edited": "cyan", "unknown": "yellow", "new": "green"}


class AdoptedFile(msgspec.Struct, frozen=True):
    """A file of an adopted package."""

    path: str
    """From the configuration's folder, POSIX."""
    status: str
    owner: str = ""
    """Element that it belongs to; empty for an unknown file."""
    edited: EditedFile | None = None


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "adopt",
        run,
        "--wait --trust",
        help="take over packages that exist already; what differs counts as your edits",
        description="Build robots whose packages were there before: written by another tool, or by urdfsync, whose "
        "recorded state is lost. Every file that differs from the generated one counts as edited by you, and stays; "
        "missing files are written. What differs is listed. From then on exports merge with it as with any edit.",
        epilog="example: urdfsync adopt arm --dry-run",
    )
    parser.add_argument("robots", nargs="+", metavar="ROBOT", help="robots of urdfsync.toml")
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, write nothing")


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Build the robots for the first time, and show how their files stand to the generated ones."""
    configuration = arguments.configuration(args)
    robots = {robot.name: robot for robot in configuration.select(args.robots)}
    request = arguments.request(args, console, dry=args.dry_run, adopts=True)
    results = []
    for result in build(configuration, list(robots.values()), request):
        results.append(result)
        if result.failed or result.conflicts:
            show_result(console, result)
            continue
        looking = arguments.request(args, console, dry=True, adopts=args.dry_run)
        files = adopted_files(result, generate_robot(inspect(configuration, robots[result.robot], looking)))
        if console.json:
            told = [
                {"path": one.path, "owner": one.owner, "edits": [], "status": one.status}
                | (edit_values(one.edited) if one.edited else {})
                for one in files
            ]
            console.add_robot({**result_values(result), "files": told})
            continue
        show_findings(console, result)
        if not console.quiet:
            console.print(_lines(result, files, console.verbose))
    code = exit_code(results)
    console.end("adopt", code)
    return code


def adopted_files(result: Result, generation: Generation) -> list[AdoptedFile]:
    """Return all files of the package but `package.order` ones, in the order of their paths."""
    edited = {one.path: one for one in find_edited(generation)}
    actions = {one.path: one for one in result.actions if one.role is not Role.ORDER and one.reason in _STATUSES}
    files = [AdoptedFile(path, _STATUSES[one.reason], one.owner, edited.get(path)) for path, one in actions.items()]
    paths = (key_of(Path(place), result.root) for place in modelica_files(result.folder))
    files += [AdoptedFile(path, "unknown") for path in paths if path not in actions]
    return sorted(files, key=lambda file: file.path.rpartition("/"))


def _lines(result: Result, files: Sequence[AdoptedFile], verbose: bool) -> Iterator[StyledLine]:
    """Yield the files with their edits, by element; those that are the same only with `verbose`."""
    counts = Counter(file.status for file in files)
    words = ", ".join(f"{counts[one]} {one}" for one in ("same", "edited", "unknown", "new") if counts[one])
    yield headline(result, f"{'to adopt' if result.dry else 'adopted'}: {words}", is_fine=True)
    for file in files:
        if verbose or file.status != "same":
            yield file_line(shown_path(result, file.path), file.status, _STYLES.get(file.status, "dim"), file.owner)
        if file.edited:
            yield from itertools.islice(edit_lines(file.edited, result.root, verbose, _EDITS), 1, None)
    if counts["unknown"]:
        yield line(("  exports do not change unknown files: new numbers go to the generated records", "dim"))
