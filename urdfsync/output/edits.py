"""Turns the user's edits into a section, by the elements of classes."""

from __future__ import annotations

import os
from pathlib import Path

from urdfsync.common.files import shown
from urdfsync.common.spelling import counted
from urdfsync.engine.edits import EditedFile, RobotEdits
from urdfsync.merge.edits import in_words
from urdfsync.modelica.layout import first_fault
from urdfsync.modelica.parser import parse
from urdfsync.output.conflicts import difference_lines
from urdfsync.output.console import StyledLine, line
from urdfsync.output.sections import Mark, Section, TextTable


def to_section(edited: RobotEdits, *, verbose: bool | None = None, most: int = 20) -> Section:
    """Return the edits of a robot by file; a terminal shows `most` of each file. If `verbose`, also edited lines."""
    if edited.failed:
        return Section(edited.robot, "can't be read", Mark.WRONG, findings=edited.diagnostics)
    tables = list[TextTable]()
    for file in edited.files:
        place = shown(Path(os.path.normpath(edited.root / file.path)))
        heading = line(("  ", ""), (place, "bold"), (f"  {file.owner}", "dim"))
        rows = [(place, *edit) for edit in _told(file)]
        tables.append(TextTable("Edits", ("File", "Element", "Edit"), rows, _edit_line, most, "edit", [heading]))
        if verbose and file.base is not None:
            differences = [(each,) for each in difference_lines(file.base, file.mine, "base", "mine")]
            tables.append(TextTable("Lines", ("",), differences, lambda each: each))
    summary = f"{counted(len(edited.files), 'file')} edited" if edited.files else "nothing is edited"
    return Section(edited.robot, summary, Mark.NONE, tables=tables)


def _edit_line(_place: str, element: str, what: str) -> StyledLine:
    style = "green" if what.endswith("added") else "red" if what.endswith("removed") else ""
    return line((f"    {element}", ""), (f"{': ' if element else ''}{what}", style))


def _told(file: EditedFile) -> list[tuple[str, str]]:
    """Return the edited elements, each with its edit; an edit of the whole file has an empty element."""
    if file.base is None:
        return [("", "its base, the text that urdfsync wrote last, is lost: nothing to compare with")]
    if (edits := file.edits) is None:
        declared = parse(file.mine)
        why = "the file is no single class"
        if declared.faults:
            fault = first_fault(file.mine, declared)
            why = f"the file {fault.reason} (line {fault.line})"
        return [("", f"{why}, so only its lines can be compared: --verbose shows them")]
    return in_words(edits) or [("", "only blanks, or the order of things")]
