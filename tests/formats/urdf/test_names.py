"""URDF names to identifiers: legal, injective however names are chosen, and nearly always a function of the name."""

from __future__ import annotations

import hashlib
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from urdfsync.domain import ElementKey
from urdfsync.formats.urdf import names
from urdfsync.formats.urdf.names import identify, natural_key, spell
from urdfsync.modelica import parser
from urdfsync.modelica.names import KEYWORDS

PAGE = Path(__file__).resolve().parents[3] / "docs" / "naming.md"

PARTS = """
    a A b _ 1 2 é 左 - . / end time name con Links rotational world
    Axis Frame Mimic Parameters Run _link _joint _link_2 _link_f88c08 a_b_19a204
""".split()
PARTS.append("_link_" + hashlib.sha256(b"link a").hexdigest())  # of `a` among twins, as `_link_f88c08`
NAMES = st.lists(st.sampled_from(PARTS), min_size=1, max_size=3).map("".join) | st.text(min_size=1, max_size=5)
KEYS = st.tuples(st.sampled_from(["link", "joint"]), NAMES)
SETS = st.frozensets(KEYS, max_size=12)
TAKEN = st.sampled_from(["Robot", "A", "B", "End_link", "RotationalAxis"])

WORDS = KEYWORDS | {"time", "real", "integer", "string", "boolean", "der", "abs", "zeros", "fill"}
ROBOT_MODEL = {
    *("animation", "checklimits", "fixedstart", "showcollisions", "frame_a", "frame_b", "m", "links", "joints"),
    *("rotationalaxis", "rotationalsupport", "rotationalrange", "phi_start", "w_start"),
    *("translationalaxis", "translationalsupport", "translationalrange", "s_start", "v_start"),
}
RECORD = Path(__file__).resolve().parents[3] / "modelica" / "UrdfSync" / "Records" / "Robot.mo"
ROBOT_RECORD = {
    part.name.parts[0].lower() for part in parser.parse(RECORD.read_text(encoding="utf-8")).classes[0].components
}
DEVICES = {"con", "prn", "aux", "nul", "com1", "com9", "lpt1", "lpt9"}


@given(SETS, TAKEN)
@example(frozenset({("link", "b-c"), ("link", "b.c"), ("joint", "b_c"), ("link", "b_c_link")}), "Robot")
@example(frozenset({("link", "fooAxis"), ("joint", "foo"), ("link", "FOO")}), "Robot")
def test_no_two_names_meet_anywhere(names: frozenset[ElementKey], taken: str) -> None:
    identifiers = identify(names, [taken])
    assert identifiers.keys() == names
    in_model = [identifier.component.lower() for identifier in identifiers.values()]
    assert len(in_model) == len(set(in_model))
    assert not {taken.lower(), *ROBOT_MODEL} & set(in_model)
    assert not ROBOT_RECORD & set(in_model)
    files = [name.lower() for each in identifiers.values() for name in (each.type, each.record)]
    assert len(files) == len(set(files))
    assert not {"package", *DEVICES} & set(files)


def test_every_field_of_the_robots_record_is_known() -> None:
    assert {"name", "connectionmatrix", "jointtree", "linkinertias"} < ROBOT_RECORD
    assert ROBOT_RECORD <= names.GENERATED
    assert spell("jointTree", "link").startswith("jointTree_")


@given(SETS, TAKEN)
def test_every_identifier_is_legal_and_begins_as_its_use_demands(names: frozenset[ElementKey], taken: str) -> None:
    for identifier in identify(names, [taken]).values():
        assert re.fullmatch("[a-z][A-Za-z0-9_]*", identifier.component, re.ASCII)
        assert re.fullmatch("[A-Z][A-Za-z0-9_]*", identifier.type, re.ASCII)
        assert identifier.type[1:] == identifier.component[1:]
        assert identifier.component.lower() not in WORDS
        assert not identifier.component.lower().endswith(("parameters", "run", "test"))


@given(st.permutations(range(12)), st.lists(KEYS, min_size=12, max_size=12), TAKEN)
def test_the_order_of_names_makes_no_difference(order: list[int], names: list[ElementKey], taken: str) -> None:
    assert identify([names[k] for k in order], [taken]) == identify(names, [taken])


def twins(key: ElementKey, other: ElementKey) -> bool:
    """Whether two elements have one identifier, but for case, while neither knows of the other."""
    return key != other and spell(key[1], key[0]).lower() == spell(other[1], other[0]).lower()


