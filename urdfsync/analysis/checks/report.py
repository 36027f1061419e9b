"""Results of checks in words: a line for each robot, with details in indented lines below."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import PurePath

from urdfsync.analysis.checks.results import (
    KINDS,
    CheckResult,
    CheckStatus,
    EditEffect,
    Judgement,
    listed,
    part_word,
    worst,
)
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.spelling import counted
from urdfsync.domain.experiment import Aspect, Deviation, Mismatch, Numbers, Quantity
from urdfsync.output.console import StyledLine, line
from urdfsync.output.sections import Mark, Section, TextTable

_MARKS = {CheckStatus.RIGHT: Mark.FINE, CheckStatus.DIFFERS: Mark.WRONG, CheckStatus.FAILED: Mark.WRONG}
_ADVICE = "; your edits are not the cause: check your own `templates`, or report a bug, with the source"
_MOST = 3
"""The greatest number of differing numbers of one file that are reported."""
_FORCES = {Quantity.EFFORT: "", Quantity.REACTION: "reaction "}
"""Quantities whose unit tells whether they are forces or torques, with the word that comes first."""


def _sentences(result: CheckResult) -> list[tuple[str, str]]:
    """Return the sentences below the first line, with their styles."""
    sentences = [*_numbers(result), *(_measured(result.log) if result.log else ())]
    sentences += [*_disagreements(result), *_differences(result)]
    if result.strict and result.is_doubtful:
        sentences.append(("the source has parts that can hardly be meant: see the warnings", "bold red"))
    for effect in result.effects:
        changed = "; ".join(_change(*each) for each in _by_kind(effect.deviations, effect.owners))
        style = _edit_style(result) if changed else "dim"
        sentences.append((f"{_edited(effect)} {changed or 'no compared motion or force'}", style))
    sentences += _agreement(result)
    sentences += [(f"{file} (edited): its effect is not compared", "dim") for file in result.uncompared_edits]
    sentences += [(gap, "magenta") for gap in result.gaps]
    if not result.built:
        sentences.append(
            ("there is no package yet; the files that `urdfsync build` would write were checked", "yellow")
        )
    elif result.conflicting:
        sentences.append(("files are in conflict; settle them with `urdfsync resolve`", "yellow"))
    elif not result.in_step:
        sentences.append(("the package is out of step; run `urdfsync build`", "yellow"))
    return sentences


def _measured(log: Judgement) -> Iterator[tuple[str, str]]:
    """Yield how far the model is from a log: one number, then each joint."""
    yield f"{log.log}: {100 * log.misfit:.1f} % of the measured efforts unexplained ({log.seconds:.3g} s)", "bold"
    for joint in log.joints:
        left = f"{joint.after:.3g} of {joint.measured:.3g} {joint.unit} are left (RMS)"
        yield f"  {joint.element}: {100 * (joint.explained or 0):.1f} % explained; {left}", ""


def _numbers(result: CheckResult) -> Iterator[tuple[str, str]]:
    """Yield the numbers that differ from the source, then those that the user changed: the first ones of each file."""
    numbers, advice = result.numbers or Numbers(), _ADVICE
    for each, more in _by_file(numbers.differences):
        fault = f"{each.quantity} of {each.element} is {each.given}, and {each.expected} in {_place(each)}"
        file = f"{PurePath(result.folder, each.file).as_posix()}{f':{each.line}' if each.line else ''}"
        yield f"{file}: {fault}{more}{advice}", "bold red"
        advice = ""
    for each, more in _by_file(numbers.edits):
        change = f"changes {each.quantity} of {each.element}: {each.expected} in {_place(each)}"
        yield f"{each.file} (edited) {change}, {each.given} in line {each.line}{more}", _edit_style(result)


def _place(each: Mismatch) -> str:
    return f"{each.source}:{each.source_line}" if each.source_line else each.source


def _by_file(differences: Iterable[Mismatch]) -> Iterator[tuple[Mismatch, str]]:
    """Yield the first differences in each file; the last one comes with the number of further differences."""
    for _, group in itertools.groupby(differences, lambda each: each.file):
        own = list(group)
        more = f" (and {len(own) - _MOST} more there)" if len(own) > _MOST else ""
        yield from ((each, "") for each in own[: _MOST - 1])
        yield from ((each, more) for each in own[_MOST - 1 : _MOST])


def _disagreements(result: CheckResult) -> Iterator[tuple[str, str]]:
    """Yield which of two compilers and the reference stands alone, then what the compilers make of edits."""
    if not result.tools:
        return
    first, second = result.tools
    names = second.tool, first.tool, result.reference or "the reference"
    by_first, by_second = ({each.key: each for each in tool.deviations or ()} for tool in result.tools)
    outliers: dict[str, list[Deviation]] = {}
    for deviation in result.between or ():
        three = by_first[deviation.key], by_second[deviation.key], deviation
        if not all(each.agrees for each in three):
            # the third one of a pair that agrees; near the tolerance two pairs may agree
            outlier = next((name for name, pair in zip(names, three, strict=True) if pair.agrees), "")
            outliers.setdefault(outlier, []).append(max(three, key=lambda each: each.relative))
    for name, deviations in outliers.items():
        for deviation, others in _by_kind(deviations):
            what, amount = _amount(deviation)
            who = f"{name} stands alone, by {amount}" if name else f"all three differ, by up to {amount}"
            yield f"{deviation.element}: {what}: {who}{others}", "bold red"
    for deviation, others in _by_kind([each for each in result.between_edited if not each.agrees]):
        what, amount = _amount(deviation)
        sentence = f"with your edits, the {what} by {second.tool} differs from that by {first.tool} by {amount}"
        yield f"{deviation.element}: {sentence}{others}", "bold red"


def _agreement(result: CheckResult) -> Iterator[tuple[str, str]]:
    """Yield how far two compilers agree, and their times."""
    if result.between and all(each.agrees for each in result.between):
        greatest = max(each.relative for each in result.between)
        yield f"{result.tool} agree {f'to {greatest:.1e}' if greatest else 'exactly'}", ""
    if result.tools:
        yield "; ".join(f"{tool.tool}: {tool.seconds:.1f} s" for tool in result.tools), "dim"


def _differences(result: CheckResult) -> Iterator[tuple[str, str]]:
    """Yield how the package differs from the reference, except where two compilers were compared."""
    advice = "" if result.numbers and result.numbers.differences else _ADVICE
    reference = result.reference or "the reference"
    by_both = {each.key for each in result.between or ()}
    differing = [each for each in result.deviations or () if not (each.agrees or each.key in by_both)]
    for deviation, others in _by_kind(differing):
        what, amount = _amount(deviation)
        yield f"{deviation.element}: {what} differs from {reference} by {amount}{others}{advice}", "bold red"
        if deviation.unit in ("N·m", "N", "kg"):
            yield f"  its largest {what} by {reference} is {_digits(deviation.value)} {deviation.unit}", "dim"
        advice = ""


def _details(result: CheckResult) -> Iterator[str]:
    """Yield each model, and each number that was compared."""
    for tool in result.tools or (result,):
        by = f" by {tool.tool}" if result.tools else ""
        for model in tool.compiled:
            yield f"{model.model}: compiles{by}"
        for part, deviation in worst(tool.deviations or ()).items():
            place = f"{deviation.element}, {deviation.quantity}"
            most = f"relative differences of up to {deviation.relative:.1e} ({place})"
            yield f"{part}: {most if deviation.relative else 'no difference'}{by}"
        for deviation in tool.deviations or ():
            what, amount = _amount(deviation)
            yield f"{deviation.element}: {what} differs by {amount} ({deviation.relative:.1e}){by}"
    for deviation in result.between or ():
        what, amount = _amount(deviation)
        yield f"{deviation.element}: {what} differs by {amount} between the compilers"
    for effect in result.effects:
        yield from (f"{_edited(effect)} {_change(deviation)}" for deviation in effect.deviations)


def closing_lines(results: Sequence[CheckResult]) -> Iterator[StyledLine]:
    """Yield the sentences that concern several robots, each once."""
    for label, field in (("not compared", "unchecked"), ("for the comparison", "notes")):
        robots: dict[str, list[str]] = {}
        for result in results:
            for sentence in dict.fromkeys(getattr(result, field)):
                robots.setdefault(sentence, []).append(result.robot)
        for sentence, names in robots.items():
            who = "all robots" if len(names) == len(results) else listed(names)
            which = "" if len(results) == 1 else f" ({who})"
            yield line((f"{label}: ", "bold"), (f"{sentence}{which}", ""))
    if len(results) > 1:
        counts = Counter(result.status for result in results)
        tally = ", ".join(f"{counts[status]} {status}" for status in CheckStatus if counts[status])
        yield line((f"{counted(len(results), 'robot')}: {tally}", "bold"))


def to_section(result: CheckResult, *, verbose: bool | None = None) -> Section:
    """Return the sentences about a robot, and how far each part agrees with the reference.

    For documents `verbose` is None: the section also lists the parts that were not compared. On a terminal,
    `verbose=True` adds each number.
    """
    status, sentences = result.status, _sentences(result)
    rows = [
        (part, f"{part_word(each)}, to {each.relative:.1e}", f"{each.element}, {each.quantity}")
        for part, each in result.worst.items()
    ]
    finding = None
    if status not in (CheckStatus.RIGHT, CheckStatus.FAILED):
        file = f"{result.folder}/package.mo" if result.folder else ""
        # faults come first; gaps and stale files come last
        told = sentences[0 if status is CheckStatus.DIFFERS else -1][0].strip()
        severity = Severity.NOTE if status is CheckStatus.INCOMPLETE else Severity.WARNING
        finding = Diagnostic(severity, status.replace(" ", "-"), f"{result.package}: {told}", file)
    more = _details(result) if verbose else ()
    if verbose is None:
        more = (f"not compared: {sentence}" for sentence in dict.fromkeys(result.unchecked))
    points = [line(("  ", ""), sentence) for sentence in (*sentences, *((words, "dim") for words in more))]
    table = TextTable(f"Compared with {result.reference}", ("", "", "Worst"), rows)
    about = result.robot, result.summary, _MARKS.get(status, Mark.OPEN)
    return Section(*about, points, [table], result.diagnostics, finding, most=len(points))


def _by_kind(deviations: Sequence[Deviation], owners: Collection[str] = ()) -> Iterator[tuple[Deviation, str]]:
    """Yield the first deviation of each kind, with the names of the other elements that have one.

    The element nearest to the cause comes first: one of `owners`, which are edited. Otherwise it is the first from the
    root, since a displaced link moves all links behind it. For efforts it is the last joint, since each joint carries
    all links behind it. Free motion repeats no kind.
    """
    told = set[Sequence[Quantity]]()
    for is_free, quantities in itertools.product((False, True), KINDS):
        own = (each for each in deviations if (each.part is Aspect.FREE_MOTION) == is_free)
        kind = [each for each in own if each.quantity in quantities]
        if Quantity.EFFORT in quantities:
            kind.reverse()
        kind.sort(key=lambda deviation: (deviation.element not in owners, deviation.quantity is Quantity.REACTION))
        names = list(dict.fromkeys(deviation.element for deviation in kind))
        if names and not (is_free and quantities in told):
            told.add(quantities)
            yield kind[0], f" (also {listed(names[1:])})" if names[1:] else ""


def _edit_style(result: CheckResult) -> str:
    return "bold red" if result.strict else "cyan"


def _edited(effect: EditEffect) -> str:
    words = "changes" if len(effect.files) == 1 else "together change" if effect.deviations else "change"
    return f"{listed(effect.files)} (edited) {words}"


def _change(deviation: Deviation, others: str = "") -> str:
    what, amount = _amount(deviation)
    return f"the {what} of {deviation.element} by {amount}{others}"


def _amount(deviation: Deviation) -> tuple[str, str]:
    """Return the quantity that differs, and by how much: `torque`, `0.4 N·m`.

    Lengths are in mm; a difference of rotation matrices is given as an angle.
    """
    what, unit, value = str(deviation.quantity), deviation.unit, deviation.difference
    if deviation.quantity in _FORCES:
        what = f"{_FORCES[deviation.quantity]}{'force' if unit == 'N' else 'torque'}"
    if deviation.quantity is Quantity.ORIENTATION:
        value, unit = math.degrees(2 * math.asin(min(value / 2, 1))), "°"
    elif unit == "m":
        value, unit = 1000 * value, "mm"
    return what, f"{_digits(value)} {unit}" if math.isfinite(deviation.difference) else "more than any number"


def _digits(value: float) -> str:
    """Return a number with three significant digits."""
    return f"{float(f'{value:.3g}'):.10g}"
