"""Changes of a model in words: the rows of each element.

The components of a vector share a row; so do all rounding errors, and all unmodelled parts. Elements with equal rows
share these rows.
"""

from __future__ import annotations

import itertools
import json
import math
import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from urdfsync.common.spelling import growth, same_count
from urdfsync.domain import ChangeClass, ChangeKind
from urdfsync.domain.changes import Change, Effect, is_number
from urdfsync.domain.comparison import Changes
from urdfsync.output.sections import TextTable

_NAMES = 140
"""The greatest number of characters of the names in a title; a title has one name at least."""
_SAME = 1e-9
"""Up to this value, a relative change of a sum is rounding, and a length (m) or an angle (rad) can't be measured."""
_COMPONENT = r"(.*)\[(\d+)\]"
_MOVED = 3
"""If more elements of a kind exchanged their names, they share one row."""
_WIDTH = 40
"""The greatest number of characters of a text that are shown."""
_CONTEXT = 12
"""Characters of a long text before the place where it differs."""
_HASH = "[0-9a-f]{64}"


class OutlineRow(NamedTuple):
    """A change or an effect in words, in parts for the columns of a table; empty parts are left out."""

    label: str
    """The place in the element; empty for the element itself."""
    value: str
    relation: str = ""
    """The change relative to the old value, such as a percentage."""

    def __str__(self) -> str:
        """Return the row as text: `limit / effort 54 → 60 N·m (+11.1 %)`."""
        return " ".join(filter(None, (self.label, self.value, f"({self.relation})" if self.relation else "")))


def outline(changes: Changes, *, everything: bool = False) -> list[tuple[str, tuple[OutlineRow, ...]]]:
    """Return changed elements with their rows; with `everything`, each change has its own row, with all digits."""
    moved = {} if everything else _moved_names(changes)
    elements: dict[tuple[OutlineRow, ...], list[str]] = defaultdict(list)
    for element, words in moved.items():
        if words:
            elements[(OutlineRow("", words),)].append(element)
    others = [one for one in changes.changes if not (one.kind is ChangeKind.RENAMED and one.element in moved)]
    for element, of_element in Changes(tuple(others)).by_element().items():
        rows = [change_row([change], exact=True) for change in of_element] if everything else _element_rows(of_element)
        elements[tuple(rows)].append(element)
    return [(_title(names), rows) for rows, names in elements.items()]


def _moved_names(changes: Changes) -> dict[str, str]:
    """Return a row for each element that exchanged its name; more than three elements of a kind share one row."""
    renamed = [change for change in changes.changes if change.kind is ChangeKind.RENAMED]
    kinds: dict[str, dict[str, str]] = defaultdict(dict)
    for change in renamed:
        kinds[change.element.partition(" ")[0]][change.old] = change.new
    rows = dict[str, str]()
    for kind, names in kinds.items():
        moved = {old: new for old, new in names.items() if new in names or old in names.values()}
        steps = {_step(old, new) for old, new in moved.items()}
        step = {1: " shifted by one", -1: " shifted back by one"}.get(next(iter(steps)) if len(steps) == 1 else 0, "")
        for number, (old, new) in enumerate(moved.items()):
            more = f" (and {len(moved) - 1} more {'numbers' if step else 'names'}{step})" if len(moved) > _MOVED else ""
            is_told = not (number and more)
            rows[f"{kind} {old}"] = f"is now {new}{more}" if is_told else ""
    return rows


def _step(old: str, new: str) -> int:
    """Return the change of the number in a name; 0 if anything else changed."""
    texts = [name.rstrip("0123456789") for name in (old, new)]
    numbers = [name.removeprefix(text) for name, text in zip((old, new), texts, strict=True)]
    return int(numbers[1]) - int(numbers[0]) if texts[0] == texts[1] and all(numbers) else 0


def _title(elements: Sequence[str]) -> str:
    """Return elements in words, with their common kind only once."""
    first, space, _ = elements[0].partition(" ")
    begin = f"{first} " if space and all(element.startswith(f"{first} ") for element in elements) else ""
    names = [element.removeprefix(begin) for element in elements]
    few = max(1, sum(length <= _NAMES for length in itertools.accumulate(len(name) + 2 for name in names)))
    more = f" and {len(names) - few} more" if few < len(names) else ""
    return f"{begin}{', '.join(names[:few])}{more}"


def _element_rows(changes: Sequence[Change]) -> list[OutlineRow]:
    """Return a row for each change or vector, a row for all unmodelled changes, and a row for all rounding errors."""
    counts = {"not modelled": 0, "rounding": 0}
    vectors: dict[object, list[Change]] = defaultdict(list)
    for change in changes:
        are_numbers = is_number(change.old) and is_number(change.new)
        component = re.fullmatch(_COMPONENT, change.path[-1])
        if change.change_class is ChangeClass.UNMODELLED:
            counts["not modelled"] += 1
        elif change.noise or (are_numbers and change.unit in ("m", "rad") and abs(change.new - change.old) <= _SAME):
            counts["rounding"] += 1
        elif component and are_numbers:
            vectors[(*change.path[:-1], component[1], change.unit)].append(change)
        else:
            vectors[id(change)].append(change)
    rows = [change_row(components) for components in vectors.values()]
    for label, number in counts.items():
        if number:
            rows.append(OutlineRow("", f"{label} {number} change{'s' if number > 1 else ''}"))
    return rows


