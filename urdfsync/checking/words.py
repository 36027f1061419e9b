"""Verdicts in words: what a check found out, without saying how it looks."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from urdfsync.checking.verdict import EFFORTS, MASSES, POSES, TOLERANCE, Comparison, Compiled, Effect, Standing, Verdict
from urdfsync.diagnostics import Severity
from urdfsync.domain import Deviation, Quantity
from urdfsync.output.phrases import counted

_KINDS = (("poses", POSES), ("torques", EFFORTS), ("masses", MASSES))
_NAMED = 3
"""So many elements of a kind are named at most; of more, only their number."""
_FILES = 3
"""So many files or robots are named at most; of more, only their number."""
_MANY = 6
"""Of more edited files than this, there is no telling which one it comes from: only their number is said of them."""
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
        said += filter(None, (_agreement(found.generated, name, kinds) for name, kinds in _KINDS))
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


def _agreement(found: Comparison, name: str, kinds: Sequence[Quantity]) -> str:
    """How far a package agrees in quantities of one kind; empty if they were not compared."""
    worst = found.worst(kinds)
    if worst is None:
        return ""
    if kinds is MASSES and not agrees(worst):  # a mass and a centre have no unit in common
        return _differing([one for one in found.deviations if one.quantity in MASSES and not agrees(one)])
    place = "" if kinds is MASSES else f" ({_place(worst)})"  # masses are of the whole model
    if agrees(worst):
        return f"{name} agree to {figure(worst.relative)}{place}" if worst.difference else f"{name} agree exactly"
    return f"{name} {f'differ by {amount(worst)}' if math.isfinite(worst.difference) else 'are not finite'}{place}"


def _place(found: Deviation) -> str:
    """The element, and what of it where that is no torque of an axis and no pose."""
    return f"{quantity(found)} of {found.element}" if found.quantity is Quantity.REACTION else found.element


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
        return _load(found)
    if found.quantity is Quantity.REACTION:
        return f"reaction {_load(found)}"
    turns = found.quantity is Quantity.ACCELERATION and found.unit.startswith("rad")
    return f"angular {found.quantity}" if turns else str(found.quantity)


def _load(found: Deviation) -> str:
    return "force" if found.unit == "N" else "torque"


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
    wrong = [one for one in found.generated.deviations if not agrees(one)]
    return list(_phrases(wrong, f" from {found.reference or 'the reference'}", size=True))


def advice(verdicts: Iterable[Verdict]) -> str:
    """What to do about packages that are wrong as they are generated; empty if none is."""
    wrong = [found.robot for found in verdicts if differs(found)]
    if not wrong:
        return ""
    what = f"{listed(wrong)} as generated, whatever you edited"
    return f"{what}; look at `templates` of your own if there are some, else please report it as a bug, with the source"


def effect(found: Effect) -> str:
    """What an edit did, as a sentence without a full stop."""
    said = list(_phrases(found.deviations, "", size=False, owners=found.owners))
    every = ", all" if len(said) > 1 else ""
    if len(found.files) > _MANY:
        edited = f"{files(found)} ({', '.join(found.files[: _FILES - 1])}, …)"
        return f"{'; '.join(said)}{every} because of {edited}" if said else f"{edited} change nothing that is compared"
    edited = f"{files(found)} {'was' if len(found.files) == 1 else 'were'} edited"
    return f"{'; '.join(said)}{every} since {edited}" if said else f"{edited}; nothing that is compared changed"


def files(found: Effect) -> str:
    """The edited files, or how many they are: `a.mo and b.mo`, `12 edited files`."""
    return f"{len(found.files)} edited files" if len(found.files) > _MANY else listed(found.files)


def _phrases(found: Sequence[Deviation], against: str, *, size: bool, owners: Collection[str] = ()) -> Iterator[str]:
    """A phrase for each kind of what differs; `owners` are the elements that were edited."""
    for _, kinds in _KINDS:
        elements: dict[str, list[Deviation]] = {}
        for one in found:
            if one.quantity in kinds:
                elements.setdefault(one.element, []).append(one)
        if elements:
            (first, leading), *others = _ranked(elements, owners, outwards=kinds is not EFFORTS)
            yield f"{first}: {_differing(leading, against, size=size)}{_others(others, leading)}"


def _ranked(
    elements: Mapping[str, list[Deviation]], owners: Collection[str], *, outwards: bool
) -> list[tuple[str, list[Deviation]]]:
    """Elements, which come from the root outwards, with the one first that is nearest to what is wrong.

    That is one that was edited. Else, since a link that is displaced takes along all that hangs on it, the first one;
    and since each joint carries all that is behind it and the root carries everything, the last joint.
    """

    def rank(item: tuple[str, list[Deviation]]) -> tuple[bool, bool]:
        element, deviations = item
        return element not in owners, deviations[0].quantity is Quantity.REACTION

    order = list(elements.items())
    return sorted(order if outwards else reversed(order), key=rank)


def _differing(found: Sequence[Deviation], against: str = "", *, size: bool = False) -> str:
    """How one element differs: `torque differs by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected`."""
    said, verb, glue = [], f"differs{against} ", " and "
    for one in found:
        if not math.isfinite(one.difference):
            said.append(f"{quantity(one)} is not finite")
            continue
        by, more = amount(one), ""
        if size and by.endswith("%"):
            up, glue = "" if one.quantity is Quantity.MASS else "up to ", ", and "
            more = f", {absolute(one)} where {up}{digits(one.value)} {one.unit} are expected"
        said.append(f"{quantity(one)} {verb}by {by}{more}")
        verb = ""
    return glue.join(said)


def _others(found: Sequence[tuple[str, list[Deviation]]], leading: Sequence[Deviation]) -> str:
    """The other elements: ` (joint wrist by 0.8 %, and 3 more)`."""
    few = found if len(found) < _NAMED else found[: _NAMED - 1]
    said = [_other(element, deviations, leading) for element, deviations in few]
    if len(few) < len(found):
        said.append(f"and {len(found) - len(few)} more")
    return f" ({', '.join(said)})" if said else ""


def _other(element: str, found: Sequence[Deviation], leading: Sequence[Deviation]) -> str:
    """One of the other elements; what differs is told unless that is clear from the first one and the units."""
    first, *rest = [f"{'by ' if math.isfinite(one.difference) else ''}{amount(one)}" for one in found]
    whats = [quantity(one) for one in found]
    if whats == [quantity(one) for one in leading] and (not rest or found[0].quantity in POSES):
        return " and ".join([f"{element} {first}", *(by.removeprefix("by ") for by in rest)])
    labelled = [f"{what} {by}" for what, by in zip(whats[1:], rest, strict=True)]
    return " and ".join([f"{whats[0]} of {element} {first}", *labelled])


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`, `a, b and 5 more`."""
    if len(names) > _FILES:
        names = [*names[: _FILES - 1], f"{len(names) - _FILES + 1} more"]
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)


def tally(verdicts: Sequence[Verdict], strict: bool) -> str:
    """`4 robots: 2 right, 1 incomplete, 1 failed`."""
    heads = [head(found, strict) for found in verdicts]
    words = ("right", "incomplete", "out of step", "not built", "differs", "failed")
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
