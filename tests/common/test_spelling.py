"""Texts: the nearest name, the similarity of two texts, and texts with their special characters shown."""

from __future__ import annotations

import pytest

from urdfsync.common.spelling import counted, nearest, same_count, visible


@pytest.mark.parametrize(("name", "likeness", "meant"), [
    ("elbw", 0.6, "elbow"), ("Elbow", 0.6, "elbow"), ("wrist", 0.6, ""), ("elbw", 0.95, ""), ("", 0.6, ""),
])  # fmt: skip
def test_the_most_alike_is_meant(name: str, likeness: float, meant: str) -> None:
    assert nearest(name, iter(["shoulder", "el", "elbow"]), likeness) == meant


@pytest.mark.parametrize(
    ("old", "new", "count"), [("abc", "abd", 2), ("abc", "abc", 3), ("ab", "abc", 2), ("", "a", 0)]
)
def test_so_many_characters_are_the_same(old: str, new: str, count: int) -> None:
    assert same_count(old, new) == same_count(new, old) == count


def test_what_a_terminal_would_obey_is_escaped() -> None:
    assert visible("é 腕\x1b[31m\n\u202e") == "é 腕\\x1b[31m\\n\\u202e"
    assert [counted(count, "file") for count in range(3)] == ["0 files", "1 file", "2 files"]
