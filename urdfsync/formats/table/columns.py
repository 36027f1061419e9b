"""The columns of a table: which ones have a new name, and which ones jump.

`urdfsync.domain.features` describes the functions: `Parts` and `Judgements`.
"""

from __future__ import annotations

import itertools
import statistics
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import ElementKey, Version
from urdfsync.domain.changes import is_number
from urdfsync.domain.jumps import SAME_UNIT, more, units_of
from urdfsync.formats.table.model import SHEETS, CellValue, Table, shown_unit

_LARGE, _LARGEST = 3, 99
"""Greater ratios are probably mistakes: the first one if three different numbers have it."""
_CELSIUS = 273.15
_MOST_CELLS = 2_000_000
"""The greatest number of cells that are compared to find renamed columns: a million take a second."""


class _Number(NamedTuple):
    """A number in both versions of a table, neither of them zero."""

    row: str
    before: float
    after: float


def pairs(old: Table, new: Table) -> Mapping[ElementKey, ElementKey]:
    """Return new columns by old columns with another name: of one unit, and with mostly equal cells, as no other is."""
    found = dict[ElementKey, ElementKey]()
    for kind, (types, rows) in SHEETS.items():
        (before, formers), (after, news) = ((getattr(table, types), getattr(table, rows)) for table in (old, new))
        removed, added = sorted(before.keys() - after.keys()), sorted(after.keys() - before.keys())
        same_unit = [(name, other) for name in removed for other in added if before[name] == after[other]]
        common = [(formers[key], news[key]) for key in formers if same_unit and key in news]
        if len(same_unit) * len(common) > _MOST_CELLS:
            continue
        alike = [
            (name, other)
            for name, other in same_unit
            if _are_alike([(former.get(name), row.get(other)) for former, row in common])
        ]
        uses = Counter(itertools.chain.from_iterable(alike))
        found |= {(kind, name): (kind, other) for name, other in alike if uses[name] == uses[other] == 1}
    return found


def _are_alike(cells: Iterable[tuple[CellValue | None, CellValue | None]]) -> bool:
    """Return whether most cells of two columns are equal, and not only by zeros, ones or one truth value."""
    filled = [pair for pair in cells if pair != (None, None)]
    equal = [value for value, other in filled if value == other]
    return 2 * len(equal) > len(filled) and (len(set(equal)) > 1 or not {*equal} <= {0, 1})


def renamed(old: Table, renames: Mapping[ElementKey, str]) -> Table:
    """Return an old table whose rows have the new names of columns."""
    for kind, (_, rows) in SHEETS.items():
        names = {name: new for (of_kind, name), new in renames.items() if of_kind == kind}
        if names:
            cells = {
                key: {names.get(name, name): value for name, value in row.items()}
                for key, row in getattr(old, rows).items()
            }
            old = msgspec.structs.replace(old, **{rows: cells})
    return old


def judge(version: Version, changed: object) -> Sequence[Diagnostic]:  # noqa: ARG001 - see `Judgements`
    """Return nothing: any number may be meant; see `Judgements`."""
    return ()


def find_jumps(old: Version, new: Version, renames: Mapping[ElementKey, str]) -> Iterator[Diagnostic]:
    """Yield a warning for each column most of whose numbers jump as if its unit had changed."""
    for kind, (types, rows) in SHEETS.items():
        noun, units = rows.removesuffix("s"), getattr(old.snapshot, types)
        former = {renames.get((noun, key), key): row for key, row in getattr(old.snapshot, rows).items()}
        # a column with another name has the same numbers, mostly
        for column in (name for name, unit in getattr(new.snapshot, types).items() if units.get(name) == unit):
            cells = (
                (key, former.get(key, {}).get(column), row.get(column))
                for key, row in getattr(new.snapshot, rows).items()
            )
            numbers = [_Number(*cell) for cell in cells if all(map(is_number, cell[1:])) and cell[1] and cell[2]]
            if found := _find_jump(numbers, units[column]):
                words, (first, *_) = found
                place, unit = f"{noun} {first.row}", shown_unit(units[column])
                size = f"{first.before:g} to {first.after:g} {unit}".rstrip()
                message = f"{_noun(kind)} {column} jumps by {words}: {place} from {size}{more(found[1])}"
                hint, element = "check the unit in the header", f"{place} / {column}"
                yield Diagnostic(Severity.WARNING, "unit-jump", message, hint=hint, element=element)


def _find_jump(numbers: Sequence[_Number], unit: str) -> tuple[str, Sequence[_Number]] | None:
    """Return how most numbers of a column jump, and these numbers; None if they do not."""
    factor = statistics.median_low([abs(number.after / number.before) for number in numbers] or [1])
    alike = [number for number in numbers if abs(number.after - factor * number.before) < SAME_UNIT * abs(number.after)]
    ratio = factor if factor > 1 else 1 / (factor or 1)
    is_large = ratio > _LARGEST or (ratio > _LARGE and len({number.before for number in alike}) > 2)
    words = f"a factor of {factor:g}" if units_of(factor) or is_large else ""
    shifted = [number for number in numbers if abs(abs(number.after - number.before) - _CELSIUS) < SAME_UNIT]
    ways = (words, alike if words else ()), (f"{_CELSIUS} K", shifted if unit == "K" else ())
    return next((way for way in ways if 2 * len(way[1]) > len(numbers)), None)


def _noun(kind: str) -> str:
    return kind.replace("_", " ")
