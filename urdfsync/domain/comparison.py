"""Compares two versions of a model: finds and classifies the changes. Works for any domain."""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import (
    ChangeClass,
    ChangeKind,
    Domain,
    ElementKey,
    Import,
    Version,
    displaced,
    plain,
)
from urdfsync.domain.changes import Change
from urdfsync.domain.matching import Doubt, Matching, match

_KINDS = {
    "dictionary_item_added": ChangeKind.ADDED,
    "dictionary_item_removed": ChangeKind.REMOVED,
    "iterable_item_added": ChangeKind.ADDED,
    "iterable_item_removed": ChangeKind.REMOVED,
    "type_changes": ChangeKind.CHANGED,
    "values_changed": ChangeKind.CHANGED,
}
"""Names of deepdiff for the differences of plain data."""


class Difference(msgspec.Struct, frozen=True):
    """One place at which two versions differ; `old` is None for an addition, `new` for a removal."""

    path: tuple[str | int, ...]
    """Keys and indices (from 0) that lead to the value in plain data; `("imports", key)` for an imported file."""
    kind: ChangeKind
    old: Any
    new: Any

    def change(self, path: tuple[str, ...], change_class: ChangeClass, unit: str = "") -> Change:
        """Return the difference in the domain's words: `("joint elbow", "origin", "xyz[2]")` begins with the element.

        `unit` is the unit of both values, or `old → new` for two units; empty for a value without unit.
        """
        return Change(path, self.kind, change_class, self.old, self.new, unit)


class Changes(msgspec.Struct, frozen=True):
    """All differences of two versions of a model."""

    KEYS = ("change_class", "generator", "options", "changes", "doubts")

    changes: tuple[Change, ...] = ()
    """Structural changes first, then changed numbers, then rounding and unmodelled parts."""
    renames: Mapping[ElementKey, str] = msgspec.field(default_factory=dict)
    doubts: tuple[Doubt, ...] = ()
    """Elements that have the name of an old element, but may be other parts."""
    generator: bool = False
    """Whether templates, options, or the version of urdfsync differ."""
    options: tuple[str, ...] = ()
    """The changed options; empty if templates or the version of urdfsync differ."""
    package: str = ""
    """The former and the present name of the package, if its name changed, and templates and options did not."""

    @property
    def change_class(self) -> ChangeClass:
        """The class with the farthest reach among all differences."""
        if self.generator:
            return ChangeClass.GENERATOR
        return max((change.change_class for change in self.changes), key=lambda c: c.rank, default=ChangeClass.NONE)

    @property
    def noise(self) -> bool:
        """Whether there are changes and all of them are numeric noise."""
        return bool(self.changes) and not self.generator and all(change.noise for change in self.changes)

    def by_element(self) -> Mapping[str, Sequence[Change]]:
        """Return the changes of each changed element, in order."""
        result: dict[str, list[Change]] = {}
        for change in self.changes:
            result.setdefault(change.element, []).append(change)
        return result


def compare(old: Version, new: Version, domain: Domain, options: Any, matching: Matching | None = None) -> Changes:
    """Return the changes from one version to another; `options` are the domain's, in the new version.

    `matching` pairs elements; if it is None, this finds the pairs.
    """
    if matching is None:
        is_same = old.snapshot == new.snapshot
        matching = Matching() if is_same else match(domain.features(old.snapshot), domain.features(new.snapshot))
    renames = matching.renames
    describe = domain.describe or functools.partial(_describe, domain=domain)
    changes = [
        Change((f"{kind.replace('_', ' ')} {name}",), ChangeKind.RENAMED, ChangeClass.STRUCTURAL, name, renamed)
        for (kind, name), renamed in renames.items()
    ]
    if old.snapshot != new.snapshot or (None not in (old.imports, new.imports) and old.imports != new.imports):
        changes += describe(old, new, renames, options)
    return Changes(tuple(sorted(changes, key=_weight)), renames, tuple(matching.doubts.values()))


def by_texts(changes: Changes, owners: Collection[str]) -> Changes:
    """Reclassify the changes of a domain without `describe`; `owners` are the elements of models whose text changed.

    Changes of these elements become structural. If only a model of the whole has another text, all changes do.
    """
    is_whole = not changes.generator and changes.change_class.rank < ChangeClass.STRUCTURAL.rank
    is_whole = is_whole and bool(owners - changes.by_element().keys())
    raised = [
        msgspec.structs.replace(change, change_class=ChangeClass.STRUCTURAL)
        if is_whole or change.element in owners
        else change
        for change in changes.changes
    ]
    return msgspec.structs.replace(changes, changes=tuple(sorted(raised, key=_weight)))


def _describe(
    old: Version,
    new: Version,
    renames: Mapping[ElementKey, str],
    options: Any,  # noqa: ARG001 - see `Describe`
    *,
    domain: Domain,
) -> Iterator[Change]:
    """Yield the changes of a domain without `describe`: `("parts", "motor", "mass")` is `part motor / mass`."""
    snapshot = domain.parts.renamed(old.snapshot, renames) if domain.parts else old.snapshot
    before = _under_new_names(plain(snapshot), renames)
    for difference in find_differences(old, new, before, plain(new.snapshot)):
        kind, *path = map(str, difference.path)
        words = (f"{kind.removesuffix('s').replace('_', ' ')} {path[0]}", *path[1:]) if path else (kind,)
        is_value = difference.kind is ChangeKind.CHANGED
        of_value = domain.unit(new.snapshot, [kind, *path])
        yield difference.change(words, ChangeClass.PARAMETER if is_value else ChangeClass.STRUCTURAL, of_value)


