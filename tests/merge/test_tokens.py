"""Tokens: what counts as one, and that nothing gets lost."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge.tokens import inner_lines, tokens


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("m = -1.2e-05,", "m| |=| |-1.2e-05|,", id="sign and exponent"),
        pytest.param("a-5 + b[2]-1.5", "a|-|5| |+| |b[2]|-|1.5", id="a sign after an operand is an operator"),
        pytest.param("{0, -0.5, 1e3}", "{0, -0.5, 1e3}", id="vector"),
        pytest.param("[1, 2; 3, 4];", "[1, 2; 3, 4]|;", id="matrix"),
        pytest.param("{{1,2},{3,4}}}", "{{1,2},{3,4}}|}", id="array of arrays"),
        pytest.param("{0, a}", "{|0|,| |a|}", id="an array with a name in it is no number"),
        pytest.param(".Modelica.A.b[i, 2].c", ".Modelica.A.b[i, 2].c", id="dotted name with subscripts"),
        pytest.param(r'"a \" // b" // "c', r'"a \" // b"| |// "c', id="string, comment"),
        pytest.param("/* a\n b */'q \" r'", "/* a\n b */|'q \" r'", id="comment of two lines, quoted name"),
        pytest.param('"a\nb\n', '"a\nb\n', id="unfinished string"),
        pytest.param("x:=a<=b;\n\n \t", "x|:=|a|<=|b|;|\n|\n| \t", id="operators, ends of line, blanks"),
        pytest.param("2.07.1", "2.07|.|1", id="no number"),
        pytest.param("→ é", "→| |é", id="not ASCII"),
    ],
)
def test_what_is_one_token(text: str, expected: str) -> None:
    assert tokens(text) == expected.split("|")


@given(st.text(st.sampled_from("ab1.-+eE\"'\\/*[]{}(),; \t\n\r=:<>é\u2028"), max_size=40))
def test_tokens_are_the_text(text: str) -> None:
    assert "".join(tokens(text)) == text


def test_lines_inside_strings_and_comments() -> None:
    text = 'a = "one\ntwo\nthree"; // no "\nb /* four\nfive */ c\n"unfinished\n\n'
    assert inner_lines(text) == {1, 2, 4, 6, 7}
    assert inner_lines('a = "b";\nc = 1;\n') == frozenset()
