"""`urdfsync diff --edits`: what the user edited in generated files, by the elements of their classes."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec

from urdfsync import config
from urdfsync.commands import arguments
from urdfsync.diagnostics import ConfigError, UrdfsyncError
from urdfsync.engine.edits import EditedFile, find_edited
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.result import Exit
from urdfsync.files import shown
from urdfsync.merge.edits import find_edits, in_words
from urdfsync.output.conflicts import difference_lines
from urdfsync.output.console import Console, Format, StyledLine, first_lines, line
from urdfsync.output.markdown import Mark, Section, Table
from urdfsync.output.phrases import counted

_EDITS = 20
"""So many edits of a file are listed at most, without --verbose."""


def run(args: argparse.Namespace, console: Console) -> int:
    """Show the edits in the files that the paths mean, or in all. Raises ConfigError if a path means none."""
    configuration, code = arguments.configuration(args), Exit.IN_STEP
    request = arguments.request(args, console, dry=True)
    places = {text: Path(os.path.normpath(config.working_folder() / text)) for text in args.sources}
    unknown = set(places)
    for robot in configuration.select(args.robot or []):
        named = {
            text: robot.folder if text == robot.name else place
            for text, place in places.items()
            if text == robot.name or place.is_relative_to(robot.folder) or robot.folder.is_relative_to(place)
        }
        unknown -= named.keys()
        if places and not named:
            continue
        try:
            files = list(find_edited(generate_robot(inspect(configuration, robot, request))))
        except UrdfsyncError as error:
            console.add_robot({"name": robot.name, "failed": True, "files": []})
            console.add_section(Section(robot.name, "can't be read", Mark.WRONG, findings=error.diagnostics))
            console.findings(error.diagnostics)
            code = Exit.ERROR
            continue
        if named:
            root = configuration.root
            files = [
                file for file in files if any((root / file.path).is_relative_to(place) for place in named.values())
            ]
        words = f"{counted(len(files), 'file')} edited" if files else "nothing is edited"
        if console.format is Format.JSON:
            console.add_robot({"name": robot.name, "failed": False, "files": list(map(edit_values, files))})
        elif console.json:
            rows = [(_shown(file, configuration.root), *edit) for file in files for edit in _told(file)]
            table = Table("Edits", ("File", "Element", "Edit"), rows)
            console.add_section(Section(robot.name, words, Mark.NONE, tables=[table]))
        console.tell([line((robot.name, "bold"), (f": {words}", ""))])
        for file in files:
            console.tell(edit_lines(file, configuration.root, console.verbose))
    if unknown:
        message = f"{min(unknown)!r} is no robot, and no file of a package"
        raise ConfigError.of("no-source", message, hint="name a robot, or a file of its package")
    return console.end(code)


def edit_values(file: EditedFile) -> dict[str, Any]:
    """Return an edited file as plain data; `edits` is None if they can't be told by element."""
    edits = None if file.base is None else find_edits(file.base, file.mine)
    told = None if edits is None else [msgspec.structs.asdict(edit) for edit in edits if edit.element != "comments"]
    return {"path": file.path, "owner": file.owner, "edits": told}


def edit_lines(file: EditedFile, root: Path, verbose: bool, most: int = _EDITS) -> Iterator[StyledLine]:
    """Yield the lines of one file: each element that is edited, and what of it; with `verbose`, the lines as well.

    Without it, so many edits are listed at `most`.
    """
    yield line(("  ", ""), (_shown(file, root), "bold"), (f"  {file.owner}", "dim"))
    lines = [
        line((f"    {element}", ""), (f"{': ' if element else ''}{what}", _style(what)))
        for element, what in _told(file)
    ]
    yield from first_lines(lines, most, "edit", verbose=verbose)
    if verbose and file.base is not None:
        yield from difference_lines(file.base, file.mine, "base", "mine")


def _shown(file: EditedFile, root: Path) -> str:
    return shown(Path(os.path.normpath(root / file.path)))


def _told(file: EditedFile) -> list[tuple[str, str]]:
    """Return the elements that are edited, and what of each; the element is empty for the file as a whole."""
    if file.base is None:
        return [("", "its base, the text that urdfsync wrote last, is lost: nothing to compare with")]
    edits = find_edits(file.base, file.mine)
    if edits is None:
        return [("", "edited; it is no single class, so only its lines can be compared: --verbose shows them")]
    return in_words(edits) or [("", "only blanks, or the order of things")]


def _style(what: str) -> str:
    return "green" if what.endswith("added") else "red" if what.endswith("removed") else ""
