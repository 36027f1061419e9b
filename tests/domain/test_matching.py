"""The matching of elements by contents, places and names, in tables of plain elements."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.domain import ElementKey, Features
from urdfsync.domain.matching import Matching, match

Elements = Mapping[ElementKey, Features]
ALIKE = 1.5


def chain(names: str, masses: Iterable[float | None], x: Iterable[float] = ()) -> Elements:
    """Links in a row; the joint before link `b` is `to_b`. Without a mass a link has no content."""
    elements, places, before = dict[ElementKey, Features](), iter(x), ""
    for name, mass in zip(names, masses, strict=True):
        contents = {} if mass is None else {"mass": {"mass": mass, "inertia": [mass / 10, 0.0]}}
        elements["link", name] = Features(contents, {"joint": ("joint", f"to_{name}")} if before else {})
        if before:
            ends = {"child": ("link", name), "parent": ("link", before)}
            elements["joint", f"to_{name}"] = Features({"position": {"xyz": [next(places, 0.0), 0.0, 0.0]}}, ends)
        before = name
    return elements


def links(matching: Matching) -> dict[str, str]:
    return {name: new for (kind, name), new in matching.renames.items() if kind == "link"}


def doubtful(matching: Matching) -> set[str]:
    return {name for kind, name in matching.doubts if kind == "link"}


OLD = chain("abcd", [9, 2, 3, 4])
FOLLOWED: dict[str, tuple[Elements, Elements, dict[str, str]]] = {
    "nothing": (OLD, OLD, {}),
    "other numbers": (OLD, chain("abcd", [9.5, 2.5, 3.5, 4.5]), {}),
    "rounded numbers": (OLD, chain("acbd", [9, 2 + 1e-7, 3 - 1e-7, 4]), {"b": "c", "c": "b"}),
    "exchanged": (OLD, chain("acbd", [9, 2, 3, 4]), {"b": "c", "c": "b"}),
    "rotated": (OLD, chain("acdb", [9, 2, 3, 4]), {"b": "c", "c": "d", "d": "b"}),
    "shifted": (OLD, chain("bcde", [9, 2, 3, 4]), {"a": "b", "b": "c", "c": "d", "d": "e"}),
    "inserted": (OLD, chain("abcde", [9, 2, 7, 3, 4]), {"c": "d", "d": "e"}),
    "inserted at the root": (OLD, chain("abcde", [7, 9, 2, 3, 4]), {"a": "b", "b": "c", "c": "d", "d": "e"}),
    "removed": (OLD, chain("abc", [9, 3, 4]), {"c": "b", "d": "c"}),
    "exchanged, and one has another mass": (OLD, chain("acbd", [9, 2, 7, 4]), {"b": "c", "c": "b"}),
    "alike, told apart by their joints": (
        chain("abcd", [9, ALIKE, ALIKE, ALIKE], [0.2, 0.3, 0.4]),
        chain("acbd", [9, ALIKE, ALIKE, ALIKE], [0.2, 0.3, 0.4]),
        {"b": "c", "c": "b"},
    ),
    "without content, told apart by their joints": (
        chain("abcd", [9, None, None, 4], [0.2, 0.3, 0.4]),
        chain("acbd", [9, None, None, 4], [0.2, 0.3, 0.4]),
        {"b": "c", "c": "b"},
    ),
    "all alike, and one is appended": (chain("abc", [ALIKE] * 3), chain("abcd", [ALIKE] * 4), {}),
    "numbers that were exchanged by mistake": (
        chain("abcd", [9, 2, 3, 4], [0.2, 0.3, 0.4]),
        chain("abcd", [9, 3, 2, 4], [0.2, 0.3, 0.4]),
        {},
    ),
}


@pytest.mark.parametrize(("old", "new", "names"), FOLLOWED.values(), ids=FOLLOWED)
def test_contents_and_places_speak_against_a_name(old: Elements, new: Elements, names: dict[str, str]) -> None:
    found = match(old, new)
    assert links(found) == names
    joints = {name: renamed for (kind, name), renamed in found.renames.items() if kind == "joint"}
    assert joints == {f"to_{name}": f"to_{names[name]}" for name in names if ("joint", f"to_{name}") in old}


def rows(table: str) -> Elements:
    """Rows of a table: `A 1 foo, B 0` has an empty cell."""
    elements = dict[ElementKey, Features]()
    for name, *cells in map(str.split, table.split(",")):
        values = [float(cell) if cell.isdigit() else cell for cell in cells]
        elements["element", name] = Features(dict(zip(("n", "part"), values, strict=False)), {})
    return elements


def other_order(elements: Elements) -> Elements:
    """The elements are the same; a record may have another order of columns than its source."""
    return {
        key: Features(dict(reversed([*features.contents.items()])), features.neighbours)
        for key, features in elements.items()
    }


@pytest.mark.parametrize(("old", "new", "names"), [
    ("A 5 foo, B 5 bar, C 5 baz", "B 5 foo, C 5 bar, D 5 baz", "A-B B-C C-D"),
    ("A 1 foo, B 1 bar, C 1 baz", "B 1 foo, C 1 bar, D 1 baz", "A-B B-C C-D"),
    ("A 5 foo, B 1 bar", "C 7 foo, B 1 bar", ""),
    ("A 1 x, B 2 y, C 3 z", "B 1 x, C 2 y, D 3 z", "A-B B-C C-D"),
    ("A 1, B 2, C 3", "B 1, C 2, D 3", "A-B B-C C-D"),
    ("A 1 foo, B 0 bar", "B 1 foo, A 0 bar", "A-B B-A"),
    ("A 1, B 2, C 3", "C 1, B 2, A 3", "A-C C-A"),
    ("A 1 foo, B 1 bar, C 1 baz", "A 1 foo, B 1 baz", "C-B"),
    ("A 600, B 600", "A 600, C 600", "B-C"),
    ("A 600, B 600, C 600", "A 600, D 600, E 600", ""),
    ("A 5 foo, B 6 bar", "A 5 bar, B 6 foo", ""),
    ("A 1, B 2", "A 0, B 2", ""),
])  # fmt: skip
def test_rows_are_found_by_texts_and_by_zeros_and_ones(old: str, new: str, names: str) -> None:
    found = match(rows(old), other_order(rows(new)))
    assert " ".join(f"{former}-{name}" for (_, former), name in found.renames.items()) == names


@pytest.mark.parametrize(("old", "new", "doubtful"), [
    ("A 1, B 0", "A 0, B 1", "AB"),
    ("A 1 pump, B 0 pump", "A 0 pump, B 1 pump", "AB"),
    ("A 600, B 600, C 7", "B 600, C 600, D 7", "B"),
    ("A 6, B 6", "C 6, A 5", "A"),
    ("A 1 foo, B 1 bar, C 1 baz", "A 1 foo, B 1 baz", "B"),
    ("A 1 foo, B 1 bar, C 1 baz", "B 2 foo, C 3 bar, D 4 baz", "BC"),
])  # fmt: skip
def test_a_row_that_was_switched_or_renamed_is_a_doubt(old: str, new: str, doubtful: str) -> None:
    found = match(rows(old), other_order(rows(new)))
    assert "".join(name for _, name in found.doubts) == doubtful


@given(st.randoms(use_true_random=False))
def test_no_row_has_the_name_of_another_one_without_a_doubt(random: Random) -> None:
    """Rows keep their cells, with any contents, under other names, and one row is removed or added."""
    cells = [f"{number} {text}" for number in (0, 1, 5) for text in ("", "foo", "bar")]
    contents = dict(zip("ABCDE", random.choices(cells, k=5), strict=True))
    names = dict(zip("ABCDE", random.choice(["ABCDE", "BCDEF", "ACDEF", random.sample("ABCDE", 5)]), strict=True))
    removed = random.choice("ABCDE-")
    renamed = {names[old]: content for old, content in contents.items() if old != removed}
    added = {"F": random.choice(cells)} if removed == "-" else {}
    old, new = (
        rows(", ".join(f"{name} {content}" for name, content in table.items())) for table in (contents, added | renamed)
    )
    found = match(old, new)
    taken = {(kind, name) for (kind, _), name in found.renames.items()}
    for key, features in old.items():
        is_same_name = key in new and key not in taken and key not in found.renames and key not in found.doubts
        present = key if is_same_name else (key[0], found.renames.get(key, ""))
        is_right = present[1] == names[key[1]] and key[1] != removed
        assert present not in new or is_right or features == new[present]


def test_what_cannot_be_known_is_a_doubt() -> None:
    """`c` has the mass of `b`, and `d` has its shape."""

    def arm(*shapes: float) -> Elements:
        parts = zip("bcd", [2, 3, 4] if shapes[0] == 5 else [7, 2, 8], shapes, strict=True)
        return {
            ("link", name): Features({"mass": {"mass": mass}, "shape": {"box": size}}, {}) for name, mass, size in parts
        }

    found = match(arm(5, 6, 7), arm(8, 9, 5))
    assert found.renames == {}
    assert doubtful(found) == {"b"}
    assert found.doubts["link", "b"].moved_to in ("c", "d")


def test_an_element_whose_name_another_one_has_is_told() -> None:
    """`b` is renamed to `c`; the old `c` is removed."""
    found = match(chain("abc", [9, 2, 3]), chain("ac", [9, 2]))
    assert links(found) == {"b": "c"}
    doubt = found.doubts["link", "c"]
    assert (doubt.former, doubt.is_certain) == ("b", True)


@pytest.mark.parametrize("mass", [3.5, 3])
def test_a_neighbour_that_is_another_one_now_is_a_doubt(mass: float) -> None:
    """The old `b` is removed; `c` takes its name, and has another mass, or another place."""
    old = chain("abcd", [9, 2, 3, 4], [0.2, 0.3, 0.4])
    found = match(old, chain("abc", [9, mass, 4], [0.3 if mass == 3.5 else 0.5, 0.4]))
    assert (("link", "b") if mass == 3.5 else ("joint", "to_b")) in found.doubts


@pytest.mark.parametrize("names", ["abcd", "abc"])
def test_other_numbers_in_the_same_place_are_no_doubt(names: str) -> None:
    """The result is the same with and without the last part."""
    old = chain("abcd", [9, 2, 3, 4], [0.2, 0.3, 0.4])
    found = match(old, chain(names, [9.5, 2.5, 3.5, 4.5][: len(names)], [0.25, 0.35, 0.45]))
    assert found == Matching()


@pytest.mark.parametrize("name", "ed")
@pytest.mark.parametrize(("parent", "mass", "x", "is_doubt"), [
    ("a", 7, 0.6, True), ("a", 4, 0.6, False), ("a", 7, 0.4, False), ("c", 7, 0.6, False),
])  # fmt: skip
def test_a_name_alone_is_a_doubt(parent: str, mass: float, x: float, name: str, *, is_doubt: bool) -> None:
    """The last part `d` is replaced: `to_d` has another parent, and another link with this name, or with another."""
    old = chain("abcd", [9, 2, 3, 4], [0.2, 0.3, 0.4])
    ends = {"child": ("link", name), "parent": ("link", parent)}
    newcomer = {
        ("link", name): Features({"mass": {"mass": mass, "inertia": [mass / 10, 0.0]}}, {"joint": ("joint", "to_d")}),
        ("joint", "to_d"): Features({"position": {"xyz": [x, 0.0, 0.0]}}, ends),
    }
    found = match(old, {**chain("abc", [9, 2, 3], [0.2, 0.3]), **newcomer})
    assert {key for key, doubt in found.doubts.items() if doubt.is_named_alike} == (
        {("joint", "to_d"), ("link", name)} & old.keys() if is_doubt else set()
    )
    assert (links(found) == {"d": "e"}) is (name == "e" and not is_doubt)


def test_what_is_declared_holds() -> None:
    old, new = chain("abc", [9, ALIKE, ALIKE]), chain("abc", [9, ALIKE, ALIKE])
    declared = {("link", "b"): ("link", "c"), ("link", "c"): ("link", "b")}
    assert links(match(old, new, declared)) == {"b": "c", "c": "b"}
    assert links(match(old, chain("acb", [9, 2, 3]), {("link", "b"): ("link", "b")})).get("b", "b") == "b"


@given(st.randoms(use_true_random=False), st.integers(3, 9))
def test_any_permutation_of_parts_that_differ_is_followed(random: Random, count: int) -> None:
    names = "abcdefghi"[:count]
    masses = random.sample([1.1, 2.2, 3.3, 4.4, 5.5, 6.6, 7.7, 8.8, 9.9], count)
    others = "".join(random.sample(names, count))
    found = match(chain(names, masses), chain(others, masses))
    assert links(found) == {old: new for old, new in zip(names, others, strict=True) if old != new}
    assert found.doubts == {}


@given(st.randoms(use_true_random=False))
def test_a_match_is_of_one_to_one_and_of_one_kind(random: Random) -> None:
    """This holds for all versions, and the doubts concern names in both versions."""

    def version() -> Elements:
        names = "".join(random.sample("abcdef", random.randint(1, 6)))
        return chain(names, random.choices([None, ALIKE, 2, 3, 4], k=len(names)), random.choices([0, 0.3, 0.5], k=5))

    old, new = version(), version()
    found = match(old, new)
    assert len({(kind, name) for (kind, _), name in found.renames.items()}) == len(found.renames)
    assert all(
        (kind, name) in new and key in old for key in found.renames for kind, name in [(key[0], found.renames[key])]
    )
    assert found.doubts.keys() <= old.keys() & new.keys()
