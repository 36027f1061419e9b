"""`urdfsync adopt`: takes a package that was there before for an edited one."""

from __future__ import annotations

import argparse
import enum
import itertools
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.commands import arguments
from urdfsync.commands.edits import edit_lines, edit_values
from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.edits import EditedFile, OtherNumber, find_edited, find_other_numbers
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.package_files import key_of
from urdfsync.engine.package_names import class_of
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.modelica.files import modelica_files
from urdfsync.output.conflicts import shown_path
from urdfsync.output.console import Console, StyledLine, first_lines, line
from urdfsync.output.repeated import show_findings
from urdfsync.output.results import file_line, headline, result_values, show_result

_EDITS = 5
"""So many edits of a file are listed at most, without --verbose."""


class AdoptedStatus(enum.StrEnum):
    """How a file of an adopted package stands to the generated ones."""

    SAME = "same"
    EDITED = "edited"
    """Its text differs from the generated one, and stays."""
    UNKNOWN = "unknown"
    """Nothing like it is generated: it stays the user's."""
    NEW = "new"
    """It was missing, and is generated."""


_STATUSES = {
    Reason.UNCHANGED: AdoptedStatus.SAME,
    Reason.ADOPT: AdoptedStatus.SAME,
    Reason.KEEP: AdoptedStatus.EDITED,
    Reason.CREATE: AdoptedStatus.NEW,
    Reason.RESTORE: AdoptedStatus.NEW,
}
_STYLES = {AdoptedStatus.EDITED: "cyan", AdoptedStatus.UNKNOWN: "yellow", AdoptedStatus.NEW: "green"}


class AdoptedFile(msgspec.Struct, frozen=True):
    """A file of an adopted package."""

    path: str
    """From the configuration's folder, POSIX."""
    status: AdoptedStatus
    owner: str
    """Element that it belongs to; of an unknown file the one that its name begins with, empty for none."""
    edited: EditedFile | None = None
    numbers: Sequence[OtherNumber] = ()
    """Of an unknown file: those that its element does not have in the source."""


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
    results = []
    for result in build(
        configuration, list(robots.values()), arguments.request(args, console, dry=args.dry_run, adopts=True)
    ):
        results.append(result)
        if result.failed or result.conflicts:
            show_result(console, result)
            continue
        request = arguments.request(args, console, dry=True, adopts=args.dry_run)
        generation = generate_robot(inspect(configuration, robots[result.robot], request))
        _show(console, result, adopted_files(result, generation))
    code = exit_code(results)
    console.end("adopt", code)
    return code


def adopted_files(result: Result, generation: Generation) -> list[AdoptedFile]:
    """Return all files of the package but `package.order` ones, in the order of their paths."""
    edited = {one.path: one for one in find_edited(generation)}
    actions = {one.path: one for one in result.actions if one.role is not Role.ORDER and one.reason in _STATUSES}
    files = [AdoptedFile(path, _STATUSES[one.reason], one.owner, edited.get(path)) for path, one in actions.items()]
    owners = {class_of(path): one.owner for path, one in actions.items() if one.role in (Role.MODEL, Role.RECORD)}
    paths = (key_of(Path(place), result.root) for place in modelica_files(result.folder))
    files += [_unknown(path, _owner(path, owners), generation) for path in paths if path not in actions]
    return sorted(files, key=lambda file: file.path.rpartition("/"))


def _unknown(path: str, owner: str, generation: Generation) -> AdoptedFile:
    kind, _, name = owner.partition(" ")
    element = generation.now.snapshot.get(f"{kind}s", {}).get(name)
    text = generation.inputs.files.any_text(path)
    numbers = find_other_numbers(text, element) if element is not None else []
    return AdoptedFile(path, AdoptedStatus.UNKNOWN, owner, numbers=numbers)


def _owner(path: str, owners: Mapping[str, str]) -> str:
    """Return the element whose class an unknown file is called after, as in `ElbowParams`; empty if there is none."""
    name = class_of(path)
    found = [one for one in owners if name == one or (name.startswith(one) and name[len(one)].isupper())]
    return owners[max(found, key=len)] if found else ""


def _show(console: Console, result: Result, files: Sequence[AdoptedFile]) -> None:
    if console.json:
        values = result_values(result)
        told = {key: values[key] for key in ("name", "package", "folder", "failed", "locked", "diagnostics")}
        console.add_robot({**told, "files": list(map(_values, files))})
        return
    show_findings(console, result)
    if console.quiet:
        return
    counts = Counter(file.status for file in files)
    words = ", ".join(f"{counts[one]} {one}" for one in AdoptedStatus if counts[one])
    console.print([headline(result, f"{'to adopt' if result.dry else 'adopted'}: {words}", is_fine=True)])
    for file in files:
        console.print(_lines(file, result, console.verbose))
    if counts[AdoptedStatus.UNKNOWN]:
        console.print([line(("  exports do not change unknown files: new numbers go to the generated records", "dim"))])


def _values(file: AdoptedFile) -> dict[str, Any]:
    edits = edit_values(file.edited) if file.edited else []
    numbers = [msgspec.structs.asdict(one) for one in file.numbers]
    return {"path": file.path, "status": file.status, "owner": file.owner, "edits": edits, "numbers": numbers}


def _lines(file: AdoptedFile, result: Result, verbose: bool) -> Iterator[StyledLine]:
    """Yield the lines of one file: with its edits, by element; those that are the same only with `verbose`."""
    if verbose or file.status is not AdoptedStatus.SAME:
        why = f"named after {file.owner}" if file.owner and file.status is AdoptedStatus.UNKNOWN else file.owner
        yield file_line(shown_path(result, file.path), file.status, _STYLES.get(file.status, "dim"), why)
    if file.edited:
        yield from itertools.islice(edit_lines(file.edited, result.root, verbose, _EDITS), 1, None)
    numbers = (f"    line {one.line}: {one.name} = {one.value} is not in the source" for one in file.numbers)
    yield from first_lines([line((text, "")) for text in numbers], _EDITS, "number", verbose=verbose)
