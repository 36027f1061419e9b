"""The recorded state: the same value gives the same text, and nothing but its own text is read."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.diagnostics import StateError
from urdfsync.domain import Role
from urdfsync.state.manifest import DependencyRecord, Generator, Manifest, Source, dumps, loads
from urdfsync.state.record import Choice, FileRecord
from urdfsync.state.record import RecordState as State

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
        "modelica/Plant/Arm/Joints/Left.mo": FileRecord("joint left", Role.RECORD, "ef", State.ORPHAN),
    },
)


def test_text_is_for_people() -> None:
    text = dumps(MANIFEST)
    assert text.startswith("# What urdfsync last built for this robot.")
    entry = '[files."Links/Base_link.mo"]\nowner = "link base link"\nrole = "model"\nbase = "ab"\nstate = "edited"\n'
    assert entry in text
    assert '"../package.order" = [\n    "Arm",\n]' in text
    assert not any(word in text for word in ("origin", "choice", "chosen_for", "stands")), "nothing waits"


names = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12)
paths = st.from_regex(r"[a-z ]{1,5}(/[A-Za-z_ ][A-Za-z_. ]{0,7})?[a-z]\.mo", fullmatch=True)
copies = paths.map("Resources/{}".format)


records = st.builds(
    FileRecord,
    names,
    st.sampled_from([Role.MODEL, Role.RECORD, Role.PACKAGE]),
    st.none() | names,
    st.sampled_from(State),
    st.none() | paths.map("m/P/{}".format),
    st.none() | names,
    st.none() | st.sampled_from(Choice),
)
manifests = st.builds(
    Manifest,
    package=st.just("P"),
    class_=names,
    folder=st.just("m/P"),
    source=st.just(MANIFEST.source),
    generator=st.just(MANIFEST.generator),
    options=st.sampled_from([None, {}, {"ground": True, "names": ["a"], "inner": {"x": 1.5}}]),
    names=st.dictionaries(names, st.dictionaries(names, names, max_size=3), max_size=2),
    dependencies=st.dictionaries(names, st.builds(DependencyRecord, names, copies, st.none() | names), max_size=2),
    orders=st.dictionaries(
        st.sampled_from(["m/P/package.order", "m/P/A/package.order", "m/Q/package.order"]),
        st.lists(names, max_size=3).map(tuple),
    )
    | st.just({"m/package.order": ("P",)}),
    files=st.dictionaries(paths.map("m/P/{}".format) | st.just("m/Q/A.mo"), records, max_size=4),
)


@pytest.mark.slow
@given(manifests)
def test_what_comes_back_is_known_before(manifest: Manifest) -> None:
    """Whoever writes a manifest need not read it to know what it says."""
    text, expected = dumps(manifest), manifest.recorded
    found = loads(text, "p.toml")
    assert msgspec.json.encode(found) == msgspec.json.encode(expected), "in the same order, too"
    assert found == expected
    assert dumps(found) == text
    assert "m/Q/A.mo" not in found.files


def test_order_of_entries_does_not_matter() -> None:
    turned = msgspec.structs.replace(
        MANIFEST,
        files=dict(reversed(list(MANIFEST.files.items()))),
        orders=dict(reversed(list(MANIFEST.orders.items()))),
        dependencies=dict(reversed(list(MANIFEST.dependencies.items()))),
        names={"links": dict(reversed(list(MANIFEST.names["links"].items())))},
    )
    assert dumps(turned) == dumps(MANIFEST)


def failure(text: str) -> str:
    with pytest.raises(StateError) as caught:
        loads(text, "arm.toml")
    return str(caught.value)


ORIGIN = "modelica/Plant/Arm/Links/Old.mo"
WAITS = FileRecord(
    "link new", Role.MODEL, "ab", State.CONFLICT, origin=ORIGIN, choice=Choice.TAKE, chosen_for="de", replaced_hash="fa"
)
WAITING = msgspec.structs.replace(MANIFEST, files={**MANIFEST.files, "modelica/Plant/Arm/Links/New.mo": WAITS})
NO_STATE = ": error: this is no state of urdfsync: "
MARKERS = '<<<<<<< HEAD\nhash = "5a"\n=======\nhash = "6a"\n>>>>>>> feature'


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('hash = "5a"', MARKERS, ":11: error: unresolved merge markers; restore it from version control"),
        ("[generator]", "[generator", ":14:11: error: expected ']' at the end of a table declaration; restore it from"),
        ("format = 1", "format = 99", ": error: a newer urdfsync wrote this state (format 99"),
        ('path = "cad/', 'path = "cad/\\u0000', ": error: the recorded path 'cad/\\x00arm.urdf' does not belong"),
        ('choice = "take"', 'choice = "guess"', NO_STATE + "Invalid enum value 'guess' - at `$.files[...].choice`"),
        ("revision = 3", 'revision = "3"', NO_STATE),
        ('owner = "joint left"', "", NO_STATE),
        ('"Arm",', "5,", NO_STATE),
        ('package = "Plant.Arm"', "", NO_STATE),
        ('folder = "modelica/Plant/Arm"', "folder = [1]", NO_STATE),
    ],
)
def test_garbage_is_refused(old: str, new: str, message: str) -> None:
    assert failure(dumps(WAITING).replace(old, new)).startswith(f"arm.toml{message}")


def test_a_file_that_waits_has_its_origin_below_the_package_in_the_text() -> None:
    text = dumps(WAITING)
    entry = text[text.index('[files."Links/New.mo"]') :].partition("\n\n")[0]
    assert 'origin = "Links/Old.mo"\n' in entry
    assert 'choice = "take"\nchosen_for = "de"' in entry
    assert loads(text, "arm.toml") == WAITING, "and from the configuration's folder in the value"


PLACES = [
    *"../../victim.txt ../package.mo .. . /etc/passwd C:/victim.txt Links/../../victim.txt Links/../Arm.mo".split(),
    *("./Arm.mo", "Links//Arm.mo", "Links/", "Links\\..\\..\\victim.txt", "", "a\0b.mo", "a\nb.mo", "a\x1b[2J.mo"),
]
SPOTS = {
    "Links/Base_link.mo": ["a.txt", "Resources/a.stl", ".git/x.mo", "Links/.hidden/A.mo"],
    "Links/Old.mo": ["Links/Old.txt", ".git/Old.mo"],
    "../package.order": ["../../package.order", "Links/Arm.mo", ".git/package.order"],
    "Resources/lost.stl": ["Links/Arm.mo", "arm.stl", "Resources/.ssh/a"],
    "modelica/Plant/Arm": ["modelica/Plant", "a/../Plant/Arm", "XPlant/Arm"],
}
"""Paths of a file, an origin, an order, a dependency and the folder, with others that are wrong there alone."""


@pytest.mark.parametrize(("path", "place"), [(path, place) for path in SPOTS for place in PLACES + SPOTS[path]])
def test_a_path_that_no_build_writes_is_refused(path: str, place: str) -> None:
    quoted = "".join(char if char.isprintable() and char != "\\" else f"\\u{ord(char):04x}" for char in place)
    message = failure(dumps(WAITING).replace(path, quoted, 1))
    assert message.startswith(f"arm.toml: error: the recorded path {place!r} does not belong to the package")
    assert "`Plant.Arm`; restore the state from version control, or delete it" in message
    assert message.isprintable()
