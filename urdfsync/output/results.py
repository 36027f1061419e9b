"""The result of a build as lines: a headline, what changed in the model, files, and conflicts."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from urdfsync.config import shown
from urdfsync.engine.actions import Action, Kind
from urdfsync.outcome import Checked, Result
from urdfsync.output.console import Console, StyledLine, headline, is_terminal, line, more, rich_console
from urdfsync.output.json_values import result_values
from urdfsync.output.phrases import change_lines, counted, reason, summary

_STYLES = {
    Kind.CREATE: "green",
    Kind.RESTORE: "green",
    Kind.ADOPT: "green",
    Kind.UPDATE: "green",
    Kind.MERGE: "green",
    Kind.MOVE: "green",
    Kind.LEAVE: "magenta",
    Kind.INCLUDED: "cyan",
    Kind.DELETE: "magenta",
    Kind.KEEP: "cyan",
    Kind.ORPHAN: "yellow",
    Kind.NEEDED: "yellow",
    Kind.CONFLICT: "bold red",
    Kind.UNOWNED: "bold red",
}
_ALWAYS_LISTED = (Kind.ORPHAN, Kind.NEEDED)
_ORPHANS = "  `urdfsync resolve FILE --keep` makes it yours, --take deletes it"
_WIDEST_NAME = 40
"""Longer names push their reason to the right."""
_CHANGES = 12
"""So many changes of a model are shown at most, without --verbose."""


class FileLine(NamedTuple):
    """What to say of one file: a word and its style, and why; the path is that of the manifest."""

    path: str
    word: str
    style: str
    reason: str


def file_lines(files: Iterable[FileLine], root: Path, *, by_folder: bool) -> Iterator[StyledLine]:
    """A line for each file, those of a folder in succession: with its path, or `by_folder` below the folder's."""
    files = sorted(files, key=lambda file: file.path.rpartition("/"))
    width = min(_WIDEST_NAME, max((len(file.path.rpartition("/")[2]) for file in files), default=0))
    folder = None
    for file in files:
        place = Path(shown(Path(os.path.normpath(root / file.path))))
        if by_folder and place.parent != folder:
            folder = place.parent
            yield line((f"  {folder}/", "bold blue"))
        name = f"{place.name:<{width}}" if by_folder else str(place)
        indent = "    " if by_folder else "  "
        why = [(f"  {file.reason}", "dim")] if file.reason else []
        yield line((f"{indent}{file.word}  ", file.style), (name if why else name.rstrip(), ""), *why)


def show_results(console: Console, results: Iterator[Result], *, explain: bool = False) -> list[Result]:
    """Show what was done with each robot as soon as it is done, and return it all."""
    shown_results: list[Result] = []
    for result in results:
        conflicts = sum(len(other.conflicts) for other in shown_results)
        show_result(console, result, explain=explain, conflicts_shown=conflicts)
        shown_results.append(result)
    return shown_results


def show_result(console: Console, result: Result, *, explain: bool = False, conflicts_shown: int = 0) -> None:
    """Show what was done with one robot; `conflicts_shown` are those of other robots before it."""
    if console.json:
        console.add_robot(result_values(result))
        return
    console.findings(result.diagnostics)
    if console.quiet and not result.conflicts:
        console.stop_progress()
        return
    verbose = console.verbose
    lines = result_lines(result, error=result.failed, quiet=console.quiet, verbose=verbose, explain=explain)
    console.print(lines, error=result.failed)
    if result.conflicts:
        from urdfsync.output.conflicts import Extent, conflict_lines

        stream = sys.stderr if result.failed else sys.stdout
        extent = Extent(console.verbose, console.quiet, conflicts_shown, console.config)
        console.print(conflict_lines(result, rich_console(stream), extent), error=result.failed)


def result_lines(
    result: Result, *, error: bool = False, quiet: bool = False, verbose: bool = False, explain: bool = False
) -> Iterator[StyledLine]:
    """Everything but conflicts, for the output stream or the error stream; `explain` names every file."""
    stream = sys.stderr if error else sys.stdout
    is_wrong = result.failed or result.checked is Checked.WRONG
    mark, style = ("✗", "bold red") if is_wrong else ("!", "yellow") if result.conflicts else ("✓", "green")
    yield headline(stream, result.robot, summary(result), mark, style)
    if not quiet:
        changed = change_lines(result.changes) if result.changes else []
        few = len(changed) if verbose or len(changed) <= _CHANGES else _CHANGES - 1
        yield from (line((f"  {words}", "")) for words in changed[:few])
        if few < len(changed):
            yield more(len(changed) - few, "change")
        actions: Sequence[Action] = result.actions if verbose and explain else result.actions.decided
        if not (verbose or explain):
            actions = [action for action in actions if action.kind in _ALWAYS_LISTED]
        files = []
        for action in actions:
            word = "waiting" if action.held else action.kind.value.removeprefix("unowned-")
            style = "yellow" if action.held else _STYLES.get(action.kind, "dim")
            files.append(FileLine(action.path, f"{word:<9}", style, reason(action, result.changes)))
        yield from file_lines(files, result.root, by_folder=is_terminal(stream) and (verbose or explain))
        if explain and (rest := len(result.actions) - len(actions)):
            yield line((f"  {counted(rest, 'unchanged file')}; --verbose names each", "dim"))
        if any(action.kind is Kind.ORPHAN for action in actions):
            yield line((_ORPHANS, "dim"))
    if result.drawing:
        yield line((f"  diagram: {shown(result.drawing)}", ""))
