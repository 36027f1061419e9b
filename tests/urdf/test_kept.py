"""What a domain keeps of its last package: it spares work, and never shows in the next one."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any

import msgspec
from hypothesis import given, settings
from hypothesis import strategies as st
from support import mutations
from support.packages import RENDERER

from urdfsync.domain import Artifact, Lookup, Order, Parts, Piece, Snapshot, Target, Version
from urdfsync.urdf.domain import DOMAIN, UrdfDomain
from urdfsync.urdf.kept import Kept
from urdfsync.urdf.options import Options

TARGETS = (Target("Robots.Arm", "Arm"), Target("Robots.Arm", "Leg"), Target("Arm", "Arm"))
OPTIONS = (
    Options(),
    Options(base="floating"),
    Options(collisions=False, visualizer="visualization2"),
    Options(approach=("record",)),
    Options(approach=("package", "record"), meshes="skip"),
)


def exactly(value: object) -> bytes:
    """Tells 1 from 1.0, and 0.0 from -0.0."""
    return msgspec.json.encode(value, order="sorted")


def written_otherwise(value: Any, random: Random) -> Any:
    """The same data in new objects, in which numbers may have another type or zeros another sign."""
    if isinstance(value, Mapping):
        return {key: written_otherwise(item, random) for key, item in value.items()}
    if isinstance(value, list):
        return [written_otherwise(item, random) for item in value]
    if isinstance(value, float) and value == 0 and random.random() < 0.1:
        return -value
    whole = isinstance(value, float) and value == int(value)
    return int(value) if whole and random.random() < 0.1 else value


def sharing(last: Snapshot, new: Snapshot, random: Random) -> Snapshot:
    """A snapshot of which most elements that did not change are those of the last one."""

    def element(part: str, name: str, value: Any) -> Any:
        before = last[part].get(name)
        same = before is not None and exactly(before) == exactly(value)
        return before if same and random.random() < 0.8 else value

    shared = {part: {n: element(part, n, value) for n, value in new[part].items()} for part in ("links", "joints")}
    return {**new, **shared}


def histories(random: Random) -> Sequence[Version]:
    """Versions of one robot, each with elements of the one before."""
    versions = [mutations.version(random)]
    for _ in range(4):
        changed = mutations.mutated(versions[-1], random, random.randrange(3))
        again = written_otherwise(changed.snapshot, random) if random.random() < 0.5 else changed.snapshot
        versions.append(Version(sharing(versions[-1].snapshot, again, random), copy.deepcopy(changed.imports)))
    return versions


def seen(files: Sequence[Artifact | Order]) -> list[Any]:
    """All that a build can see of a package, numbers by their spelling; the texts come last."""
    data = [repr(f) if isinstance(f, Order) else (f.path, f.role, f.template, f.owner, _plain(f.data)) for f in files]
    return [*data, *(RENDERER.render(f.template, f.data) for f in files if isinstance(f, Artifact))]


def _plain(value: Any) -> str:
    """The data; of its pieces without the texts that they have kept."""
    if isinstance(value, Mapping):
        return str({key: _plain(item) for key, item in value.items()})
    if isinstance(value, list):
        return str([_plain(item) for item in value])
    return repr(value.of if isinstance(value, Piece) else value)


@settings(max_examples=60)
@given(st.randoms(use_true_random=False))
def test_files_made_with_parts_of_the_last_are_those_made_without(random: Random) -> None:
    parts: Parts = {}
    target, options = TARGETS[0], OPTIONS[0]
    for version in histories(random):
        if random.random() < 0.3:
            target, options = random.choice(TARGETS), random.choice(OPTIONS)
        made_of = version.snapshot, version.imports or {}, Target(*msgspec.structs.astuple(target)), options
        assert seen(DOMAIN.artifacts(*made_of, parts)) == seen(DOMAIN.artifacts(*made_of))


@settings(max_examples=25)
@given(st.randoms(use_true_random=False))
def test_elements_that_are_the_same_objects_have_the_same_files(random: Random) -> None:
    parts: Parts = {}
    first = mutations.version(random)
    made_of = first.imports or {}, TARGETS[0], OPTIONS[0]
    before = DOMAIN.artifacts(first.snapshot, *made_of, parts)
    name = random.choice(list(first.snapshot["links"]))
    heavier = {**first.snapshot["links"][name], "inertial": {"mass": random.random() + 100}}
    links = {**first.snapshot["links"], name: heavier}
    after = DOMAIN.artifacts({**first.snapshot, "links": links}, *made_of, parts)
    own = [file for file in before if isinstance(file, Artifact) and file.path.startswith(("Links/", "Joints/"))]
    shared = {id(file) for file in after}
    elements = [file for file in own if not file.path.endswith("/package.mo")]
    assert {file.owner for file in elements if id(file) not in shared} == {f"link {name}"}


def test_what_was_not_asked_for_is_forgotten() -> None:
    parts: Parts = {}
    one, two = [1.0], [2.0]
    for names in ({"a": one, "b": two}, {"a": one}):
        kept = Kept(parts, "kind")
        assert {name: kept.get(name, tuple, made_of) for name, made_of in names.items()} == {
            name: tuple(made_of) for name, made_of in names.items()
        }
    assert parts["kind"].keys() == {"a"}


def test_what_is_equal_but_another_object_is_made_anew() -> None:
    parts: Parts = {}
    assert str(Kept(parts, "kind").get("a", tuple, [0.0])) == "(0.0,)"
    assert str(Kept(parts, "kind").get("a", tuple, [-0.0])) == "(-0.0,)"


def test_of_many_elements_only_those_that_are_other_objects_are_made_anew() -> None:
    made: list[str] = []

    def make(name: str, element: list[float], common: str) -> str:
        made.append(name)
        return f"{common} {element}"

    parts: Parts = {}
    a, b, c = [0.0], [2.0], [3.0]
    for elements, common, anew in (
        ({"a": a, "b": b, "c": c}, "x", "abc"),
        ({"c": c, "b": b}, "x", ""),
        ({"c": c, "b": [2.0], "a": a}, "x", "ba"),
        ({"a": [-0.0], "c": c}, "x", "a"),
        ({"a": a, "c": c}, "y", "ac"),
        ({}, "y", ""),
        ({"a": a}, "y", "a"),
    ):
        made.clear()
        found = Kept(parts, "kind").each("name", make, elements, common)
        assert list(found.items()) == [(name, f"{common} {element}") for name, element in elements.items()]
        assert made == list(anew)


def test_an_element_may_be_none() -> None:
    parts: Parts = {}
    for elements in ({"a": None}, {"a": None, "b": None}):
        found = Kept(parts, "kind").each("name", lambda name, element: f"{name} {element}", elements)
        assert list(found.values()) == [f"{name} None" for name in elements]


@settings(max_examples=15)
@given(st.randoms(use_true_random=False))
def test_the_files_that_a_robot_refers_to_are_those_of_a_domain_that_keeps_nothing(random: Random) -> None:
    keeping, lookup = UrdfDomain(), Lookup(Path("/cad/arm.urdf"))
    assert keeping.read(b'<robot name="r"><link name="l"/></robot>', "r", Options(cross_check=False), {}).snapshot
    for version in histories(random):
        found = keeping.dependencies(version.snapshot, lookup, OPTIONS[0], {})
        assert found == UrdfDomain().dependencies(version.snapshot, lookup, OPTIONS[0], {})


def test_without_parts_nothing_is_kept() -> None:
    made: list[int] = []
    number = 1000
    for _ in range(2):
        Kept(None, "kind").get("a", made.append, number)
    assert made == [number, number]