@given(SETS, SETS, TAKEN)
def test_a_neighbour_changes_no_identifier_but_a_twins(
    names: frozenset[ElementKey], new: frozenset[ElementKey], taken: str
) -> None:
    before, after = identify(names, [taken]), identify(names | new, [taken])
    for key in names:
        assert after[key] == before[key] or any(twins(key, other) for other in names | new)
        if after[key].component == spell(key[1], key[0]):
            assert after[key] == before[key]


@given(SETS, SETS, TAKEN)
@example(frozenset({("joint", "arm")}), frozenset({("link", "arm")}), "Robot")
@example(frozenset({("link", "a-b"), ("link", "a.b")}), frozenset({("link", "a_b"), ("link", "a b")}), "Robot")
def test_no_identifier_passes_to_another_element_because_of_a_neighbour(
    names: frozenset[ElementKey], new: frozenset[ElementKey], taken: str
) -> None:
    before, after = identify(names, [taken]), identify(names | new, [taken])
    owners = {identifier.component.lower(): key for key, identifier in before.items()}
    for key, identifier in after.items():
        assert owners.get(identifier.component.lower(), key) == key


def test_only_names_that_lose_something_have_a_hash() -> None:
    for name in ("arm", "LF_HAA", "base-link", "link_6-tool0", "L4", "panda_link0_sc", "part_123456"):
        assert spell(name, "link") == (name[0].lower() + name[1:]).replace("-", "__")
    for name, stem in [
        ("a.b", "a_b"),
        ("a__b", "a_b"),
        ("左臂", "zuoBi"),
        ("плечо", "plecho"),
        ("Öl", "ol"),
        ("🦾 1", "mechanical_arm_1"),
    ]:
        assert re.fullmatch(f"{stem}_[0-9a-f]{{6}}", spell(name, "link"))
    assert spell("a.b", "link") != spell("a.b", "joint")
    assert spell("world", "link") == "worldLink"


def test_letters_are_read_only_when_a_name_needs_it() -> None:
    use = "from urdfsync.formats.urdf.names import spell; spell('a.b', 'link')"
    program = f"import sys; {use}; sys.exit('anyascii' in sys.modules)"
    subprocess.run([sys.executable, "-c", program], check=True)


@pytest.mark.parametrize("name", sorted(ROBOT_MODEL | ROBOT_RECORD | DEVICES | WORDS))
@pytest.mark.parametrize("kind", ["link", "joint"])
def test_reserved_names_give_way(name: str, kind: str) -> None:
    assert re.fullmatch(f"{name}_[0-9a-f]{{6}}", spell(name, kind))


@given(st.text(min_size=50, max_size=400) | st.text("ab", min_size=95, max_size=105))
def test_file_names_stay_below_what_file_systems_take(name: str) -> None:
    clashing = [("link", name), ("joint", name), ("link", name + "x"), ("link", name.swapcase() + "x")]
    identifiers = identify(clashing)
    assert len({identifier.type.lower() for identifier in identifiers.values()}) == len(set(clashing))
    assert all(len(f"{identifier.record}.mo".encode()) <= 143 for identifier in identifiers.values()), "eCryptfs: 143"


def test_what_is_cut_off_still_counts() -> None:
    long, other = spell("a" * 99 + "bc", "link"), spell("a" * 99 + "bd", "link")
    assert len(long) == len(other) == 100
    assert long[:94] == other[:94] == "a" * 93 + "_"
    assert long != other
    assert spell("a" * 100, "link") == "a" * 100


def test_the_natural_order_counts() -> None:
    names = ["link10", "link9", "link09", "link", "9", "10", "link1b", "link1a2"]
    expected = ["9", "10", "link", "link1a2", "link1b", "link09", "link9", "link10"]
    assert sorted(names, key=natural_key) == expected


def table_rows() -> list[list[str]]:
    """Rows of the examples in the page for users: robot's names, and identifiers in the same order."""
    rows = re.findall(r"^\| (.*?) \| (.*?) \| (.*?) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    return [[names, identifiers] for names, identifiers, _ in rows if "`" in names]


def key_of(text: str) -> ElementKey:
    kind, _, name = text.partition(" ")
    return kind, name.strip("`")


@pytest.mark.parametrize(("names", "identifiers"), table_rows())
def test_the_examples_for_users_are_true(names: str, identifiers: str) -> None:
    keys = [key_of(part) for part in names.split(", ")]
    assert [identify(keys, ["MyArm"])[key].component for key in keys] == re.findall("`(.*?)`", identifiers)
