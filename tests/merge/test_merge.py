"""Merging: what survives side by side, what is a conflict, and that whole lines merge as they do in git."""

from __future__ import annotations

import random
import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often
from urdfsync.merge.tokens import inner_lines, is_word, tokens

from urdfsync.merge import Merge, merge, split_lines
from urdfsync.merge.lines import find_flaw, merge_lines

EXAMPLES = Path(__file__).parents[2] / "modelica" / "UrdfSync" / "Examples"

RECORD = """\
record ForearmParameters "Numbers of link \\"forearm\\""
  extends UrdfSync.Records.Link(
    name = "forearm",
    inertial(
      origin(
        xyz = {0.1118, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.2,
      inertia(
        ixx = 0.005953,
        iyy = 0.029335,
        izz = 0.030752)));
  parameter Real gain = 1.05
    "Of the drive";
  Real r = min(a, b);
  Real s = sum(2 * a + 2 * a);
  Body body(m = parameters.mass, animation = false) annotation (Placement(transformation(extent={{0, 0}, {20, 20}})));
end ForearmParameters;
"""

REWRITTEN = (
    "Body body(m = parameters.mass, animation = false)",
    "Sphere ball(each quantity = 7, m = parameters.mass, color = red, r = 3)",
)

Edit = tuple[str, str]
"""What is there once, and what it is replaced by."""


def changed(*edits: Edit, text: str = RECORD) -> str:
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


SIDE_BY_SIDE: dict[str, tuple[Edit, Edit]] = {
    "comment at the end of the line, value": (("1.2,", "1.2, // weighed"), ("1.2", "1.25")),
    "comment, line added after it": (("1.2,", "1.2, // kg"), ("      inertia", "      load = 3,\n      inertia")),
    "comment right after the value": (("gain = 1.05", "gain = 1.05 // tuned"), ("1.05", "1.07")),
    "comment line before the value's": (("      mass", "      // full\n      mass"), ("1.2", "1.25")),
    "values two lines apart": (("mass = 1.2", "mass = 1.3"), ("ixx = 0.005953", "ixx = 0.006")),
    "value, name on the next line": (("mass = 1.2", "mass = 1.3"), ("inertia(", "tensor(")),
    "values one line apart": (("ixx = 0.005953", "ixx = 0.006"), ("iyy = 0.029335", "iyy = 0.03")),
    "prefix, value": (("        ixx", "        final ixx"), ("0.005953", "0.006")),
    "spacing, value": (("ixx = 0.005953", "ixx  =  0.005953"), ("0.005953", "0.006")),
    "last item added": (("752)));", "752,\n        ixy = 1e-6)));"), ("iyy = 0.029335", "iyy = 1")),
    "item line added, value before": (("mass = 1.2,", "mass = 1.2,\n      load = 3,"), ("1.2", "1.25")),
    "item line added, value after": (("      mass", "      load = 3,\n      mass"), ("1.2", "1.25")),
    "item line removed, value before": (("        iyy = 0.029335,\n", ""), ("0.005953", "0.006")),
    "item added, value before": (("mass, anim", "mass, r = 1, anim"), ("parameters.mass", "5")),
    "item added at the end, value before": (("= false)", "= false, r = 1)"), ("= false", "= true")),
    "item removed, value after": (("m = parameters.mass, ", ""), ("false", "true")),
    "item renamed, value before": (("animation =", "visible ="), ("parameters.mass", "5")),
    "type, value": (("Body body", "Sphere body"), ("parameters.mass", "5")),
    "function, its second argument": (("min(a", "max(a"), ("b)", "y)")),
    "declaration, the next one": (('"Of the drive";', '"Mine";'), ("Real r", "Length r")),
    "declaration added, the one before": (("  Body", "  Real x;\n  Body"), ('drive"', 'motor"')),
}  # fmt: skip


@pytest.mark.parametrize(("mine", "generated"), SIDE_BY_SIDE.values(), ids=SIDE_BY_SIDE)
def test_both_survive(mine: Edit, generated: Edit) -> None:
    result = merge(RECORD, changed(mine), changed(generated))
    both = changed(mine, generated)
    assert result == Merge(both, both, ())
    assert merge(RECORD, changed(generated), changed(mine)) == result


