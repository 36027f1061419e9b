"""Finds parts and changes of a model that no text of the package shows: templates need not use all of a model."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from collections.abc import Set as AbstractSet
from typing import Any

import msgspec

from urdfsync.changes import Changes
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import Artifact, ChangeClass, ChangeKind, Domain, Order, Reading, Target, Version
from urdfsync.domain.changes import Change
from urdfsync.engine.package.generate import Package
from urdfsync.files import Templates

CODE = "unused"
IMPORTS = "imports"
"""Stands for the owners of imported files."""


def find_unused(
    domain: Domain, version: Version, target: Target, options: Any, templates: Templates, package: Package
) -> frozenset[str]:
    """Return the parts of a model without which its package would have the same texts."""
    parts = domain.parts
    without = parts.without_each(version.snapshot, options) if parts else {}
    artifacts = (domain.artifacts(snapshot, version.imports or {}, target, options) for snapshot in without.values())
    pairs = zip(without, artifacts, strict=True)
    return frozenset(part for part, others in pairs if not _differs(package, others, templates, target.package))


def _differs(package: Package, others: Iterable[Artifact | Order], templates: Templates, name: str) -> bool:
    """Return whether a package of other artifacts has a file with another text, or has other files."""
    paths, of_whole = set[str](), list[Artifact]()

    def is_other(artifact: Artifact) -> bool:
        try:
            return artifact.path in _changed_texts(Package([artifact], templates, name), package)
        except ConfigError:  # a template needs what the other artifact lacks
            return True

    for artifact in others:  # one by one: the file of the first row shows nearly each column of a table
        if isinstance(artifact, Artifact):
            paths.add(artifact.path)
            if " " not in artifact.owner:  # rendering a model of 10,000 rows takes as long as thousands of its rows
                of_whole.append(artifact)
            elif is_other(artifact):
                return True
    return paths != package.artifacts.keys() or any(map(is_other, of_whole))


def _changed_paths(package: Package, other: Package) -> Iterator[str]:
    """Yield the paths of files that differ in two packages, or that only one of them has."""
    yield from package.artifacts.keys() ^ other.artifacts.keys()
    yield from _changed_texts(package, other)


def _changed_texts(package: Package, other: Package) -> Iterator[str]:
    """Yield the paths of files with another text in the other package."""
    for path in sorted(package.changed_since(other) & other.artifacts.keys()):
        if package.hash(path) != other.hash(path):
            yield path


def changed_owners(package: Package, last: Package) -> set[str]:
    """Return the owners of text files that differ in two packages, or that only one of them has."""
    return {{**last.owners, **package.owners}[path] for path in _changed_paths(package, last)}


def with_unshown(
    news: Changes, domain: Domain, unused: Collection[str], owners: Collection[str], changed: AbstractSet[str]
) -> Changes:
    """Return the changes, of which those that no file shows count as unmodelled.

    `owners` own files, `changed` own files that differ; `unused` are parts of the model. A differing file shows each
    change of its owner. A file whose owner has no change, such as the robot model, may show any change. So may any file
    show a change of an element without a file.
    """
    if news.renames:  # no text shows which of two parts that look alike is which, but edits follow them
        return news
    elements = set(news.by_element())
    is_whole = any(owner not in elements or " " not in owner for owner in changed - {IMPORTS})

    def is_unused(change: Change) -> bool:
        return bool(domain.parts and domain.parts.part_of(change.path) in unused)

    def is_shown(change: Change) -> bool:
        if is_unused(change):
            return False
        return is_whole or change.element in changed or (bool(changed) and change.element not in owners)

    silent = (ChangeClass.NONE, ChangeClass.UNMODELLED)
    unshown = [change for change in news.changes if change.change_class not in silent and not is_shown(change)]
    changes = [
        msgspec.structs.replace(change, change_class=ChangeClass.UNMODELLED) if change in unshown else change
        for change in news.changes
    ]
    told = (change for change in unshown if not is_unused(change))
    return msgspec.structs.replace(news, changes=tuple(changes), unshown=tuple(told))


def tell_unused(unused: Iterable[str], unshown: Iterable[Change], file: str, reading: Reading) -> Iterator[Diagnostic]:
    """Yield a warning for each part that no template uses, and for each change of other parts that no text shows."""
    places = {f"no template uses {part}": part for part in sorted(unused)}
    verbs = {ChangeKind.ADDED: "is new", ChangeKind.REMOVED: "is gone"}
    places |= {
        f"{change} {verbs.get(change.kind, 'changed')}, but no template uses it": change.element for change in unshown
    }
    hint = f'use it in a template, or set `ignore = ["{CODE}"]`'
    for message, place in places.items():
        yield Diagnostic(Severity.WARNING, CODE, message, *reading.place(place, file), hint=hint)
