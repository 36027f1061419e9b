"""What the user did not touch is not read by a merge: the result is the same as if it were."""

from __future__ import annotations

import functools
import time
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often
from support.statements import KINDS, Editor

from urdfsync.merge import Merge, merge

COMPONENTS = "".join(
    f"  replaceable Joints.J{number} j{number}(\n    k = {number})\n    constrainedby Joint(k = {number})\n"
    f'    "Joint {number}"\n    annotation (Placement(transformation(extent={{{{0, {number}}}, {{1, 1}}}})));\n\n'
    for number in range(9)
)
CONNECTIONS = "".join(
    f"  connect(j{number}.a, j{number + 1}.b)\n    annotation (Line(points={{{{{number}, 0}}, {{1, 1}}}}));\n"
    for number in range(8)
)
TEXT = f"""\
within P;

model A "An arm"
  extends B;

{COMPONENTS}protected
  Real x;
  model N
    Real j3;
  end N;

equation
{CONNECTIONS}
  annotation (
    Icon(graphics={{Text(textString="a")}}),
    Documentation(info="<html>
  Real j7(k = 1);
  connect(j7.a, j8.b);
</html>"));
end A;
"""
UNREAD = "urdfsyncStub"
"""A text with this word is read as a whole."""


SAYING = [kind for kind in KINDS if kind not in ("remark", "comment")]
"""Comments of an export reach a merge only where it says something else, too."""


def as_a_whole(*texts: str) -> Merge:
    """The merge of texts of which all is read."""
    return merge(*(f"{text}// {UNREAD}\n" for text in texts), is_modelica=True)


@often(100)
@given(
    st.randoms(use_true_random=False), st.lists(st.sampled_from(KINDS), max_size=3), st.lists(st.sampled_from(SAYING))
)
def test_what_is_not_read_changes_no_merge(random: Random, mine: list[str], generated: list[str]) -> None:
    base = TEXT.replace("  model N\n    Real j3;\n  end N;\n", "")
    ours = functools.reduce(Editor("mine", random).edit, mine, base)
    theirs = functools.reduce(Editor("new", random).edit, generated, base)
    found, expected = merge(base, ours, theirs, is_modelica=True), as_a_whole(base, ours, theirs)
    assert found.text == (expected.text and expected.text.removesuffix(f"// {UNREAD}\n"))
    assert found.conflicts == expected.conflicts
    assert UNREAD not in found.proposal


CHANGES = {
    "a class within": ("    Real j3;\n", "    Real j3 = 1;\n"),
    "a documentation": ("  Real j7(k = 1);\n", "  Real j7(k = 2);\n"),
    "a section": ("protected\n", ""),
    "a name": ("j5", "j55"),
    "an element less": ("  connect(j3.a, j4.b)\n    annotation (Line(points={{3, 0}, {1, 1}}));\n", ""),
}


@pytest.mark.parametrize("mine", CHANGES)
@pytest.mark.parametrize("generated", CHANGES)
def test_changes_of_all_kinds(mine: str, generated: str) -> None:
    ours, theirs = (TEXT.replace(*CHANGES[one]) for one in (mine, generated))
    found, expected = merge(TEXT, ours, theirs, is_modelica=True), as_a_whole(TEXT, ours, theirs)
    assert found.text == (expected.text and expected.text.removesuffix(f"// {UNREAD}\n"))
    assert found.conflicts == expected.conflicts


def test_a_large_model_merges_in_a_fraction_of_the_time() -> None:
    """Seconds depend on the machine; with all of it read, it takes five times as long."""
    parts = COMPONENTS + "".join(COMPONENTS.replace("j", f"j{number}_") for number in range(60))
    base = TEXT.replace(COMPONENTS, parts)
    mine, generated = base.replace("  Real x;", "  Real x;\n  Real m;"), base.replace("extent={{0", "extent={{7")
    times = []
    for texts in ((base, mine, generated), [f"{text}// {UNREAD}\n" for text in (base, mine, generated)]):
        start = time.process_time()
        assert merge(*texts, is_modelica=True).text is not None
        times.append(time.process_time() - start)
    assert times[0] < 0.6 * times[1]
