"""Results of checks as people and programs read them: a table on a terminal, a line per robot in a pipe, JSON."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from urdfsync.check.results import (
    EFFORTS,
    MASSES,
    MOST_SINGLE_EDITS,
    POSES,
    TOLERANCE,
    CheckResult,
    CheckStatus,
    EditEffect,
    agrees,
    largest,
)
from urdfsync.diagnostics import Severity
from urdfsync.domain import Deviation, Quantity
from urdfsync.output.console import has_marks, text, visible
from urdfsync.output.json_values import finding_values
from urdfsync.output.phrases import counted

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
_KINDS = (("poses", POSES), ("torques", EFFORTS), ("masses", MASSES))
_NAMED_ELEMENTS = _NAMED_FILES = 3
_LARGEST_PERCENT, _SMALLEST_PERCENT = 999.5, 0.001  # from the first on, the reference is about zero
_WIDEST_NAME = 24
_ELEMENT_WIDTHS = (14, 24)  # the worst elements stand in the row if there is room for the first, else below it
_GAP, _NONE = "  ", "–"
_UNIT = re.compile(r"(?<=\d) (?=(?:%|mm?|N(?:·m)?|kg|rad/s²|m/s²)(?:[\s,;)]|$))")
"""The blank between a number and its unit, where no line ends."""
_GLUE = "\ue000"  # stands for that blank meanwhile: a character of no meaning that is as wide

_TITLES = (
    *(("", "robot"), ("models", "compile"), ("equations", "= unknowns"), ("", "states"), ("pose", "error")),
    *(("", "largest at"), ("torque", "error"), ("", "largest at"), ("", "time")),
)
_WIDTHS = (0, 7, 10, 6, 7, 0, 7, 0, 6)  # 0: depends on names, and is aligned to the left


class CheckReport:
    """The lines of one command; `robots` are all that it is about, so that their names have a column."""

    def __init__(
        self, console: Console, robots: Sequence[str], *, strict: bool = False, verbose: bool = False, quiet: bool
    ) -> None:
        self._console, self._strict, self._verbose, self._quiet = console, strict, verbose, quiet
        self._marks, self._terminal = has_marks(console.file), console.is_terminal
        self._indent = "    " if self._terminal else _GAP
        self._results: list[CheckResult] = []
        self._has_titles = False
        name, room = min(max((5, *map(len, robots))), _WIDEST_NAME), console.width - 2 * self._marks
        fixed = sum(width + len(_GAP) for width in _WIDTHS if width) + name  # without elements
        element = (room - fixed) // 2 - len(_GAP)
        self._element = min(element, _ELEMENT_WIDTHS[1]) if element >= _ELEMENT_WIDTHS[0] else 0
        """Width of the columns with elements; 0 if there is no room for them."""
        self._widths = [width or (self._element if k else name) for k, width in enumerate(_WIDTHS)]
        self._is_table = self._terminal and fixed <= room

    def lines(self, result: CheckResult) -> Iterator[Text]:
        """Everything that there is to say about one robot alone."""
        self._results.append(result)
        if self._quiet and result.status(self._strict) is CheckStatus.RIGHT:
            return
        word = verdict(result, self._strict)
        mark, style = _STYLES[word]
        marks = [(f"{mark} ", style)] if self._marks else []
        if self._is_table:
            yield from self._table_rows(result, marks)
        elif self._terminal:
            time = f", {duration(result.seconds)}"
            yield text(*marks, (result.robot, "bold"), (": ", ""), (word, style), (time, ""))
            yield from (self._wrapped(self._indent, text((said, ""))) for said in _findings(result))
        else:
            yield text(*marks, (f"{result.robot}: {summary(result, self._strict)}", ""))
        said = [(one, "bold red", True) for one in reference_differences(result)]
        changed = "bold red" if self._strict else "bold cyan"
        said += [(effect(one), changed if one.deviations else "dim", True) for one in result.effects]
        said += [(gap, _STYLES["incomplete"][1], False) for gap in result.gaps]
        if not result.built:
            said.append(("there is no package yet, so what `urdfsync build` would write was checked", "yellow", False))
        elif result.conflicting and not result.in_step:
            advice = "your edits and what is new contradict each other; settle that with `urdfsync resolve`"
            said.append((advice, "yellow", False))
        elif not result.in_step:
            said.append(("the package is not what a build would leave; run `urdfsync build`", "yellow", False))
        for sentence, style, names_element in said:  # an element at its beginning stands out
            element, colon, rest = sentence.partition(": ") if names_element else (sentence, "", "")
            yield self._wrapped(self._indent, text((element, style), (f"{colon}{rest}", "")))
        if self._verbose:
            yield from _details(result, self._console.width if self._terminal else 10_000)

    def end(self) -> Iterator[Text]:
        """What is to be said of several robots, each sentence once."""
        results = self._results
        wrong = [result.robot for result in results if result.differs]
        if self._terminal and (wrong or not self._quiet):
            yield text()
        if wrong:
            advice = (
                "look at `templates` of your own if there are some, else please report it as a bug, with the source"
            )
            said = f"{listed(wrong)} as generated, whatever you edited; {advice}"
            yield self._wrapped("", text(("differs: ", "bold red"), (said, "")))
        if self._quiet:
            return
        if self._is_table and any(result.deviations for result in results):
            reference = next((result.reference for result in results if result.reference), "the reference")
            legend = f"errors: largest difference from {reference} relative to the largest value of its kind and unit, "
            yield self._wrapped("", text((f"{legend}or to 1; up to {TOLERANCE:.0e} agrees", "dim")))
        for label, field in (("not checked", "unchecked"), ("for the comparison", "notes")):
            robots: dict[str, list[str]] = {}
            for result in results:
                for sentence in dict.fromkeys(getattr(result, field)):
                    robots.setdefault(sentence, []).append(result.robot)
            shared = []
            for sentence, names in robots.items():
                who = "all robots" if len(names) == len(results) else listed(names)
                shared.append(sentence if len(results) == 1 else f"{sentence} ({who})")
            if self._terminal and shared:
                yield text((f"{label}:", "bold"))
                yield from (self._wrapped(_GAP, text((sentence, ""))) for sentence in shared)
            else:
                yield from (text((f"{label}: {sentence}", "")) for sentence in shared)
        if len(results) > 1:
            words = [verdict(result, self._strict) for result in results]
            counts = {word: words.count(word) for word in _STYLES if word in words}
            said = ", ".join(f"{n} {'differ' if word == 'differs' and n > 1 else word}" for word, n in counts.items())
            yield self._wrapped("", text((f"{counted(len(results), 'robot')}: {said}", "bold")))

    def _table_rows(self, result: CheckResult, marks: Sequence[tuple[str, str]]) -> Iterator[Text]:
        """The row of a robot, below the titles if it is the first one, and above what has no room in it."""
        if not self._has_titles:
            self._has_titles = True
            for titles in zip(*_TITLES, strict=True):
                yield self._row([("  ", "")] if self._marks else [], [(title, "dim") for title in titles])
        cells = [(result.robot, "bold")]
        cells.append((str(len(result.compiled)), "") if result.compiled else (_NONE, "dim"))
        model = max(result.compiled, key=lambda one: one.unknowns, default=None)
        sizes = (f"{model.unknowns:,}", f"{model.states:,}") if model and model.unknowns else ()
        cells += [(size, "") for size in sizes] or [(_NONE, "dim")] * 2
        elements = []
        for quantities in (POSES, EFFORTS):
            one = largest(result.deviations, quantities)
            elements.append(one.element if one and one.difference else "")
            style = "dim" if one is None else "green" if agrees(one) else "bold red"
            cells += [(figure(one.relative) if one else _NONE, style), (elements[-1], "dim")]
        yield self._row(marks, [*cells, (duration(result.seconds), "")])
        if not self._element and any(elements):
            named = listed(list(dict.fromkeys(filter(None, elements))))
            yield text((f"{self._indent}largest at {named}", "dim"))

    def _row(self, marks: Sequence[tuple[str, str]], cells: Sequence[tuple[str, str]]) -> Text:
        shown = [(cell, width, not _WIDTHS[k]) for k, (cell, width) in enumerate(zip(cells, self._widths, strict=True))]
        return text(*marks).append_text(_row([one for one in shown if one[1]]))

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

    def deviations(found: Sequence[Deviation]) -> list[dict[str, Any]]:
        values = []
        for one in found:
            numbers = {name: getattr(one, name) for name in ("difference", "relative", "value", "size")}
            finite = {name: number if math.isfinite(number) else None for name, number in numbers.items()}
            reason = "" if finite["difference"] is not None else "the simulation gave no number"
            named = {"quantity": one.quantity, "element": one.element}
            values.append({**named, **finite, "unit": one.unit, "reason": reason})
        return values

    return {
        "name": result.robot,
        "package": result.package,
        "standing": result.status(strict),
        "failed": result.failed,
        "built": result.built,
        "in_step": result.in_step,
        "conflicting": result.conflicting,
        "summary": summary(result, strict),
        "compiled": [
            {"model": one.model, "unknowns": one.unknowns or None, "states": one.states if one.unknowns else None}
            for one in result.compiled
        ],
        "reference": result.reference,
        "tolerance": TOLERANCE,
        "agrees": None if result.deviations is None else not result.differs,
        "deviations": deviations(result.deviations or ()),
        "edits": [
            {"files": list(one.files), "owners": list(one.owners), "deviations": deviations(one.deviations)}
            for one in result.effects
        ],
        **{name: list(getattr(result, name)) for name in ("notes", "unchecked", "gaps")},
        "seconds": result.seconds,
        "megabytes": result.megabytes,
        "diagnostics": [finding_values(diagnostic) for diagnostic in result.diagnostics],
    }


def summary(result: CheckResult, strict: bool) -> str:
    """What was found out, as the rest of a line that names the robot."""
    return f"{verdict(result, strict)}: {'; '.join([*_findings(result), duration(result.seconds)])}"


def verdict(result: CheckResult, strict: bool) -> str:
    """The status in a word or two."""
    status = result.status(strict)
    if status is not CheckStatus.DIFFERS or result.differs or (strict and result.is_changed_by_edits):
        return str(status)
    return "out of step" if result.built else "not built"


def _findings(result: CheckResult) -> list[str]:
    """What was found, step by step: what failed, what compiles, how far it agrees with the reference."""
    errors = sum(one.severity is Severity.ERROR for one in result.diagnostics)
    said = [counted(errors, "error")] if errors else []
    if result.compiled:
        count, model = len(result.compiled), max(result.compiled, key=lambda model: model.unknowns)
        said.append("1 model compiles" if count == 1 else f"{count} models compile")
        if model.unknowns:
            size = f"{model.unknowns:,} equations = unknowns and {counted(model.states, 'state')}"
            said.append(size if count == 1 else f"{size} in the largest")
    elif not errors:
        said.append("syntax and layout")
    for name, quantities in _KINDS:
        worst = largest(result.deviations, quantities)
        if worst is None:
            continue
        wrong = [one for one in result.deviations or () if one.quantity in quantities and not agrees(one)]
        element = f"{_quantity(worst)} of {worst.element}" if worst.quantity is Quantity.REACTION else worst.element
        place = "" if quantities is MASSES else f" ({element})"
        if wrong and quantities is MASSES:
            said.append(_differences(wrong))  # a mass and a centre have no unit in common
        elif wrong:
            differs = f"differ by {_amount(worst)}" if math.isfinite(worst.difference) else "are not finite"
            said.append(f"{name} {differs}{place}")
        else:
            said.append(
                f"{name} agree to {figure(worst.relative)}{place}" if worst.difference else f"{name} agree exactly"
            )
    return said


def reference_differences(result: CheckResult) -> list[str]:
    """How what is generated differs from the reference: a sentence for poses, for torques and for masses."""
    wrong = [one for one in result.deviations or () if not agrees(one)]
    return list(_phrases(wrong, f" from {result.reference or 'the reference'}", with_size=True))


def effect(found: EditEffect) -> str:
    """What an edit did, as a sentence without a full stop."""
    said = list(_phrases(found.deviations, "", with_size=False, owners=found.owners))
    every = ", all" if len(said) > 1 else ""
    edited, verb = _edited_files(found), "was" if len(found.files) == 1 else "were"
    if len(found.files) > MOST_SINGLE_EDITS:
        edited = f"{edited} ({', '.join(found.files[: _NAMED_FILES - 1])}, …)"
        return f"{'; '.join(said)}{every} because of {edited}" if said else f"{edited} change nothing that is compared"
    edited = f"{edited} {verb} edited"
    return f"{'; '.join(said)}{every} since {edited}" if said else f"{edited}; nothing that is compared changed"


def _edited_files(found: EditEffect) -> str:
    """The edited files, or how many they are: `a.mo and b.mo`, `12 edited files`."""
    return f"{len(found.files)} edited files" if len(found.files) > MOST_SINGLE_EDITS else listed(found.files)


def _phrases(
    deviations: Sequence[Deviation], against: str, *, with_size: bool, owners: Collection[str] = ()
) -> Iterator[str]:
    """A phrase for each kind of what differs; `owners` are the elements that were edited.

    The element comes first that is nearest to the cause: one that was edited. Else, since a link that is displaced
    takes along all that hangs on it, the first from the root; and since each joint carries all that is behind it and
    the root carries everything, the last joint.
    """
    for _, quantities in _KINDS:
        elements: dict[str, list[Deviation]] = {}
        for one in deviations:
            if one.quantity in quantities:
                elements.setdefault(one.element, []).append(one)
        if not elements:
            continue
        outwards = list(elements.items())
        (first, leading), *others = sorted(
            outwards[::-1] if quantities is EFFORTS else outwards,
            key=lambda item: (item[0] not in owners, item[1][0].quantity is Quantity.REACTION),
        )
        few = others if len(others) < _NAMED_ELEMENTS else others[: _NAMED_ELEMENTS - 1]
        more = []
        for element, found in few:  # what differs is told unless that is clear from the first one and the units
            by = [f"{'by ' if math.isfinite(one.difference) else ''}{_amount(one)}" for one in found]
            nouns = [_quantity(one) for one in found]
            if nouns == [_quantity(one) for one in leading] and (len(by) == 1 or found[0].quantity in POSES):
                more.append(" and ".join([f"{element} {by[0]}", *(one.removeprefix("by ") for one in by[1:])]))
            else:
                rest = [f"{noun} {one}" for noun, one in zip(nouns[1:], by[1:], strict=True)]
                more.append(" and ".join([f"{nouns[0]} of {element} {by[0]}", *rest]))
        more += [f"and {len(others) - len(few)} more"] if len(few) < len(others) else []
        brackets = f" ({', '.join(more)})" if more else ""
        yield f"{first}: {_differences(leading, against, with_size)}{brackets}"


def _differences(deviations: Sequence[Deviation], against: str = "", with_size: bool = False) -> str:
    """How one element differs: `torque differs by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected`."""
    said, verb, glue = [], f"differs{against} ", " and "
    for one in deviations:
        if not math.isfinite(one.difference):
            said.append(f"{_quantity(one)} is not finite")
            continue
        by, more = _amount(one), ""
        if with_size and by.endswith("%"):
            up, glue = "" if one.quantity is Quantity.MASS else "up to ", ", and "
            more = f", {_absolute(one)} where {up}{_digits(one.value)} {one.unit} are expected"
        said.append(f"{_quantity(one)} {verb}by {by}{more}")
        verb = ""
    return glue.join(said)


def _quantity(one: Deviation) -> str:
    """What differs, in a word or three."""
    load = "force" if one.unit == "N" else "torque"
    if one.quantity is Quantity.EFFORT:
        return load
    if one.quantity is Quantity.REACTION:
        return f"reaction {load}"
    turns = one.quantity is Quantity.ACCELERATION and one.unit.startswith("rad")
    return f"angular {one.quantity}" if turns else str(one.quantity)


def _amount(one: Deviation) -> str:
    """How far it differs: in percent of its own greatest value where that says something, else with its unit."""
    percent = 100 * one.difference / one.value if one.value else math.inf
    is_geometric = one.quantity in (Quantity.POSITION, Quantity.CENTRE, Quantity.ORIENTATION)
    if is_geometric or not percent < _LARGEST_PERCENT:
        return _absolute(one)
    if percent < _SMALLEST_PERCENT:
        return f"less than {_SMALLEST_PERCENT:g} %"
    return f"{_digits(percent, 2)} %" if percent < 10 else f"{percent:.0f} %"


def _absolute(one: Deviation) -> str:
    """How far it differs, with its unit; lengths in mm, elements of a rotation matrix as the angle that they show."""
    value = one.difference
    if not math.isfinite(value):
        return "not finite"
    if one.quantity in (Quantity.POSITION, Quantity.CENTRE):
        return f"{_digits(1000 * value)} mm" if value < 1 else f"{_digits(value)} m"
    if one.quantity is Quantity.ORIENTATION:
        return f"{_digits(math.degrees(2 * math.asin(min(value / 2, 1))))}°"
    return f"{_digits(value)} {one.unit}".rstrip()


def figure(value: float) -> str:
    """A difference that is held against a tolerance: `2.2e-15`."""
    if not math.isfinite(value):
        return "none"
    return f"{value:.1e}" if value else "0"


def _digits(value: float, count: int = 3) -> str:
    """A number with so many digits that count."""
    return f"{float(f'{value:.{count}g}'):.10g}"


def duration(seconds: float) -> str:
    """A time in few characters: `0.3 s`, `12.4 s`, `183 s`, `12 min`."""
    if seconds >= 600:
        return f"{seconds / 60:.0f} min"
    return f"{seconds:.1f} s" if seconds < 99.95 else f"{seconds:.0f} s"


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`, `a, b and 5 more`."""
    if len(names) > _NAMED_FILES:
        names = [*names[: _NAMED_FILES - 1], f"{len(names) - _NAMED_FILES + 1} more"]
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)


