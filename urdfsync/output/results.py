"""The result of a build: as lines for people, and as plain data for JSON documents (docs/json.md)."""

from __future__ import annotations

import sys
from collections.abc import Container, Iterable, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.changes import Change, Changes
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine.actions import Action, FileStatus, Kind, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.files import shown
from urdfsync.output.build_section import build_section
from urdfsync.output.conflicts import DisputedFile, conflict_lines, describe, find_conflicts, saved_texts, shown_path
from urdfsync.output.console import Console, StyledLine, first_lines, has_marks, line
from urdfsync.output.documents import KEYS, fill
from urdfsync.output.phrases import change_lines, counted, reason, summary
from urdfsync.output.repeated import show_findings


class ActionDocument(msgspec.Struct, rename={"kind": "action"}):
    """What happens to a file."""

    path: str
    origin: str | None
    status: FileStatus | None
    kind: Kind
    reason: str
    held: bool
    owner: str
    role: Role
    text: str


class ConflictDocument(msgspec.Struct):
    """A file in conflict."""

    path: str
    origin: str | None
    merges: bool
    reason: str
    base: str | None
    generated: str | None
    merge: str | None


class RobotDocument(msgspec.Struct, rename=KEYS):
    """The result of a build of one robot; paths are relative to the configuration's folder."""

    robot: str
    package: str
    folder: Path
    failed: bool
    locked: bool
    is_built: bool
    in_step: bool
    is_broken: bool
    writes: bool
    summary: str
    drawing: Path | None
    checked: Checked | None
    stale: Sequence[str]
    change_class: ChangeClass
    changes: Sequence[Change]
    actions: Sequence[ActionDocument]
    conflicts: Sequence[ConflictDocument]
    diagnostics: Sequence[Diagnostic]


_STYLES = {Kind.WRITE: "green", Kind.DELETE: "magenta", Kind.CONFLICT: "bold red"}
_STYLES_LEFT: dict[FileStatus | None, str] = {FileStatus.EDITED: "cyan", FileStatus.ORPHAN: "yellow"}
"""Styles of files that are left as they are, by how they stand."""
_ALWAYS_LISTED = (Reason.MERGE, Reason.MOVE, Reason.UNDO, Reason.ORPHAN, Reason.NEEDED)
_ORPHANS = "  of an orphan: `urdfsync resolve FILE --keep` makes it yours, --take deletes it"
_CHANGES = 12
"""So many lines about changes of a model are shown at most, without --verbose."""


def action_word(action: Action) -> tuple[str, str]:
    """Return what happens to a file in a word, and its style."""
    if action.held:
        return "waiting", "yellow"
    left = _STYLES_LEFT.get(action.reason.status, "dim")
    return action.reason.word, _STYLES.get(action.kind, left)


def headline(result: Result, words: str, *, is_fine: bool) -> StyledLine:
    """Return the first line about a robot, with a mark where it can be shown: `✓ arm: in step`."""
    is_wrong = result.failed or result.checked is Checked.WRONG
    mark = ("✗ ", "bold red") if is_wrong else ("✓ ", "green") if is_fine else ("! ", "yellow")
    marks = [mark] if has_marks(sys.stderr if result.failed else sys.stdout) else []
    return line(*marks, (result.robot, "bold"), (f": {words}", ""))


def file_line(path: str, word: str, style: str, why: str = "") -> StyledLine:
    """Return a line for one file: `  update     modelica/Arm/Arm.mo  why`."""
    return line((f"  {word:<9}  ", style), (path, ""), (f"  {why}" if why else "", "dim"))


def change_line(text: str) -> StyledLine:
    """Return a line about a change, with its element in bold: `  link fore: inertial / mass 1 → 1.2 kg (+20 %)`."""
    element, colon, what = text.partition(": ")
    styles = {"added": "green", "removed": "red", "renamed": "cyan", "rounding": "dim", "not modelled": "dim"}
    style = next((styles[word] for word in styles if what.startswith(word)), "")
    return line((f"  {element}{colon}", "bold" if colon else ""), (what, style))


def show_result(console: Console, result: Result, *, explain: bool = False, named: Container[str] = ()) -> None:
    """Show what was done with one robot; `named` files are listed."""
    console.add(result, robot_document, build_section)
    show_lines(console, result, build_lines(result, console, explain=explain, named=named), result.diagnostics)


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


def build_lines(
    result: Result, console: Console, *, explain: bool = False, named: Container[str] = ()
) -> Iterator[StyledLine]:
    """Yield what was done with one robot, without its findings."""
    yield headline(result, summary(result), is_fine=not (result.conflicts or result.is_broken))
    if not console.quiet:
        yield from result_lines(result, verbose=console.verbose, explain=explain, named=named)
    if result.conflicts:
        yield from conflict_lines(result, console)


def result_lines(
    result: Result, *, verbose: bool, explain: bool = False, named: Container[str] = ()
) -> Iterator[StyledLine]:
    """Yield what changed, files and the diagram: all but headline and conflicts; `explain` names every file.

    Without it, files that are `named` by their keys are among those that are listed.
    """
    if result.effective_changes:
        most = None if verbose or explain else _CHANGES
        changed = map(change_line, change_lines(result.effective_changes, most, everything=verbose))
        yield from first_lines(list(changed), _CHANGES, "line", verbose=verbose or explain)
    actions: Sequence[Action] = result.actions if verbose and explain else result.actions.decided
    if not (verbose or explain):
        actions = [
            action
            for action in actions
            if (action.reason in _ALWAYS_LISTED and not action.held)
            or (action.path in named and action.kind is not Kind.CONFLICT)  # conflicts have lines of their own
        ]
    for action in sorted(actions, key=lambda action: action.path.rpartition("/")):
        why = reason(action, result.effective_changes, brief=True)
        yield file_line(shown_path(result, action.path), *action_word(action), why)
    if explain and (rest := len(result.actions) - len(actions)):
        yield line((f"  {counted(rest, 'unchanged file')}; --verbose names each", "dim"))
    if any(action.reason is Reason.ORPHAN for action in actions):
        yield line((_ORPHANS, "dim"))
    if result.drawing:
        yield line((f"  diagram: {shown(result.drawing)}", ""))


def robot_document(result: Result) -> RobotDocument:
    """Return a result as a part of a document."""
    changes = result.changes
    return fill(
        RobotDocument,
        result,
        summary=summary(result),
        change_class=changes.change_class if changes else ChangeClass.NONE,
        changes=changes.changes if changes else (),
        actions=[_action_document(action, changes) for action in result.actions],
        conflicts=list(map(_conflict_document, find_conflicts([result]))),
    )


def _action_document(action: Action, changes: Changes | None) -> ActionDocument:
    """Return what happens to a file; `changes` tell why, if it is because of them."""
    why = {"reason": action.reason.word, "text": reason(action, changes)}
    return fill(ActionDocument, action, status=action.reason.status, **why)


def _conflict_document(target: DisputedFile) -> ConflictDocument:
    texts = dict.fromkeys(("base", "generated", "merge")) | saved_texts(target)
    action = target.action
    return fill(ConflictDocument, target, path=action.path, origin=action.origin, reason=describe(target), **texts)
