"""Contradictions in words; `test_elements` has more of them."""

from __future__ import annotations

import pytest

from urdfsync.merge.lines import Contradiction
from urdfsync.merge.words import describe

PATHS = {
    ("body", "component body", "arguments", "m", "value", "expression"): (
        ("11.5", "99", "12.1"), "component `body`: you set `m = 99`, the export changes 11.5 to 12.1",
    ),
    ("body", "component body", "type"): (
        ("A", "B", "C"), "component `body`: you changed the type to `B`, the export to `C`",
    ),
    ("body", "component body"): (
        ("B b;", "", "B b = 1;"), "component `body`: you removed it, the export changed it to `B b = 1;`",
    ),
    ("body", "component body", "arguments", "m"): (
        ("m = 1", "m = 2", ""), "component `body`: you changed `m` to `m = 2`, the export removes it",
    ),
    ("body", "component hand"): (
        ("Hand hand(\n  a = 1)\n  \"Hand\";", "Hand hand(\n  color = 7,\n  a = 1)\n  \"Hand\";", ""),
        "component `hand`: you added `color = 7,`, the export removes the component",
    ),
    ("body", "component body", "value"): (
        ("", "= 1", "= 2"), "component `body`: you added `= 1`, the export `= 2`",
    ),
    ("body", "component body", "arguments", "origin", "arguments", "xyz", "value"): (
        ("", "= 1", "= 2"), "component `body`: you added `origin.xyz = 1`, the export `origin.xyz = 2`",
    ),
    ("body", "component body", "arguments", "origin", "arguments", "xyz"): (
        ("", "xyz = 1", "xyz = 2"), "component `body`: you added `origin.xyz = 1`, the export `origin.xyz = 2`",
    ),
    ("body", "equation a + b = c", "equation"): (
        ("a + b = c", "a = c", "b\n  = c"),
        "equation `a + b = c`: you changed the equation to `a = c`, the export to `b = c`",
    ),
    ("body", "when a", "equation"): (
        ("when a then\n  x = 1;\nend", "when a then\n  x = 1;\n  y = 3;\nend", "when a then\n  x = 7;\nend"),
        "when `a`: you added `y = 3;`, the export changed `x = 1;` to `x = 7;`",
    ),
    ("body", "when b", "equation"): (
        ("1;\n2;\n3;\n4;", "1;\n7;\n3;\n4;", "1;\n2;\n8;\n4;"),
        "when `b`: you changed `2;` to `7;`, the export changed `3;` to `8;`",
    ),
    ("body", "statements of algorithm 1"): (
        ("x := 1;\ny := 2;", "x := 1;", "x := 1;\ny := 2;\nz := 3;"),
        "statements of algorithm 1: you removed `y := 2;`, the export added `z := 3;`",
    ),
    ("head",): (
        ("model A", "block A", "record A"),
        "the class: you changed the kind and name to `block A`, the export to `record A`",
    ),
    (): (("1", "2", "3"), ""),
}  # fmt: skip


@pytest.mark.parametrize("path", PATHS)
def test_words(path: tuple[str, ...]) -> None:
    (base, mine, generated), expected = PATHS[path]
    assert describe(Contradiction(path, base, mine, generated)) == expected


def test_of_long_texts_the_first_difference_is_shown() -> None:
    start = "{base.mass, upper.mass, fore.mass, hand.mass, finger.mass, "
    texts = (f"{start}{end}}}" for end in ("a", "2*a", "b"))
    told = describe(Contradiction(("body", "component m", "value", "expression"), *texts))
    assert told.endswith("2*a}`, the export changes …, finger.mass, a} to …, finger.mass, b}")


def test_long_texts_are_cut() -> None:
    found = describe(Contradiction(("body", f"equation {'a + ' * 40}", "equation"), "a", "b" * 99, "c"))
    assert len(found) < 200
    assert found.count("…") == 2


def test_of_long_texts_that_differ_at_once_the_beginning_is_shown() -> None:
    texts = (f"term + {first} + {' + '.join(f'term{n}' for n in range(20))}" for first in ("one", "two", "ten"))
    told = describe(Contradiction(("body", "component m", "value", "expression"), *texts))
    assert "you set `m = term + two + term0" in told
    assert "the export changes term + one + term0" in told


@pytest.mark.parametrize(
    "path",
    [
        ("body", "component m", "value", "expression"),  # a value
        ("body", "equation m", "equation"),  # lines
    ],
)
@pytest.mark.parametrize("base", ["", "term"])
def test_of_long_texts_that_differ_late_the_difference_of_both_sides_is_shown(path: tuple[str, ...], base: str) -> None:
    """Also if both sides replaced the whole text, or added it."""
    long = " + ".join(f"term{n}" for n in range(30))
    told = describe(Contradiction(path, base, f"{long} + mine", f"{long} + other"))
    assert "+ mine`" in told
    assert "+ other" in told