CONFLICTS: dict[str, tuple[Edit, Edit]] = {
    "one number": (("1.05", "2.05"), ("1.05", "1.07")),
    "sign, digits": (("= 1.05", "= -1.05"), ("1.05", "1.07")),
    "exponent, digits": (("= 1.05", "= 1.05e-3"), ("1.05", "1.07")),
    "expression, number": (("1.05", "1.05 + offset"), ("1.05", "1.07")),
    "one vector": (("{0.1118, 0, 0}", "{0.2, 0, 0}"), ("{0.1118, 0, 0}", "{0.1118, 0, 0.5}")),
    "one matrix": (("{0, 0}, {", "{5, 5}, {"), ("{20, 20}", "{30, 30}")),
    "one dotted name": (("parameters.mass", "data.mass"), ("parameters.mass", "parameters.m")),
    "one string": (("Of the drive", "Of my drive"), ("the drive", "the motor")),
    "name, its value": (("gain = ", "factor = "), ("1.05", "1.07")),
    "value, the description after it": (("1.05", "1.06"), ('"Of the drive"', '"Of it"')),
    "line removed, value in it": (("      mass = 1.2,\n", ""), ("1.2", "1.25")),
    "two items at one place": (("mass, a", "mass, r = 1, a"), ("mass, a", "mass, s = 2, a")),
    "two items at the end": (("false)", "false, r = 1)"), ("false)", "false, s = 2)")),
    "two arguments": (("min(a", "min(x"), ("b)", "y)")),
    "two lines at one place": (("  Body", "  Real x;\n  Body"), ("  Body", "  Real y;\n  Body")),
    "item added, the next one removed": (("mass, a", "mass, r = 1, a"), (", animation = false", "")),
    "item added, the one before removed": (("false)", "false, r = 1)"), (", animation = false", "")),
    "one of two equal terms removed, the other changed": (("2 * a + 2 * a", "2 * a"), ("sum(2", "sum(3")),
    "comment, its value removed": (("1.05\n", "1.05 // mine\n"), (" = 1.05", "")),
    "comment, its line removed and a comment on the line before": (
        ("iyy = 0.029335,", "iyy = 0.029335, // mine"),
        ("ixx = 0.005953,\n        iyy = 0.029335,", "ixx = 0.005953, // approximate"),
    ),
    "comment that would swallow what follows": (("a);\n", "a); // mine\n"), ("a);\n ", "a);")),
    "declaration rewritten, value in it": (REWRITTEN, ("parameters.mass", "5")),
}  # fmt: skip


@pytest.mark.parametrize(("mine", "generated"), CONFLICTS.values(), ids=CONFLICTS)
def test_conflicts(mine: Edit, generated: Edit) -> None:
    result = merge(RECORD, changed(mine), changed(generated))
    assert result.text is None
    assert len(result.conflicts) == 1
    assert merge(RECORD, changed(generated), changed(mine)).text is None


def test_a_conflict_says_where_and_shows_all_three() -> None:
    mine = changed(("name", "// edited\n    name"), ("1.05", "2.05"))
    result = merge(RECORD, mine, changed(("1.05", "1.07"), ("ixx = 0.005953", "ixx = 0.006")))
    (conflict,) = result.conflicts
    assert (conflict.base, conflict.mine, conflict.generated) == (range(13, 14), range(14, 15), range(13, 14))
    assert result.proposal == changed(
        ("ixx = 0.005953", "ixx = 0.006"),
        (
            "  parameter Real gain = 2.05\n",
            "<<<<<<< mine\n  parameter Real gain = 2.05\n"
            "||||||| base\n  parameter Real gain = 1.05\n"
            "=======\n  parameter Real gain = 1.07\n>>>>>>> generated\n",
        ),
        text=mine,
    )


@pytest.mark.parametrize(("length", "clean"), [(200, True), (201, False)])
def test_a_rewrite_is_left_to_people(length: int, clean: bool) -> None:
    base, mine, generated, both = (
        "".join(f"  x{number} = {value};{comment}\n" for number in range(length))
        for value in (1, 2)
        for comment in ("", " // mine")
    )
    assert merge(base, mine, generated).text == (both if clean else None)


