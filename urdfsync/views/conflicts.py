"""How conflicts look: what each side did to the file, whether both fit together, and the command that settles it.

Terminals of `WIDE` columns and more get mine and generated side by side, each against base; narrower ones, files and
pipes get the versions one below the other.
"""

from __future__ import annotations

import itertools
import os
import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from urdfsync import resolution, wording
from urdfsync.config import shown
from urdfsync.engine.conflicts import Conflict
from urdfsync.outcome import Result
from urdfsync.state.record import Choice
from urdfsync.views.terminal import has_marks, text

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

    from urdfsync.views import hunks

WIDE = 100
"""Columns from which a terminal has room for two versions side by side."""
FULL = 3
"""So many conflicts are shown in full, unless somebody asks for more."""
LINES = 30
"""So many lines of a conflict are shown, unless somebody asks for more."""
_ROWS = 3
"""A changed line may take so many rows, others one; of a longer one, what surrounds its first change is shown."""
_NARROW = 20
"""Columns that a line gets on the narrowest terminal."""
_LEAD = 12
"""Characters shown before the first change of a line that is too long."""
_PIPE = 240
"""Characters of one line in a file or pipe; of a longer one, see `_ROWS`."""

_COLOURS = {"base": "red", "mine": "cyan", "generated": "green", "both": "magenta", "": ""}
_EXPLAINED = {
    Choice.MERGE: "--merge takes both sides' changes",
    Choice.KEEP: "--keep leaves your file as it is",
    Choice.TAKE: "--take replaces it by the generated one",
}
_BY_HAND = ": first put into it what you want of both"


class Look(NamedTuple):
    """How much of the conflicts to show."""

    verbose: bool = False
    """Everything."""
    quiet: bool = False
    """One line for each."""
    before: int = 0
    """So many conflicts of other robots have been shown."""
    config: str = ""
    """The configuration, if the user named one."""


def lines(result: Result, console: Console, look: Look) -> Iterator[Text]:
    """All conflicts of one robot: the first ones in full, the others on a line each, and what settles them."""
    found = resolution.conflicts([result])
    full = len(found) if look.verbose else 0 if look.quiet else max(0, FULL - look.before)
    for target in found[:full]:
        yield text(("", ""))
        yield from _Block(target, console, look).lines()
    if full and found[full:]:
        yield text(("", ""))
    for target in found[full:]:
        yield _headline(target)
    if len(found) > 1 or not full:
        yield from _together(found, look)


def place(result: Result, path: str) -> str:
    """A path of the manifest as the user would type it."""
    return shown(Path(os.path.normpath(result.root / path)))


def command(arguments: Sequence[str], look: Look) -> str:
    """A command line of `resolve` to copy."""
    options = ["--config", look.config] if look.config else []
    return " ".join(["urdfsync", "resolve", *map(_quoted, [*arguments, *options])])


def _quoted(argument: str) -> str:
    if os.name == "nt":
        return f'"{argument}"' if " " in argument else argument
    return shlex.quote(argument)


def _typed(path: str) -> str:
    return f"./{path}" if path.startswith("-") else path


def _headline(target: resolution.Target) -> Text:
    where, reason = place(target.result, target.place), resolution.standing(target)
    return text(("  conflict   ", "bold red"), (where, ""), (f"  {reason}", "dim"))


def _together(found: Sequence[resolution.Target], look: Look) -> Iterator[Text]:
    """What settles all conflicts of a robot at once."""
    mergeable = sum(target.merges for target in found)
    everything = ["--all", "--robot", found[0].result.robot]
    choice = Choice.MERGE if mergeable else Choice.KEEP
    yield text(("", ""))
    if mergeable == len(found):
        what = {1: "merges it", 2: "merges both"}.get(mergeable, f"merges all {mergeable}")
    elif mergeable:
        what = f"merges what can be merged: {mergeable} of {len(found)}"
    else:
        what = "keeps all your files as they are, --take replaces them by the generated ones"
    yield text((f"  {command([*everything, f'--{choice}'], look)}", "bold"), (f"  {what}", "dim"))


