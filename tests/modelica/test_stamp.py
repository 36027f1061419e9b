"""Stamps of classes: what is stamped can be bared again, and a text that can't has no stamp."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.modelica.stamp import Stamp, split, stamped, with_stamp

STAMP = Stamp("1f0c3a52-9d3e", "9f86d081884c7d65")
TEXTS = [
    "within A;\nmodel M\n  Real x;\nend M;\n",
    "model M\n  Real x;\n  annotation (Icon);\nend M;\n",
    'model M\n  annotation (Documentation(info="<html>; end M;</html>"));\nend M;\n',
    "record R = S(a = 1);\n",
    'record R = S(a = 1) annotation (Documentation(info="&quot;"));\n',
    "package P\r\nend P;\r\n",
    "model M Real x; end M;",
]


@pytest.mark.parametrize("text", TEXTS)
def test_a_stamp_comes_back_and_leaves_the_text_as_it_was(text: str) -> None:
    marked = stamped(text, STAMP)
    assert split(marked) == (text, STAMP)
    assert with_stamp(marked.encode(), None) == text.encode()
    assert split(with_stamp(marked.encode(), Stamp("2", "3")).decode()) == (text, Stamp("2", "3"))


@pytest.mark.parametrize("text", ["", "// nothing\n", 'record A\n<p>&quot;a&quot;. They;\n</html>"));\nend A;\n'])
def test_a_text_that_is_no_class_or_too_broken_has_none(text: str) -> None:
    """A stamp would stand in the middle of a documentation that somebody has broken."""
    assert stamped(text, STAMP) == text


@given(st.sampled_from(TEXTS), st.data())
def test_a_stamp_never_changes_the_rest_of_a_broken_text(text: str, data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(text)))
    broken = text[:start] + text[data.draw(st.integers(start, len(text))) :]
    assert split(stamped(broken, STAMP))[0] == broken
