"""Two versions of a model to classified changes, and to the files that these concern. Knows no domain.

Equality comes first: elements that are equal cost one comparison. Of those that differ, most do so in numbers alone,
which takes one walk; only those of which something comes or goes are handed to deepdiff, element by element.
"""

from __future__ import annotations

import operator
from collections import defaultdict
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from itertools import compress
from typing import Any, Protocol

import msgspec

from urdfsync.difference import ChangeClass, Difference, ElementKey, Kind, Meaning, Version
from urdfsync.domain import Artifact, Import, Order, Snapshot

NOISE = 1e-6
"""Relative change of a number that an exporter's rounding explains."""

_KINDS = {
    "dictionary_item_added": Kind.ADDED,
    "dictionary_item_removed": Kind.REMOVED,
    "iterable_item_added": Kind.ADDED,
    "iterable_item_removed": Kind.REMOVED,
    "type_changes": Kind.CHANGED,
    "values_changed": Kind.CHANGED,
}
"""What deepdiff calls the differences of plain data."""
_LEAVES = (str, int, float, bool, type(None))


class Comparing(Protocol):
    """What comparing needs of a domain."""

    def renames(self, old: Snapshot, new: Snapshot) -> Mapping[ElementKey, str]:
        """Elements that have another name and nothing else, in the same place, with the new names."""
        ...

    def comparable(self, snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
        """The snapshot under the new names."""
        ...

    def describe(
        self, differences: Sequence[Difference], old: Version, new: Version, options: Any
    ) -> Sequence[Meaning | None]:
        """The meaning of each difference, None for one that need not be reported."""
        ...


class Change(msgspec.Struct, frozen=True):
    """One change in the domain's words; `old` and `new` are plain data, None for what is not there."""

    path: tuple[str, ...]
    kind: Kind
    change_class: ChangeClass
    old: Any
    new: Any
    unit: str = ""

    @property
    def element(self) -> str:
        """The element that the change belongs to, for example `joint elbow`."""
        return self.path[0]

    @property
    def noise(self) -> bool:
        """Whether only the rounding of a number may have changed. It is applied like any other change."""
        if not (_is_number(self.old) and _is_number(self.new)):
            return False
        return bool(abs(self.new - self.old) <= NOISE * max(abs(self.old), abs(self.new)))

    @property
    def percent(self) -> float | None:
        """Change of a number relative to its old value; None without one, or if that is zero."""
        if not (_is_number(self.old) and _is_number(self.new)) or self.old == 0:
            return None
        return float(100 * (self.new - self.old) / abs(self.old))

    def __str__(self) -> str:
        """The path as people read it: `joint elbow / origin / xyz[2]`."""
        return " / ".join(self.path)


class Changes(msgspec.Struct, frozen=True):
    """Everything that differs between two versions of a model."""

    changes: tuple[Change, ...] = ()
    renames: Mapping[ElementKey, str] = msgspec.field(default_factory=dict)
    generator: bool = False
    """Whether what turns the model into files is another."""

    @property
    def change_class(self) -> ChangeClass:
        """The class that reaches farthest."""
        if self.generator:
            return ChangeClass.GENERATOR
        return max((change.change_class for change in self.changes), key=lambda c: c.rank, default=ChangeClass.NONE)

    @property
    def is_structural(self) -> bool:
        """Whether any element, type or connection changed."""
        return any(change.change_class is ChangeClass.STRUCTURAL for change in self.changes)

    @property
    def noise(self) -> bool:
        """Whether there are changes and all of them are numeric noise."""
        return bool(self.changes) and not self.generator and all(change.noise for change in self.changes)

    def by_element(self) -> Mapping[str, Sequence[Change]]:
        """The changes of each element that has any, in their order."""
        result: dict[str, list[Change]] = {}
        for change in self.changes:
            result.setdefault(change.element, []).append(change)
        return result


class Stale(msgspec.Struct, frozen=True):
    """Paths of the files to render, and of those that are no longer generated."""

    render: frozenset[str]
    gone: frozenset[str]


def compare(old: Version, new: Version, domain: Comparing, options: Any) -> Changes:
    """What changed from one version to another, with the domain's options of the new one."""
    renames: Mapping[ElementKey, str] = {}
    differences: list[Difference] = []
    if old.snapshot != new.snapshot:
        renames = domain.renames(old.snapshot, new.snapshot)
        old = msgspec.structs.replace(old, snapshot=domain.comparable(old.snapshot, renames))
        new = msgspec.structs.replace(new, snapshot=domain.comparable(new.snapshot, {}))
        differences += _of_snapshots(old.snapshot, new.snapshot)
    if old.imports is not None and new.imports is not None:
        differences += _of_imports(old.imports, new.imports)
    meanings = domain.describe(differences, old, new, options) if differences else ()
    changes = [_renamed(*element, name) for element, name in renames.items()]
    changes += [
        Change(meaning.path, difference.kind, meaning.change_class, difference.old, difference.new, meaning.unit)
        for difference, meaning in zip(differences, meanings, strict=True)
        if meaning is not None
    ]
    return Changes(tuple(changes), renames, old.generator != new.generator)


def stale(old: Mapping[str, Artifact | Order], new: Mapping[str, Artifact | Order]) -> Stale:
    """The files, by their paths, whose text can differ from one version's to the other's with the same templates.

    A text follows from its template and data alone, so a file that is not among them has the same text.
    """
    differing = map(operator.ne, map(old.get, new), new.values())  # in C: there are thousands
    return Stale(frozenset(compress(new, differing)), frozenset(old.keys() - new.keys()))


def moves(
    old: Mapping[str, tuple[str, str]], new: Mapping[str, tuple[str, str]], renames: Mapping[ElementKey, str]
) -> Mapping[str, str]:
    """Old path → new path of each file that belongs to the same element as before, but is at another place.

    Both mappings have the owner and the template of files by their path. A file moves with its element's new name, or
    with an identifier that had to give way to another element's. Where an element has several files of one template
    that moved, nothing is matched.
    """
    if old == new and not renames:
        return {}
    owners = {f"{kind} {name}": f"{kind} {renamed}" for (kind, name), renamed in renames.items()}
    leaving = {path: (owners.get(owner, owner), template) for path, (owner, template) in old.items()}
    staying = {path for path, key in leaving.items() if new.get(path) == key}
    sources = _by_value((path, key) for path, key in leaving.items() if path not in staying)
    targets = _by_value((path, key) for path, key in new.items() if path not in staying)
    pairs = ((paths, targets[key]) for key, paths in sources.items() if key in targets)
    return {one[0]: two[0] for one, two in pairs if len(one) == len(two) == 1}


def _by_value(items: Iterable[tuple[str, Hashable]]) -> Mapping[Hashable, Sequence[str]]:
    result: defaultdict[Hashable, list[str]] = defaultdict(list)
    for path, value in items:
        result[value].append(path)
    return result


def _renamed(kind: str, old: str, new: str) -> Change:
    return Change((f"{kind} {old}",), Kind.RENAMED, ChangeClass.STRUCTURAL, old, new)


def _of_snapshots(old: Snapshot, new: Snapshot) -> Iterator[Difference]:
    for part in dict.fromkeys([*new, *old]):
        before, after = old.get(part), new.get(part)
        if isinstance(before, Mapping) and isinstance(after, Mapping):
            yield from _of_elements(part, before, after)
        elif before != after:
            yield from _inside((part,), before, after)


def _of_elements(part: str, old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[Difference]:
    for name in sorted(old.keys() | new.keys()):
        if name not in old:
            yield Difference((part, name), Kind.ADDED, None, new[name])
        elif name not in new:
            yield Difference((part, name), Kind.REMOVED, old[name], None)
        elif old[name] != new[name]:
            yield from _inside((part, name), old[name], new[name])


def _inside(path: tuple[str, ...], old: Any, new: Any) -> Iterator[Difference]:
    """Differences of two values that are not equal, in the order of their paths."""
    found = _of_leaves(path, old, new)
    yield from sorted(_by_deepdiff(path, old, new) if found is None else found, key=lambda difference: difference.path)


def _of_leaves(path: tuple[Any, ...], old: Any, new: Any) -> list[Difference] | None:
    """Differences of two values with the same keys and lengths; None for other values."""
    if isinstance(old, _LEAVES) and isinstance(new, _LEAVES):
        return [Difference(path, Kind.CHANGED, old, new)] if old != new else []
    if isinstance(old, dict) and isinstance(new, dict) and old.keys() == new.keys():
        parts = [_of_leaves((*path, key), value, new[key]) for key, value in old.items()]
    elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        parts = [_of_leaves((*path, number), *values) for number, values in enumerate(zip(old, new, strict=True))]
    else:
        return None
    return None if any(part is None for part in parts) else [found for part in parts for found in part or ()]


def _by_deepdiff(path: tuple[Any, ...], old: Any, new: Any) -> list[Difference]:
    """Differences of any two values."""
    from deepdiff import DeepDiff  # takes 180 ms

    tree = DeepDiff(
        old,
        new,
        view="tree",
        zip_ordered_iterables=True,  # else a vector's number that moves is taken for one that comes and one that goes
        threshold_to_diff_deeper=0,  # else mappings with few keys in common are compared as a whole
        ignore_private_variables=False,
    )
    return [
        Difference(
            (*path, *level.path(output_format="list")),
            _KINDS[report],
            None if _KINDS[report] is Kind.ADDED else level.t1,
            None if _KINDS[report] is Kind.REMOVED else level.t2,
        )
        for report, levels in tree.items()
        for level in levels
        if level.t1 != level.t2  # 1 and 1.0 are of two types
    ]


def _of_imports(old: Mapping[str, Import], new: Mapping[str, Import]) -> Iterator[Difference]:
    """Imported files by their content: its hash stands for it."""
    for key in sorted(old.keys() | new.keys()):
        before, after = old.get(key), new.get(key)
        if before is None or after is None:
            kind = Kind.ADDED if before is None else Kind.REMOVED
            yield Difference(("imports", key), kind, before and before.target_hash, after and after.target_hash)
        elif (before.target_hash, before.facts) != (after.target_hash, after.facts):
            yield Difference(("imports", key), Kind.CHANGED, before.target_hash, after.target_hash)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