def _row(cells: Sequence[tuple[tuple[str, str], int, bool]]) -> Text:
    """Cells with their widths, and whether they are aligned to the left; what does not fit ends in an ellipsis."""
    line = text()
    for count, (cell, width, is_left) in enumerate(cells):
        content = text(cell)
        content.truncate(width, overflow="ellipsis")
        space = " " * (width - content.cell_len)
        line.append(_GAP if count else "")
        line = line.append_text(content).append(space) if is_left else line.append(space).append_text(content)
    line.rstrip()
    return line


def _details(result: CheckResult, width: int) -> Iterator[Text]:
    """Each model that compiles, each quantity of each element, and what edits do to it, in tables."""
    from rich.cells import cell_len

    def row(one: Deviation) -> tuple[str, ...]:
        value = "" if one.quantity is Quantity.ORIENTATION else f"{_digits(one.value)} {one.unit}"  # it is about 1
        return one.element, _quantity(one), figure(one.relative), _absolute(one), value

    sizes = [(f"{one.unknowns:,}", f"{one.states:,}") if one.unknowns else (_NONE, _NONE) for one in result.compiled]
    models = [((one.model, *size), "") for one, size in zip(result.compiled, sizes, strict=True)]
    titles = ("quantity", "error", "difference", "of up to")
    found = [(row(one), "" if agrees(one) else "red") for one in result.deviations or ()]
    tables: list[tuple[str, tuple[str, ...], Sequence[tuple[tuple[str, ...], str]]]] = [
        ("model", ("equations = unknowns", "states"), models),
        ("element", titles, found),
    ]
    tables += [
        (f"since {_edited_files(one)}", titles, [(row(each), "") for each in one.deviations]) for one in result.effects
    ]
    for name, columns, rows in tables:
        if not rows:
            continue
        lines = [((name, *columns), "dim"), *rows]
        widths = [max(cell_len(visible(cells[k])) for cells, _ in lines) for k in range(len(columns) + 1)]
        while (room := width - 4 - sum(len(_GAP) + one for one in widths[1:])) < 16 and len(widths) > 3:
            widths.pop()  # without room the last columns go, then names are cut
        widths[0] = min(widths[0], max(room, 16))
        for cells, style in lines:
            shown = zip(cells, widths, (name, *columns), strict=False)
            styled = [((cell, style), size, title in (name, "quantity")) for cell, size, title in shown]
            yield text(("    ", "")).append_text(_row(styled))
