"""Results of checks as people and programs read them: a table on a terminal, a line per robot in a pipe, JSON."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from urdfsync.check import sentences
from urdfsync.check.results import EFFORTS, POSES, TOLERANCE, CheckResult, CheckStatus, agrees, largest
from urdfsync.domain import Deviation, Quantity
from urdfsync.output.console import has_marks, text, visible
from urdfsync.output.json_values import finding_values

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
_WIDEST_NAME = 24
_ELEMENT_WIDTHS = (14, 24)  # the worst elements stand in the row if there is room for the first, else below it
_GAP, _INDENT, _NONE = "  ", "    ", "–"
_UNIT = re.compile(r"(?<=\d) (?=(?:%|mm?|N(?:·m)?|kg|rad/s²|m/s²)(?:[\s,;)]|$))")
"""The blank between a number and its unit, where no line ends."""
_GLUE = "\ue000"  # stands for that blank meanwhile: a character of no meaning that is as wide


class Column(NamedTuple):
    """A column of a table."""

    titles: tuple[str, ...]
    width: int
    left: bool = False


class CheckReport:
    """The lines of one command; `robots` are all that it is about, so that their names have a column."""

    def __init__(
        self, console: Console, robots: Sequence[str], *, strict: bool = False, verbose: bool = False, quiet: bool
    ) -> None:
        self._console, self._strict, self._verbose, self._quiet = console, strict, verbose, quiet
        self._marks, self._terminal = has_marks(console.file), console.is_terminal
        self._indent = _INDENT if self._terminal else "  "
        self._results: list[CheckResult] = []
        room = console.width - 2 * self._marks
        self._columns, self._elements_beside = _columns(robots, room)
        width = sum(column.width for column in self._columns) + len(_GAP) * (len(self._columns) - 1)
        self._is_table = self._terminal and width <= room
        self._has_titles = False

    def lines(self, result: CheckResult) -> Iterator[Text]:
        """Everything that there is to say about one robot alone."""
        self._results.append(result)
        if self._quiet and result.status(self._strict) is CheckStatus.RIGHT:
            return
        yield from self._table_rows(result) if self._is_table else self._block(result)
        for said in sentences.reference_differences(result):
            yield self._wrapped(self._indent, _with_element(said, "bold red"))
        for effect in result.effects:
            style = "dim" if not effect.deviations else "bold red" if self._strict else "bold cyan"
            yield self._wrapped(self._indent, _with_element(sentences.effect(effect), style))
        for gap in result.gaps:
            yield self._wrapped(self._indent, text((gap, _STYLES["incomplete"][1])))
        if not result.in_step:
            yield self._wrapped(self._indent, text((_next_step(result), "yellow")))
        if self._verbose:
            width = self._console.width if self._terminal else 10_000
            yield from _details(result, width)

    def end(self) -> Iterator[Text]:
        """What is to be said of several robots, each sentence once."""
        advice = sentences.advice(self._results)
        if self._terminal and (advice or not self._quiet):
            yield text()
        if advice:
            yield self._wrapped("", text(("differs: ", "bold red"), (advice, "")))
        if self._quiet:
            return
        if self._is_table and any(result.deviations for result in self._results):
            reference = next((result.reference for result in self._results if result.reference), "the reference")
            legend = f"errors: largest difference from {reference} relative to the largest value of its kind and unit, "
            yield self._wrapped("", text((f"{legend}or to 1; up to {TOLERANCE:.0e} agrees", "dim")))
        for label, said in (
            ("not checked", [result.unchecked for result in self._results]),
            ("for the comparison", [result.notes for result in self._results]),
        ):
            shared = sentences.shared(self._results, said)
            if self._terminal and shared:
                yield text((f"{label}:", "bold"))
                yield from (self._wrapped("  ", text((sentence, ""))) for sentence in shared)
            else:
                yield from (text((f"{label}: {sentence}", "")) for sentence in shared)
        if len(self._results) > 1:
            yield self._wrapped("", text((sentences.tally(self._results, self._strict), "bold")))

    def _table_rows(self, result: CheckResult) -> Iterator[Text]:
        """The row of a robot, below the titles if it is the first one, and above what has no room in it."""
        if not self._has_titles:
            self._has_titles = True
            for titles in zip(*(column.titles for column in self._columns), strict=True):
                yield self._row("", "", [(title, "dim") for title in titles])
        worst = [largest(result.deviations, quantities) for quantities in (POSES, EFFORTS)]
        elements = [one.element if one and one.difference else "" for one in worst]
        cells = [(result.robot, "bold"), *_size_cells(result)]
        for one, element in zip(worst, elements, strict=True):
            figure = sentences.figure(one.relative) if one else _NONE
            cells.append((figure, "dim" if one is None else "green" if agrees(one) else "bold red"))
            cells += [(element, "dim")] if self._elements_beside else []
        yield self._row(*_STYLES[self._verdict(result)], [*cells, (sentences.duration(result.seconds), "")])
        if not self._elements_beside and any(elements):
            named = sentences.listed(list(dict.fromkeys(filter(None, elements))))
            yield text((f"{_INDENT}largest at {named}", "dim"))

    def _row(self, mark: str, style: str, cells: Sequence[tuple[str, str]]) -> Text:
        line = text((f"{mark:<2}", style)) if self._marks else text()
        return line.append_text(_row(self._columns, cells))

    def _block(self, result: CheckResult) -> Iterator[Text]:
        """All in words: in one line, or on a terminal with a line for each finding."""
        mark, style = _STYLES[self._verdict(result)]
        marks = [(f"{mark} ", style)] if self._marks else []
        if not self._terminal:
            yield text(*marks, (f"{result.robot}: {sentences.summary(result, self._strict)}", ""))
            return
        time = sentences.duration(result.seconds)
        yield text(*marks, (result.robot, "bold"), (": ", ""), (self._verdict(result), style), (f", {time}", ""))
        for said in sentences.findings(result):
            yield self._wrapped(self._indent, text((said, "")))

    def _verdict(self, result: CheckResult) -> str:
        return sentences.verdict(result, self._strict)

    def _wrapped(self, lead: str, line: Text) -> Text:
        """A line that is broken between words if it is too long for the terminal; what follows stands below it."""
        room = self._console.width - len(lead)
        if not self._terminal or line.cell_len <= room:
            return text((lead, "")).append_text(line)
        whole = text()
        line.plain = _UNIT.sub(_GLUE, line.plain)
        for count, piece in enumerate(line.wrap(self._console, max(room - 2 * (not lead), 20))):
            piece.plain = piece.plain.rstrip().replace(_GLUE, " ")
            whole.append(("\n" + " " * max(len(lead), 2)) if count else lead).append_text(piece)
        return whole


def to_json(result: CheckResult, strict: bool) -> dict[str, Any]:
    """What was checked of a robot as plain data; with `strict`, what an edit does is a difference as well."""
    return {
        "name": result.robot,
        "package": result.package,
        "standing": result.status(strict),
        "failed": result.failed,
        "built": result.built,
        "in_step": result.in_step,
        "conflicting": result.conflicting,
        "summary": sentences.summary(result, strict),
        "compiled": [
            {"model": one.model, "unknowns": one.unknowns or None, "states": one.states if one.unknowns else None}
            for one in result.compiled
        ],
        "reference": result.reference,
        "tolerance": TOLERANCE,
        "agrees": None if result.deviations is None else not result.differs,
        "deviations": [_deviation_json(one) for one in result.deviations or ()],
        "edits": [
            {
                "files": list(one.files),
                "owners": list(one.owners),
                "deviations": [_deviation_json(each) for each in one.deviations],
            }
            for one in result.effects
        ],
        "notes": list(result.notes),
        "unchecked": list(result.unchecked),
        "gaps": list(result.gaps),
        "seconds": result.seconds,
        "megabytes": result.megabytes,
        "diagnostics": [finding_values(diagnostic) for diagnostic in result.diagnostics],
    }


def _deviation_json(found: Deviation) -> dict[str, Any]:
    """How far a quantity of an element is from the reference; JSON has no words for what is no number."""
    numbers = {name: getattr(found, name) for name in ("difference", "relative", "value", "size")}
    finite = {name: number if math.isfinite(number) else None for name, number in numbers.items()}
    reason = "" if finite["difference"] is not None else "the simulation gave no number"
    return {"quantity": found.quantity, "element": found.element, **finite, "unit": found.unit, "reason": reason}


def _next_step(result: CheckResult) -> str:
    """What to do about a package that is not what a build would leave."""
    if not result.built:
        return "there is no package yet, so what `urdfsync build` would write was checked"
    if result.conflicting:
        return "your edits and what is new contradict each other; settle that with `urdfsync resolve`"
    return "the package is not what a build would leave; run `urdfsync build`"


def _columns(robots: Sequence[str], width: int) -> tuple[list[Column], bool]:
    """The columns of the table, and whether `width` has room for those with the worst elements among them."""
    pose, torque = Column(("pose", "error"), 7), Column(("torque", "error"), 7)
    first = [
        Column(("", "robot"), min(max((5, *map(len, robots))), _WIDEST_NAME), left=True),
        Column(("models", "compile"), 7),
        Column(("equations", "= unknowns"), 10),
        Column(("", "states"), 6),
    ]
    time = Column(("", "time"), 6)
    taken = sum(column.width + len(_GAP) for column in (*first, pose, torque, time)) - len(_GAP)
    least, most = _ELEMENT_WIDTHS
    room = (width - taken) // 2 - len(_GAP)
    if room < least:
        return [*first, pose, torque, time], False
    element = Column(("", "largest at"), min(room, most), left=True)
    return [*first, pose, element, torque, element, time], True


def _row(columns: Sequence[Column], cells: Sequence[tuple[str, str]]) -> Text:
    """Cells in their columns; what does not fit ends in an ellipsis."""
    line = text()
    for count, (column, cell) in enumerate(zip(columns, cells, strict=True)):
        content = text(cell)
        content.truncate(column.width, overflow="ellipsis")
        space = " " * (column.width - content.cell_len)
        line.append(_GAP if count else "")
        line = line.append_text(content).append(space) if column.left else line.append(space).append_text(content)
    line.rstrip()
    return line


def _size_cells(result: CheckResult) -> list[tuple[str, str]]:
    """How many models compile, and the size of the largest one."""
    count = (str(len(result.compiled)), "") if result.compiled else (_NONE, "dim")
    model = max(result.compiled, key=lambda model: model.unknowns, default=None)
    if model is None or not model.unknowns:
        return [count, (_NONE, "dim"), (_NONE, "dim")]
    return [count, (f"{model.unknowns:,}", ""), (f"{model.states:,}", "")]


def _with_element(said: str, style: str) -> Text:
    """A sentence about an element, whose name stands out; one without is styled as a whole."""
    element, colon, rest = said.partition(": ")
    return text((element, style), (f"{colon}{rest}", ""))


def _details(result: CheckResult, width: int) -> Iterator[Text]:
    """Each model that compiles, each quantity of each element, and what edits do to it."""
    sizes = [(f"{m.unknowns:,}", f"{m.states:,}") if m.unknowns else (_NONE, _NONE) for m in result.compiled]
    models = [((one.model, *size), "") for one, size in zip(result.compiled, sizes, strict=True)]
    yield from _listing(("model", "equations = unknowns", "states"), models, width)
    titles = ("quantity", "error", "difference", "of up to")
    rows = [(_deviation_cells(one), "" if agrees(one) else "red") for one in result.deviations or ()]
    yield from _listing(("element", *titles), rows, width)
    for effect in result.effects:
        rows = [(_deviation_cells(one), "") for one in effect.deviations]
        yield from _listing((f"since {sentences.edited_files(effect)}", *titles), rows, width)


def _deviation_cells(one: Deviation) -> tuple[str, ...]:
    value = "" if one.quantity is Quantity.ORIENTATION else f"{sentences.digits(one.value)} {one.unit}"  # it is about 1
    figure, difference = sentences.figure(one.relative), sentences.absolute(one)
    return one.element, sentences.quantity(one), figure, difference, value


def _listing(titles: Sequence[str], rows: Sequence[tuple[Sequence[str], str]], width: int) -> Iterator[Text]:
    """Cells with their style as a table as wide as they are; without room the last columns go, then names are cut."""
    from rich.cells import cell_len

    if not rows:
        return
    columns = [
        Column((title,), max(cell_len(visible(cell)) for cell in cells), left=title in (titles[0], "quantity"))
        for title, *cells in zip(titles, titles, *(row for row, _ in rows), strict=True)
    ]
    while (room := width - len(_INDENT) - sum(len(_GAP) + column.width for column in columns[1:])) < 16:
        if len(columns) == 3:
            break
        columns.pop()
    columns[0] = columns[0]._replace(width=min(columns[0].width, max(room, 16)))
    for cells, style in [(titles, "dim"), *rows]:
        styled = [(cell, style) for cell in cells[: len(columns)]]
        yield text((_INDENT, "")).append_text(_row(columns, styled))
