"""Changes as an outline for people: per element a few rows, numbers with the digits that tell them apart.

What belongs together is one row: the components of a vector, and whatever is noise. Elements with the same rows share
an entry. A long outline is condensed to one row per element.
"""

from __future__ import annotations

import enum
import itertools
import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.comparing import figures
from urdfsync.difference import ChangeClass, Effect, Kind

if TYPE_CHECKING:
    from urdfsync.changes import Change, Changes

LONG = 60
"""So many rows are shown in full; of more, numbers are condensed unless somebody asks."""
_NAMES = 140
"""Characters of the names of elements of which the same is to be said; there is always one name."""
_FOREIGN, _ROUNDING = _COUNTS = ("not modelled", "rounding")
"""Labels of rows that only count changes."""
_FEW = 2
"""So many changes of an element that are not modelled are shown one by one."""
_SAME = 1e-9
"""Relative change of a sum that comes from its rounding."""
_UNMEASURABLE = {"m": 1e-9, "rad": 1e-9}
"""Changes of lengths and angles that nobody measures: zeros of an exporter, mostly."""
_COUNTED = re.compile(r" \d+$")
_COMPONENT = re.compile(r"(.*)\[(\d+)\]")


class Tone(enum.Enum):
    """What a row is, for whoever chooses colours."""

    CHANGED = enum.auto()
    ADDED = enum.auto()
    REMOVED = enum.auto()
    RENAMED = enum.auto()
    QUIET = enum.auto()
    """Nothing in the package depends on it, or next to nothing."""


class Row(msgspec.Struct, frozen=True):
    """One line below an element, or beside its name if it has no label."""

    label: str
    tone: Tone
    old: str = ""
    new: str = ""
    """With an old value, what it becomes; else what there is to say."""
    relation: str = ""
    """How the new value stands to the old one: percent, or degrees."""


class Entry(msgspec.Struct, frozen=True):
    """Elements of which the same is to be said."""

    elements: tuple[str, ...]
    rows: tuple[Row, ...]

    @property
    def title(self) -> str:
        """The elements in words; what they all begin with is said once."""
        first, space, _ = self.elements[0].partition(" ")
        begin = f"{first} " if space and all(e.startswith(f"{first} ") for e in self.elements) else ""
        names = [element.removeprefix(begin) for element in self.elements]
        lengths = itertools.accumulate(len(name) + 2 for name in names)
        few = max(1, sum(length <= _NAMES for length in lengths))
        more = f" and {len(names) - few} more" if few < len(names) else ""
        return f"{begin}{', '.join(names[:few])}{more}"


class Outline(msgspec.Struct, frozen=True):
    """All entries, and whether numbers were condensed."""

    entries: tuple[Entry, ...]
    condensed: bool = False


def outline(changes: Changes, *, everything: bool = False) -> Outline:
    """The outline of these changes; with `everything`, each change has a row of its own and all its digits."""
    by_element = changes.by_element()
    entries = [Entry((element,), tuple(_rows(found, everything))) for element, found in by_element.items()]
    if everything:
        return Outline(tuple(entries))
    shared = tuple(_shared(_hushed(entries)))
    if sum(len(entry.rows) for entry in shared) <= LONG:
        return Outline(shared)
    short = [Entry((element,), tuple(_condensed(found))) for element, found in by_element.items()]
    return Outline(tuple(_shared(short)), condensed=True)


def effects(found: Sequence[Effect]) -> list[Row]:
    """Properties of the whole model as rows; those that differ by rounding at most are left out."""
    return [_effect(effect) for effect in found if not _is_same(effect.old, effect.new)]


def _effect(found: Effect) -> Row:
    label, old, new = " ".join(found.path), found.old, found.new
    if old is None or new is None:
        tone, there = (Tone.REMOVED, old) if new is None else (Tone.ADDED, new)
        return Row(
            label,
            tone,
            new=f"{'was' if new is None else 'now'} {figures.with_unit(figures.one(there), found.unit)}",
            relation=found.hint,
        )
    if figures.is_vector(old) and figures.is_vector(new) and len(old) == len(new):
        before, after = figures.vectors(old, new)
        relation = f"by {figures.with_unit(f'{math.dist(old, new):.3g}', found.unit)}"
        return Row(label, Tone.CHANGED, before, figures.with_unit(after, found.unit), relation)
    before, after = figures.pair(old, new)
    relation = found.hint or figures.percent(old, new)
    return Row(label, Tone.CHANGED, before, figures.with_unit(after, found.unit), relation)


def _is_same(old: Any, new: Any) -> bool:
    if figures.is_number(old) and figures.is_number(new):
        return math.isclose(old, new, rel_tol=_SAME)
    if figures.is_vector(old) and figures.is_vector(new) and len(old) == len(new):
        return bool(math.dist(old, new) <= _SAME * max(map(abs, (*old, *new))))
    return bool(old == new)


def _hushed(entries: Sequence[Entry]) -> Iterator[Entry]:
    """The entries; those that have nothing but counts of what hardly matters come last, and without the counts."""
    loud = [entry for entry in entries if any(row.label not in _COUNTS for row in entry.rows)]
    yield from loud
    for entry in entries:
        if entry not in loud:
            words = " and ".join(row.label for row in entry.rows)
            yield Entry(entry.elements, (Row("", Tone.QUIET, new=words),))


def _shared(entries: Iterable[Entry]) -> Iterator[Entry]:
    """The entries with elements of the same rows put together, at the place of the first."""
    groups: dict[tuple[Row, ...], list[str]] = {}
    for entry in entries:
        groups.setdefault(entry.rows, []).extend(entry.elements)
    return (Entry(tuple(elements), rows) for rows, elements in groups.items())


