"""How verdicts look: rows of a table as they come on a terminal, else a line per robot; then what holds for all."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from urdfsync.checking import words
from urdfsync.checking.verdict import EFFORTS, POSES, TOLERANCE, Standing, Verdict
from urdfsync.domain import Deviation, Quantity
from urdfsync.output.console import has_marks, text, visible

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

_STYLES = {
    "right": ("✓", "green"),
    "incomplete": ("?", "magenta"),
    "out of step": ("!", "yellow"),
    "not built": ("!", "yellow"),
    "differs": ("≠", "bold red"),
    "failed": ("✗", "bold red"),
}
_NAME = 24
"""Columns for the name of a robot at most."""
_ELEMENT, _WIDEST = 14, 24
"""The worst elements stand in the row if each has so many columns, and get so many at most; else they stand below."""
_GAP = "  "
_MARGIN = "    "
_LEAST, _FEWEST = 16, 3
"""The names in a listing have so many columns at least, for which all others give way but so many."""
_NONE = "–"
_UNIT = re.compile(r"(?<=\d) (?=(?:%|mm?|N(?:·m)?|kg|rad/s²|m/s²)(?:[\s,;)]|$))")
"""The blank between a number and its unit, where no line ends."""
_GLUE = "\ue000"
"""Stands for that meanwhile: a character of no meaning that is as wide as a blank."""
_STALE = "the package is not what a build would leave; run `urdfsync build`"
_CONFLICTING = "your edits and what is new contradict each other; settle that with `urdfsync resolve`"
_ABSENT = "there is no package yet, so what `urdfsync build` would write was checked"


class Look(NamedTuple):
    """What the user asked for."""

    strict: bool = False
    verbose: bool = False
    quiet: bool = False


class _Column(NamedTuple):
    """A column of the table; its title takes two lines."""

    upper: str
    lower: str
    width: int
    left: bool = False

    def cell(self, content: str, style: str) -> Text:
        """The content in its column; what does not fit ends in an ellipsis."""
        cell = text((content, style))
        cell.truncate(self.width, overflow="ellipsis")
        space = " " * (self.width - cell.cell_len)
        return cell.append(space) if self.left else text((space, "")).append_text(cell)


class _Table:
    """Rows below each other, one at a time."""

    def __init__(self, robots: Sequence[str], width: int, *, marks: bool) -> None:
        self._marks = marks
        room = width - 2 * marks
        self._columns, self._beside = _columns(robots, room)
        self._headed = False
        self.fits = sum(column.width for column in self._columns) + len(_GAP) * (len(self._columns) - 1) <= room

    def rows(self, found: Verdict, head: str) -> Iterator[Text]:
        """The row of a robot, below the titles if it is the first one, and above what has no room in it."""
        if not self._headed:
            self._headed = True
            yield self._row("", "", [(column.upper, "dim") for column in self._columns])
            yield self._row("", "", [(column.lower, "dim") for column in self._columns])
        figures, elements = _figures(found), _elements(found)
        if self._beside:
            pairs = zip(figures, elements, strict=True)
            figures = [cell for figure, element in pairs for cell in (figure, (element, "dim"))]
        time = (words.duration(found.seconds), "")
        yield self._row(*_STYLES[head], [(found.robot, "bold"), *_sizes(found), *figures, time])
        if not self._beside and any(elements):
            named = words.listed(list(dict.fromkeys(filter(None, elements))))
            yield text((f"    largest at {named}", "dim"))

    def _row(self, mark: str, style: str, cells: Sequence[tuple[str, str]]) -> Text:
        line = text((f"{mark:<2}", style)) if self._marks else text()
        for count, (column, (content, look)) in enumerate(zip(self._columns, cells, strict=True)):
            line.append(_GAP if count else "").append_text(column.cell(content, look))
        line.rstrip()
        return line


class Checks:
    """The verdicts of one command; `robots` are all that it is about, so that their names have a column."""

    def __init__(self, console: Console, robots: Sequence[str], look: Look) -> None:
        self._console, self._look = console, look
        self._marks = has_marks(console.file)
        self._indent = _MARGIN if console.is_terminal else "  "
        self._verdicts: list[Verdict] = []
        table = _Table(robots, console.width, marks=self._marks)
        self._table = table if console.is_terminal and table.fits else None

    def lines(self, found: Verdict) -> Iterator[Text]:
        """Everything that there is to say about one robot alone."""
        self._verdicts.append(found)
        if self._look.quiet and found.standing(self._look.strict) is Standing.RIGHT:
            return
        head = words.head(found, self._look.strict)
        yield from self._table.rows(found, head) if self._table else self._block(found, head)
        yield from self._remarks(found)
        if self._look.verbose:
            width = self._console.width if self._console.is_terminal else 10_000
            yield from _models(found, width)
            yield from _deviations(found, width)

    def end(self) -> Iterator[Text]:
        """What is to be said of several robots, each sentence once."""
        advice = words.advice(self._verdicts)
        if self._console.is_terminal and (advice or not self._look.quiet):
            yield text()
        if advice:
            yield self._wrapped("", text(("differs: ", "bold red"), (advice, "")))
        if self._look.quiet:
            return
        if self._table and any(found.generated for found in self._verdicts):
            yield self._wrapped("", text((_legend(self._verdicts), "dim")))
        yield from self._section("not checked", [found.unchecked for found in self._verdicts])
        yield from self._section("for the comparison", [found.notes for found in self._verdicts])
        if len(self._verdicts) > 1:
            yield self._wrapped("", text((words.tally(self._verdicts, self._look.strict), "bold")))

    def _section(self, label: str, said: Sequence[Sequence[str]]) -> Iterator[Text]:
        """Sentences of one kind, below a title; in a pipe each has it before it."""
        sentences = words.shared(self._verdicts, said)
        if not self._console.is_terminal:
            yield from (text((f"{label}: {sentence}", "")) for sentence in sentences)
        elif sentences:
            yield text((f"{label}:", "bold"))
            yield from (self._wrapped("  ", text((sentence, ""))) for sentence in sentences)

    def _block(self, found: Verdict, head: str) -> Iterator[Text]:
        """All in words: in one line, or on a terminal with a line for each step."""
        mark, style = _STYLES[head]
        marks = [(f"{mark} ", style)] if self._marks else []
        if not self._console.is_terminal:
            yield text(*marks, (f"{found.robot}: {words.summary(found, self._look.strict)}", ""))
            return
        time = words.duration(found.seconds)
        yield text(*marks, (found.robot, "bold"), (": ", ""), (head, style), (f", {time}", ""))
        for part in words.parts(found):
            yield self._wrapped(self._indent, text((part, "")))

    def _remarks(self, found: Verdict) -> Iterator[Text]:
        """What is behind the verdict: what differs, what edits do, what is missing, and what to do about it."""
        if words.differs(found):
            for said in words.failures(found):
                yield self._wrapped(self._indent, _emphasised(said, "bold red"))
        for effect in found.effects:
            style = "dim" if not effect.deviations else "bold red" if self._look.strict else "bold cyan"
            yield self._wrapped(self._indent, _emphasised(words.effect(effect), style))
        gaps = [(gap, _STYLES["incomplete"][1]) for gap in found.gaps]
        for said, style in (*gaps, (_advice(found), "yellow")):
            if said:
                yield self._wrapped(self._indent, text((said, style)))

    def _wrapped(self, lead: str, line: Text) -> Text:
        """A line that is broken between words if it is too long for the terminal; what follows stands below it."""
        room = self._console.width - len(lead)
        if not self._console.is_terminal or line.cell_len <= room:
            return text((lead, "")).append_text(line)
        whole = text()
        line.plain = _UNIT.sub(_GLUE, line.plain)
        for count, piece in enumerate(line.wrap(self._console, max(room - 2 * (not lead), 20))):
            piece.plain = piece.plain.rstrip().replace(_GLUE, " ")
            whole.append(("\n" + " " * max(len(lead), 2)) if count else lead).append_text(piece)
        return whole


def _advice(found: Verdict) -> str:
    """What to do about a package that is not what a build would leave; empty if it is."""
    if found.in_step:
        return ""
    return (_CONFLICTING if found.conflicting else _STALE) if found.built else _ABSENT


def _columns(robots: Sequence[str], width: int) -> tuple[list[_Column], bool]:
    """The columns of the table, and whether `width` has room for those with the worst elements among them."""
    name = _Column("", "robot", min(max((5, *map(len, robots))), _NAME), left=True)
    sizes = [_Column("models", "compile", 7), _Column("equations", "= unknowns", 10), _Column("", "states", 6)]
    pose, torque, time = _Column("pose", "error", 7), _Column("torque", "error", 7), _Column("", "time", 6)
    taken = sum(column.width + len(_GAP) for column in (name, *sizes, pose, torque, time)) - len(_GAP)
    room = (width - taken) // 2 - len(_GAP)
    if room < _ELEMENT:
        return [name, *sizes, pose, torque, time], False
    element = _Column("", "largest at", min(room, _WIDEST), left=True)
    return [name, *sizes, pose, element, torque, element, time], True


def _sizes(found: Verdict) -> list[tuple[str, str]]:
    """How many models compile, and the size of the largest one."""
    model = words.largest(found)
    count = (str(len(found.compiled)), "") if model else (_NONE, "dim")
    if model is None or not model.unknowns:
        return [count, (_NONE, "dim"), (_NONE, "dim")]
    return [count, (f"{model.unknowns:,}", ""), (f"{model.states:,}", "")]


def _worst(found: Verdict) -> list[Deviation | None]:
    """The worst pose and the worst torque."""
    return [found.generated.worst(kinds) if found.generated else None for kinds in (POSES, EFFORTS)]


def _figures(found: Verdict) -> list[tuple[str, str]]:
    """The greatest errors of poses and torques."""
    return [
        (words.figure(one.relative), "green" if words.agrees(one) else "bold red") if one else (_NONE, "dim")
        for one in _worst(found)
    ]


def _elements(found: Verdict) -> list[str]:
    """Where these are."""
    return [one.element if one and one.difference else "" for one in _worst(found)]


def _legend(verdicts: Sequence[Verdict]) -> str:
    reference = next((found.reference for found in verdicts if found.reference), "") or "the reference"
    return (
        f"errors: largest difference from {reference} relative to the largest value of its kind and unit, or to 1; "
        f"up to {TOLERANCE:.0e} agrees"
    )


def _emphasised(said: str, style: str) -> Text:
    """A sentence about an element, whose name stands out; one without is styled as a whole."""
    element, colon, rest = said.partition(": ")
    return text((element, style), (f"{colon}{rest}", ""))


def _models(found: Verdict, width: int) -> Iterator[Text]:
    """Each model that compiles, with its size."""
    columns = [_Column("", "model", 0, left=True), _Column("", "equations = unknowns", 0), _Column("", "states", 0)]
    rows = [
        (one.model, *((f"{one.unknowns:,}", f"{one.states:,}") if one.unknowns else (_NONE, _NONE)))
        for one in found.compiled
    ]
    return _listing(columns, [(row, "") for row in rows], width)


def _deviations(found: Verdict, width: int) -> Iterator[Text]:
    """Each quantity of each element, and what edits do to it."""
    values = [_Column("", name, 0, left=name == "quantity") for name in ("quantity", "error", "difference", "of up to")]
    if found.generated:
        rows = [(_deviation(one), "" if words.agrees(one) else "red") for one in found.generated.deviations]
        yield from _listing([_Column("", "element", 0, left=True), *values], rows, width)
    for effect in found.effects:
        first = _Column("", f"since {words.files(effect)}", 0, left=True)
        yield from _listing([first, *values], [(_deviation(one), "") for one in effect.deviations], width)


def _deviation(one: Deviation) -> tuple[str, ...]:
    value = "" if one.quantity is Quantity.ORIENTATION else f"{words.digits(one.value)} {one.unit}"  # it is about 1
    return one.element, words.quantity(one), words.figure(one.relative), words.absolute(one), value


def _listing(columns: Sequence[_Column], rows: Sequence[tuple[Sequence[str], str]], width: int) -> Iterator[Text]:
    """A table of its own, as wide as its contents; where there is no room, the last one goes and the first is cut."""
    from rich.cells import cell_len

    if not rows:
        return
    contents = zip(*(cells for cells, _ in rows), strict=True)
    fitted = [
        column._replace(width=max(cell_len(visible(cell)) for cell in (column.lower, *cells)))
        for column, cells in zip(columns, contents, strict=True)
    ]
    while (room := width - len(_MARGIN) - sum(len(_GAP) + column.width for column in fitted[1:])) < _LEAST:
        if len(fitted) == _FEWEST:
            break
        fitted.pop()
    fitted[0] = fitted[0]._replace(width=min(fitted[0].width, max(room, _LEAST)))
    for cells, style in [([column.lower for column in columns], "dim"), *rows]:
        line = text((_MARGIN, ""))
        for count, (column, cell) in enumerate(zip(fitted, cells, strict=False)):
            line.append(_GAP if count else "").append_text(column.cell(cell, style))
        line.rstrip()
        yield line
