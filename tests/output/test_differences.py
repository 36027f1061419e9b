"""Where versions of a text differ: rows side by side, and stacks, from which all versions can be read again."""

from __future__ import annotations

from itertools import groupby

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge import merge
from urdfsync.output.differences import CONTEXT, Cell, Hunk, Line, find_hunks

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
    assert (hunk.lines, hunk.sides, hunk.clash) == (range(1, 5), frozenset({"mine", "generated"}), False)


def test_contradictions_are_marked() -> None:
    (hunk,) = three("a\nb\nc\n", "a\nx\nc\n", "a\ny\nc\n")
    assert hunk.clash
    assert shown(hunk) == ["1 a | 1 a", "2-b | 2-b !", "2+x | 2+y !", "3 c | 3 c"]
    assert stacked(hunk) == [" 1 a", "base 2 b", "mine 2 x", "generated 2 y", " 3 c"]


def test_what_both_did_alike_is_shown_once() -> None:
    (hunk,) = three("a\nb\nc\n", "a\nx\nc\n", "a\nx\nc\n")
    assert stacked(hunk) == [" 1 a", "base 2 b", "both 2 x", " 3 c"]


def test_what_is_gone_is_said() -> None:
    (hunk,) = three("a\nb\nc\n", "a\nc\n", "a\nx\nc\n")
    assert stacked(hunk) == [" 1 a", "base 2 b", "mine 0 (removed)", "generated 2 x", " 2 c"]


def test_distant_changes_are_hunks_of_their_own() -> None:
    first, second = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("l", "L"))
    assert (first.lines, first.sides) == (range(1, 6), frozenset({"mine"}))
    assert (second.lines, second.sides) == (range(10, 15), frozenset({"generated"}))
    (joined,) = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("h", "H"))
    assert joined.lines == range(1, 11)


def test_numbers_are_those_of_each_version() -> None:
    (_, second) = three(LETTERS, LETTERS.replace("b", "1\n2\n3"), LETTERS.replace("m", "M"))
    assert shown(second) == ["13 k | 11 k", "14 l | 12 l", "15 m | 13-m", " | 13+M", "16 n | 14 n", "17 o | 15 o"]


def test_without_a_base_only_the_difference_is_known() -> None:
    (hunk,) = find_hunks(None, "a\nb\nc\n", "a\nx\ny\nc\n", None)
    assert shown(hunk) == ["1 a | 1 a", "2*b | 2*x", " | 3*y", "3 c | 4 c"]
    assert stacked(hunk) == [" 1 a", "mine 2 b", "generated 2 x", "generated 3 y", " 3 c"]


def parts(line: Line) -> list[str]:
    return [line.text[part.start : part.stop] for part in line.parts]


def test_the_changed_parts_of_a_line_are_known() -> None:
    (hunk,) = three("  Real x = 1.05;\n", "  Real x = 1.07; // measured\n", "  Real x = 1.05;\n")
    (old, new) = (row.mine.line for row in hunk.rows if row.mine)
    assert parts(old) == ["1.05"]
    assert parts(new) == ["1.07", "// measured"]


def test_of_a_rewritten_line_no_part_is_singled_out() -> None:
    (hunk,) = three("Real x;\n", "Body body(m = 3);\n", "Real x;\n")
    assert all(not row.mine.line.parts for row in hunk.rows if row.mine)


def test_white_space_shows_where_nothing_else_changed() -> None:
    (hunk,) = three("  Real x;\n", "\tReal x; \n", "  Real x;\n")
    assert [row.mine.line.text for row in hunk.rows if row.mine] == ["··Real·x;", "→Real·x;·"]


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
        own = {cell.line.number: cell.line.text for cell in column if cell.mark in " +"}
        assert own == {number: lines[number - 1] for number in own}
        assert all(cell.line.text == base.split("\n")[cell.line.number - 1] for cell in column if cell.mark == "-")
        outside.append([line for number, line in enumerate(lines, start=1) if number not in own])
    assert outside[0] == outside[1], "what is not shown is the same on both sides"
    numbers = [cell.line.number for cell in columns[0] if cell.mark in " +"]
    assert numbers == [number for hunk in found for number in hunk.lines]


@given(TEXTS, TEXTS, TEXTS)
def test_all_versions_can_be_read_from_the_stack(base: str, mine: str, generated: str) -> None:
    for hunk in three(base, mine, generated):
        own = [line for label, line in hunk.stack if label in ("", "mine", "both") and line.number]
        lines = mine.split("\n")
        assert {line.number for line in own} <= set(hunk.lines)
        assert all(line.text == lines[line.number - 1] for line in own)
        theirs = [line for label, line in hunk.stack if label == "generated" and line.number]
        assert all(line.text == generated.split("\n")[line.number - 1] for line in theirs)
        unchanged = [len(list(run)) for label, run in groupby(hunk.stack, lambda part: part[0]) if not label]
        assert max(unchanged, default=0) <= 2 * CONTEXT