def test_a_line_of_very_many_tokens_is_left_to_people() -> None:
    """Comparing them all would take minutes, and the test would not end."""
    base, mine, generated = (
        f"a = {{{', '.join(random.Random(seed).choices(NAMES, k=20_000))}}};\n" for seed in range(3)
    )
    assert merge(base, mine, generated).text is None
    assert merge(base, mine.replace("a =", "b ="), base + "c = 1;\n").text is None


DOCUMENT = (
    'model A\n  annotation (Documentation(info="<html>\n<p>one</p>\n<p>two</p>\n<p>three</p>\n</html>"));\nend A;\n'
)


def test_lines_of_a_string_merge_as_lines() -> None:
    mine, generated = DOCUMENT.replace("one", "1"), DOCUMENT.replace("three", "3")
    assert merge(DOCUMENT, mine, generated).text == mine.replace("three", "3")


def test_a_string_over_several_lines_is_not_merged_by_tokens() -> None:
    mine, generated = DOCUMENT.replace("one", "1"), DOCUMENT.replace("two", "2")
    assert merge(DOCUMENT, mine, generated).text is None


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
        pytest.param("a\nb\nc\n", "a\nb\nc", "a\nb\nx\n", "a\nb\nx", id="last line without end, new value"),
        pytest.param("a\nb\nc", "a\nb\nc", "a\nb\nc\nd", "a\nb\nc\nd", id="lines after one without end"),
        pytest.param("a\nb\n", "a\nb", "a\nb\nc\n", None, id="last line without end, but more to come"),
        pytest.param("a;\nb;\n", "a;\nb;", "a;\nb;\nc;\n", None, id="last line without end, but one more to come"),
        pytest.param("a\r\nb\r\nc\r\n", "a\r\nb\r\nx\r\n", "y\nb\nc\n", "y\r\nb\r\nx\r\n", id="CRLF is kept"),
        pytest.param("a\nb\nc\n", "a\r\nb\r\nc\r\n", "a\nb\nc\nd\n", "a\r\nb\r\nc\r\nd\r\n", id="CRLF is no change"),
        pytest.param("a\nb\nc\n", "a\nb\nc\n", "a\r\nb\r\nd\r\n", "a\nb\nd\n", id="CRLF is not taken over"),
        pytest.param("a\nb\nc\n", "a\r\nb\nc\n", "a\nb\nd\n", "a\r\nb\nd\n", id="mixed endings stay mixed"),
        pytest.param("a = 1;\r\n", "a = 1; // µ\r\n", "a = 2;\n", "a = 2; // µ\r\n", id="CRLF and tokens"),
        pytest.param(
            "ä\u2028\x0b\nb\nc\n", "ä\u2028\x0b\nb\nx\n", "ö\u2028\x0b\nb\nc\n", "ö\u2028\x0b\nb\nx\n", id="Unicode"
        ),
        pytest.param("\ufeffa\nb\nc\n", "\ufeffa\nb\nx\n", "\ufeffy\nb\nc\n", "\ufeffy\nb\nx\n", id="byte order mark"),
    ],
)
def test_texts_of_all_kinds(base: str, mine: str, generated: str, merged: str | None) -> None:
    assert merge(base, mine, generated).text == merged


# --- Modelica -----------------------------------------------------------------------------------------------------

DECLARED = "model A\n  Real a;\n  Real b;\n  Real c;\nequation\n  a = b;\n  b = c;\n  c = 1;\nend A;\n"


def test_a_merge_that_makes_no_sense_as_modelica_is_none() -> None:
    mine, generated = (DECLARED.replace(f"  Real {name};\n", f"  Real {name};\n  Real d;\n") for name in "ac")
    plain, result = (merge(DECLARED, mine, generated, is_modelica=flag) for flag in (False, True))
    assert plain.text == plain.proposal == result.proposal
    assert result == Merge(None, plain.proposal, (), "declares `d` twice (line 6)")


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
    st.sampled_from([*set(tokens(DECLARED)), '"', "'", "/*", "?", "(", ")", "<<<<<<< x\n", "\n"]), max_size=30
)


