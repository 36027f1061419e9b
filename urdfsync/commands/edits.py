"""`urdfsync diff --edits`: what the user edited in generated files, by the elements of their classes."""

from __future__ import annotations

import argparse
import difflib
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.edits import EditedFile, find_edited
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.result import Exit
from urdfsync.files import shown
from urdfsync.merge.edits import Edit, find_edits, in_words
from urdfsync.output.console import Console, StyledLine, first_lines, line
from urdfsync.output.phrases import counted

_EDITS = 20
"""So many edits of a file are listed at most, without --verbose."""


def run(args: argparse.Namespace, console: Console) -> Exit:
    """Show the edits in the files that the paths mean, or in all. Raises ConfigError if a path means none."""
    loaded = arguments.configuration(args)
    request, robots = arguments.request(args, console, dry=True), loaded.select(args.robot or [])
    named = {text: Path(os.path.normpath(config.working_folder() / text)) for text in args.sources}
    meant = set[str]()
    code = Exit.IN_STEP
    for robot in robots:
        wanted = {text for text, place in named.items() if text == robot.name or robot.folder.is_relative_to(place)}
        try:
            found = list(find_edited(generate_robot(inspect(loaded, robot, request))))
        except UrdfsyncError as error:
            console.add_robot({"name": robot.name, "failed": True, "files": []})
            console.findings(error.diagnostics)
            code = Exit.ERROR
            continue
        inside = {text for text, place in named.items() if place.is_relative_to(robot.folder)}
        meant |= wanted | inside
        if named and not wanted:
            places = [named[text] for text in inside]
            found = [one for one in found if any((loaded.root / one.path).is_relative_to(place) for place in places)]
            if not inside:
                continue
        _show(console, loaded.root, robot.name, found)
    if unknown := [text for text in named if text not in meant]:
        message, hint = (
            f"{unknown[0]!r} is no robot, and no file of a package",
            "name a robot, or a file of its package",
        )
        raise ConfigError(Diagnostic(Severity.ERROR, "no-source", message, hint=hint))
    console.end("diff", code)
    return code


def _show(console: Console, root: Path, robot: str, found: Sequence[EditedFile]) -> None:
    if console.json:
        files = [
            {"path": one.path, "owner": one.owner, "base": one.base is not None, "edits": edit_values(one)}
            for one in found
        ]
        console.add_robot({"name": robot, "failed": False, "files": files})
        return
    if console.quiet:
        return
    words = f"{counted(len(found), 'file')} edited" if found else "nothing is edited"
    console.print([line((robot, "bold"), (f": {words}", ""))])
    for one in found:
        console.print(edit_lines(one, root, console.verbose))


def _edits(file: EditedFile) -> list[Edit] | None:
    return find_edits(file.base, file.mine) if file.base is not None else None


def edit_values(file: EditedFile) -> list[dict[str, str | None]] | None:
    """Return the edits of a file as plain data; None if they can't be told by element."""
    edits = _edits(file)
    return None if edits is None else [msgspec.structs.asdict(one) for one in edits if one.element != "comments"]


def edit_lines(file: EditedFile, root: Path, verbose: bool, most: int = _EDITS) -> Iterator[StyledLine]:
    """Yield the lines of one file: each element that is edited, and what of it; with `verbose`, the lines as well.

    Without it, so many edits are listed at `most`.
    """
    edits = _edits(file)
    yield line(("  ", ""), (shown(Path(os.path.normpath(root / file.path))), "bold"), (f"  {file.owner}", "dim"))
    if file.base is None:
        yield line(("    what urdfsync wrote last is lost: there is nothing to compare with", "dim"))
        return
    if edits is None:
        told = [("", "edited; it is no single class, so only its lines can be compared: --verbose shows them")]
    else:
        told = in_words(edits) or [("", "only blanks, or the order of things")]
    lines = [line((f"    {element}", ""), (f"{': ' if element else ''}{what}", _style(what))) for element, what in told]
    yield from first_lines(lines, most, "edit", verbose=verbose)
    if verbose:
        old, new = (text.replace("\r\n", "\n").splitlines() for text in (file.base, file.mine))
        for text in difflib.unified_diff(old, new, "base", "mine", lineterm="", n=2):
            yield line((f"    {text}", {"+": "green", "-": "red", "@": "cyan"}.get(text[:1], "dim")))


def _style(what: str) -> str:
    return "green" if what.endswith("added") else "red" if what.endswith("removed") else ""
