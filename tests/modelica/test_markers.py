"""Merge markers of any length."""

from __future__ import annotations

import pytest

from urdfsync.modelica.markers import find_markers, join_sides, read_sides, without_labels

MERGE = "a\n<<<<<<< HEAD\nb\n=======\nc\n>>>>>>> theirs\nd\n"
DIFF3 = "a\n<<<<<<< HEAD\nb\n||||||| 1f0a\nx\n=======\nc\n>>>>>>> theirs\nd\n"
LONGER = MERGE.replace("<<<<<<<", 9 * "<").replace("=======", 9 * "=").replace(">>>>>>>", 9 * ">")
NESTED = f"<<<<<<< HEAD\n{LONGER}=======\nd\n>>>>>>> theirs\n"


@pytest.mark.parametrize(
    ("text", "ours", "theirs", "joined"),
    [
        (MERGE, "a\nb\nd\n", "a\nc\nd\n", "a\nb\nc\nd\n"),
        (DIFF3, "a\nb\nd\n", "a\nc\nd\n", "a\nb\nc\nd\n"),
        (LONGER, "a\nb\nd\n", "a\nc\nd\n", "a\nb\nc\nd\n"),
        (NESTED, LONGER, "d\n", f"{LONGER}d\n"),
        (MERGE.replace("\n", "\r\n"), "a\r\nb\r\nd\r\n", "a\r\nc\r\nd\r\n", "a\r\nb\r\nc\r\nd\r\n"),
        (2 * MERGE.removesuffix("d\n"), "a\nb\na\nb\n", "a\nc\na\nc\n", "a\nb\nc\na\nb\nc\n"),
        ("// =======\n=======\n", *3 * ["// =======\n=======\n"]),
        (MERGE.replace("=======\n", ""), *3 * [MERGE.replace("=======\n", "")]),
    ],
)
def test_sides_between_markers(text: str, ours: str, theirs: str, joined: str) -> None:
    assert read_sides(text) == (ours, theirs)
    assert join_sides(text) == joined


def test_markers_begin_a_line() -> None:
    text = "<<<<<<< mine\na\n|||||||\n=======\n >>>>>>> b\n>>>>>>>> theirs\n<<<<<<<a\n<<<<<<<\r\n>>>>>>>"
    assert find_markers(text) == [("<<<<<<<", 1), (">>>>>>>>", 6), ("<<<<<<<", 8), (">>>>>>>", 9)]


def test_other_signs_are_found_if_they_are_asked_for() -> None:
    assert find_markers("<<<<<<< a\n|||||||\n=======\n ======= \n", "|=") == [("|||||||", 2), ("=======", 3)]


def test_labels_do_not_count() -> None:
    assert without_labels(MERGE) == MERGE.replace(" HEAD", "").replace(" theirs", "")
    assert without_labels("a < b\n") == "a < b\n"