class _Block:
    """One conflict in full."""

    def __init__(self, target: resolution.Target, console: Console, look: Look) -> None:
        self._target, self._console, self._look = target, console, look
        self._side_by_side = console.is_terminal and console.width >= WIDE
        self._aside = resolution.aside(target)

    def lines(self) -> Iterator[Text]:
        """What happened, what the versions are, and what to do."""
        target = self._target
        name = place(target.result, target.place)
        yield text(("  conflict   ", "bold red"), (name, "bold"), (f"  {target.action.owner}", "dim"))
        yield from self._filled(" ".join(self._sentences()), "")
        if target.standoff:
            yield text(("", ""))
            yield from self._difference(target.standoff)
            yield text(("", ""))
        yield from self._advice(name)

    def _sentences(self) -> Iterator[str]:
        target = self._target
        yield f"{_sentence(target.action.reason)} {_sentence(resolution.standing(target))}"
        if target.action.origin:
            new = place(target.result, target.action.path)
            yield f"Its element has another name now: it is to become {new}."

    def _advice(self, name: str) -> Iterator[Text]:
        target, said = self._target, dict(_EXPLAINED)
        if self._aside and not target.result.dry:
            files = [place(target.result, path) for path in self._aside.files]
            shared = place(target.result, self._aside.stem)
            yield text((f"    {_listed(self._aside.names)}: {_braced(files, shared)}", "dim"))
        if target.action.origin:
            said[Choice.KEEP] = "--keep moves your file as it is"
        if not target.merges:
            del said[Choice.MERGE]
            if target.standoff:
                said[Choice.KEEP] += f"{_BY_HAND}, and its new name" if target.action.origin else _BY_HAND
        if not target.replaceable:
            del said[Choice.TAKE]
        yield text((f"    {command([_typed(name), f'--{next(iter(said))}'], self._look)}", "bold"))
        yield from self._filled("; ".join(said.values()), "dim")

    def _filled(self, words: str, style: str) -> Iterator[Text]:
        """A paragraph; on a terminal, in lines that keep the indent."""
        paragraph = text((words, style))
        width = self._console.width - 4 if self._console.is_terminal else paragraph.cell_len
        for line in paragraph.wrap(self._console, max(width, 20)):
            line.rstrip()
            line.pad_left(4)
            yield line

    def _difference(self, standoff: Conflict) -> Iterator[Text]:
        from urdfsync.views import hunks

        found = hunks.hunks(standoff.base, standoff.mine, standoff.generated, standoff.merge)
        cells = (cell for hunk in found for row in hunk.rows for cell in (row.mine, row.generated) if cell)
        widest = len(str(max((cell.line.number for cell in cells), default=1)))
        painter = (_Columns if self._side_by_side else _Stack)(self._console, widest)
        sizes = [1 + len(hunk.rows if self._side_by_side else hunk.stack) for hunk in found]
        kept = range(len(found)) if self._look.verbose else _cut(sizes, [hunk.clash for hunk in found], LINES)
        left = sum(sizes) - sum(sizes[index] for index in kept)
        yield from painter.head()
        for index in kept:
            rows = [self._title(found[index], standoff), *painter.lines(found[index])]
            room = len(rows) if self._look.verbose else LINES
            yield from rows[:room]
            left += len(rows[room:])
        if left:
            full = self._aside.files[-1] if self._aside else ""
            see = "--verbose shows them" if self._target.result.dry else f"see {place(self._target.result, full)}"
            yield text((f"    … {left} more line{'s' if left > 1 else ''}; {see}", "dim"))

    def _title(self, hunk: hunks.Hunk, standoff: Conflict) -> Text:
        first, last = hunk.lines.start, hunk.lines.stop - 1
        where = f"lines {first} to {last}" if last > first else f"line {first}" if last == first else "empty"
        if hunk.clash:
            what, style = "the sides contradict each other", "bold red"
        elif standoff.base is None:
            what, style = "not the same", ""
        else:
            what = {"mine": "your edit", "generated": "new"}.get("".join(hunk.sides), "your edit and what is new")
            style = ""
        rule = "──" if has_marks(self._console.file) else "--"
        return text((f"    {rule} {where}: ", "dim"), (what, style))