def _rows(found: Sequence[Change], everything: bool) -> Iterator[Row]:
    noise = [] if everything else [change for change in found if _is_rounding(change)]
    foreign = [] if everything else [change for change in found if change.change_class is ChangeClass.UNMODELLED]
    foreign = foreign if len(foreign) > _FEW else []
    rest = [change for change in found if change not in noise and change not in foreign]
    rows = []
    for _, group in itertools.groupby(rest, key=lambda change: _stem(change, everything)):
        together = list(group)
        rows.append(_vector(together) if len(together) > 1 else _row(together[0], everything))
    yield from rows if everything else _numbered(rows)
    if foreign:
        kinds = Counter(change.kind for change in foreign if change not in noise)
        kinds.update(Kind.CHANGED for change in foreign if change in noise)
        yield Row(_FOREIGN, Tone.QUIET, new=", ".join(f"{number} {kind}" for kind, number in kinds.items()))
    noise = [change for change in noise if change not in foreign]
    if noise:
        yield Row(_ROUNDING, Tone.QUIET, new=_numbers(len(noise)))


def _condensed(found: Sequence[Change]) -> Iterator[Row]:
    """Rows of an element with its numbers put together, and with what is not modelled or only rounding."""
    quiet = [c for c in found if c.change_class is ChangeClass.UNMODELLED or _is_rounding(c)]
    numbers = [
        c for c in found if c not in quiet and c.kind is Kind.CHANGED and figures.is_number(c.old) and len(c.path) > 1
    ]
    parts = []
    if numbers:
        places = dict.fromkeys(_COUNTED.sub("", change.path[1]) for change in numbers)
        parts.append(f"{len(numbers)} in {', '.join(places)}")
    if rounding := sum(c.change_class is not ChangeClass.UNMODELLED for c in quiet):
        parts.append(f"{rounding} by rounding")
    if foreign := len(quiet) - rounding:
        parts.append(f"{foreign} not modelled")
    if parts:
        yield Row("", Tone.CHANGED if numbers else Tone.QUIET, new="; ".join(parts))
    yield from _numbered(
        _row(change, everything=False) for change in found if change not in numbers and change not in quiet
    )


def _numbered(rows: Iterable[Row]) -> Iterator[Row]:
    """The rows, those of things that differ in their numbers only put together: `visual 2, 3, 4`."""
    for (stem, rest), group in itertools.groupby(rows, key=lambda row: (_COUNTED.sub("", row.label), _plain(row))):
        together = list(group)
        numbers = [row.label.removeprefix(stem).strip() for row in together]
        yield msgspec.structs.replace(rest, label=f"{stem} {', '.join(filter(None, numbers))}".strip())


def _plain(row: Row) -> Row:
    return msgspec.structs.replace(row, label="")


def _numbers(count: int) -> str:
    return f"{count} number{'s' if count > 1 else ''}"


def _is_rounding(change: Change) -> bool:
    """Whether a change is noise, or none that anybody could measure."""
    if change.noise:
        return True
    limit = _UNMEASURABLE.get(change.unit)
    numbers = limit is not None and figures.is_number(change.old) and figures.is_number(change.new)
    return bool(numbers and abs(change.new - change.old) <= limit)


def _stem(change: Change, everything: bool) -> object:
    """What the components of one vector share; nothing else shares it."""
    match = _COMPONENT.fullmatch(change.path[-1])
    numbers = figures.is_number(change.old) and figures.is_number(change.new)
    if match is None or not numbers or everything:
        return id(change)
    return (*change.path[:-1], match[1], change.unit, change.change_class)


def _row(change: Change, everything: bool) -> Row:
    label = " / ".join(change.path[1:])
    quiet = change.change_class is ChangeClass.UNMODELLED
    match change.kind:
        case Kind.RENAMED:
            return Row(label, Tone.RENAMED, new=f"renamed to {change.new}")
        case Kind.ADDED:
            tone, come = Tone.QUIET if quiet else Tone.ADDED, figures.coming("added", change.new)
            return Row(label, tone, new=come, relation=_remark(change))
        case Kind.REMOVED:
            gone = figures.coming("removed", change.old if label else None)
            return Row(label, Tone.QUIET if quiet else Tone.REMOVED, new=gone, relation=_remark(change))
    old, new = figures.pair(change.old, change.new, everything=everything)
    tone = Tone.QUIET if quiet or change.noise else Tone.CHANGED
    return Row(label, tone, old, figures.with_unit(new, change.unit), _relation(change) or _remark(change))


def _vector(components: Sequence[Change]) -> Row:
    """Components of one vector as one row."""
    found = [_COMPONENT.fullmatch(change.path[-1]) for change in components]
    indices = ", ".join(match[2] for match in found if match)
    stem = found[0][1] if found[0] else ""
    first = components[0]
    before, after = [change.old for change in components], [change.new for change in components]
    old, new = figures.vectors(before, after)
    quiet = first.change_class is ChangeClass.UNMODELLED
    relation = _remark(first)
    if first.unit == "rad":
        relation = " → ".join(figures.vectors([*map(math.degrees, before)], [*map(math.degrees, after)], "°"))
    label = " / ".join([*first.path[1:-1], f"{stem}[{indices}]"])
    return Row(label, Tone.QUIET if quiet else Tone.CHANGED, old, figures.with_unit(new, first.unit), relation)


def _relation(change: Change) -> str:
    if change.noise:
        return _ROUNDING
    if change.unit == "rad" and figures.is_number(change.old) and figures.is_number(change.new):
        old, new = figures.pair(math.degrees(change.old), math.degrees(change.new))
        return f"{old}° → {new}°"
    return figures.percent(change.old, change.new)


def _remark(change: Change) -> str:
    return _FOREIGN if change.change_class is ChangeClass.UNMODELLED else ""
