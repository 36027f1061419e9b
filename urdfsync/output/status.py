"""How the files of a package stand: lines for people."""

from __future__ import annotations

from collections.abc import Iterator

from urdfsync.engine.actions import Action, FileStatus, Reason
from urdfsync.engine.result import Result
from urdfsync.output.conflicts import settle_hint
from urdfsync.output.console import StyledLine, first_lines, line
from urdfsync.output.phrases import change_counts, generator_change, reason
from urdfsync.output.results import action_word, file_line, headline

_INPUTS = 5
"""So many inputs that changed are named at most, without --verbose."""
_STALE = 20
"""So many stale files of a robot are listed at most, without --verbose."""


def lines(result: Result, *, verbose: bool = False) -> Iterator[StyledLine]:
    """Yield all that there is to say about one robot: with `verbose` all files, else those that are not in step.

    Stale files come last. New files of a robot that was never built are not named.
    """
    yield headline(result, summary(result), is_fine=result.in_step)
    if result.stale:
        yield from first_lines([line((f"  {name}", "")) for name in result.stale], _INPUTS, "input", verbose=verbose)
    changes = result.effective_changes
    if changes and changes.generator:
        yield line((f"  {generator_change(changes)}", ""))
    elif changes:
        yield line((f"  {change_counts(changes)} in the source", ""))
    silent = set() if verbose else {FileStatus.IN_STEP} | (set() if result.is_built else {FileStatus.STALE})
    listed = [action for action in result.actions if action.status and action.status not in silent]
    conflicts = {file.action.path: file.relation for file in result.conflicts}
    stale, others = list[StyledLine](), list[StyledLine]()
    for action in sorted(listed, key=lambda action: _path(action).rpartition("/")):
        group = stale if action.status is FileStatus.STALE else others
        group.append(_file_line(result, action, conflicts.get(action.path)))
    yield from (*others, *first_lines(stale, _STALE, "stale file", verbose=verbose))
    if conflicts:
        adopts = f"`urdfsync adopt {result.robot}` takes these files for your edits"
        yield line((f"  {settle_hint(result.conflicts) if result.is_built else adopts}", "dim"))


def _path(action: Action) -> str:
    """Return where the user's file is: that of a conflict may wait for its new name."""
    if action.reason is Reason.KEEP and not action.is_on_disk:  # he made a folder of the class
        return f"{action.path.removesuffix('.mo')}/package.mo"
    return action.origin or action.path if action.is_conflict else action.path


def _file_line(result: Result, action: Action, conflict: str | None) -> StyledLine:
    status = action.status or FileStatus.IN_STEP
    says_all = action.reason in (Reason.UNCHANGED, Reason.KEEP) and not action.is_waiting
    why = "" if says_all else conflict or reason(action, result.effective_changes)
    return file_line(result.shown(_path(action)), status, action_word(action)[1], why)


def summary(result: Result) -> str:
    """Return what a build would do, as the rest of a line that names the robot."""
    if result.stale and not result.actions:
        return "not expanded, so its files were not compared"
    words = result.summary
    if result.failed or result.in_step or result.is_broken or result.stale:
        return words
    return f"{'out of step' if result.is_built else 'not built yet'}: {words}"
