"""The result of a build as lines: a headline, what changed in the model, files, and conflicts."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.result import Checked, Result
from urdfsync.files import shown
from urdfsync.output.conflicts import conflict_lines, shown_path
from urdfsync.output.console import Console, StyledLine, first_lines, has_marks, line, rich_console
from urdfsync.output.json_values import result_values
from urdfsync.output.phrases import change_lines, counted, reason, summary

_STYLES = {
    **dict.fromkeys((Kind.CREATE, Kind.RESTORE, Kind.ADOPT, Kind.UPDATE, Kind.MERGE, Kind.MOVE), "green"),
    **dict.fromkeys((Kind.LEAVE, Kind.DELETE), "magenta"),
    **dict.fromkeys((Kind.INCLUDED, Kind.KEEP), "cyan"),
    **dict.fromkeys((Kind.ORPHAN, Kind.NEEDED), "yellow"),
    **dict.fromkeys((Kind.CONFLICT, Kind.UNOWNED), "bold red"),
}
_ALWAYS_LISTED = (Kind.ORPHAN, Kind.NEEDED)
_ORPHANS = "  `urdfsync resolve FILE --keep` makes it yours, --take deletes it"
_CHANGES = 12
"""So many changes of a model are shown at most, without --verbose."""


def action_word(action: Action) -> tuple[str, str]:
    """What happens to a file in a word, and its style."""
    if action.held:
        return "waiting", "yellow"
    return action.kind.value.removeprefix("unowned-"), _STYLES.get(action.kind, "dim")


def headline(result: Result, words: str, *, is_fine: bool) -> StyledLine:
    """The first line about a robot, with a mark where it can be shown: `✓ arm: in step`."""
    is_wrong = result.failed or result.checked is Checked.WRONG
    mark = ("✗ ", "bold red") if is_wrong else ("✓ ", "green") if is_fine else ("! ", "yellow")
    marks = [mark] if has_marks(sys.stderr if result.failed else sys.stdout) else []
    return line(*marks, (result.robot, "bold"), (f": {words}", ""))


def file_line(path: str, word: str, style: str, why: str = "") -> StyledLine:
    """A line for one file: `  update     modelica/Arm/Arm.mo  why`."""
    return line((f"  {word:<9}  ", style), (path, ""), (f"  {why}" if why else "", "dim"))


def show_results(console: Console, results: Iterator[Result], *, explain: bool = False) -> list[Result]:
    """Show what was done with each robot as soon as it is done, and return it all."""
    shown_results = []
    for result in results:
        show_result(console, result, explain=explain)
        shown_results.append(result)
    return shown_results


def show_result(console: Console, result: Result, *, explain: bool = False) -> None:
    """Show what was done with one robot."""
    if console.json:
        console.add_robot(result_values(result))
        return
    console.findings(result.diagnostics)
    if console.quiet and not result.conflicts:
        console.stop_progress()
        return
    lines = [headline(result, summary(result), is_fine=not result.conflicts)]
    if not console.quiet:
        lines += result_lines(result, verbose=console.verbose, explain=explain)
    console.print(lines, error=result.failed)
    if result.conflicts:
        screen = rich_console(sys.stderr if result.failed else sys.stdout)
        console.print(conflict_lines(result, console, screen), error=result.failed)


def result_lines(result: Result, *, verbose: bool, explain: bool = False) -> Iterator[StyledLine]:
    """What changed, files and the diagram: all but headline and conflicts; `explain` names every file."""
    changed = change_lines(result.changes, everything=verbose) if result.changes else []
    yield from first_lines(
        [line((f"  {words}", "")) for words in changed], _CHANGES, "change", verbose=verbose or explain
    )
    actions: Sequence[Action] = result.actions if verbose and explain else result.actions.decided
    if not (verbose or explain):
        actions = [action for action in actions if action.kind in _ALWAYS_LISTED]
    for action in sorted(actions, key=lambda action: action.path.rpartition("/")):
        why = reason(action, result.changes, brief=True)
        yield file_line(shown_path(result, action.path), *action_word(action), why)
    if explain and (rest := len(result.actions) - len(actions)):
        yield line((f"  {counted(rest, 'unchanged file')}; --verbose names each", "dim"))
    if any(action.kind is Kind.ORPHAN for action in actions):
        yield line((_ORPHANS, "dim"))
    if result.drawing:
        yield line((f"  diagram: {shown(result.drawing)}", ""))
