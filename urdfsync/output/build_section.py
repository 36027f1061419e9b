"""Turns the result of a build into a section, and shows it."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from functools import partial
from typing import Any

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import same_count
from urdfsync.domain import ChangeClass
from urdfsync.domain.comparison import Changes
from urdfsync.engine.actions import CONFLICTS, ORPHANS, USERS, Action, Reason
from urdfsync.engine.result import Checked, DisputedFile, Result
from urdfsync.output.conflicts import conflict_lines, settle_hint
from urdfsync.output.console import Console, StyledLine
from urdfsync.output.outline import OutlineRow, outline
from urdfsync.output.phrases import change_counts, generator_change, reason
from urdfsync.output.repeated import show_findings
from urdfsync.output.sections import Mark, Section, TextTable
from urdfsync.output.terminal import change_line, file_line, text

_BUILD = "run `urdfsync build`, and commit what it writes"
_SETTLE = "run `urdfsync build` for both sides, and settle the conflicts with `urdfsync resolve`"
_ADD = "`git add` the files that git has not merged, once their text is right"
_FIT = "correct the files that do not fit"
_SILENT = {Reason.FORGET} | CONFLICTS
"""Reasons of actions that tables leave out; conflicts are findings."""
_ALWAYS_LISTED = {Reason.MERGE, Reason.MOVE, Reason.UNDO} | ORPHANS
_ORPHANS = "for an orphan: `urdfsync resolve FILE --keep` makes it yours, --take deletes it"


def build_section(result: Result, *, verbose: bool | None = None, named: Container[str] = ()) -> Section:
    """Return what a build did, or would do, with the files that change.

    If `verbose`, the section also lists edited files that stay, and numbers have all digits. Otherwise it lists only
    files with a text of the user's, and the `named` files.
    """
    points, tables = change_parts(result.effective_changes, verbose=bool(verbose))
    silent = _SILENT if verbose or named else _SILENT | {Reason.KEEP}
    listed = [action for action in result.actions.decided if action.reason not in silent]
    if verbose is False:
        important = {one.path for one in listed if _is_important(one)}
        listed = [action for action in listed if action.path in important or action.path in named]
    orphans = (result.root / action.path for action in listed if action.reason is Reason.ORPHAN)
    # what stays in a package's former folder is the user's own afterwards
    hints = [_ORPHANS] if any(path.is_relative_to(result.folder) for path in orphans) else []
    hints += [f"diagram: {shown(result.drawing)}"] if result.drawing else []
    return Section(
        result.robot,
        result.summary,
        mark_of(result),
        points,
        (*tables, file_table(result, listed)),
        (*result.diagnostics, *_conflicts(result)),
        None if result.failed else out_of_step(result),
        hints,
    )


def show_result(console: Console, result: Result, *, named: Container[str] = ()) -> None:
    """Show what a build did with one robot; `named` files are always listed."""
    show(console, result, partial(build_section, named=named), result, quiet=console.quiet)
    if not console.is_document and result.conflicts:
        console.print(conflict_lines(result, console))


def show(
    console: Console,
    told: Any,
    to_section: Callable[..., Section],
    result: Result | None = None,
    *,
    quiet: bool = False,
) -> None:
    """Show `told`, a result about one robot, as a section; with --quiet, show it only if the user has to act."""
    if console.is_document:
        console.add(told, to_section)
        return
    if not console.quiet or (result and (result.conflicts or result.is_broken)):
        section = to_section(told, verbose=console.verbose)
        lines = list(text(section, verbose=console.verbose, quiet=quiet))
        is_event = result is not None and (result.writes or result.renews or result.settled)
        if console.counts_robots and len(lines) == 1 and section.mark in (Mark.FINE, Mark.NONE) and not is_event:
            console.uneventful[section.summary.partition(",")[0]] += 1
        else:
            console.print(lines, error=bool(result and result.failed))
    if result:
        show_findings(console, result, told.diagnostics)
    else:
        console.findings(told.diagnostics)


def build_lines(result: Result) -> Iterator[StyledLine]:
    """Yield lines about what a build did with one robot, without findings."""
    yield from text(build_section(result, verbose=False))
    yield from conflict_lines(result, Console()) if result.conflicts else ()


def _is_important(action: Action) -> bool:
    is_known = action.base is not None  # `adopt` stamps many files
    return (action.reason in _ALWAYS_LISTED or (action.restores_stamp and is_known)) and not action.is_waiting


def mark_of(result: Result) -> Mark:
    """Return the mark of a package."""
    if result.failed or result.is_broken or result.checked is Checked.WRONG:
        return Mark.WRONG
    return Mark.FINE if result.in_step else Mark.OPEN


def out_of_step(result: Result) -> Diagnostic | None:
    """Return the finding that a package is out of step, at its `package.mo`; None for a package in step."""
    if result.in_step:
        return None
    hint = _SETTLE if result.conflicts else _BUILD if not result.are_files_in_step else _FIT
    hint = hint if result.is_broken or not result.are_files_in_step else _ADD
    message = f"the package {result.package} is out of step: {result.summary}"
    return Diagnostic(Severity.WARNING, "out-of-step", message, shown(result.folder / "package.mo"), hint=hint)


def _conflicts(result: Result) -> Iterable[Diagnostic]:
    """Yield a finding for each file in conflict."""
    for target in result.conflicts:
        message = f"{reason(target.action, result.changes)}: {target.relation}"
        place, hint = (target.shown, _edited_line(target)), settle_hint([target])
        yield Diagnostic(Severity.ERROR, "conflict", message, *place, hint=hint)


def _edited_line(target: DisputedFile) -> int:
    """Return the first line that the user edited; 0 if unknown."""
    if target.texts is None or target.texts.base is None:
        return 0
    base, mine = target.texts.base.splitlines(), target.texts.mine.splitlines()
    return min(same_count(base, mine) + 1, len(mine))


def change_parts(
    changes: Changes | None, most: int = 12, *, verbose: bool = False
) -> tuple[list[StyledLine], list[TextTable]]:
    """Return changes of a model: structural changes as lines, other changes as a table that shows `most` rows."""
    if changes is None:
        return [], []
    structure = tuple(each for each in changes.changes if each.change_class is ChangeClass.STRUCTURAL)
    others = tuple(each for each in changes.changes if each.change_class is not ChangeClass.STRUCTURAL)
    points = [generator_change(changes)] if changes.generator else []
    points += [change_counts(changes)] if len(changes.changes) > 1 else []
    points += [f"{title}: {row}" for title, rows in outline(Changes(structure), everything=verbose) for row in rows]
    rows = [(title, *row) for title, rows in outline(Changes(others), everything=verbose) for row in rows]

    def line(element: str, *row: str) -> StyledLine:
        return change_line(f"{element}: {OutlineRow(*row)}")

    return [*map(change_line, points)], [
        TextTable("Changes", ("Element", "Property", "Change", "By"), rows, line, most)
    ]


def file_table(result: Result, actions: Sequence[Action], **options: Any) -> TextTable:
    """Return a table of the actions, edited files first; `options` are those of `TextTable`."""
    actions = sorted(actions, key=lambda action: (action.reason not in USERS, action.present.rpartition("/")))
    words = [action.word for action in actions]
    reasons = [reason(action, result.effective_changes) for action in actions]
    rows = list(zip([result.shown(action.present) for action in actions], words, reasons, strict=True))
    options = {"line": file_line, "most": len(rows), **options}
    return TextTable("Files", ("File", "", "Why"), rows, **options)
