"""How the result of a build looks, line by line."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from urdfsync import wording
from urdfsync.config import shown
from urdfsync.engine.actions import Action, Kind
from urdfsync.outcome import Checked, Result
from urdfsync.views.terminal import Words, has_marks, is_styled, is_terminal, words

_KINDS = {
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
_LISTED = (Kind.ORPHAN, Kind.NEEDED)
"""What is named file by file even if nobody asks."""
_ORPHANS = "  `urdfsync resolve FILE --keep` makes it yours, --take deletes it"
_CHANGES = 12
"""So many changes of a model are shown at most, unless somebody asks."""


def lines(
    result: Result, stream: IO[str], *, quiet: bool = False, verbose: bool = False, explain: bool = False
) -> Iterator[Words]:
    """Everything that there is to say about one robot but its conflicts; `explain` names every file."""
    yield _headline(result, stream)
    if not quiet:
        yield from _details(result, stream, verbose, explain)
    if result.drawing:
        yield words((f"  diagram: {shown(result.drawing)}", ""))


def _details(result: Result, stream: IO[str], verbose: bool, explain: bool) -> Iterator[Words]:
    """What changed in the model, and the files that deserve attention."""
    if result.changes:
        lines = wording.changes(result.changes)
        few = len(lines) if verbose or len(lines) <= _CHANGES else _CHANGES - 1
        yield from (words((f"  {line}", "")) for line in lines[:few])
        if few < len(lines):
            yield words((f"  … and {len(lines) - few} more changes; --verbose shows them", "dim"))
    if explain or verbose:
        yield from _explanation(result, stream, everything=explain)
    else:
        for action in result.actions.decided:
            if action.kind in _LISTED:
                yield words(("  ", ""), *_verdict(action, _place(result, action)))
    if any(action.kind is Kind.ORPHAN for action in result.actions.decided):
        yield words((_ORPHANS, "dim"))


def has_more(result: Result) -> bool:
    """Whether there is more to say about a robot than its headline, or the headline is no good news."""
    wrong = result.failed or result.conflicts or result.checked is Checked.WRONG
    listed = any(action.kind in _LISTED for action in result.actions.decided)
    return bool(wrong or result.drawing or result.changes or listed)


def plain(name: str, summary: str) -> None:
    """A headline without rich; it looks as `headline` does."""
    styled = is_styled(sys.stdout) and sys.platform != "win32"
    green, bold, off = ("\x1b[32m", "\x1b[1m", "\x1b[0m") if styled else ("", "", "")
    mark = f"{green}✓ {off}" if has_marks(sys.stdout) else ""
    sys.stdout.write(f"{mark}{bold}{name}{off}: {summary}\n")


def _headline(result: Result, stream: IO[str]) -> Words:
    wrong = result.failed or result.checked is Checked.WRONG
    mark, style = ("✗", "bold red") if wrong else ("!", "yellow") if result.conflicts else ("✓", "green")
    marks = [(f"{mark} ", style)] if has_marks(stream) else []
    return words(*marks, (result.robot, "bold"), (f": {wording.summary(result)}", ""))


def _explanation(result: Result, stream: IO[str], everything: bool) -> Iterator[Words]:
    """Each file, what happens to it and why: below its folder on a terminal, else one path per line."""
    actions = [action for action in result.actions if everything or action.kind is not Kind.UNCHANGED]
    actions.sort(key=lambda action: action.path.rpartition("/"))
    folder = None
    width = max((len(Path(action.path).name) for action in actions), default=0)
    for action in actions:
        place = _place(result, action)
        if not is_terminal(stream):
            yield words(("  ", ""), *_verdict(action, place))
            continue
        if place.parent != folder:
            folder = place.parent
            yield words((f"  {folder}/", "bold blue"))
        yield words(("    ", ""), *_verdict(action, Path(place.name), width))


def _place(result: Result, action: Action) -> Path:
    from urdfsync.views import conflicts

    return Path(conflicts.place(result, action.path))


def _verdict(action: Action, path: Path, width: int = 0) -> tuple[tuple[str, str], ...]:
    word = "waiting" if action.held else action.kind.value.removeprefix("unowned-")
    style = "yellow" if action.held else _KINDS.get(action.kind, "dim")
    return (f"{word:<9}  ", style), (f"{path!s:<{width}}", ""), (f"  {action.reason}", "dim")