def change_row(components: Sequence[Change], *, exact: bool = False) -> OutlineRow:
    """Return a change, or the changes of a vector's components, in words.

    With `exact`, numbers have all digits, and texts are not cut.
    """
    first, old, new = components[0], components[0].old, components[0].new
    label = " / ".join(first.path[1:])
    relation = "not modelled" if first.change_class is ChangeClass.UNMODELLED else ""
    if first.kind is ChangeKind.RENAMED:
        return OutlineRow(label, f"renamed to {new}")
    if first.kind is not ChangeKind.CHANGED:
        value = new if first.kind is ChangeKind.ADDED else old if label else None
        details = f"{_details(value)} {first.unit if is_number(value) else ''}".rstrip()
        return OutlineRow(label, f"{first.kind}: {details}" if details else first.kind, relation)
    if len(components) > 1:
        indices = ", ".join(change.path[-1].rpartition("[")[2][:-1] for change in components)
        label = f"{label.rpartition('[')[0]}[{indices}]"
        old, new = [change.old for change in components], [change.new for change in components]
    if first.noise:
        relation = "rounding"
    elif first.unit == "rad" and is_number(first.old) and is_number(first.new):
        degrees = [
            list(map(math.degrees, value)) if isinstance(value, list) else math.degrees(value) for value in (old, new)
        ]
        relation = _pair(*degrees, mark="°")
    else:
        relation = _percent(old, new) or relation
    return OutlineRow(label, f"{_pair(old, new, exact=exact)} {first.unit}".rstrip(), relation)


def effect_rows(effects: Sequence[Effect]) -> list[OutlineRow]:
    """Return properties of the whole model as rows; properties that differ only by rounding are left out."""
    rows = []
    for effect in effects:
        old, new = effect.old, effect.new
        value, relation, is_same = _pair(old, new), effect.hint or _percent(old, new), old == new
        if old is None or new is None:
            gone = f"{old} is gone" if isinstance(old, str) else f"was {_value(old)}"
            value, relation = gone if new is None else f"now {_value(new)}", effect.hint
        elif _is_vector(old) and _is_vector(new) and len(old) == len(new):
            is_same = math.dist(old, new) <= _SAME * max(map(abs, (*old, *new)))
            relation = f"by {math.dist(old, new):.3g} {effect.unit}".rstrip()
        elif is_number(old) and is_number(new):
            is_same = math.isclose(old, new, rel_tol=_SAME)
        if not is_same:
            limit = "" if effect.limit is None else f"/{_value(effect.limit)}"
            rows.append(OutlineRow(" ".join(effect.path), f"{value}{limit} {effect.unit}".rstrip(), relation))
    return rows


def number_table(effects: Sequence[Effect]) -> TextTable:
    """Return the numbers of the whole model as a table; `Before` is empty where nothing changed."""
    rows = []
    for effect in (each for each in effects if each.unit and each.new is not None):
        values = effect.old if effect_rows([effect]) else None, effect.new, effect.limit
        cells = ("" if value is None else f"{_value(value)} {effect.unit}" for value in values)
        rows.append((" ".join(effect.path), *cells))
    return TextTable("In numbers", ("Property", "Before", "Now", "Limit"), rows)


# --- values in few characters -------------------------------------------------------------------------------------


def _pair(old: Any, new: Any, *, mark: str = "", exact: bool = False) -> str:
    """Return two values; `mark` follows numbers, which have all digits if they would look equal otherwise.

    Long texts are cut, unless `exact`.
    """
    if isinstance(old, str) and isinstance(new, str):
        shown = old or '""', new or '""'
        if re.fullmatch(_HASH, old) and re.fullmatch(_HASH, new):
            shown = old[:8], new[:8]
        elif not exact and max(len(old), len(new)) > _WIDTH:
            begin = max(0, same_count(old, new) - _CONTEXT)
            dots = "…" if begin else ""
            shown = _cut(dots + " ".join(old[begin:].split())), _cut(dots + " ".join(new[begin:].split()))
    else:
        shown = _value(old, mark=mark, exact=exact), _value(new, mark=mark, exact=exact)
        if shown[0] == shown[1]:
            shown = _value(old, mark=mark, exact=True), _value(new, mark=mark, exact=True)
    return " → ".join(shown)


def _value(value: Any, *, mark: str = "", exact: bool = False) -> str:
    """Return one value."""
    if is_number(value):
        return f"{repr(value) if exact else format(value, '.6g')}{mark}"
    if _is_vector(value):
        return f"({', '.join(_value(number, mark=mark, exact=exact) for number in value)})"
    return _cut(value if isinstance(value, str) else json.dumps(value, ensure_ascii=False))


def _details(value: Any) -> str:
    """Return the numbers and texts of an added or removed value."""
    if isinstance(value, str) and value.startswith("<"):
        return ""
    if isinstance(value, str) or is_number(value) or _is_vector(value):
        return _value(value)
    if not isinstance(value, Mapping):
        return ""
    items = sorted(value.items(), key=lambda pair: isinstance(pair[1], Mapping))  # a mass stands before an inertia
    told = (f"{key} {_details(item)}" for key, item in items if item != "" and not _is_vector(item))
    return _cut(", ".join(text for text in told if not text.endswith(" ")), 2 * _WIDTH)


def _percent(old: Any, new: Any) -> str:
    """Return how much a number's size grew; empty if the ratio means nothing, as after a change of sign."""
    percent = growth(old, new) if is_number(old) and is_number(new) else None
    if percent is None:
        return ""
    return f"{percent:+.3g} %" if abs(percent) < 999 else f"× {new / old:.3g}"


def _is_vector(value: object) -> bool:
    return isinstance(value, list | tuple) and bool(value) and all(map(is_number, value))


def _cut(text: str, width: int = _WIDTH) -> str:
    return text if len(text) <= width else f"{text[: width - 1]}…"
