"""Turns the plan of a build into a section about the files of a package."""

from __future__ import annotations

from urdfsync.engine.actions import FileStatus, Reason
from urdfsync.engine.result import Result
from urdfsync.output.build_section import change_parts, mark_of
from urdfsync.output.conflicts import settle_hint
from urdfsync.output.console import line
from urdfsync.output.phrases import reason
from urdfsync.output.sections import Section, TextTable
from urdfsync.output.terminal import file_line

_COLUMNS = ("File", "", "Why")


def status_section(result: Result, *, verbose: bool | None = False) -> Section:
    """Return the files of one robot that are not in step; if `verbose`, all files.

    Stale files come last. New files of a robot that was never built are only counted.
    """
    changes = result.effective_changes
    points, changed = change_parts(changes)
    silent = set() if verbose else {FileStatus.IN_STEP} | (set() if result.is_built else {FileStatus.STALE})
    listed = [action for action in result.actions if action.status and action.status not in silent]
    conflicts = {file.action.path: file.relation for file in result.conflicts}
    stale, others = list[tuple[str, str, str]](), list[tuple[str, str, str]]()
    for action in sorted(listed, key=lambda action: action.present.rpartition("/")):
        says_all = action.reason in (Reason.UNCHANGED, Reason.KEEP) and not (action.is_waiting or action.lacks_stamp)
        why = "" if says_all else conflicts.get(action.path) or reason(action, changes)
        group = stale if action.status is FileStatus.STALE else others
        group.append((result.shown(action.present), str(action.status), why))
    inputs = [(name,) for name in result.stale]
    tables = (
        *changed,
        TextTable("Inputs", ("Input",), inputs, lambda name: line((f"  {name}", "")), 5, "input"),
        TextTable("Files", _COLUMNS, others, file_line, len(others)),
        TextTable("Stale files", _COLUMNS, stale, file_line, 20, "stale file"),
    )
    adopts = f"`urdfsync adopt {result.robot}` takes these files for your edits"
    hints = [settle_hint(result.conflicts) if result.is_built else adopts] if conflicts else []
    about = result.robot, summary(result), mark_of(result)
    return Section(*about, points, tables, result.diagnostics, hints=hints)


def summary(result: Result) -> str:
    """Return what a build would do, as the end of a line that names the robot."""
    if result.stale and not result.actions:
        return "not expanded, so its files were not compared"
    words = result.summary
    if result.failed or result.in_step or result.is_broken or result.stale:
        return words
    return f"{'out of step' if result.is_built else 'not built yet'}: {words}"
