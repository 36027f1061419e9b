"""Where versions of a text differ: rows side by side, and stacks, from which all versions can be read again."""

from __future__ import annotations

from itertools import groupby

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge import merge
from urdfsync.output.differences import CONTEXT, Cell, Hunk, find_hunks

TEXTS = st.lists(st.sampled_from("abcdefgh"), max_size=30).map(lambda lines: "".join(f"{line}\n" for line in lines))
LETTERS = "".join(f"{letter}\n" for letter in "abcdefghijklmnop")


def three(base: str, mine: str, generated: str) -> list[Hunk]:
    return find_hunks(base, mine, generated, merge(base, mine, generated))


def shown(hunk: Hunk) -> list[str]:
    """The rows of a hunk: `12-old | 12 old`."""
    return [f"{half(row.mine)} | {half(row.generated)}{' !' if row.clash else ''}".rstrip() for row in hunk.rows]


def half(cell: Cell | None) -> str:
    return f"{cell.line.number}{cell.mark}{cell.line.text}" if cell else ""


def stacked(hunk: Hunk) -> list[str]:
    return [f"{label} {line.number} {line.text}" for label, line in hunk.stack]


@pytest.mark.parametrize(
    ("base", "mine", "generated", "rows", "stack"),
    [
        pytest.param(
            "abcd", "aBcd", "abcDE",
            ["1 a | 1 a", "2-b | 2 b", "2+B |", "3 c | 3 c", "4 d | 4-d", " | 4+D", " | 5+E"],
            [" 1 a", "base 2 b", "mine 2 B", " 3 c", "base 4 d", "generated 4 D", "generated 5 E"],
            id="each side against base",
        ),
        pytest.param(
            "abc", "axc", "ayc",
            ["1 a | 1 a", "2-b | 2-b !", "2+x | 2+y !", "3 c | 3 c"],
            [" 1 a", "base 2 b", "mine 2 x", "generated 2 y", " 3 c"],
            id="a contradiction is marked",
        ),
        pytest.param(
            "abc", "axc", "axc",
            ["1 a | 1 a", "2-b | 2-b", "2+x | 2+x", "3 c | 3 c"],
            [" 1 a", "base 2 b", "both 2 x", " 3 c"],
            id="what both did alike is shown once",
        ),
        pytest.param(
            "abc", "ac", "axc",
            ["1 a | 1 a", "2-b | 2-b !", " | 2+x !", "2 c | 3 c"],
            [" 1 a", "base 2 b", "mine 0 (removed)", "generated 2 x", " 2 c"],
            id="what is gone is said",
        ),
        pytest.param(
            None, "abc", "axyc",
            ["1 a | 1 a", "2*b | 2*x", " | 3*y", "3 c | 4 c"],
            [" 1 a", "mine 2 b", "generated 2 x", "generated 3 y", " 3 c"],
            id="without a base only the difference is known",
        ),
    ],
)  # fmt: skip
def test_examples(base: str | None, mine: str, generated: str, rows: list[str], stack: list[str]) -> None:
    one, two, three_ = ("".join(f"{letter}\n" for letter in version) for version in (base or "", mine, generated))
    (hunk,) = find_hunks(None, two, three_, None) if base is None else three(one, two, three_)
    assert shown(hunk) == rows
    assert stacked(hunk) == stack
    assert hunk.clash == any(row.endswith("!") for row in rows)


def test_distant_changes_are_hunks_of_their_own() -> None:
    first, second = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("l", "L"))
    assert (first.lines, first.sides) == (range(1, 6), frozenset({"mine"}))
    assert (second.lines, second.sides) == (range(10, 15), frozenset({"generated"}))
    (joined,) = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("h", "H"))
    assert joined.lines == range(1, 11)


def test_numbers_are_those_of_each_version() -> None:
    (_, second) = three(LETTERS, LETTERS.replace("b", "1\n2\n3"), LETTERS.replace("m", "M"))
    assert shown(second) == ["13 k | 11 k", "14 l | 12 l", "15 m | 13-m", " | 13+M", "16 n | 14 n", "17 o | 15 o"]


@pytest.mark.parametrize(
    ("old", "new", "shown", "parts"),
    [
        ("  Real x = 1.05;", "  Real x = 1.07; // measured", "  Real x = 1.07; // measured", ["1.07", "// measured"]),
        ("Real x;", "Body body(m = 3);", "Body body(m = 3);", []),
        ("  Real x;", "\tReal x; ", "→Real·x;·", None),
    ],
    ids=["changed parts", "a line that is rewritten", "white space only"],
)
def test_what_changed_in_a_line(old: str, new: str, shown: str, parts: list[str] | None) -> None:
    (hunk,) = three(f"{old}\n", f"{new}\n", f"{old}\n")
    (_, line) = (row.mine.line for row in hunk.rows if row.mine)
    assert line.text == shown
    assert parts is None or [line.text[part.start : part.stop] for part in line.parts] == parts


def test_line_endings_are_no_difference_but_a_missing_one_is() -> None:
    assert three("a\nb\n", "a\r\nb\r\n", "a\nb\n") == []
    (hunk,) = three("a\nb\n", "a\nb", "a\nb\n")
    assert shown(hunk)[1:] == ["2-b | 2 b", "2+b  (no end of line) |"]


@given(TEXTS, TEXTS, TEXTS)
def test_all_versions_can_be_read_from_rows_and_stack(base: str, mine: str, generated: str) -> None:
    found = three(base, mine, generated)
    assert any(hunk.clash for hunk in found) == bool(merge(base, mine, generated).conflicts)
    rows = [row for hunk in found for row in hunk.rows]
    columns = [[row.mine for row in rows if row.mine], [row.generated for row in rows if row.generated]]
    outside: list[list[str]] = []
    for text, column in zip((mine, generated), columns, strict=True):
        lines = text.split("\n")
        own = {cell.line.number: cell.line.text for cell in column if cell.mark in " +"}
        assert own == {number: lines[number - 1] for number in own}
        assert all(cell.line.text == base.split("\n")[cell.line.number - 1] for cell in column if cell.mark == "-")
        outside.append([line for number, line in enumerate(lines, start=1) if number not in own])
    assert outside[0] == outside[1], "what is not shown is the same on both sides"
    numbers = [cell.line.number for cell in columns[0] if cell.mark in " +"]
    assert numbers == [number for hunk in found for number in hunk.lines]
    for hunk in found:
        for labels, version in ((("", "mine", "both"), mine), (("generated",), generated)):
            stacked = [line for label, line in hunk.stack if label in labels and line.number]
            assert all(line.text == version.split("\n")[line.number - 1] for line in stacked)
            assert version is generated or {line.number for line in stacked} <= set(hunk.lines)
        unchanged = [len(list(run)) for label, run in groupby(hunk.stack, lambda part: part[0]) if not label]
        assert max(unchanged, default=0) <= 2 * CONTEXT
