"""Changes as an outline for people: a few rows per element, numbers with the digits that tell them apart.

What belongs together is one row: the components of a vector, and all rounding. Elements with the same rows share
an entry. A long outline is condensed to one row per element.
"""

from __future__ import annotations

import enum
import itertools
import json
import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.diff.changes import Change, Changes, is_number
from urdfsync.domain import ChangeClass, ChangeKind, Effect

LONG = 60
"""So many rows are shown in full; of more, numbers are condensed unless somebody asks."""
_NAMES = 140
"""Characters of the names of elements in a title; there is always one name."""
_FOREIGN, _ROUNDING = "not modelled", "rounding"
"""Labels of rows that only count changes."""
_FEW = 2
"""So many changes of an element that are not modelled are shown one by one."""
_SAME = 1e-9
"""Relative change of a sum that comes from its rounding."""
_UNMEASURABLE = {"m": 1e-9, "rad": 1e-9}
"""Changes of lengths and angles that nobody measures: zeros of an exporter, mostly."""
_COUNTED = re.compile(r" \d+$")
_COMPONENT = re.compile(r"(.*)\[(\d+)\]")

_WIDTH = 40
"""Characters of a text that are shown."""
_CONTEXT = 12
"""Characters of a long text before the place where it differs."""
_SHORT = 32
"""Texts of more characters do not help to tell a thing from others."""
_DIGITS = 6
"""Numbers with so many characters are not rounded."""
_HASH = re.compile(r"[0-9a-f]{64}")


class Tone(enum.Enum):
    """Kind of a row, by which a terminal chooses its colour."""

    CHANGED = enum.auto()
    ADDED = enum.auto()
    REMOVED = enum.auto()
    RENAMED = enum.auto()
    QUIET = enum.auto()
    """Nothing in the package depends on it, or next to nothing."""


class OutlineRow(msgspec.Struct, frozen=True):
    """One line below an element, or beside its name if it has no label."""

    label: str
    tone: Tone
    old: str = ""
    new: str = ""
    """With an old value, the new one; else all that there is to say."""
    relation: str = ""
    """Percent, or the same values in degrees."""


class OutlineEntry(msgspec.Struct, frozen=True):
    """Elements that share their rows."""

    elements: tuple[str, ...]
    rows: tuple[OutlineRow, ...]

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
    """All entries."""

    entries: tuple[OutlineEntry, ...]
    condensed: bool = False
    """Whether numbers are counted instead of shown."""


def outline(changes: Changes, *, everything: bool = False) -> Outline:
    """Return the outline of changes; with `everything`, each change has a row of its own and all its digits."""
    by_element = changes.by_element()
    if everything:
        entries = (((element,), map(_whole_row, found)) for element, found in by_element.items())
        return Outline(tuple(OutlineEntry(elements, tuple(rows)) for elements, rows in entries))
    full = [((element,), tuple(_rows(found))) for element, found in by_element.items()]
    # elements with nothing but counts come last, and without the numbers
    loud = [(element, rows) for element, rows in full if any(row.label not in (_FOREIGN, _ROUNDING) for row in rows)]
    quiet: list[tuple[tuple[str, ...], tuple[OutlineRow, ...]]] = [
        (element, (OutlineRow("", Tone.QUIET, new=" and ".join(row.label for row in rows)),))
        for element, rows in full
        if all(row.label in (_FOREIGN, _ROUNDING) for row in rows)
    ]
    shared = _shared([*loud, *quiet])
    if sum(len(entry.rows) for entry in shared) <= LONG:
        return Outline(shared)
    short = [((element,), tuple(_condensed(found))) for element, found in by_element.items()]
    return Outline(_shared(short), condensed=True)


def effect_rows(effects: Sequence[Effect]) -> list[OutlineRow]:
    """Return properties of the whole model as rows, without those that differ by rounding at most."""
    return [_effect(effect) for effect in effects if not _is_same(effect.old, effect.new)]