class _Columns:
    """Mine and generated side by side."""

    def __init__(self, console: Console, widest: int) -> None:
        self._console, self._widest = console, widest
        self._bar, self._clash = ("│", "┃") if has_marks(console.file) else ("|", "!")
        self._half = (console.width - 4 - 3) // 2
        self._room = self._half - widest - 3

    def head(self) -> Iterator[Text]:
        """The names of the columns."""
        title = f"{'mine':<{self._half}} {self._bar} generated"
        yield text((f"    {title}", "bold"))

    def lines(self, hunk: hunks.Hunk) -> Iterator[Text]:
        """The rows of a hunk; long lines go on below."""
        from rich.text import Text

        for row in hunk.rows:
            halves = [self._cell(row.mine, "mine"), self._cell(row.generated, "generated")]
            for mine, generated in itertools.zip_longest(*halves):
                left = mine or Text()
                left.pad_right(self._half - left.cell_len)
                bar = (self._clash, "bold red") if row.clash else (self._bar, "dim")
                yield Text.assemble("    ", left, " ", bar, *([" ", generated] if generated else []))

    def _cell(self, cell: hunks.Cell | None, side: str) -> list[Text]:
        from rich.text import Text

        if cell is None:
            return []
        style = {"-": "red", " ": "dim"}.get(cell.mark, _COLOURS[side])
        gutter = Text(f"{cell.line.number:>{self._widest}} {cell.mark} ", "dim" if cell.mark == " " else style)
        rows = 1 if cell.mark == " " else _ROWS
        parts = _wrapped(_painted(cell.line, style, self._room * rows), self._room, self._console)
        blank = Text(" " * gutter.cell_len)
        return [Text.assemble(blank if number else gutter, part) for number, part in enumerate(parts)]


class _Stack:
    """The versions one below the other, each line with the name of its version."""

    def __init__(self, console: Console, widest: int) -> None:
        self._console, self._widest = console, widest
        self._room = max(_NARROW, console.width - widest - 17) if console.is_terminal else _PIPE

    def head(self) -> Iterator[Text]:
        """Nothing: each line says what it is."""
        return iter(())

    def lines(self, hunk: hunks.Hunk) -> Iterator[Text]:
        """The lines of a hunk."""
        from rich.text import Text

        for label, line, _ in hunk.stack:
            style = _COLOURS[label]
            number = line.number or ""
            gutter = Text(f"    {label:<9}  {number:>{self._widest}}  ", style or "dim")
            blank = Text(" " * gutter.cell_len)
            for part in self._rows(line, style or "dim", _ROWS if label else 1):
                row = Text.assemble(gutter, part)
                row.rstrip()
                yield row
                gutter = blank

    def _rows(self, line: hunks.Line, style: str, rows: int) -> list[Text]:
        if not self._console.is_terminal:
            return [_painted(line, style, self._room)]
        return _wrapped(_painted(line, style, self._room * rows), self._room, self._console)


def _painted(line: hunks.Line, style: str, room: int) -> Text:
    """A line with its changed parts set off; cut around the first of them if it is longer than `room` characters."""
    from rich.text import Text

    start, stop = 0, len(line.text)
    if stop > room:
        first = line.parts[0].start if line.parts else 0
        start = max(0, min(first - _LEAD, stop - room + 2))
        stop = min(stop, start + room - 2)
    pieces, position = [("…", "dim")] if start else [], start
    for part in line.parts:
        part = range(max(part.start, start), min(part.stop, stop))
        if part:
            changed = line.text[part.start : part.stop]
            pieces += [(line.text[position : part.start], style), (changed, f"bold underline {style}")]
            position = part.stop
    pieces.append((line.text[position:stop], style))
    pieces += [("…", "dim")] if stop < len(line.text) else []
    return Text.assemble(*((wording.visible(piece.replace("\t", "    ")), look) for piece, look in pieces))


def _wrapped(line: Text, room: int, console: Console) -> list[Text]:
    return list(line.wrap(console, room, overflow="fold", tab_size=4)) or [line]


def _cut(sizes: Sequence[int], first: Sequence[bool], limit: int) -> Sequence[int]:
    """Which parts there is room for, at least one, in order; some come `first`."""
    kept: list[int] = []
    room = limit
    for index in sorted(range(len(sizes)), key=lambda index: not first[index]):
        room -= sizes[index]
        if kept and room < 0:
            break
        kept.append(index)
    return sorted(kept)


def _sentence(clause: str) -> str:
    """The clause as a sentence; the program's name keeps its small letter."""
    return f"{clause if clause.startswith('urdfsync') else clause[:1].upper() + clause[1:]}."


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _braced(files: Sequence[str], shared: str) -> str:
    """Several files whose names begin alike, with that written once."""
    return files[0] if len(files) == 1 else f"{shared}{{{','.join(file.removeprefix(shared) for file in files)}}}"
