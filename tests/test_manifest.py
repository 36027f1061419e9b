"""The recorded state: the same value gives the same text, and nothing but its own text is read."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.diagnostics import StateError
from urdfsync.domain import Import, Role
from urdfsync.manifest import (
    DependencyRecord,
    Generator,
    Manifest,
    Source,
    dump_model,
    dumps,
    load_model,
    loads,
    plain,
    text_hash,
)
from urdfsync.plan import FileRecord, State

MANIFEST = Manifest(
    package="Plant.Arm",
    class_="Arm",
    folder="modelica/Plant/Arm",
    source=Source("cad/arm.urdf", "5a", "7b"),
    generator=Generator("urdf", 3, "9c"),
    names={"links": {"base link": "base_link", "a.b": "a_b"}},
    dependencies={
        "package://arm/a b.stl": DependencyRecord("package://arm/a b.stl", "Resources/a_b.stl", "1f", "2f", 4),
        "lost.stl": DependencyRecord("lost.stl", "Resources/lost.stl"),
    },
    orders={"modelica/Plant/package.order": ("Arm",), "modelica/Plant/Arm/package.order": ("Links", "Arm")},
    files={
        "modelica/Plant/Arm/Links/Base_link.mo": FileRecord("link base link", Role.MODEL, "ab", State.EDITED),
        "modelica/Plant/Arm/Arm.mo": FileRecord("robot", Role.MODEL, "cd"),
        "modelica/Plant/Arm/New.mo": FileRecord("robot", Role.MODEL, None, State.WAITING),
        "modelica/Old/Left.mo": FileRecord("joint left", Role.RECORD, "ef", State.ORPHAN),
    },
)


def test_round_trip() -> None:
    assert loads(dumps(MANIFEST), "arm.toml") == MANIFEST


def test_text_is_for_people() -> None:
    text = dumps(MANIFEST)
    assert text.startswith("# What urdfsync last built for this robot.")
    entry = '[files."Links/Base_link.mo"]\nowner = "link base link"\nrole = "model"\nbase = "ab"\nstate = "edited"\n'
    assert entry in text
    assert '[files."../../Old/Left.mo"]' in text
    assert '"../package.order" = [\n    "Arm",\n]' in text


names = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12)
paths = st.from_regex(r"[a-z ]{1,5}(/[A-Za-z_. ]{1,8})?[a-z]", fullmatch=True)


@given(
    files=st.dictionaries(paths, st.builds(FileRecord, names, st.sampled_from(Role), st.none() | names)),
    mapping=st.dictionaries(names, names, min_size=1),
    uri=names,
)
def test_any_names_survive(files: dict[str, FileRecord], mapping: dict[str, str], uri: str) -> None:
    files = {f"m/P/{path}": record for path, record in files.items()}
    dependencies = {uri: DependencyRecord(uri, "Resources/a")}
    manifest = Manifest(
        package="P",
        class_="P",
        folder="m/P",
        source=MANIFEST.source,
        generator=MANIFEST.generator,
        names={"links": mapping},
        dependencies=dependencies,
        files=files,
    )
    text = dumps(manifest)
    assert loads(text, "p.toml") == manifest
    assert dumps(loads(text, "p.toml")) == text


def test_order_of_entries_does_not_matter() -> None:
    turned = msgspec.structs.replace(
        MANIFEST,
        files=dict(reversed(list(MANIFEST.files.items()))),
        orders=dict(reversed(list(MANIFEST.orders.items()))),
        dependencies=dict(reversed(list(MANIFEST.dependencies.items()))),
        names={"links": dict(reversed(list(MANIFEST.names["links"].items())))},
    )
    assert dumps(turned) == dumps(MANIFEST)


def test_line_endings_of_a_checkout_do_not_matter() -> None:
    assert loads(dumps(MANIFEST).replace("\n", "\r\n"), "arm.toml") == MANIFEST


def failure(text: str) -> str:
    with pytest.raises(StateError) as caught:
        loads(text, "arm.toml")
    (diagnostic,) = caught.value.diagnostics
    return str(diagnostic)


def test_merge_markers_are_named_with_their_line() -> None:
    text = dumps(MANIFEST).replace('hash = "5a"', '<<<<<<< HEAD\nhash = "5a"\n=======\nhash = "6a"\n>>>>>>> feature')
    line = text.splitlines().index("<<<<<<< HEAD") + 1
    assert failure(text).startswith(f"arm.toml:{line}: error: unresolved merge markers; restore it")


def test_a_newer_format_is_refused() -> None:
    text = dumps(MANIFEST).replace("format = 1", "format = 99")
    assert failure(text).startswith("arm.toml:4: error: a newer urdfsync wrote this state (format 99")


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("revision = 3", 'revision = "3"', "revision ="),
        ('role = "record"', 'role = "recrod"', 'role = "recrod"'),
        ('owner = "joint left"', "", '[files."../../Old/Left.mo"]'),
        ('"Arm",', "5,", '"../package.order"'),
        ('hash = "5a"', "", "[source]"),
        ('package = "Plant.Arm"', "", ""),
        ('folder = "modelica/Plant/Arm"', "folder = [1]", "folder ="),
        ("[generator]", "[generator", "[generator"),
    ],
)
def test_garbage_is_refused_with_its_line(old: str, new: str, line: str) -> None:
    text = dumps(MANIFEST).replace(old, new)
    message = failure(text)
    place = next((n for n, found in enumerate(text.splitlines(), 1) if line and found.startswith(line)), 0)
    assert message.startswith(f"arm.toml:{place}:" if place else "arm.toml: ")
    assert "restore it from version control" in message


SNAPSHOT = {"name": "arm", "links": {"b": {"m": 1.0}, "a": {"m": 0.1, "rgba": None}}}
IMPORTS = {"a.stl": Import("Resources/a.stl", "1f", "2f", 4, {"size": [1, 2.5]})}


def test_model_round_trip() -> None:
    model = load_model(dump_model(SNAPSHOT, IMPORTS), "arm.json")
    assert model.snapshot == SNAPSHOT
    facts = model.imports["a.stl"]
    assert (facts.source_hash, facts.converter, facts.facts) == ("1f", 4, {"size": [1, 2.5]})


def test_a_snapshot_is_used_as_it_will_come_back() -> None:
    assert list(plain(SNAPSHOT)["links"]) == ["a", "b"]
    assert plain({"a": (1, 2)}) == {"a": [1, 2]}


@pytest.mark.parametrize("text", ["", "[]", '{"snapshot": 1}', "<<<<<<< HEAD\n{}\n"])
def test_a_broken_model_is_refused(text: str) -> None:
    with pytest.raises(StateError, match=r"arm\.json.*restore it"):
        load_model(text, "arm.json")


def test_line_endings_are_normalised_before_hashing() -> None:
    assert text_hash("a\r\nb\n") == text_hash("a\nb\n") != text_hash("a\nb")