def _shared(entries: Iterable[tuple[tuple[str, ...], tuple[OutlineRow, ...]]]) -> tuple[OutlineEntry, ...]:
    """Put elements of the same rows together, at the place of the first."""
    groups: dict[tuple[OutlineRow, ...], list[str]] = {}
    for elements, rows in entries:
        groups.setdefault(rows, []).extend(elements)
    return tuple(OutlineEntry(tuple(elements), rows) for rows, elements in groups.items())


def _rows(found: Sequence[Change]) -> Iterator[OutlineRow]:
    """Yield the rows of an element."""
    foreign = [change for change in found if change.change_class is ChangeClass.UNMODELLED]
    if len(foreign) <= _FEW:
        foreign = []
    noise = [change for change in found if _is_rounding(change) and change not in foreign]
    rest = [change for change in found if change not in noise and change not in foreign]
    rows = []
    for _, group in itertools.groupby(rest, key=_vector_key):
        together = list(group)
        rows.append(_vector_row(together) if len(together) > 1 else _row(together[0]))
    yield from _numbered(rows)
    if foreign:
        kinds = Counter(change.kind for change in foreign if not _is_rounding(change))
        kinds.update(ChangeKind.CHANGED for change in foreign if _is_rounding(change))
        yield OutlineRow(_FOREIGN, Tone.QUIET, new=", ".join(f"{number} {kind}" for kind, number in kinds.items()))
    if noise:
        yield OutlineRow(_ROUNDING, Tone.QUIET, new=f"{len(noise)} number{'s' if len(noise) > 1 else ''}")


