"""Changes as an outline for people: a few rows per element, numbers with the digits that tell them apart.

What belongs together is one row: the components of a vector, and all rounding. Elements with the same rows share
an entry. A long outline is condensed to one row per element.
"""

from __future__ import annotations

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
NOT_MODELLED, _ROUNDING = "not modelled", "rounding"
"""Relations of changes that matter little, and labels of rows that only count them."""
_NAMES = 140
"""Characters of the names of elements in a title; there is always one name."""
_FEW = 2
"""So many changes of an element that are not modelled are shown one by one."""
_SAME = 1e-9
"""Relative change of a sum that comes from its rounding; lengths and angles that nobody can measure, in m and rad."""
_NUMBERED = re.compile(r" \d+$")
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


class OutlineRow(msgspec.Struct, frozen=True):
    """One line below an element, or beside its name if it has no label."""

    label: str
    kind: ChangeKind = ChangeKind.CHANGED
    old: str = ""
    new: str = ""
    """With an old value, the new one; else all that there is to say."""
    relation: str = ""
    """Percent, or the same values in degrees."""
    is_quiet: bool = False
    """Whether nothing in the package depends on it, or next to nothing."""


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
        rows = (
            (element, [change_row(change, exact=True) for change in found]) for element, found in by_element.items()
        )
        return Outline(tuple(OutlineEntry((element,), tuple(own)) for element, own in rows))
    full = []
    for element, found in by_element.items():
        own = tuple(_element_rows(found))
        if all(row.label in (NOT_MODELLED, _ROUNDING) for row in own):
            # elements with nothing but counts come last, and without the numbers
            own = (OutlineRow("", new=" and ".join(row.label for row in own), is_quiet=True),)
        full.append((element, own))
    full.sort(key=lambda pair: pair[1][0].is_quiet and not pair[1][0].label)
    shared = _shared(full)
    if sum(len(entry.rows) for entry in shared) <= LONG:
        return Outline(shared)
    return Outline(_shared((name, tuple(_condensed_rows(found))) for name, found in by_element.items()), condensed=True)


def _shared(entries: Iterable[tuple[str, tuple[OutlineRow, ...]]]) -> tuple[OutlineEntry, ...]:
    """Put elements of the same rows together, at the place of the first."""
    groups: dict[tuple[OutlineRow, ...], list[str]] = {}
    for element, rows in entries:
        groups.setdefault(rows, []).append(element)
    return tuple(OutlineEntry(tuple(elements), rows) for rows, elements in groups.items())


def _element_rows(found: Sequence[Change]) -> Iterator[OutlineRow]:
    foreign = [change for change in found if change.change_class is ChangeClass.UNMODELLED]
    foreign = foreign if len(foreign) > _FEW else []
    noise = [change for change in found if _is_rounding(change) and change not in foreign]
    rest = (change for change in found if change not in noise and change not in foreign)
    yield from _numbered(_vector_row(list(group)) for _, group in itertools.groupby(rest, key=_vector_key))
    if foreign:
        kinds = Counter(ChangeKind.CHANGED if _is_rounding(change) else change.kind for change in foreign)
        yield OutlineRow(NOT_MODELLED, new=", ".join(f"{n} {kind}" for kind, n in kinds.items()), is_quiet=True)
    if noise:
        yield OutlineRow(_ROUNDING, new=f"{len(noise)} number{'s' if len(noise) > 1 else ''}", is_quiet=True)


