"""Where the versions of a file in conflict differ, one below the other."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from itertools import repeat, zip_longest
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from urdfsync.engine.conflicts import Conflict
from urdfsync.merge import ChangedLines, Merge, find_changes, split_lines
from urdfsync.output.console import StyledLine, has_marks, line, visible

if TYPE_CHECKING:
    from rich.console import Console

CONTEXT = 2
"""So many unchanged lines are shown around changed ones."""
LINES = 16
"""So many lines of a conflict are shown without --verbose."""
_ROWS = 3
"""A changed line may take so many rows of a terminal, others one; of a longer one, its change is shown."""
_NARROW = 20
"""Columns that a line gets on the narrowest terminal."""
_PIPE = 240
"""Characters of one line in a file or pipe."""
_LEAD = 12
"""Characters before the change of a line that is too long."""
_COLOURS = {"base": "red", "mine": "cyan", "generated": "green", "both": "magenta", "": "dim"}

Texts: TypeAlias = Mapping[str, Sequence[str]]
"""Lines of `base`, `mine` and `generated`."""


class Line(NamedTuple):
    """One line, with the version that has it: `base`, `mine`, `generated`, `both` of these, or empty for all."""

    version: str
    number: int
    """In that version, from 1; 0 for none."""
    text: str
    same: int = 0
    """So many characters at its beginning are those of the lines in its place in other versions."""


class Hunk(NamedTuple):
    """A run of lines with changes in it."""

    lines: list[Line]
    clash: bool
    """The sides contradict each other."""


def find_hunks(base: str | None, mine: str, generated: str, merge: Merge | None) -> list[Hunk]:
    """Where base, mine and generated differ; without a base, where the other two do."""
    versions = {"base": mine if base is None else base, "mine": mine, "generated": generated}
    texts = {name: split_lines(one.replace("\r\n", "\n")) for name, one in versions.items()}
    clashes = [conflict.base for conflict in merge.conflicts] if merge else []
    groups: list[tuple[bool, list[ChangedLines]]] = []
    for change in find_changes(**texts):
        clash = any(_touches(change.base, one) for one in clashes)
        if not groups or groups[-1][0] != clash or change.base.start - groups[-1][1][-1].base.stop > 2 * CONTEXT:
            groups.append((clash, []))
        groups[-1][1].append(change)
    hunks: list[Hunk] = []
    end, same = 0, texts["mine"]
    starts = [*(changes[0].mine.start for _, changes in groups[1:]), len(same)]
    for (clash, changes), following in zip(groups, starts, strict=False):
        lines: list[Line] = []  # those of the changes, those between them, and some around them
        end = max(end, changes[0].mine.start - CONTEXT)
        for change in changes:
            lines += (Line("", index + 1, same[index]) for index in range(end, change.mine.start))
            lines += _changed_lines(texts, change, base is not None)
            end = change.mine.stop
        behind = range(end, min(end + CONTEXT, following))
        lines += (Line("", index + 1, same[index]) for index in behind)
        end = behind.stop
        hunks.append(Hunk(lines, clash))
    return hunks


def _touches(change: range, clash: range) -> bool:
    """Return whether lines, by indices, are part of a contradiction, by numbers; an empty range is a place."""
    start, stop = clash.start - 1, clash.stop - 1
    is_inside = start < change.stop and change.start < stop
    return is_inside or (not (change and clash) and start <= change.stop and change.start <= stop)


def _changed_lines(texts: Texts, change: ChangedLines, has_base: bool) -> Iterator[Line]:
    """Yield the lines of base that are gone, and those of each side that changed something."""
    places = {"base": change.base, "mine": change.mine, "generated": change.generated, "both": change.mine}
    parts = {name: texts[name][places[name].start : places[name].stop] for name in texts}
    names = [name for name in ("mine", "generated") if not has_base or parts[name] != parts["base"]]
    if len(names) == 2 and parts["mine"] == parts["generated"]:
        names, parts["both"] = ["both"], parts["mine"]
    names = ["base", *names] if has_base else names
    in_place = zip_longest(*(parts[name] for name in names), fillvalue="")
    shared = [len(os.path.commonprefix(lines)) for lines in in_place]  # noqa: RUF071 - of texts
    for name in names:
        numbers = range(places[name].start + 1, places[name].stop + 1)
        yield from map(Line, repeat(name), numbers, parts[name], shared)
        if has_base and not parts[name] and name != "base":
            yield Line(name, 0, "(removed)\n")


# --- lines for people ---------------------------------------------------------------------------------------------


def difference_lines(conflict: Conflict, console: Console, verbose: bool) -> tuple[list[StyledLine], int]:
    """The versions of a file where they differ, and the number of lines that were left out for want of room.

    Contradictions come first. Of those that have names, nothing else is shown unless `verbose`.
    """
    hunks = find_hunks(conflict.base, conflict.mine, conflict.generated, conflict.merge)
    if not verbose and conflict.merge and any(one.what for one in conflict.merge.conflicts):
        hunks = [hunk for hunk in hunks if hunk.clash]
    digits = len(str(max((line.number for hunk in hunks for line in hunk.lines), default=1)))
    lines: list[StyledLine] = []
    for hunk in sorted(hunks, key=lambda hunk: not hunk.clash):
        lines.append(_title(hunk, conflict, console))
        lines += (row for line in hunk.lines for row in _rows(line, console, digits))
    most = len(lines) if verbose else LINES
    return lines[:most], len(lines[most:])


def _title(hunk: Hunk, conflict: Conflict, console: Console) -> StyledLine:
    numbers = [line.number for line in hunk.lines if line.number and line.version in ("", "mine", "both")]
    first, last = min(numbers, default=0), max(numbers, default=0)
    where = f"lines {first} to {last}" if last > first else f"line {first}" if first else "empty"
    sides = {line.version for line in hunk.lines} - {"", "base"}
    what = {"mine": "your edit", "generated": "generated text changed"}.get(
        "".join(sides), "your edit, and generated text changed"
    )
    if hunk.clash or conflict.base is None:
        what = "the sides contradict each other" if hunk.clash else "different"
    rule = "──" if has_marks(console.file) else "--"
    return line((f"    {rule} {where}: ", "dim"), (what, "bold red" if hunk.clash else ""))


def _rows(one: Line, console: Console, digits: int) -> Iterator[StyledLine]:
    """Yield a line in rows of the terminal; a longer one is cut around its change."""
    gutter = f"    {one.version:<9}  {one.number or '':>{digits}}  "
    room = max(_NARROW, console.width - len(gutter)) if console.is_terminal else _PIPE
    most = room * _ROWS if one.version and console.is_terminal else room
    end = "" if one.text.endswith("\n") else "  (no newline at end of file)"
    same, words = len(_shown(one.text[: one.same])), _shown(one.text.removesuffix("\n")) + end
    if len(words) > most:
        start = max(0, min(same - _LEAD, len(words) - most + 1))
        words = f"{'…' if start else ''}{words[start:]}"
        words = words if len(words) <= most else f"{words[: most - 1]}…"
    for begin in range(0, max(len(words), 1), room):
        yield line((f"{gutter}{words[begin : begin + room]}".rstrip(), _COLOURS[one.version]))
        gutter = " " * len(gutter)


def _shown(words: str) -> str:
    return visible(words.replace("\t", "    "))
