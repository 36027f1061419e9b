"""The class of a change says which files it reaches: tested against what the templates print."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from pathlib import Path
from random import Random
from typing import NamedTuple

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import mutations
from support.cases import often
from support.packages import RENDERER, read

from urdfsync.common.files import Templates
from urdfsync.domain import Artifact, ChangeClass, Import, Lookup, Order, Role, Snapshot, Target, Version
from urdfsync.domain.comparison import compare
from urdfsync.engine.package.generate import Package
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options

TARGET = Target("Robots.Arm", "Arm")
LOOKUP = Lookup(Path("/robots/arm.urdf"))
OPTIONS = st.builds(
    Options,
    base=st.sampled_from(["fixed", "floating"]),
    collisions=st.booleans(),
    meshes=st.sampled_from(["import", "import", "skip"]),
    drives=st.sampled_from(["joint", "motor"]),
)
REACH = {ChangeClass.NONE: set(), ChangeClass.UNMODELLED: set(), ChangeClass.PARAMETER: {Role.RECORD}}
"""Roles of the files that a class may reach."""


class File(NamedTuple):
    role: Role
    owner: str
    text: str


def artifacts(version: Version, options: Options) -> list[Artifact | Order]:
    return list(DOMAIN.artifacts(version.snapshot, version.imports or {}, TARGET, options))


def render(version: Version, options: Options) -> Mapping[str, File]:
    """Every file of the package by its path."""
    result = {}
    for artifact in artifacts(version, options):
        if isinstance(artifact, Order):
            result[artifact.path] = File(Role.ORDER, "robot", "\n".join(artifact.names))
        else:
            text = RENDERER.render(artifact.template, artifact.data)
            result[artifact.path] = File(artifact.role, artifact.owner, text)
    return result


def referenced(version: Version, options: Options) -> Version:
    """The version with the imports that a build would have: of each mesh only the facts that its shapes ask for."""
    found, imports = version.imports or {}, dict[str, Import]()
    for dependency in DOMAIN.dependencies(version.snapshot, LOOKUP, options, {}):
        if file := found.get(dependency.key):
            facts = {name: value for name, value in file.facts.items() if name in dependency.facts}
            imports[dependency.key] = msgspec.structs.replace(file, facts=facts)
    return msgspec.structs.replace(version, imports=imports)


def differing(before: Mapping[str, File], after: Mapping[str, File]) -> Set[str]:
    return {path for path in before.keys() | after.keys() if before.get(path) != after.get(path)}


def check(old: Version, new: Version, options: Options) -> None:
    """The class, and the elements with changes, agree with the files that differ."""
    changes, before, after = compare(old, new, DOMAIN, options), render(old, options), render(new, options)
    [root] = {link.name for link in old.snapshot.links} - {joint.child for joint in old.snapshot.joints}
    found = [file for path in differing(before, after) for file in (before.get(path), after.get(path)) if file]
    roles = {file.role for file in found}
    listed = [f"{change.change_class}: {change}" for change in changes.changes]
    if changes.change_class is ChangeClass.STRUCTURAL:
        assert roles & {Role.MODEL, Role.PACKAGE, Role.ORDER}, listed
    else:
        assert roles <= REACH[changes.change_class], listed
        if not any(change.element.startswith("mesh ") for change in changes.changes):
            reached = {"robot", *changes.by_element()}
            if any(change.path[1:] == ("inertial",) for change in changes.changes):
                reached.add(f"link {root}")  # which is a body where no other link is
            assert {file.owner for file in found} <= reached


@pytest.mark.slow
@often(60)
@given(st.randoms(use_true_random=False), st.integers(0, 3), OPTIONS)
def test_the_class_of_random_changes_says_which_files_differ(random: Random, count: int, options: Options) -> None:
    first = mutations.version(random)
    second = mutations.mutated(first, random, count)
    old, new = referenced(first, options), referenced(second, options)
    check(old, new, options)
    before, after = render(old, options), render(new, options)
    one, two = (Package(artifacts(version, options), Templates((), ""), "") for version in (old, new))
    gone = one.artifacts.keys() - two.artifacts.keys()
    orders = {path for path in one.orders.keys() | two.orders.keys() if one.orders.get(path) != two.orders.get(path)}
    assert differing(before, after) <= two.changed_since(one) | gone | orders


@pytest.mark.slow
@given(st.randoms(use_true_random=False), OPTIONS)
def test_the_class_of_drives_says_which_files_differ(random: Random, options: Options) -> None:
    old, new = (referenced(version, options) for version in mutations.driven_and_passive(random))
    check(old, new, options)


def everything_found(snapshot: Snapshot, options: Options) -> Mapping[str, Import]:
    """Every mesh of a model as if it were there."""
    facts = {"bounds": [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]], "hull": [[0.0, 0.0, 0.0]]}
    found = DOMAIN.dependencies(snapshot, LOOKUP, options, {})
    return {
        one.key: Import(one.target, "", "", {name: facts[name] for name in facts if name in one.facts}) for one in found
    }


def versions(history: Path, options: Options, meshes: bool) -> Iterator[Version]:
    """The versions of a history that can be read."""
    for file in sorted(history.glob("*.urdf")):
        snapshot = read(file.read_bytes(), file.name).snapshot
        if snapshot is not None:
            yield Version(snapshot, everything_found(snapshot, options) if meshes else {})