def _condensed_rows(found: Sequence[Change]) -> Iterator[OutlineRow]:
    """Yield the rows of an element with its numbers, rounding and what is not modelled counted in one."""
    quiet = [c for c in found if c.change_class is ChangeClass.UNMODELLED or _is_rounding(c)]
    numbers = [
        c for c in found if c not in quiet and c.kind is ChangeKind.CHANGED and is_number(c.old) and len(c.path) > 1
    ]
    parts = []
    if numbers:
        places = dict.fromkeys(_NUMBERED.sub("", change.path[1]) for change in numbers)
        parts.append(f"{len(numbers)} in {', '.join(places)}")
    if rounding := sum(c.change_class is not ChangeClass.UNMODELLED for c in quiet):
        parts.append(f"{rounding} by rounding")
    if foreign := len(quiet) - rounding:
        parts.append(f"{foreign} not modelled")
    if parts:
        yield OutlineRow("", new="; ".join(parts), is_quiet=not numbers)
    yield from _numbered(change_row(change) for change in found if change not in numbers and change not in quiet)


def _numbered(rows: Iterable[OutlineRow]) -> Iterator[OutlineRow]:
    """Put rows of things together that differ in their numbers only: `visual 2, 3, 4`."""

    def split(row: OutlineRow) -> tuple[str, OutlineRow]:
        return _NUMBERED.sub("", row.label), msgspec.structs.replace(row, label="")

    for (stem, rest), group in itertools.groupby(rows, key=split):
        numbers = [row.label.removeprefix(stem).strip() for row in group]
        yield msgspec.structs.replace(rest, label=f"{stem} {', '.join(filter(None, numbers))}".strip())


def _is_rounding(change: Change) -> bool:
    """Whether a change is noise, or none that anybody could measure: zeros of an exporter, mostly."""
    is_length = change.unit in ("m", "rad") and is_number(change.old) and is_number(change.new)
    return change.noise or bool(is_length and abs(change.new - change.old) <= _SAME)


def _vector_key(change: Change) -> object:
    """Return what the components of one vector share; nothing else shares it."""
    match = _COMPONENT.fullmatch(change.path[-1])
    if match is None or not (is_number(change.old) and is_number(change.new)):
        return id(change)
    return (*change.path[:-1], match[1], change.unit, change.change_class)


def _vector_row(components: Sequence[Change]) -> OutlineRow:
    """Return components of one vector as one row."""
    first = components[0]
    if len(components) == 1:
        return change_row(first)
    indices = ", ".join(change.path[-1].rpartition("[")[2][:-1] for change in components)
    label = " / ".join([*first.path[1:-1], f"{first.path[-1].rpartition('[')[0]}[{indices}]"])
    before, after = [change.old for change in components], [change.new for change in components]
    old, new = _pair(before, after)
    is_quiet = first.change_class is ChangeClass.UNMODELLED
    relation = NOT_MODELLED if is_quiet else ""
    if first.unit == "rad":
        relation = " → ".join(_pair([*map(math.degrees, before)], [*map(math.degrees, after)], mark="°"))
    return OutlineRow(label, ChangeKind.CHANGED, old, f"{new} {first.unit}".rstrip(), relation, is_quiet)


def change_row(change: Change, *, exact: bool = False) -> OutlineRow:
    """Return a change as a row; with `exact` all digits and the whole text."""
    label = " / ".join(change.path[1:])
    is_quiet = change.change_class is ChangeClass.UNMODELLED
    relation = NOT_MODELLED if is_quiet else ""
    if change.kind is ChangeKind.RENAMED:
        return OutlineRow(label, change.kind, new=f"renamed to {change.new}")
    if change.kind is not ChangeKind.CHANGED:
        value = change.new if change.kind is ChangeKind.ADDED else change.old if label else None
        details = _details(value)
        new = f"{change.kind}: {details}" if details else str(change.kind)
        return OutlineRow(label, change.kind, new=new, relation=relation, is_quiet=is_quiet)
    old, new = _pair(change.old, change.new, exact=exact)
    if change.noise:
        relation = _ROUNDING
    elif change.unit == "rad" and is_number(change.old) and is_number(change.new):
        relation = " → ".join(_pair(math.degrees(change.old), math.degrees(change.new), mark="°"))
    else:
        relation = _percent(change.old, change.new) or relation
    new = f"{new} {change.unit}".rstrip()
    return OutlineRow(label, change.kind, old, new, relation, is_quiet or change.noise)