def _condensed(found: Sequence[Change]) -> Iterator[OutlineRow]:
    """Yield the rows of an element with its numbers, rounding and what is not modelled counted in one."""
    quiet = [c for c in found if c.change_class is ChangeClass.UNMODELLED or _is_rounding(c)]
    numbers = [
        c for c in found if c not in quiet and c.kind is ChangeKind.CHANGED and is_number(c.old) and len(c.path) > 1
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
        yield OutlineRow("", Tone.CHANGED if numbers else Tone.QUIET, new="; ".join(parts))
    yield from _numbered(_row(change) for change in found if change not in numbers and change not in quiet)


def _numbered(rows: Iterable[OutlineRow]) -> Iterator[OutlineRow]:
    """Put rows of things together that differ in their numbers only: `visual 2, 3, 4`."""

    def split(row: OutlineRow) -> tuple[str, OutlineRow]:
        return _COUNTED.sub("", row.label), msgspec.structs.replace(row, label="")

    for (stem, rest), group in itertools.groupby(rows, key=split):
        numbers = [row.label.removeprefix(stem).strip() for row in group]
        yield msgspec.structs.replace(rest, label=f"{stem} {', '.join(filter(None, numbers))}".strip())


def _is_rounding(change: Change) -> bool:
    """Whether a change is noise, or none that anybody could measure."""
    if change.noise:
        return True
    limit = _UNMEASURABLE.get(change.unit)
    numbers = limit is not None and is_number(change.old) and is_number(change.new)
    return bool(numbers and abs(change.new - change.old) <= limit)


def _vector_key(change: Change) -> object:
    """Return what the components of one vector share; nothing else shares it."""
    match = _COMPONENT.fullmatch(change.path[-1])
    if match is None or not (is_number(change.old) and is_number(change.new)):
        return id(change)
    return (*change.path[:-1], match[1], change.unit, change.change_class)


def _row(change: Change) -> OutlineRow:
    """Return a change as a row."""
    label = " / ".join(change.path[1:])
    quiet = change.change_class is ChangeClass.UNMODELLED
    remark = _FOREIGN if quiet else ""
    match change.kind:
        case ChangeKind.RENAMED:
            return OutlineRow(label, Tone.RENAMED, new=f"renamed to {change.new}")
        case ChangeKind.ADDED:
            added = _with_details("added", change.new)
            return OutlineRow(label, Tone.QUIET if quiet else Tone.ADDED, new=added, relation=remark)
        case ChangeKind.REMOVED:
            removed = _with_details("removed", change.old if label else None)
            return OutlineRow(label, Tone.QUIET if quiet else Tone.REMOVED, new=removed, relation=remark)
    old, new = _pair(change.old, change.new)
    relation = _percent(change.old, change.new)
    if change.noise:
        relation = _ROUNDING
    elif change.unit == "rad" and is_number(change.old) and is_number(change.new):
        relation = "° → ".join(_pair(math.degrees(change.old), math.degrees(change.new))) + "°"
    tone = Tone.QUIET if quiet or change.noise else Tone.CHANGED
    return OutlineRow(label, tone, old, f"{new} {change.unit}".rstrip(), relation or remark)


def _whole_row(change: Change) -> OutlineRow:
    """Return a change as a row with all digits and the whole text."""
    row = _row(change)
    if not row.old:
        return row
    if is_number(change.old) and is_number(change.new):
        old, new = repr(change.old), repr(change.new)
    elif isinstance(change.old, str) and isinstance(change.new, str):
        if _HASH.fullmatch(change.old) and _HASH.fullmatch(change.new):
            return row
        old, new = change.old or '""', change.new or '""'
    else:
        return row
    return msgspec.structs.replace(row, old=old, new=f"{new} {change.unit}".rstrip())


def _vector_row(components: Sequence[Change]) -> OutlineRow:
    """Return components of one vector as one row."""
    first = components[0]
    found = [_COMPONENT.fullmatch(change.path[-1]) for change in components]
    indices = ", ".join(match[2] for match in found if match)
    label = " / ".join([*first.path[1:-1], f"{found[0][1] if found[0] else ''}[{indices}]"])
    before, after = [change.old for change in components], [change.new for change in components]
    old, new = _vectors(before, after)
    quiet = first.change_class is ChangeClass.UNMODELLED
    relation = _FOREIGN if quiet else ""
    if first.unit == "rad":
        relation = " → ".join(_vectors([*map(math.degrees, before)], [*map(math.degrees, after)], "°"))
    return OutlineRow(label, Tone.QUIET if quiet else Tone.CHANGED, old, f"{new} {first.unit}".rstrip(), relation)


def _effect(effect: Effect) -> OutlineRow:
    label, old, new, unit = " ".join(effect.path), effect.old, effect.new, effect.unit
    if old is None or new is None:
        tone, word, value = (Tone.REMOVED, "was", old) if new is None else (Tone.ADDED, "now", new)
        return OutlineRow(label, tone, new=f"{word} {_single(value)} {unit}".rstrip(), relation=effect.hint)
    if _is_vector(old) and _is_vector(new) and len(old) == len(new):
        before, after = _vectors(old, new)
        relation = f"by {math.dist(old, new):.3g} {unit}".rstrip()
    else:
        before, after = _pair(old, new)
        relation = effect.hint or _percent(old, new)
    return OutlineRow(label, Tone.CHANGED, before, f"{after} {unit}".rstrip(), relation)


def _is_same(old: Any, new: Any) -> bool:
    if is_number(old) and is_number(new):
        return math.isclose(old, new, rel_tol=_SAME)
    if _is_vector(old) and _is_vector(new) and len(old) == len(new):
        return bool(math.dist(old, new) <= _SAME * max(map(abs, (*old, *new))))
    return bool(old == new)


# --- values in few characters -------------------------------------------------------------------------------------


def _pair(old: Any, new: Any) -> tuple[str, str]:
    """Return two values, numbers with as many digits as it takes to see the difference, of long texts a part."""
    if is_number(old) and is_number(new):
        decimals = max(_decimals(abs(new - old), 2), _decimals(abs(old), 3), _decimals(abs(new), 3))
        return _number(old, decimals), _number(new, decimals)
    if not (isinstance(old, str) and isinstance(new, str)):
        return _single(old), _single(new)
    if _HASH.fullmatch(old) and _HASH.fullmatch(new):
        return old[:8], new[:8]
    if max(len(old), len(new)) <= _WIDTH:
        return old or '""', new or '""'
    same = next((k for k, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    begin = max(0, same - _CONTEXT)
    lead = "…" if begin else ""
    before, after = (_cut(lead + " ".join(text[begin:].split())) for text in (old, new))
    return before, after


def _vectors(old: Sequence[Any], new: Sequence[Any], mark: str = "") -> tuple[str, str]:
    """Return two vectors of the same length; their components have the same decimals."""
    decimals = max(_decimals(math.dist(old, new), 2), _decimals(max(map(abs, (*old, *new))), 3))
    before, after = (", ".join(f"{_number(value, decimals)}{mark}" for value in vector) for vector in (old, new))
    return f"({before})", f"({after})"


def _single(value: Any) -> str:
    """Return a value in words."""
    if is_number(value):
        return _number(value, _decimals(abs(value), 3))
    if _is_vector(value):
        return f"({', '.join(map(_single, value))})"
    return _cut(value if isinstance(value, str) else json.dumps(value, ensure_ascii=False))


def _with_details(verb: str, value: Any) -> str:
    """Return a verb for something that comes or goes, with the little that tells what it is."""
    if isinstance(value, Mapping):
        details = _cut(", ".join(_details(value)), 2 * _WIDTH)
    elif isinstance(value, str):
        details = "" if value.startswith("<") else _cut(value)
    else:
        details = _single(value) if _is_vector(value) or isinstance(value, int | float) else ""
    return f"{verb}: {details}" if details else verb


def _details(value: Mapping[str, Any], depth: int = 2) -> Iterator[str]:
    """Yield names and values that tell a thing from others: texts and numbers, of its parts texts only."""
    for key, item in value.items():
        if isinstance(item, Mapping) and depth > 1:
            texts = {name: text for name, text in item.items() if isinstance(text, str)}
            yield from (f"{key} {detail}" for detail in _details(texts, depth - 1))
        elif isinstance(item, str | int | float) and item != "":
            yield key if isinstance(item, str) and len(item) > _SHORT else f"{key} {_single(item)}"


def _percent(old: Any, new: Any) -> str:
    """Return a number relative to an older one; empty where that says nothing, as with another sign."""
    if not (is_number(old) and is_number(new)) or old == 0 or new / old < 0:
        return ""
    percent = 100 * (new - old) / abs(old)
    if abs(percent) >= 1000:
        return f"× {new / old:.3g}"
    if 0 < abs(percent) < 0.001:
        return "< 0.001 %"
    digits = max(0, 2 - math.floor(math.log10(abs(percent)))) if percent else 0
    text = f"{percent:+.{digits}f}"
    return f"{text.rstrip('0').rstrip('.') if '.' in text else text} %"


def _is_vector(value: object) -> bool:
    return isinstance(value, list | tuple) and bool(value) and all(map(is_number, value))


def _decimals(size: float, digits: int) -> int:
    """Return how many decimals show a number of this size with so many digits after its first one."""
    return max(0, digits - math.floor(math.log10(size))) if 0 < size < math.inf else 0


def _number(value: float, decimals: int) -> str:
    """Return a number with so many decimals, but with no digit more than it has, or than ten; with all if few."""
    exact = f"{value:.10g}"
    if len(exact.lstrip("-")) <= _DIGITS or not math.isfinite(value):
        return exact
    return f"{round(value, decimals) + 0.0:.10g}"


def _cut(text: str, width: int = _WIDTH) -> str:
    return text if len(text) <= width else f"{text[: width - 1]}…"