def _under_new_names(data: Mapping[str, Any], renames: Mapping[ElementKey, str]) -> Mapping[str, Any]:
    """Return plain data by kind and name, with new names of elements, and without `displaced` elements."""
    gone, moved = displaced(renames), dict[str, Any]()
    for part, elements in data.items():
        kind = part.removesuffix("s")
        if isinstance(elements, Mapping) and any(of_kind == kind for of_kind, _ in renames):
            kept = {name: value for name, value in elements.items() if (kind, name) not in gone}
            elements = {renames.get((kind, name), name): value for name, value in kept.items()}
        moved[part] = elements
    return moved


def _weight(change: Change) -> tuple[bool, ...]:
    """Return a sort key for people: renames first, then whole elements, structure, numbers, and rounding."""
    is_structural, is_quiet = (
        change.change_class is ChangeClass.STRUCTURAL,
        change.change_class is ChangeClass.UNMODELLED,
    )
    return change.kind is not ChangeKind.RENAMED, not is_structural, len(change.path) > 1, change.noise or is_quiet


def find_differences(
    old: Version, new: Version, old_data: Mapping[str, Any], new_data: Mapping[str, Any]
) -> Iterator[Difference]:
    """Yield the differences of two versions: of their snapshots, then of their imports.

    The snapshots are given as plain data by kind and name; callers may leave out equal elements.
    """
    yield from _of_snapshots(old_data, new_data)
    if old.imports is not None and new.imports is not None:
        yield from _of_imports(old.imports, new.imports)


def _of_snapshots(old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[Difference]:
    for part in dict.fromkeys([*new, *old]):
        before, after = old.get(part), new.get(part)
        if not (isinstance(before, Mapping) and isinstance(after, Mapping)):
            yield from _of_values((part,), before, after)
            continue
        for name in sorted(before.keys() | after.keys()):
            if name not in before:
                yield Difference((part, name), ChangeKind.ADDED, None, after[name])
            elif name not in after:
                yield Difference((part, name), ChangeKind.REMOVED, before[name], None)
            else:
                yield from _of_values((part, name), before[name], after[name])


def _of_values(path: tuple[str, ...], old: Any, new: Any) -> list[Difference]:
    """Return the differences of two values, in the order of their paths."""
    if old == new:
        return []
    differences = of_leaves(path, old, new)
    if differences is None:
        differences = by_deepdiff(path, old, new)
    return sorted(differences, key=lambda difference: difference.path)


def of_leaves(path: tuple[Any, ...], old: Any, new: Any) -> list[Difference] | None:
    """Return the differences of two values with the same keys and lengths; None for other values.

    Loading deepdiff takes 110 ms: too long for the row "one mass changed, whole process, 100 links" of docs/speed.md. A
    property test compares the results of this function and of deepdiff.
    """
    if isinstance(old, dict) and isinstance(new, dict):
        if old.keys() != new.keys():
            return None
        pairs = [((*path, key), value, new[key]) for key, value in old.items()]
    elif isinstance(old, list) and isinstance(new, list):
        if len(old) != len(new):
            return None
        pairs = [((*path, index), *values) for index, values in enumerate(zip(old, new, strict=True))]
    elif isinstance(old, dict | list) or isinstance(new, dict | list):
        return None
    else:
        return [Difference(path, ChangeKind.CHANGED, old, new)] if old != new else []
    differences: list[Difference] = []
    for pair in pairs:
        part = of_leaves(*pair)
        if part is None:
            return None
        differences += part
    return differences


def by_deepdiff(path: tuple[Any, ...], old: Any, new: Any) -> list[Difference]:
    """Return the differences of any two values."""
    from deepdiff import DeepDiff  # see `of_leaves`

    tree = DeepDiff(
        old,
        new,
        view="tree",
        zip_ordered_iterables=True,  # else a changed number of a vector counts as a removal and an addition
        threshold_to_diff_deeper=0,  # else mappings with few common keys are compared as a whole
        ignore_private_variables=False,
    )
    return [
        Difference(
            (*path, *level.path(output_format="list")),
            _KINDS[report],
            None if _KINDS[report] is ChangeKind.ADDED else level.t1,
            None if _KINDS[report] is ChangeKind.REMOVED else level.t2,
        )
        for report, levels in tree.items()
        for level in levels
        if level.t1 != level.t2  # deepdiff reports 1 → 1.0 as a change of type
    ]


def _differ_in(old: Mapping[str, Any], new: Mapping[str, Any]) -> bool:
    """Return whether the two mappings differ at a common key."""
    return any(old[name] != new[name] for name in old.keys() & new.keys())


def _of_imports(old: Mapping[str, Import], new: Mapping[str, Import]) -> Iterator[Difference]:
    """Yield the differences of imported files, as hashes of their contents."""
    for key in sorted(old.keys() | new.keys()):
        before, after = old.get(key), new.get(key)
        if before is None or after is None:
            kind = ChangeKind.ADDED if before is None else ChangeKind.REMOVED
            yield Difference(("imports", key), kind, before and before.target_hash, after and after.target_hash)
        # a robot without colliding shapes asks for fewer facts of the same file
        elif before.target_hash != after.target_hash or _differ_in(before.facts, after.facts):
            hashes = before.target_hash, after.target_hash
            if before.target_hash == after.target_hash:  # the contents are equal; only facts differ, such as colours
                hashes = before.source_hash, after.source_hash
            yield Difference(("imports", key), ChangeKind.CHANGED, *hashes)
