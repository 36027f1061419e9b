"""Where versions of a text differ: rows side by side, and stacks, from which all versions can be read again."""

from __future__ import annotations

from itertools import groupby

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge import merge
from urdfsync.output.differences import CONTEXT, Hunk, Line, find_hunks, stack

TEXTS = st.lists(st.sampled_from("abcdefgh"), max_size=30).map(lambda lines: "".join(f"{line}\n" for line in lines))
LETTERS = "".join(f"{letter}\n" for letter in "abcdefghijklmnop")


def three(base: str, mine: str, generated: str) -> list[Hunk]:
    return find_hunks(base, mine, generated, merge(base, mine, generated))


def shown(hunk: Hunk) -> list[str]:
    """The rows of a hunk: `2-old | 2 old`."""
    return [f"{half(row.mine)} | {half(row.generated)}".rstrip() for row in hunk.rows]


def half(line: Line | None) -> str:
    return f"{line.number}{line.mark}{line.text}" if line else ""


def stacked(hunk: Hunk) -> list[str]:
    return [f"{name} {line.number} {line.text}" for name, line in stack(hunk.rows)]


def test_each_side_stands_against_base() -> None:
    (hunk,) = three("a\nb\nc\nd\n", "a\nB\nc\nd\n", "a\nb\nc\nD\nE\n")
    assert shown(hunk) == ["1 a | 1 a", "2-b | 2 b", "2+B |", "3 c | 3 c", "4 d | 4-d", " | 4+D", " | 5+E"]
    assert stacked(hunk) == [
        " 1 a",
        "base 2 b",
        "mine 2 B",
        " 3 c",
        "base 4 d",
        "generated 4 D",
        "generated 5 E",
    ]
    assert not hunk.clash


def test_contradictions_are_marked() -> None:
    (hunk,) = three("a\nb\nc\n", "a\nx\nc\n", "a\ny\nc\n")
    assert hunk.clash
    assert shown(hunk) == ["1 a | 1 a", "2-b | 2-b", "2+x | 2+y", "3 c | 3 c"]
    assert stacked(hunk) == [" 1 a", "base 2 b", "mine 2 x", "generated 2 y", " 3 c"]


def test_what_both_did_alike_is_shown_once() -> None:
    (hunk,) = three("a\nb\nc\n", "a\nx\nc\n", "a\nx\nc\n")
    assert stacked(hunk) == [" 1 a", "base 2 b", "both 2 x", " 3 c"]


def test_what_is_gone_is_said() -> None:
    (hunk,) = three("a\nb\nc\n", "a\nc\n", "a\nx\nc\n")
    assert stacked(hunk) == [" 1 a", "base 2 b", "mine 0 (removed)", "generated 2 x", " 2 c"]


def test_distant_changes_are_hunks_of_their_own() -> None:
    first, second = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("l", "L"))
    assert (shown(first)[0], shown(first)[-1]) == ("1 a | 1 a", "5 e | 5 e")
    assert (shown(second)[0], shown(second)[-1]) == ("10 j | 10 j", "14 n | 14 n")
    (joined,) = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("h", "H"))
    assert (shown(joined)[0], shown(joined)[-1]) == ("1 a | 1 a", "10 j | 10 j")


def test_numbers_are_those_of_each_version() -> None:
    (_, second) = three(LETTERS, LETTERS.replace("b", "1\n2\n3"), LETTERS.replace("m", "M"))
    assert shown(second) == ["13 k | 11 k", "14 l | 12 l", "15 m | 13-m", " | 13+M", "16 n | 14 n", "17 o | 15 o"]


def test_without_a_base_only_the_difference_is_known() -> None:
    (hunk,) = find_hunks(None, "a\nb\nc\n", "a\nx\ny\nc\n", None)
    assert shown(hunk) == ["1 a | 1 a", "2*b |", " | 2*x", " | 3*y", "3 c | 4 c"]
    assert stacked(hunk) == [" 1 a", "mine 2 b", "generated 2 x", "generated 3 y", " 3 c"]


def test_the_changed_part_of_a_line_is_known() -> None:
    (hunk,) = three("  Real x = 1.05;\n", "  Real x = 1.07; // measured\n", "  Real x = 1.05;\n")
    changed = [row.mine.text[row.mine.changed.start : row.mine.changed.stop] for row in hunk.rows if row.mine]
    assert changed == ["5;", "7; // measured"]


def test_a_missing_end_of_line_is_said() -> None:
    (hunk,) = three("a\nb\n", "a\nb", "a\nb\n")
    assert shown(hunk)[1:] == ["2-b | 2 b", "2+b  (no end of line) |"]


def test_kinds_of_line_endings_are_no_difference() -> None:
    assert three("a\nb\n", "a\r\nb\r\n", "a\nb\n") == []


@given(TEXTS, TEXTS, TEXTS)
def test_all_versions_can_be_read_from_the_rows(base: str, mine: str, generated: str) -> None:
    found = three(base, mine, generated)
    assert any(hunk.clash for hunk in found) == bool(merge(base, mine, generated).conflicts)
    rows = [row for hunk in found for row in hunk.rows]
    columns = [[row.mine for row in rows if row.mine], [row.generated for row in rows if row.generated]]
    outside: list[list[str]] = []
    for text, column in zip((mine, generated), columns, strict=True):
        lines = text.split("\n")
        own = {line.number: line.text for line in column if line.mark in " +"}
        assert own == {number: lines[number - 1] for number in own}
        assert all(line.text == base.split("\n")[line.number - 1] for line in column if line.mark == "-")
        outside.append([line for number, line in enumerate(lines, start=1) if number not in own])
    assert outside[0] == outside[1], "what is not shown is the same on both sides"


@given(TEXTS, TEXTS, TEXTS)
def test_all_versions_can_be_read_from_the_stack(base: str, mine: str, generated: str) -> None:
    for hunk in three(base, mine, generated):
        lines = list(stack(hunk.rows))
        for text, names in ((mine, ("", "mine", "both")), (generated, ("generated",)), (base, ("base",))):
            own = [line for name, line in lines if name in names and line.number]
            assert all(line.text == text.split("\n")[line.number - 1] for line in own)
        unchanged = [len(list(run)) for name, run in groupby(lines, lambda part: part[0]) if not name]
        assert max(unchanged, default=0) <= 2 * CONTEXT
