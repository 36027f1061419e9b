"""Where versions of a text differ: lines one below the other, from which all versions can be read again."""

from __future__ import annotations

from itertools import groupby

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge import merge
from urdfsync.output.differences import Hunk, Line, find_hunks

TEXTS = st.lists(st.sampled_from("abcdefgh"), max_size=30).map(lambda lines: "".join(f"{line}\n" for line in lines))
LETTERS = "".join(f"{letter}\n" for letter in "abcdefghijklmnop")


def three(base: str, mine: str, generated: str) -> list[Hunk]:
    return find_hunks(base, mine, generated, merge(base, mine, generated))


def shown(hunk: Hunk) -> list[str]:
    return [f"{line.version} {line.number} {line.text.strip()}" for line in hunk.lines]


@pytest.mark.parametrize(
    ("base", "mine", "generated", "lines"),
    [
        pytest.param(
            "a\nb\nc\nd\n",
            "a\nB\nc\nd\n",
            "a\nb\nc\nD\nE\n",
            [" 1 a", "base 2 b", "mine 2 B", " 3 c", "base 4 d", "generated 4 D", "generated 5 E"],
            id="each side stands against base",
        ),
        pytest.param(
            "a\nb\nc\n",
            "a\nx\nc\n",
            "a\nx\nc\n",
            [" 1 a", "base 2 b", "both 2 x", " 3 c"],
            id="what both did alike is shown once",
        ),
        pytest.param(
            "a\nb\nc\n",
            "a\nc\n",
            "a\nx\nc\n",
            [" 1 a", "base 2 b", "mine 0 (removed)", "generated 2 x", " 2 c"],
            id="what is gone is said",
        ),
    ],
)
def test_a_change(base: str, mine: str, generated: str, lines: list[str]) -> None:
    (hunk,) = three(base, mine, generated)
    assert shown(hunk) == lines
    assert hunk.clash == bool(merge(base, mine, generated).conflicts)


def test_distant_changes_are_hunks_of_their_own() -> None:
    first, second = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("l", "L"))
    assert (shown(first)[0], shown(first)[-1]) == (" 1 a", " 5 e")
    assert (shown(second)[0], shown(second)[-1]) == (" 10 j", " 14 n")
    (joined,) = three(LETTERS, LETTERS.replace("c", "C"), LETTERS.replace("h", "H"))
    assert (shown(joined)[0], shown(joined)[-1]) == (" 1 a", " 10 j")


def test_kinds_of_line_endings_are_no_difference() -> None:
    assert three("a\nb\n", "a\r\nb\r\n", "a\nb\n") == []


def versions(hunk: Hunk) -> dict[str, list[Line]]:
    """The lines of a hunk as each version has them; a side that changed nothing has those of base."""
    found: dict[str, list[Line]] = {"base": [], "mine": [], "generated": []}
    for _, run in groupby(hunk.lines, lambda line: not line.version):
        lines = list(run)
        there = {line.version for line in lines}
        for name, own in found.items():
            side = "both" if "both" in there and name != "base" else name if name in there else "base"
            own += [line for line in lines if line.version in ("", side) and line.number]
    return found


@given(TEXTS, TEXTS, TEXTS)
def test_all_versions_can_be_read_from_the_lines(base: str, mine: str, generated: str) -> None:
    hunks, position = three(base, mine, generated), 0
    assert any(hunk.clash for hunk in hunks) == bool(merge(base, mine, generated).conflicts)
    outside, found = mine.splitlines(keepends=True), {"base": "", "mine": "", "generated": ""}
    for hunk in hunks:
        lines = versions(hunk)
        starts = [line.number - 1 - index for index, line in enumerate(lines["mine"]) if line.version != "base"]
        before = "".join(outside[position : starts[0] if starts else position])
        found = {name: text + before + "".join(line.text for line in lines[name]) for name, text in found.items()}
        position = (starts[0] if starts else position) + len(lines["mine"])
    rest = "".join(outside[position:])
    assert {name: text + rest for name, text in found.items()} == {"base": base, "mine": mine, "generated": generated}
