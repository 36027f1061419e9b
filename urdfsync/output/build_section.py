"""The result of a build as a section."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass
from urdfsync.engine.actions import CONFLICTS, Kind, Reason
from urdfsync.engine.result import Checked, DisputedFile, Result
from urdfsync.files import shown
from urdfsync.output.conflicts import settle_hint
from urdfsync.output.outline import outline
from urdfsync.output.phrases import change_counts, generator_change, reason
from urdfsync.output.sections import Mark, Section, Table
from urdfsync.spelling import same_count

_BUILD = "run `urdfsync build`, and commit what it writes"
_SETTLE = "run `urdfsync build` for both sides, and settle the conflicts with `urdfsync resolve`"
_FIT = "correct the files that do not fit"
_SILENT = {Reason.UNCHANGED, Reason.KEEP, Reason.FORGET} | CONFLICTS
"""Reasons of actions that no table has; conflicts are findings."""


def build_section(result: Result) -> Section:
    """Return what was done with one robot, or would be."""
    changes = result.effective_changes
    points, tables = change_parts(changes)
    return Section(
        result.robot,
        result.summary,
        mark_of(result),
        points,
        (*tables, file_table(result)),
        (*result.diagnostics, *_conflicts(result)),
        None if result.failed else out_of_step(result),
    )


def mark_of(result: Result) -> Mark:
    """Return the verdict on a package as a sign."""
    if result.failed or result.is_broken or result.checked is Checked.WRONG:
        return Mark.WRONG
    return Mark.FINE if result.in_step else Mark.OPEN


def out_of_step(result: Result) -> Diagnostic | None:
    """Return the finding that a package is out of step, at its first file; None if it is in step."""
    if result.in_step:
        return None
    hint = _SETTLE if result.conflicts else _BUILD if not result.are_files_in_step else _FIT
    message = f"the package {result.package} is out of step: {result.summary}"
    return Diagnostic(Severity.WARNING, "out-of-step", message, shown(result.folder / "package.mo"), hint=hint)


def _conflicts(result: Result) -> Iterable[Diagnostic]:
    """Yield each file that conflicts as a finding."""
    for target in result.conflicts:
        message = f"{reason(target.action, result.changes, brief=True)}: {target.relation}"
        place, hint = (target.shown, _edited_line(target)), settle_hint([target])
        yield Diagnostic(Severity.ERROR, "conflict", message, *place, hint=hint)


def _edited_line(target: DisputedFile) -> int:
    """Return the first line that the user edited; 0 if that is not known."""
    if target.texts is None or target.texts.base is None:
        return 0
    base, mine = target.texts.base.splitlines(), target.texts.mine.splitlines()
    return min(same_count(base, mine) + 1, len(mine))


def change_parts(changes: Changes | None) -> tuple[list[str], list[Table]]:
    """Return changes of a model: those of its structure as lines, all others as a table."""
    if changes is None:
        return [], []
    structure = tuple(each for each in changes.changes if each.change_class is ChangeClass.STRUCTURAL)
    others = tuple(each for each in changes.changes if each.change_class is not ChangeClass.STRUCTURAL)
    points = [generator_change(changes)] if changes.generator else []
    points += [change_counts(changes)] if len(changes.changes) > 1 else []
    points += [f"{title}: {row}" for title, rows in outline(Changes(structure)) for row in rows]
    rows = [(title, *row) for title, rows in outline(Changes(others)) for row in rows]
    return points, [Table("Changes", ("Element", "Property", "Change", "By"), rows)]


def file_table(result: Result) -> Table:
    """Return what happens to the files of a package, without those that stay."""
    actions = [action for action in result.actions if action.reason not in _SILENT]
    actions.sort(key=lambda action: (action.kind is Kind.LEAVE, action.path.rpartition("/")))
    words = ["waiting" if action.is_waiting else action.reason for action in actions]
    reasons = [reason(action, result.effective_changes, brief=True) for action in actions]
    paths = [result.shown(action.path) for action in actions]
    return Table("Files", ("File", "", "Why"), list(zip(paths, words, reasons, strict=True)))