@given(parts=fragments, others=fragments)
def test_any_text_is_right_if_a_side_is_the_same(parts: list[str], others: list[str]) -> None:
    text, other = " ".join(parts), " ".join(others)
    assert find_flaw(text, [text]) == find_flaw(text, [other, text]) == ""


def test_lines_inside_strings_and_comments() -> None:
    text = 'a = "one\ntwo\nthree"; // no "\nb /* four\nfive */ c\n"unfinished\n\n'
    assert inner_lines(text) == {1, 2, 4, 6, 7}
    assert inner_lines('a = "b";\nc = 1;\n') == frozenset()


# --- what must hold for all texts ---------------------------------------------------------------------------------

lines = st.lists(
    st.sampled_from(["a\n", "b\n", "  c = 1,\n", "  d = {0, 1},\n", "// e\n", "\n", '"f\n', 'g" h;\n']), max_size=8
)
texts = st.builds("".join, lines)


@given(st.text(st.sampled_from("ab1.-+eE\"'\\/*[]{}(),; \t\n\r=:<>é\u2028"), max_size=40))
def test_tokens_are_the_text(text: str) -> None:
    assert "".join(tokens(text)) == text


@given(base=texts, mine=texts, generated=texts)
def test_what_one_side_does_is_done(base: str, mine: str, generated: str) -> None:
    assert merge(base, mine, base).text == mine
    assert merge(base, base, generated).text == generated
    assert merge(base, mine, mine).text == mine


@given(base=texts, mine=texts, generated=texts)
def test_symmetry_and_idempotence(base: str, mine: str, generated: str) -> None:
    result = merge(base, mine, generated)
    assert merge(base, generated, mine).text == result.text
    if result.text is not None:
        assert merge(generated, result.text, generated).text == result.text
        assert result.proposal == result.text


@given(base=texts, mine=texts, generated=texts)
def test_a_proposal_has_all_there_is_of_a_conflict(base: str, mine: str, generated: str) -> None:
    result = merge(base, mine, generated)
    assert (result.text is None) == bool(result.conflicts)
    versions = [split_lines(text) for text in (mine, base, generated)]
    blocks = re.findall(
        r"^<<<<<<< mine\n(.*?)^\|\|\|\|\|\|\| base\n(.*?)^=======\n(.*?)^>>>>>>> generated\n",
        result.proposal,
        re.M | re.S,
    )
    expected = [
        tuple("".join(version[part.start - 1 : part.stop - 1]) for version, part in zip(versions, parts, strict=True))
        for parts in ((conflict.mine, conflict.base, conflict.generated) for conflict in result.conflicts)
    ]
    assert blocks == expected


NAMES = [f"name{number}" for number in range(6)]
edits = st.lists(
    st.tuples(
        st.sampled_from(["value", "rename", "comment", "line comment", "add after", "add before", "remove", "space"]),
        st.sampled_from(NAMES),
    ),
    max_size=4,
)


def modelica(side: str, steps: Sequence[tuple[str, str]], *, one_line: bool) -> str:
    """A list of modifiers whose words are all different, with the edits of one side, whose words are its own."""
    items = [(name, f"  {name} = {number}.5,", " ") for number, name in enumerate(NAMES)]
    for count, (step, name) in enumerate(steps):
        word = f"{side}{count}"
        place = next((index for index, item in enumerate(items) if item[0] == name), None)
        if place is None:
            continue
        _, text, end = items[place]
        match step:
            case "value":
                text = re.sub(r"= [\w.]+", f"= {word}", text, count=1)
            case "rename":
                text = re.sub(r"\w+ +=", f"{word} =", text, count=1)
            case "comment":
                text += f" /* {word} */"
            case "line comment":
                end = f" // {word}\n"
            case "add after":
                text += f" {word} = {word}v,"
            case "add before":
                items.insert(place, (word, f"  {word} = {word}v,", "\n"))
                place += 1
            case "space":
                text = text.replace(" =", "   =", 1)
        items[place] = (name, text, end)
        if step == "remove":
            del items[place]
    return "".join(f"{text}{end if one_line else end.rstrip(' ') or chr(10)}" for _, text, end in items) + "\n"


