"""Merging files: line ends, what is no class, what a conflict shows, and merges that can't be right."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge import Merge, merge
from urdfsync.merge.texts import find_flaw

MODEL = "model A\n  Real a;\n  Real b;\nequation\n  a = b;\nend A;\n"
ADDED = MODEL.replace("equation", "  Real mine; // mine\nequation")
GENERATED = MODEL.replace("equation", "  Real new;\nequation")
MERGED = MODEL.replace("equation", "  Real mine; // mine\n  Real new;\nequation")


@pytest.mark.parametrize(
    ("base", "mine", "generated", "merged"),
    [
        pytest.param("", "", "", "", id="nothing"),
        pytest.param("", "a\n", "", "a\n", id="empty base, added by me"),
        pytest.param("", "", "a\n", "a\n", id="empty base, generated"),
        pytest.param("", "a\n", "b\n", None, id="empty base, both different"),
        pytest.param("a\n", "", "a\n", "", id="emptied by me"),
        pytest.param("a\n", "", "b\n", None, id="emptied by me, generated anew"),
        pytest.param("a\nb\nc\n", "a\nb\nc", "x\nb\nc\n", "x\nb\nc", id="last line without end"),
        pytest.param("a\nb\nc", "a\nb\nc\n", "x\nb\nc", "x\nb\nc\n", id="last line with an end"),
        pytest.param("a\nb\nc", "a\nb\nc", "a\nb\nc\nd", "a\nb\nc\nd", id="lines after one without end"),
        pytest.param("a\nb\n", "a\nb", "a\nb\nc\n", None, id="last line without end, but more to come"),
        pytest.param("a\r\nb\r\nc\r\n", "a\r\nb\r\nx\r\n", "y\nb\nc\n", "y\r\nb\r\nx\r\n", id="CRLF is kept"),
        pytest.param("a\nb\nc\n", "a\r\nb\r\nc\r\n", "a\nb\nc\nd\n", "a\r\nb\r\nc\r\nd\r\n", id="CRLF is no change"),
        pytest.param("a\nb\nc\n", "a\nb\nc\n", "a\r\nb\r\nd\r\n", "a\nb\nd\n", id="CRLF is not taken over"),
        pytest.param("a\nb\nc\n", "a\r\nb\nc\n", "a\nb\nd\n", "a\r\nb\nd\n", id="mixed endings stay mixed"),
        pytest.param("ä\u2028\nb\nc\n", "ä\u2028\nb\nx\n", "ö\u2028\nb\nc\n", "ö\u2028\nb\nx\n", id="Unicode"),
        pytest.param("\ufeffa\nb\nc\n", "\ufeffa\nb\nx\n", "\ufeffy\nb\nc\n", "\ufeffy\nb\nx\n", id="byte order mark"),
    ],
)
def test_texts_of_all_kinds(base: str, mine: str, generated: str, merged: str | None) -> None:
    assert merge(base, mine, generated).text == merged


def windows(text: str) -> str:
    return text.replace("\n", "\r\n")


@pytest.mark.parametrize(
    ("base", "mine", "generated", "merged"),
    [
        pytest.param(MODEL, ADDED, GENERATED, MERGED, id="plain"),
        pytest.param(MODEL, windows(ADDED), GENERATED, windows(MERGED), id="CRLF is kept"),
        pytest.param(MODEL, ADDED, windows(GENERATED), MERGED, id="CRLF is not taken over"),
        pytest.param(
            MODEL,
            ADDED.replace("a;\n", "a;\r\n"),
            GENERATED,
            MERGED.replace("a;\n", "a;\r\n"),
            id="mixed endings stay mixed",
        ),
        pytest.param(MODEL, "\ufeff" + ADDED, GENERATED, "\ufeff" + MERGED, id="byte order mark of mine"),
        pytest.param("\ufeff" + MODEL, ADDED, "\ufeff" + GENERATED, MERGED, id="byte order mark taken away"),
        pytest.param(MODEL, ADDED.rstrip(), GENERATED, MERGED.rstrip(), id="no end of the last line"),
    ],
)
def test_classes_keep_their_line_ends(base: str, mine: str, generated: str, merged: str) -> None:
    assert merge(base, mine, generated, is_modelica=True).text == merged


def test_comments_of_windows_stay_in_lines_of_windows() -> None:
    mine = windows(MODEL.replace("  Real b", "  // why\n  Real b"))
    merged = merge(MODEL, mine, MODEL.replace("  Real b;\n", ""), is_modelica=True).text
    assert merged == windows(MODEL.replace("Real b;", "// why"))


@pytest.mark.parametrize(
    "extra",
    ["model C\n  Real c;\nend C;\n", "  Real ?;\n", "model", "model A\n  Real a;\nend A;\n"],
    ids=["two classes", "no Modelica", "half a class", "the same class twice"],
)
def test_what_is_no_single_class_is_merged_by_lines(extra: str) -> None:
    base = MODEL + "\n" + extra
    mine, generated = base.replace("Real a", "Real  a", 1), base.replace("= b", "= 1")
    assert merge(base, mine, generated, is_modelica=True).text == mine.replace("= b", "= 1")
    mine, generated = base.replace("b;\neq", "b;\n  Real c;\neq"), base.replace("b;\neq", "b;\n  Real d;\neq")
    assert merge(base, mine, generated, is_modelica=True).text is None


def test_one_side_that_cannot_be_read_is_merged_by_lines() -> None:
    mine, generated = MODEL.replace("Real a", "Real a(start = 1"), MODEL.replace("= b", "= 1")
    assert merge(MODEL, mine, generated, is_modelica=True).text == mine.replace("= b", "= 1")


# --- conflicts ----------------------------------------------------------------------------------------------------


def test_a_conflict_says_where_and_shows_all_three() -> None:
    mine = MODEL.replace("  Real a", "  // edited\n  Real a(start = 1)")
    generated = MODEL.replace("Real a", "Real a(start = 2)").replace("= b", "= 1")
    result = merge(MODEL.replace("Real a", "Real a(start = 0)"), mine, generated, is_modelica=True)
    (conflict,) = result.contradictions
    assert conflict == "component `a`: you set `start = 1`, the export changes 0 to 2"
    assert result.proposal == mine.replace("= b", "= 1").replace(
        "  Real a(start = 1);\n",
        "<<<<<<< mine\n  Real a(start = 1);\n||||||| base\n  Real a(start = 0);\n"
        "=======\n  Real a(start = 2);\n>>>>>>> generated\n",
    )


GONE = [
    ("B b(x = 1, y = 2, z = 3);", "y = 2, ", "B b(x = 1, z = 3);"),
    ("B b(x = 1, y = 2);", ", y = 2", "B b(x = 1);"),
    ("B b(\n    x = 1,\n    y = 2,\n    z = 3);", "    y = 2,\n", None),
    ("B b;\n  B c(y = 2);\n  B d;", "  B c(y = 2);\n", None),
]


@pytest.mark.parametrize(("text", "removed", "shown"), GONE)
def test_what_a_side_removed_is_no_line_between_the_markers(text: str, removed: str, shown: str | None) -> None:
    base = f"model A\n  {text}\nend A;\n"
    mine, generated = base.replace(removed, ""), base.replace("= 2", "= 5")
    empty = f"  {shown}\n" if shown else ""
    assert f"<<<<<<< mine\n{empty}|||||||" in merge(base, mine, generated, is_modelica=True).proposal
    assert f"=======\n{empty}>>>>>>>" in merge(base, generated, mine, is_modelica=True).proposal


lines = st.lists(
    st.sampled_from(["a\n", "b\n", "  c = 1,\n", "  d = {0, 1},\n", "// e\n", "\n", '"f\n', 'g" h;\n']), max_size=8
)
texts = st.builds("".join, lines)


@given(base=texts, mine=texts, generated=texts)
def test_what_holds_for_all_texts(base: str, mine: str, generated: str) -> None:
    assert merge(base, mine, base).text == mine
    assert merge(base, base, generated).text == generated
    assert merge(base, mine, mine).text == mine
    result = merge(base, mine, generated)
    assert merge(base, generated, mine).text == result.text
    assert (result.text is None) == bool(result.contradictions)
    if result.text is not None:
        assert merge(generated, result.text, generated).text == result.text == result.proposal


@given(base=texts, mine=texts, generated=texts)
def test_a_proposal_has_all_there_is_of_a_conflict(base: str, mine: str, generated: str) -> None:
    result = merge(base, mine, generated)
    pattern = r"^<<<<<<< mine\n(.*?)^\|\|\|\|\|\|\| base\n(.*?)^=======\n(.*?)^>>>>>>> generated\n"
    blocks = re.findall(pattern, result.proposal, re.M | re.S)
    assert len(blocks) == len(result.contradictions)
    for text, versions in zip((mine, base, generated), zip(*blocks, strict=True), strict=False):
        assert all(version.strip() in text for version in versions)


# --- flaws --------------------------------------------------------------------------------------------------------

DECLARED = "model A\n  Real a;\n  Real b;\n  Real c;\nequation\n  a = b;\n  b = c;\n  c = 1;\nend A;\n"


def test_a_merge_that_makes_no_sense_as_modelica_is_none() -> None:
    mine, generated = DECLARED.replace("Real a;", "Real a, d;"), DECLARED.replace("Real c;", "Real c;\n  Real d;")
    result = merge(DECLARED, mine, generated, is_modelica=True)
    assert (result.text, result.contradictions, result.flaw) == (None, (), "declares `d` twice (line 5)")


@pytest.mark.parametrize("side", ["mine", "generated"])
def test_what_a_side_has_is_its_authors_business(side: str) -> None:
    """A flaw is what the merge has more often than each of the sides."""
    odd, plain = DECLARED.replace("  Real a", "  Real c;\n  Real a"), DECLARED.replace("c = 1", "c = 2")
    result = merge(DECLARED, *((odd, plain) if side == "mine" else (plain, odd)), is_modelica=True)
    assert (result.text, result.flaw) == (odd.replace("c = 1", "c = 2"), "")
    odd, more = "x\n<<<<<<< a\ny\n", "x\ny\n<<<<<<< a\n"
    assert merge("x\ny\n", odd, more, is_modelica=True).flaw == "has the conflict marker `<<<<<<<` (line 4)"
    assert find_flaw(odd, [odd, ""]) == find_flaw(odd, ["", odd]) == ""


def test_what_is_no_modelica_hides_nothing_behind_it() -> None:
    odd = DECLARED.replace("  Real a;", "  Real ?a;")
    assert find_flaw(odd, [DECLARED]) == "lacks a name before `?` (line 2)"
    assert find_flaw(odd.replace("Real b", "Real c"), [odd, odd]) == "declares `c` twice (line 4)"


fragments = st.lists(
    st.sampled_from([*set(DECLARED.split()), '"', "'", "/*", "?", "(", ")", "<<<<<<< x\n", "\n"]), max_size=30
)


@given(parts=fragments, others=fragments)
def test_any_text_is_right_if_a_side_is_the_same(parts: list[str], others: list[str]) -> None:
    text, other = " ".join(parts), " ".join(others)
    assert find_flaw(text, [text]) == find_flaw(text, [other, text]) == ""


def test_a_merge_says_nothing_of_what_did_not_change() -> None:
    assert merge(MODEL, ADDED, MODEL, is_modelica=True) == Merge(ADDED, ADDED, ())
    assert merge(MODEL, MODEL, GENERATED, is_modelica=True) == Merge(GENERATED, GENERATED, ())


def test_of_two_parts_of_one_name_neither_side_counts_more() -> None:
    base = "model M\nequation\nend M;\n"
    mine = "model M\n  Parts.Body payload;\nequation\n  connect(payload.a, hand.b);\nend M;\n"
    generated = "model M\n  Links.Payload payload;\nequation\n  connect(payload.a, grip.b);\nend M;\n"
    found = merge(base, mine, generated, is_modelica=True)
    assert found.contradictions
    assert (found.text, found.with_mine, found.with_generated) == (None, None, None)