def effect_rows(effects: Sequence[Effect]) -> list[OutlineRow]:
    """Return properties of the whole model as rows, without those that differ by rounding at most."""
    rows = []
    for effect in effects:
        label, old, new, unit = " ".join(effect.path), effect.old, effect.new, effect.unit
        is_vector = _is_vector(old) and _is_vector(new) and len(old) == len(new)
        if is_vector:
            is_same = math.dist(old, new) <= _SAME * max(map(abs, (*old, *new)))
        elif is_number(old) and is_number(new):
            is_same = math.isclose(old, new, rel_tol=_SAME)
        else:
            is_same = old == new
        if is_same:
            continue
        if old is None or new is None:
            kind, word, value = (ChangeKind.REMOVED, "was", old) if new is None else (ChangeKind.ADDED, "now", new)
            rows.append(OutlineRow(label, kind, new=f"{word} {_value(value)} {unit}".rstrip(), relation=effect.hint))
            continue
        before, after = _pair(old, new)
        relation = f"by {math.dist(old, new):.3g} {unit}".rstrip() if is_vector else effect.hint or _percent(old, new)
        rows.append(OutlineRow(label, ChangeKind.CHANGED, before, f"{after} {unit}".rstrip(), relation))
    return rows


# --- values in few characters -------------------------------------------------------------------------------------


def _pair(old: Any, new: Any, *, mark: str = "", exact: bool = False) -> tuple[str, str]:
    """Return two values; numbers have as many digits as it takes to see the difference, and `mark` behind them.

    Components of two vectors have the same decimals. Of long texts only a part is left, unless `exact`.
    """
    if is_number(old) and is_number(new):
        if exact:
            return repr(old), repr(new)
        decimals = max(_decimals(abs(new - old), 2), _decimals(abs(old), 3), _decimals(abs(new), 3))
        return f"{_number(old, decimals)}{mark}", f"{_number(new, decimals)}{mark}"
    if _is_vector(old) and _is_vector(new) and len(old) == len(new):
        decimals = max(_decimals(math.dist(old, new), 2), _decimals(max(map(abs, (*old, *new))), 3))
        before, after = (", ".join(f"{_number(value, decimals)}{mark}" for value in vector) for vector in (old, new))
        return f"({before})", f"({after})"
    if not (isinstance(old, str) and isinstance(new, str)):
        return _value(old), _value(new)
    if _HASH.fullmatch(old) and _HASH.fullmatch(new):
        return old[:8], new[:8]
    if exact or max(len(old), len(new)) <= _WIDTH:
        return old or '""', new or '""'
    same = next((k for k, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
    begin = max(0, same - _CONTEXT)
    before, after = (("…" if begin else "") + " ".join(text[begin:].split()) for text in (old, new))
    return _cut(before), _cut(after)


def _value(value: Any) -> str:
    """Return one value."""
    if is_number(value):
        return _number(value, _decimals(abs(value), 3))
    if _is_vector(value):
        return f"({', '.join(map(_value, value))})"
    return _cut(value if isinstance(value, str) else json.dumps(value, ensure_ascii=False))


def _details(value: Any) -> str:
    """Return the little that tells what comes or goes: texts and numbers, of its parts texts only."""
    if isinstance(value, str):
        return "" if value.startswith("<") else _cut(value)
    if not isinstance(value, Mapping):
        return _value(value) if _is_vector(value) or isinstance(value, int | float) else ""
    items: list[tuple[str, Any]] = []
    for key, item in value.items():
        if isinstance(item, Mapping):
            items += [(f"{key} {name}", text) for name, text in item.items() if isinstance(text, str)]
        elif isinstance(item, str | int | float):
            items.append((key, item))
    told = (
        key if isinstance(item, str) and len(item) > _SHORT else f"{key} {_value(item)}"
        for key, item in items
        if item != ""
    )
    return _cut(", ".join(told), 2 * _WIDTH)


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
