"""The result of a check in words, without saying how they look."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence

from urdfsync.check.results import (
    EFFORTS,
    MASSES,
    MOST_SINGLE_EDITS,
    POSES,
    CheckResult,
    CheckStatus,
    EditEffect,
    agrees,
    largest,
)
from urdfsync.diagnostics import Severity
from urdfsync.domain import Deviation, Quantity
from urdfsync.output.phrases import counted

_KINDS = (("poses", POSES), ("torques", EFFORTS), ("masses", MASSES))
_NAMED_ELEMENTS = 3
_NAMED_FILES = 3
_LARGEST_PERCENT, _SMALLEST_PERCENT = 999.5, 0.001  # from the first on, the reference is about zero


def summary(result: CheckResult, strict: bool) -> str:
    """What was found out, as the rest of a line that names the robot."""
    return f"{verdict(result, strict)}: {'; '.join([*findings(result), duration(result.seconds)])}"


def verdict(result: CheckResult, strict: bool) -> str:
    """The status in a word or two."""
    status = result.status(strict)
    if status is not CheckStatus.DIFFERS or result.differs or (strict and result.is_changed_by_edits):
        return str(status)
    return "out of step" if result.built else "not built"


def findings(result: CheckResult) -> list[str]:
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
            said.append(_agreement(name, worst, [one for one in result.deviations or () if one.quantity in quantities]))
    return said


def _agreement(name: str, worst: Deviation, deviations: Sequence[Deviation]) -> str:
    """How far a package agrees in quantities of one kind, of which `worst` differs most."""
    wrong = [one for one in deviations if not agrees(one)]
    if worst.quantity in MASSES and wrong:
        return _differences(wrong)  # a mass and a centre have no unit in common
    element = f"{quantity(worst)} of {worst.element}" if worst.quantity is Quantity.REACTION else worst.element
    place = "" if worst.quantity in MASSES else f" ({element})"
    if not wrong:
        return f"{name} agree to {figure(worst.relative)}{place}" if worst.difference else f"{name} agree exactly"
    return f"{name} {f'differ by {amount(worst)}' if math.isfinite(worst.difference) else 'are not finite'}{place}"


def reference_differences(result: CheckResult) -> list[str]:
    """How what is generated differs from the reference: a sentence for poses, for torques and for masses."""
    wrong = [one for one in result.deviations or () if not agrees(one)]
    return list(_phrases(wrong, f" from {result.reference or 'the reference'}", with_size=True))


def advice(results: Iterable[CheckResult]) -> str:
    """What to do about packages that are wrong as they are generated; empty if none is."""
    wrong = [result.robot for result in results if result.differs]
    if not wrong:
        return ""
    what = f"{listed(wrong)} as generated, whatever you edited"
    return f"{what}; look at `templates` of your own if there are some, else please report it as a bug, with the source"


def effect(found: EditEffect) -> str:
    """What an edit did, as a sentence without a full stop."""
    said = list(_phrases(found.deviations, "", with_size=False, owners=found.owners))
    every = ", all" if len(said) > 1 else ""
    if len(found.files) > MOST_SINGLE_EDITS:
        edited = f"{edited_files(found)} ({', '.join(found.files[: _NAMED_FILES - 1])}, …)"
        return f"{'; '.join(said)}{every} because of {edited}" if said else f"{edited} change nothing that is compared"
    edited = f"{edited_files(found)} {'was' if len(found.files) == 1 else 'were'} edited"
    return f"{'; '.join(said)}{every} since {edited}" if said else f"{edited}; nothing that is compared changed"


def edited_files(found: EditEffect) -> str:
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
        ranked = sorted(
            outwards[::-1] if quantities is EFFORTS else outwards,
            key=lambda item: (item[0] not in owners, item[1][0].quantity is Quantity.REACTION),
        )
        (first, leading), *others = ranked
        few = others if len(others) < _NAMED_ELEMENTS else others[: _NAMED_ELEMENTS - 1]
        more = [_other_element(element, found, leading) for element, found in few]
        more += [f"and {len(others) - len(few)} more"] if len(few) < len(others) else []
        brackets = f" ({', '.join(more)})" if more else ""
        yield f"{first}: {_differences(leading, against, with_size)}{brackets}"


def _differences(deviations: Sequence[Deviation], against: str = "", with_size: bool = False) -> str:
    """How one element differs: `torque differs by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected`."""
    said, verb, glue = [], f"differs{against} ", " and "
    for one in deviations:
        if not math.isfinite(one.difference):
            said.append(f"{quantity(one)} is not finite")
            continue
        by, more = amount(one), ""
        if with_size and by.endswith("%"):
            up, glue = "" if one.quantity is Quantity.MASS else "up to ", ", and "
            more = f", {absolute(one)} where {up}{digits(one.value)} {one.unit} are expected"
        said.append(f"{quantity(one)} {verb}by {by}{more}")
        verb = ""
    return glue.join(said)


def _other_element(element: str, deviations: Sequence[Deviation], leading: Sequence[Deviation]) -> str:
    """One of the other elements; what differs is told unless that is clear from the first one and the units."""
    by = [f"{'by ' if math.isfinite(one.difference) else ''}{amount(one)}" for one in deviations]
    quantities = [quantity(one) for one in deviations]
    is_clear = quantities == [quantity(one) for one in leading]
    if is_clear and (len(by) == 1 or deviations[0].quantity in POSES):
        return " and ".join([f"{element} {by[0]}", *(one.removeprefix("by ") for one in by[1:])])
    rest = [f"{name} {one}" for name, one in zip(quantities[1:], by[1:], strict=True)]
    return " and ".join([f"{quantities[0]} of {element} {by[0]}", *rest])


def quantity(one: Deviation) -> str:
    """What differs, in a word or three."""
    load = "force" if one.unit == "N" else "torque"
    if one.quantity is Quantity.EFFORT:
        return load
    if one.quantity is Quantity.REACTION:
        return f"reaction {load}"
    turns = one.quantity is Quantity.ACCELERATION and one.unit.startswith("rad")
    return f"angular {one.quantity}" if turns else str(one.quantity)


def amount(one: Deviation) -> str:
    """How far it differs: in percent of its own greatest value where that says something, else with its unit."""
    percent = 100 * one.difference / one.value if one.value else math.inf
    is_geometric = one.quantity in (Quantity.POSITION, Quantity.CENTRE, Quantity.ORIENTATION)
    if is_geometric or not percent < _LARGEST_PERCENT:
        return absolute(one)
    if percent < _SMALLEST_PERCENT:
        return f"less than {_SMALLEST_PERCENT:g} %"
    return f"{digits(percent, 2)} %" if percent < 10 else f"{percent:.0f} %"


def absolute(one: Deviation) -> str:
    """How far it differs, with its unit; lengths in mm, elements of a rotation matrix as the angle that they show."""
    value = one.difference
    if not math.isfinite(value):
        return "not finite"
    if one.quantity in (Quantity.POSITION, Quantity.CENTRE):
        return f"{digits(1000 * value)} mm" if value < 1 else f"{digits(value)} m"
    if one.quantity is Quantity.ORIENTATION:
        return f"{digits(math.degrees(2 * math.asin(min(value / 2, 1))))}°"
    return f"{digits(value)} {one.unit}".rstrip()


def figure(value: float) -> str:
    """A difference that is held against a tolerance: `2.2e-15`."""
    if not math.isfinite(value):
        return "none"
    return f"{value:.1e}" if value else "0"


def digits(value: float, count: int = 3) -> str:
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


def tally(results: Sequence[CheckResult], strict: bool) -> str:
    """`4 robots: 2 right, 1 incomplete, 1 failed`."""
    verdicts = [verdict(result, strict) for result in results]
    words = ("right", "incomplete", "out of step", "not built", "differs", "failed")
    counts = [(verdicts.count(word), word) for word in words]
    said = [f"{number} {'differ' if word == 'differs' and number > 1 else word}" for number, word in counts if number]
    return f"{counted(len(results), 'robot')}: {', '.join(said)}"


def shared(results: Sequence[CheckResult], sentences: Sequence[Sequence[str]]) -> list[str]:
    """Sentences of several results, each once, with the robots that it is said of."""
    robots: dict[str, list[str]] = {}
    for result, said in zip(results, sentences, strict=True):
        for sentence in dict.fromkeys(said):
            robots.setdefault(sentence, []).append(result.robot)
    if len(results) == 1:
        return list(robots)
    return [
        f"{sentence} ({'all robots' if len(names) == len(results) else listed(names)})"
        for sentence, names in robots.items()
    ]