def words(text: str) -> list[str]:
    """Names, numbers and comments in order."""
    return [token for token in tokens(text) if is_word(token) or token.startswith("/")]


@given(mine=edits, generated=edits, one_line=st.booleans())
def test_no_word_is_lost_doubled_or_brought_back(
    mine: list[tuple[str, str]], generated: list[tuple[str, str]], one_line: bool
) -> None:
    base, ours, theirs = (
        modelica(side, steps, one_line=one_line) for side, steps in (("", []), ("m", mine), ("g", generated))
    )
    merged = merge(base, ours, theirs).text
    if merged is None:
        return
    before, left, right, after = map(words, (base, ours, theirs, merged))
    kept = {word for word in before if word in left and word in right}
    assert sorted(after) == sorted(kept | {word for word in left + right if word not in before})
    for side in (left, right):
        assert [word for word in after if word in side] == [word for word in side if word in after], "order"
    assert merge(base, merged, theirs).text in (merged, None), "what has been merged is not merged again"


# --- git ----------------------------------------------------------------------------------------------------------

Texts = tuple[list[str], list[str], list[str]]


@st.composite
def three_texts(draw: st.DrawFn) -> Texts:
    """Lines of few kinds, and twice the same lines with some of them replaced, gone or more."""
    line = st.sampled_from([f"{number}\n" for number in range(draw(st.sampled_from([2, 5, 40])))])
    base = draw(st.lists(line, max_size=30))
    sides = list(base), list(base)
    for side in sides:
        for _ in range(draw(st.integers(0, 5))):
            place, size = draw(st.integers(0, len(side))), draw(st.integers(0, 3))
            side[place : place + size] = draw(st.lists(line, max_size=3))
        if side and draw(st.integers(0, 9)) == 9:
            side[-1] = side[-1].removesuffix("\n")
    return base, *sides


def git_merge(folder: Path, texts: Texts) -> str | None:
    """What git makes of it, None for a conflict."""
    paths = [folder / name for name in ("base", "mine", "generated")]
    for path, text in zip(paths, texts, strict=True):
        path.write_bytes("".join(text).encode())
    base, mine, generated = map(str, paths)
    command = ["git", "-c", "merge.conflictStyle=merge", "merge-file", "-p", "-q", mine, base, generated]
    process = subprocess.run(command, capture_output=True, check=False)
    assert 0 <= process.returncode < 128, process.stderr
    return process.stdout.decode() if process.returncode == 0 else None


def by_lines(texts: Texts) -> str | None:
    """What merging whole lines alone makes of it."""
    _, mine, _ = texts
    result: list[str] = []
    place = 0
    for (_, ours, _), text in merge_lines(*texts):
        if text is None:
            return None
        result += [*mine[place : ours.start], text]
        place = ours.stop
    return "".join(result + mine[place:])


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed: there is nothing to compare with")
@often(200)
@given(texts=three_texts())
def test_lines_merge_as_in_git(texts: Texts, tmp_path: Path) -> None:
    expected = git_merge(tmp_path, texts)
    assert by_lines(texts) == expected
    assert expected is None or merge(*map("".join, texts)).text == expected


def test_edits_of_one_side_are_judged_one_by_one() -> None:
    comments = ("mass = 1.2,", "mass = 1.2, // weighed"), ("iyy = 0.029335,", "iyy = 0.029335, // a guess")
    generated = ("1.2,\n", "1.3,\n      load = 3,\n"), ("0.005953", "1"), ("0.029335", "2"), ("0.030752", "3")
    expected = changed(*comments, ("1.2,", "1.3,"), ("      inertia", "      load = 3,\n      inertia"), *generated[1:])
    assert merge(RECORD, changed(*comments), changed(*generated)).text == expected


def test_alike_on_both_sides_is_done_once() -> None:
    mine, generated = changed(("1.2", "1.3"), ("1.05", "1.1 // tuned")), changed(("1.2", "1.3"), ("1.05", "1.1"))
    assert merge(RECORD, mine, generated).text == mine
    mine, generated = changed(("inertia(", "// full\n      tensor(")), changed(("inertia(", "tensor("))
    assert merge(RECORD, mine, generated).text == mine
