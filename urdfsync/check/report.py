"""Results of checks as people and programs read them: a table on a terminal, a line per robot in a pipe, JSON."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.check.results import (
    EFFORTS,
    MASSES,
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
from urdfsync.output.console import has_marks, text
from urdfsync.output.json_values import finding_values
from urdfsync.output.phrases import counted

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
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
_NAMED = 3
_LARGEST_PERCENT, _SMALLEST_PERCENT = 999.5, 0.001  # from the first on, the reference is about zero
_NONE = "–"

_TITLES = tuple(
    "models\ncompile|equations\n= unknowns|\nstates|pose\nerror|\nlargest at|torque\nerror|\nlargest at|\ntime".split(
        "|"
    )
)
_WIDTHS = (7, 10, 6, 7, 0, 7, 0, 6)  # of all columns but the first; 0: elements, aligned to the left
_GAP = 2
_WIDEST_NAME, _WIDEST_ELEMENT, _NARROWEST_ELEMENT = 24, 24, 10


class CheckReport:
    """The lines of one command; `robots` are all that it is about, so that their names have a column."""

    def __init__(
        self, console: Console, robots: Sequence[str], *, strict: bool = False, verbose: bool = False, quiet: bool
    ) -> None:
        self._console, self._strict, self._verbose, self._quiet = console, strict, verbose, quiet
        self._marks, self._terminal = has_marks(console.file), console.is_terminal
        self._options = console.options.update(width=console.width if self._terminal else 10_000)  # pipes wrap nothing
        self._indent = 4 if self._terminal else 2
        self._results: list[CheckResult] = []
        self._has_titles = False
        name = min(max((5, *map(len, robots))), _WIDEST_NAME) + 2 * self._marks
        element = (console.width - name - sum(_WIDTHS) - _GAP * len(_WIDTHS)) // 2
        self._is_table = self._terminal and element >= _NARROWEST_ELEMENT
        self._widths = (name, *(width or min(element, _WIDEST_ELEMENT) for width in _WIDTHS))

    def lines(self, result: CheckResult) -> Iterator[Text]:
        """Everything that there is to say about one robot alone."""
        self._results.append(result)
        if self._quiet and result.status(self._strict) is CheckStatus.RIGHT:
            return
        word = verdict(result, self._strict)
        mark, style = _STYLES[word]
        marks = [(f"{mark} ", style)] if self._marks else []
        if self._is_table:
            yield from self._row(text(*marks, (result.robot, "bold")), result)
        elif self._terminal:
            yield text(*marks, (result.robot, "bold"), (": ", ""), (word, style), (f", {duration(result.seconds)}", ""))
            for finding in _findings(result):
                yield from self._wrapped(text((finding, "")))
        else:
            yield text(*marks, (f"{result.robot}: {summary(result, self._strict)}", ""))
        changed = "bold red" if self._strict else "bold cyan"
        said = [(one, "bold red") for one in reference_differences(result)]
        said += [(effect(one), changed if one.deviations else "dim") for one in result.effects]
        for sentence, style in said:  # the element at its beginning stands out
            element, colon, rest = sentence.partition(": ")
            yield from self._wrapped(text((element, style), (f"{colon}{rest}", "")))
        for gap in result.gaps:
            yield from self._wrapped(text((gap, _STYLES["incomplete"][1])))
        if not result.in_step:
            advice = "the package is not what a build would leave; run `urdfsync build`"
            if not result.built:
                advice = "there is no package yet, so what `urdfsync build` would write was checked"
            elif result.conflicting:
                advice = "your edits and what is new contradict each other; settle that with `urdfsync resolve`"
            yield from self._wrapped(text((advice, "yellow")))
        if self._verbose:
            yield from self._details(result)

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
            words = f"{listed(wrong)} as generated, whatever you edited; {advice}"
            yield from self._wrapped(text(("differs: ", "bold red"), (words, "")), 0)
        if self._quiet:
            return
        if self._is_table and any(result.deviations for result in results):
            reference = next((result.reference for result in results if result.reference), "the reference")
            legend = f"errors: largest difference from {reference} relative to the largest value of its kind and unit, "
            yield from self._wrapped(text((f"{legend}or to 1; up to {TOLERANCE:.0e} agrees", "dim")), 0)
        for label, field in (("not checked", "unchecked"), ("for the comparison", "notes")):
            robots: dict[str, list[str]] = {}
            for result in results:
                for sentence in dict.fromkeys(getattr(result, field)):
                    robots.setdefault(sentence, []).append(result.robot)
            for sentence, names in robots.items():
                who = "all robots" if len(names) == len(results) else listed(names)
                which = "" if len(results) == 1 else f" ({who})"
                yield from self._wrapped(text((f"{label}: ", "bold"), (f"{sentence}{which}", "")), 0)
        if len(results) > 1:
            verdicts = [verdict(result, self._strict) for result in results]
            counts = {word: verdicts.count(word) for word in _STYLES if word in verdicts}
            tally = ", ".join(f"{n} {'differ' if word == 'differs' and n > 1 else word}" for word, n in counts.items())
            yield from self._wrapped(text((f"{counted(len(results), 'robot')}: {tally}", "bold")), 0)

    def _row(self, name: Text, result: CheckResult) -> Iterator[Text]:
        """The row of a robot, below the titles if it is the first one."""
        from rich.table import Table

        row = Table.grid(padding=(0, _GAP, 0, 0))
        for width, fixed in zip(self._widths, (0, *_WIDTHS), strict=True):
            row.add_column(width=width, no_wrap=True, overflow="ellipsis", justify="right" if fixed else "left")
        if not self._has_titles:
            self._has_titles = True
            row.add_row("\n  robot" if self._marks else "\nrobot", *_TITLES, style="dim")
        model = max(result.compiled, key=lambda one: one.unknowns, default=None)
        cells = [text((str(len(result.compiled) or _NONE), ""))]
        sizes = (model.unknowns, model.states) if model and model.unknowns else (None, None)
        cells += [text((_NONE if size is None else f"{size:,}", "")) for size in sizes]
        for quantities in (POSES, EFFORTS):
            one = largest(result.deviations, quantities)
            style = "dim" if one is None else "green" if agrees(one) else "bold red"
            cells.append(text((figure(one.relative) if one else _NONE, style)))
            cells.append(text((one.element if one and one.difference else "", "dim")))
        row.add_row(name, *cells, duration(result.seconds))
        return self._rendered(row)

    def _details(self, result: CheckResult) -> Iterator[Text]:
        """Each model that compiles, each quantity of each element, and what edits do to it, in tables."""
        sizes = [
            (f"{one.unknowns:,}", f"{one.states:,}") if one.unknowns else (_NONE, _NONE) for one in result.compiled
        ]
        models = [(one.model, *size) for one, size in zip(result.compiled, sizes, strict=True)]
        titles = ("quantity", "error", "difference", "of up to")
        yield from self._table(("model", "equations = unknowns", "states"), models)
        yield from self._table(("element", *titles), map(_cells, result.deviations or ()))
        for one in result.effects:
            yield from self._table((f"since {listed(one.files)}", *titles), map(_cells, one.deviations))

    def _table(self, titles: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[Text]:
        from rich.table import Table

        table = Table.grid(padding=(0, _GAP, 0, 0))
        for title in titles:
            table.add_column(overflow="ellipsis", justify="left" if title in (titles[0], "quantity") else "right")
        for cells in (titles, *rows):
            table.add_row(*(text((cell, "")) for cell in cells), style="dim" if cells is titles else None)
        return self._wrapped(table) if table.row_count > 1 else iter(())

    def _wrapped(self, one: RenderableType, indent: int | None = None) -> Iterator[Text]:
        """Lines that fit the terminal, indented."""
        from rich.padding import Padding

        return self._rendered(Padding(one, (0, 0, 0, self._indent if indent is None else indent)))

    def _rendered(self, one: RenderableType) -> Iterator[Text]:
        from rich.text import Text

        for segments in self._console.render_lines(one, self._options, pad=False):
            line = Text.assemble(*((segment.text, segment.style or "") for segment in segments))
            line.rstrip()
            yield line


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
        "summary": summary(result, strict),
        "compiled": [
            {"model": one.model, "unknowns": one.unknowns or None, "states": one.states if one.unknowns else None}
            for one in result.compiled
        ],
        "reference": result.reference,
        "tolerance": TOLERANCE,
        "agrees": None if result.deviations is None else not result.differs,
        "deviations": list(map(_deviation_values, result.deviations or ())),
        "edits": [
            {
                "files": list(one.files),
                "owners": list(one.owners),
                "deviations": list(map(_deviation_values, one.deviations)),
            }
            for one in result.effects
        ],
        **{name: list(getattr(result, name)) for name in ("notes", "unchecked", "gaps")},
        "seconds": result.seconds,
        "megabytes": result.megabytes,
        "diagnostics": [finding_values(diagnostic) for diagnostic in result.diagnostics],
    }


def _deviation_values(one: Deviation) -> dict[str, Any]:
    """A deviation as plain data; JSON has no infinite numbers."""
    values = {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in {**msgspec.structs.asdict(one), "relative": one.relative}.items()
    }
    return {**values, "reason": "the simulation gave no number" if values["difference"] is None else ""}


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
        if worst := largest(result.deviations, quantities):
            agreement = f"agree to {figure(worst.relative)}" if worst.difference else "agree exactly"
            place = "" if quantities is MASSES else f" ({worst.element})"
            said.append(f"{name} {agreement if agrees(worst) else 'differ'}{place}")
    return said


def reference_differences(result: CheckResult) -> list[str]:
    """How what is generated differs from the reference: a sentence for poses, for torques and for masses."""
    wrong = [one for one in result.deviations or () if not agrees(one)]
    return list(_phrases(wrong, f" from {result.reference or 'the reference'}"))


def effect(found: EditEffect) -> str:
    """What an edit did, as a sentence without a full stop."""
    edited = f"{listed(found.files)} {'was' if len(found.files) == 1 else 'were'} edited"
    said = "; ".join(_phrases(found.deviations, owners=found.owners))
    return f"{said} since {edited}" if said else f"{edited}; nothing that is compared changed"


def _phrases(deviations: Sequence[Deviation], against: str = "", owners: Collection[str] = ()) -> Iterator[str]:
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
        (first, found), *others = sorted(
            outwards[::-1] if quantities is EFFORTS else outwards,
            key=lambda item: (item[0] not in owners, item[1][0].quantity is Quantity.REACTION),
        )
        said = " and ".join(_difference(one, against) for one in found)
        yield f"{first}: {said}{f' (also {listed([name for name, _ in others])})' if others else ''}"


def _difference(one: Deviation, against: str) -> str:
    """How one quantity differs: `torque differs by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected`."""
    if not math.isfinite(one.difference):
        return f"{_quantity(one)} is not finite"
    by = _amount(one)
    expected = f", {_absolute(one)} where up to {_digits(one.value)} {one.unit} are expected"
    return f"{_quantity(one)} differs{against} by {by}{expected if against and by.endswith('%') else ''}"


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


def _cells(one: Deviation) -> tuple[str, ...]:
    """A deviation as cells of a table."""
    value = "" if one.quantity is Quantity.ORIENTATION else f"{_digits(one.value)} {one.unit}"  # it is about 1
    return one.element, _quantity(one), figure(one.relative), _absolute(one), value


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`, `a, b and 5 more`."""
    if len(names) > _NAMED:
        names = [*names[: _NAMED - 1], f"{len(names) - _NAMED + 1} more"]
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)
