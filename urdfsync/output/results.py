"""The result of a build as lines for people."""

from __future__ import annotations

import sys
from collections.abc import Container, Iterable, Iterator, Sequence

from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.actions import ORPHANS, Action, FileStatus, Kind, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.files import shown
from urdfsync.output.conflicts import conflict_lines
from urdfsync.output.console import Console, StyledLine, first_lines, has_marks, line
from urdfsync.output.phrases import change_lines, reason
from urdfsync.output.repeated import show_findings

_STYLES = {Kind.WRITE: "green", Kind.DELETE: "magenta", Kind.CONFLICT: "bold red"}
_STYLES_LEFT: dict[FileStatus | None, str] = {FileStatus.EDITED: "cyan", FileStatus.ORPHAN: "yellow"}
"""Styles of files that are left as they are, by how they stand."""
_ALWAYS_LISTED = {Reason.MERGE, Reason.MOVE, Reason.UNDO} | ORPHANS
_ORPHANS = "  of an orphan: `urdfsync resolve FILE --keep` makes it yours, --take deletes it"
_CHANGES = 12
"""So many lines about changes of a model are shown at most, without --verbose."""


def action_word(action: Action) -> tuple[str, str]:
    """Return what happens to a file in a word, and its style."""
    if action.is_waiting:
        return "waiting", "yellow"
    left = _STYLES_LEFT.get(action.status, "dim")
    return action.reason, _STYLES.get(action.kind, left)


def headline(result: Result, words: str, *, is_fine: bool) -> StyledLine:
    """Return the first line about a robot, with a mark where it can be shown: `✓ arm: in step`."""
    is_wrong = result.failed or result.checked is Checked.WRONG
    mark = ("✗ ", "bold red") if is_wrong else ("✓ ", "green") if is_fine else ("! ", "yellow")
    marks = [mark] if has_marks(sys.stderr if result.failed else sys.stdout) else []
    return line(*marks, (result.robot, "bold"), (f": {words}", ""))


def action_line(result: Result, action: Action, why: str = "") -> StyledLine:
    """Return a line for what happens to a file."""
    return file_line(result.shown(action.path), *action_word(action), why)


def file_line(path: str, word: str, style: str, why: str = "") -> StyledLine:
    """Return a line for one file: `  update     modelica/Arm/Arm.mo  why`."""
    return line((f"  {word:<9}  ", style), (path, ""), (f"  {why}" if why else "", "dim"))


def change_line(text: str) -> StyledLine:
    """Return a line about a change, with its element in bold: `  link fore: inertial / mass 1 → 1.2 kg (+20 %)`."""
    element, colon, what = text.partition(": ")
    styles = {"added": "green", "removed": "red", "renamed": "cyan", "rounding": "dim", "not modelled": "dim"}
    style = next((styles[word] for word in styles if what.startswith(word)), "")
    return line((f"  {element}{colon}", "bold" if colon else ""), (what, style))


def show_result(console: Console, result: Result, *, named: Container[str] = ()) -> None:
    """Show what was done with one robot; `named` files are listed."""
    if console.is_document:
        from urdfsync.output.build_section import build_section  # 2 of 220 ms of a build

        console.add(result, build_section)
    show_lines(console, result, build_lines(result, console, named), result.diagnostics)


def show_lines(
    console: Console, result: Result, lines: Iterable[StyledLine], diagnostics: Sequence[Diagnostic]
) -> None:
    """Show findings and lines about one robot to people; with --quiet, only what they have to look after."""
    if console.is_document:
        return
    show_findings(console, result, diagnostics)
    console.stop_progress()
    if not console.quiet or result.conflicts or result.is_broken:
        console.print(lines, error=result.failed)


def build_lines(result: Result, console: Console, named: Container[str] = ()) -> Iterator[StyledLine]:
    """Yield what was done with one robot, without its findings."""
    yield headline(result, result.summary, is_fine=not (result.conflicts or result.is_broken))
    if not console.quiet:
        yield from result_lines(result, verbose=console.verbose, named=named)
    if result.conflicts:
        yield from conflict_lines(result, console)


def result_lines(result: Result, *, verbose: bool, named: Container[str] = ()) -> Iterator[StyledLine]:
    """Yield what changed, files and the diagram: all but headline and conflicts.

    Without `verbose`, files that are `named` by their keys are among those that are listed.
    """
    if result.effective_changes:
        changed = change_lines(result.effective_changes, None if verbose else _CHANGES, everything=verbose)
        yield from first_lines(list(map(change_line, changed)), _CHANGES, "line", verbose=verbose)
    actions: Sequence[Action] = result.actions.decided
    if not verbose:
        actions = [
            action
            for action in actions
            if (action.reason in _ALWAYS_LISTED and not action.is_waiting)
            or (action.path in named and not action.is_conflict)  # conflicts have lines of their own
        ]
    for action in sorted(actions, key=lambda action: action.path.rpartition("/")):
        yield action_line(result, action, reason(action, result.effective_changes, brief=True))
    if any(action.reason is Reason.ORPHAN for action in actions):
        yield line((_ORPHANS, "dim"))
    if result.drawing:
        yield line((f"  diagram: {shown(result.drawing)}", ""))
