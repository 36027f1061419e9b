"""Stamps of classes: what is stamped can be bared again, and a text that can't has no stamp."""

from __future__ import annotations

import re

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


@pytest.mark.parametrize("text", ["", "// nothing\n", 'model A\n  annotation (Documentation(info="<p>;\nend A;\n'])
def test_a_text_that_is_no_class_or_too_broken_has_none(text: str) -> None:
    assert stamped(text, STAMP) == text


@pytest.mark.parametrize(
    "text", ['record A\n<p>&quot;a&quot;. They;\n</html>"));\nend A;\n', 'model A "a\n  );\nend A;\n']
)
def test_a_broken_string_that_ends_as_it_should_has_its_stamp_there(text: str) -> None:
    assert split(stamped(text, STAMP)) == (text, STAMP)
    assert ", __urdfsync" in stamped(text, STAMP)


@given(st.sampled_from(TEXTS), st.data())
def test_a_stamp_never_changes_the_rest_of_a_broken_text(text: str, data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(text)))
    broken = text[:start] + text[data.draw(st.integers(start, len(text))) :]
    assert split(stamped(broken, STAMP))[0] == broken


@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("comment", ["  // mine\n", "/* mine, ( */", '  // "mine,\n  /* ; */ // )\n'])
def test_a_comment_of_the_users_may_stand_anywhere(text: str, comment: str) -> None:
    """In front of the stamp, and behind it: no part of the text goes with the stamp, which can be renewed."""
    marked = stamped(text, STAMP)
    strings = [found.span() for found in re.finditer(r'"[^"]*"', marked)]
    for place in (found.start() for found in re.finditer(r"\b|\n|$", marked)):
        if any(start < place < end for start, end in strings) or marked[place - 2 : place] in ("__", '= "'):
            continue
        edited = marked[:place] + comment + marked[place:]
        bare, stamp = split(edited)
        if stamp is None:  # the comment is inside of it
            assert place in range(marked.index("__urdfsync"), marked.index(STAMP.base) + 20)
            continue
        left = code_of(bare)  # an annotation with a comment stays, even if it is empty
        assert code_of(text) in (left, left.replace("annotation();", ""), left.replace("annotation()", "")), edited
        assert comment.strip() in bare
        again = with_stamp(edited.encode(), Stamp("2", "3")).decode()
        assert split(again) == (bare, Stamp("2", "3")), again
        assert re.search(r"[,(]\s*__urdfsync", without_comments(again)), again


def without_comments(text: str) -> str:
    return re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*|/\*.*?\*/', lambda found: found[1] or " ", text, flags=re.DOTALL)


def code_of(text: str) -> str:
    return "".join(without_comments(text).split())


def test_a_stamp_in_a_comment_is_none() -> None:
    text = f'model M\n  annotation (Icon\n    //, __urdfsync(id = "{STAMP.id}", base = "{STAMP.base}")\n  );\nend M;\n'
    assert split(text.replace("//,", "//")) == (text.replace("//,", "//"), None)


def test_a_stamp_behind_broken_code_counts_and_takes_nothing_else_with_it() -> None:
    broken = stamped('model M\n  annotation (Documentation(info="<html>\n</html>"));\nend M;\n', STAMP)
    assert split(broken.replace('</html>"),\n', "")) == (
        'model M\n  annotation (Documentation(info="<html>\n    );\nend M;\n',
        STAMP,
    )
