"""What the user edited in generated files, by the elements of their classes: lines for people, and a section."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from urdfsync.engine.edits import EditedFile, RobotEdits
from urdfsync.files import shown
from urdfsync.merge.edits import in_words
from urdfsync.output.conflicts import difference_lines
from urdfsync.output.console import StyledLine, first_lines, line
from urdfsync.output.sections import Mark, Section, Table
from urdfsync.spelling import counted

_EDITS = 20
"""So many edits of a file are listed at most, without --verbose."""


def robot_lines(edited: RobotEdits, *, verbose: bool = False) -> Iterator[StyledLine]:
    """Yield the edits of a robot, file by file; of one that failed nothing, since its findings say why."""
    if edited.failed:
        return
    yield line((edited.robot, "bold"), (f": {_summary(edited)}", ""))
    for file in edited.files:
        yield from edit_lines(file, edited.root, verbose)


def to_section(edited: RobotEdits) -> Section:
    """Return the edits of a robot for a comment."""
    if edited.failed:
        return Section(edited.robot, "can't be read", Mark.WRONG, findings=edited.diagnostics)
    rows = [(_shown(file, edited.root), *edit) for file in edited.files for edit in _told(file)]
    table = Table("Edits", ("File", "Element", "Edit"), rows)
    return Section(edited.robot, _summary(edited), Mark.NONE, tables=[table])


def _summary(edited: RobotEdits) -> str:
    return f"{counted(len(edited.files), 'file')} edited" if edited.files else "nothing is edited"


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
    if (edits := file.edits) is None:
        return [("", "edited; it is no single class, so only its lines can be compared: --verbose shows them")]
    return in_words(edits) or [("", "only blanks, or the order of things")]


def _style(what: str) -> str:
    return "green" if what.endswith("added") else "red" if what.endswith("removed") else ""
