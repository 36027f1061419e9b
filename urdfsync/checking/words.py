"""Verdicts in words: what a check found out, without saying how it looks."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from urdfsync.checking.verdict import EFFORTS, MASSES, POSES, TOLERANCE, Comparison, Compiled, Effect, Standing, Verdict
from urdfsync.diagnostics import Severity
from urdfsync.domain import Deviation, Quantity
from urdfsync.wording import counted

_KINDS = (("poses", POSES), ("torques", EFFORTS), ("masses", MASSES))
_NAMED = 3
"""So many elements of a kind are named at most; of more, only their number."""
_FILES = 3
"""So many files or robots are named at most; of more, only their number."""
_PERCENT = 999.5
"""From so many percent on, the reference is about zero, and a percentage says nothing."""
_LEAST = 0.001
"""Percentages below are not told apart."""


def summary(found: Verdict, strict: bool) -> str:
    """What was found out, as the rest of a line that names the robot."""
    return f"{head(found, strict)}: {'; '.join([*parts(found), duration(found.seconds)])}"


def head(found: Verdict, strict: bool) -> str:
    """The verdict in a word or two."""
    standing = found.standing(strict)
    if standing is not Standing.DIFFERS or differs(found) or (strict and found.changed):
        return str(standing)
    return "out of step" if found.built else "not built"


def differs(found: Verdict) -> bool:
    """Whether what is generated is not what the reference says, whoever edited what."""
    return found.generated is not None and not found.generated.agrees


def parts(found: Verdict) -> list[str]:
    """What was found, step by step: what failed, what compiles, how far it agrees with the reference."""
    errors = sum(one.severity is Severity.ERROR for one in found.diagnostics)
    said = [counted(errors, "error")] if errors else []
    if model := largest(found):
        number = len(found.compiled)
        said.append("1 model compiles" if number == 1 else f"{number} models compile")
        said += _size(model, alone=number == 1)
    elif not errors:
        said.append("syntax and layout")
    if found.generated:
        agreements = [(name, _agreement(found.generated, kinds)) for name, kinds in _KINDS]
        said += [f"{name} {agreement}" for name, agreement in agreements if agreement]
    return said


def largest(found: Verdict) -> Compiled | None:
    """The model with most unknowns, which shows how large the robot is."""
    return max(found.compiled, key=lambda model: model.unknowns, default=None)


def _size(model: Compiled, *, alone: bool) -> list[str]:
    """The size of the largest model; nothing if the tool does not tell."""
    if not model.unknowns:
        return []
    size = f"{model.unknowns:,} equations = unknowns and {counted(model.states, 'state')}"
    return [size if alone else f"{size} in the largest"]


def _agreement(found: Comparison, kinds: Sequence[Quantity]) -> str:
    """How far a package agrees in quantities of one kind; empty if they were not compared."""
    worst = found.worst(kinds)
    if worst is None:
        return ""
    place = f" ({worst.element})" if kinds is not MASSES else ""  # which are of the whole model
    if agrees(worst):
        return f"agree to {figure(worst.relative)}{place}" if worst.difference else "agree exactly"
    return f"differ by {amount(worst)}{place}" if math.isfinite(worst.difference) else f"are not finite{place}"


def agrees(found: Deviation) -> bool:
    """Whether a difference is within the tolerance; one that is no number is not."""
    return found.relative <= TOLERANCE


def figure(value: float) -> str:
    """A difference that is held against a tolerance: `2.2e-15`."""
    if not math.isfinite(value):
        return "none"
    return f"{value:.1e}" if value else "0"


def duration(seconds: float) -> str:
    """A time in few characters: `0.3 s`, `12.4 s`, `183 s`, `12 min`."""
    if seconds >= 600:
        return f"{seconds / 60:.0f} min"
    return f"{seconds:.1f} s" if seconds < 99.95 else f"{seconds:.0f} s"


def quantity(found: Deviation) -> str:
    """What differs, in a word or three."""
    if found.quantity is Quantity.EFFORT:
        return "force" if found.unit == "N" else "torque"
    turns = found.quantity is Quantity.ACCELERATION and found.unit.startswith("rad")
    return f"angular {found.quantity}" if turns else str(found.quantity)


def amount(found: Deviation) -> str:
    """How far it differs: in percent of its own greatest value where that says something, else with its unit."""
    if found.quantity in (Quantity.POSITION, Quantity.CENTRE, Quantity.ORIENTATION):
        return absolute(found)
    percent = 100 * found.difference / found.value if found.value else math.inf
    if not percent < _PERCENT:
        return absolute(found)
    if percent < _LEAST:
        return f"less than {_LEAST:g} %"
    return f"{digits(percent, 2)} %" if percent < 10 else f"{percent:.0f} %"


def absolute(found: Deviation) -> str:
    """How far it differs, with its unit; lengths in mm, elements of a rotation matrix as the angle that they show."""
    value = found.difference
    if not math.isfinite(value):
        return "not finite"
    match found.quantity:
        case Quantity.POSITION | Quantity.CENTRE:
            return f"{digits(1000 * value)} mm" if value < 1 else f"{digits(value)} m"
        case Quantity.ORIENTATION:
            return f"{digits(math.degrees(2 * math.asin(min(value / 2, 1))))}°"
        case _:
            return f"{digits(value)} {found.unit}".rstrip()


def digits(value: float, count: int = 3) -> str:
    """A number with so many digits that count."""
    return f"{float(f'{value:.{count}g}'):.10g}"


def failures(found: Verdict) -> list[str]:
    """How what is generated differs from the reference: a line for poses, for torques and for masses."""
    if found.generated is None:
        return []
    wrong = sorted((one for one in found.generated.deviations if not agrees(one)), key=_rank)
    return list(_phrases(wrong, f" from {found.reference or 'the reference'}", size=True))


def advice(verdicts: Iterable[Verdict]) -> str:
    """What to do about packages that are wrong as they are generated; empty if none is."""
    wrong = [found.robot for found in verdicts if differs(found)]
    if not wrong:
        return ""
    what = f"{listed(wrong)} as generated, whatever you edited"
    return f"{what}; look at `templates` of your own if there are some, else please report it as a bug, with the source"


def _rank(found: Deviation) -> float:
    return -math.inf if math.isnan(found.relative) else -found.relative


def effect(found: Effect) -> str:
    """What an edit did, as a sentence without a full stop."""
    edited = f"{listed(found.files)} {'was' if len(found.files) == 1 else 'were'} edited"
    said = list(_phrases(found.deviations, "", size=False))
    if not said:
        return f"{edited}; nothing that is compared changed"
    return f"{'; '.join(said)}{', all' if len(said) > 1 else ''} since {edited}"


def _phrases(found: Iterable[Deviation], against: str, *, size: bool) -> Iterator[str]:
    """A phrase for each kind of what differs, in the order in which they come."""
    kinds: dict[str, dict[str, list[Deviation]]] = {}
    for one in found:
        kind = next(name for name, quantities in _KINDS if one.quantity in quantities)
        kinds.setdefault(kind, {}).setdefault(one.element, []).append(one)
    for elements in kinds.values():
        (first, worst), *others = elements.items()
        yield f"{first}: {_worst(worst, against, size=size)}{_others(others, worst[0])}"


def _worst(found: Sequence[Deviation], against: str, *, size: bool) -> str:
    """How one element differs: `torque differs by 3.2 %, 0.4 N·m of up to 12.5 N·m`."""
    said = []
    for count, one in enumerate(found):
        by = amount(one)
        more = f", {absolute(one)} of up to {digits(one.value)} {one.unit}" if size and by.endswith("%") else ""
        differing = f"{'' if count else f'differs{against} '}by {by}{more}"
        said.append(f"{quantity(one)} {differing if math.isfinite(one.difference) else 'is not finite'}")
    return " and ".join(said)


def _others(found: Sequence[tuple[str, list[Deviation]]], worst: Deviation) -> str:
    """The other elements: ` (joint wrist by 0.8 %, and 3 more)`."""
    few = found if len(found) < _NAMED else found[: _NAMED - 1]
    said = []
    for element, deviations in few:
        what = "" if quantity(deviations[0]) == quantity(worst) else f"{quantity(deviations[0])} of "
        by = "by " if math.isfinite(deviations[0].difference) else ""
        said.append(f"{what}{element} {by}{' and '.join(map(amount, deviations))}")
    if len(few) < len(found):
        said.append(f"and {len(found) - len(few)} more")
    return f" ({', '.join(said)})" if said else ""


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`, `a, b and 5 more`."""
    if len(names) > _FILES:
        names = [*names[: _FILES - 1], f"{len(names) - _FILES + 1} more"]
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)


def tally(verdicts: Sequence[Verdict], strict: bool) -> str:
    """`4 robots: 2 right, 1 differs, 1 failed`."""
    heads = [head(found, strict) for found in verdicts]
    words = ("right", "out of step", "not built", "differs", "failed")
    counts = [(heads.count(word), word) for word in words]
    said = [f"{number} {'differ' if word == 'differs' and number > 1 else word}" for number, word in counts if number]
    return f"{counted(len(verdicts), 'robot')}: {', '.join(said)}"


def shared(verdicts: Sequence[Verdict], sentences: Sequence[Sequence[str]]) -> list[str]:
    """Sentences of several verdicts, each once, with the robots that it is said of."""
    robots: dict[str, list[str]] = {}
    for found, said in zip(verdicts, sentences, strict=True):
        for sentence in dict.fromkeys(said):
            robots.setdefault(sentence, []).append(found.robot)
    if len(verdicts) == 1:
        return list(robots)
    everyone = len(verdicts)
    return [
        f"{sentence} ({'all robots' if len(names) == everyone else listed(names)})"
        for sentence, names in robots.items()
    ]
