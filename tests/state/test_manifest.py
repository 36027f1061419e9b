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
    (diagnostic,) = caught.value.diagnostics
    return str(diagnostic)


ORIGIN = "modelica/Plant/Arm/Links/Old.mo"
WAITS = FileRecord(
    "link new", Role.MODEL, "ab", State.CONFLICT, origin=ORIGIN, choice=Choice.TAKE, chosen_for="de", replaced_hash="fa"
)
WAITING = msgspec.structs.replace(MANIFEST, files={**MANIFEST.files, "modelica/Plant/Arm/Links/New.mo": WAITS})
MARKERS = '<<<<<<< HEAD\nhash = "5a"\n=======\nhash = "6a"\n>>>>>>> feature'


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ('hash = "5a"', MARKERS, "<<<<<<< HEAD", "unresolved merge markers; restore it from version control"),
        ("format = 1", "format = 99", "format =", "a newer urdfsync wrote this state (format 99"),
        ("format = 1", "format = 0", "format =", "this is no state of urdfsync: there is no format 0"),
        ("format = 1", "format = -1", "format =", "this is no state of urdfsync: there is no format -1"),
        ('choice = "take"', 'choice = "guess"', "choice =", "this is no state of urdfsync: invalid enum value 'guess'"),
        ('path = "cad/', 'path = "cad/\\u0000', "path =", "the recorded path 'cad/\\x00arm.urdf' does not belong"),
        *(
            (old, new, line, "restore it from version control")
            for old, new, line in (
                ("revision = 3", 'revision = "3"', "revision ="),
                ('role = "record"', 'role = "recrod"', 'role = "recrod"'),
                ('owner = "joint left"', "", '[files."Joints/Left.mo"]'),
                ('"Arm",', "5,", '"../package.order"'),
                ('hash = "5a"', "", "[source]"),
                ('package = "Plant.Arm"', "", ""),
                ('folder = "modelica/Plant/Arm"', "folder = [1]", "folder ="),
                ("[generator]", "[generator", "[generator"),
            )
        ),
    ],
)
def test_garbage_is_refused_with_its_line(old: str, new: str, line: str, words: str) -> None:
    text = dumps(WAITING).replace(old, new)
    message = failure(text)
    place = next((n for n, found in enumerate(text.splitlines(), 1) if line and found.startswith(line)), 0)
    assert message.startswith(f"arm.toml:{place}:" if place else "arm.toml: ")
    assert words in message


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


def quoted(text: str) -> str:
    return "".join(char if char.isprintable() and char != "\\" else f"\\u{ord(char):04x}" for char in text)


SPOTS = {
    "file": (
        "Links/Base_link.mo",
        "Links/Base_link.mo",
        ["a.txt", "Resources/a.stl", ".git/x.mo", "Links/.hidden/A.mo"],
    ),
    "origin": ("Links/Old.mo", "Links/Old.mo", ["Links/Old.txt", ".git/Old.mo"]),
    "order": ("../package.order", "../package.order", ["../../package.order", "Links/Arm.mo", ".git/package.order"]),
    "dependency": ("Resources/lost.stl", "Resources/lost.stl", ["Links/Arm.mo", "arm.stl", "Resources/.ssh/a"]),
    "folder": (
        'folder = "modelica/Plant/Arm"',
        "modelica/Plant/Arm",
        ["modelica/Plant", "a/../Plant/Arm", "XPlant/Arm"],
    ),
}
"""Texts of a manifest that hold a path, the path, and others that are wrong there alone."""


@pytest.mark.parametrize(("spot", "place"), [(spot, place) for spot in SPOTS for place in PLACES + SPOTS[spot][2]])
def test_a_path_that_no_build_writes_is_refused_with_its_line(spot: str, place: str) -> None:
    text, (found, path, _) = dumps(WAITING if spot == "origin" else MANIFEST), SPOTS[spot]
    begin = text.index(found)
    line = text[:begin].count("\n") + 1
    message = failure(text[:begin] + text[begin:].replace(path, quoted(place), 1))
    assert message.startswith(f"arm.toml:{line}: error: the recorded path {place!r} does not belong to the package")
    assert "`Plant.Arm`; restore the state from version control, or delete it" in message
    assert message.isprintable()
