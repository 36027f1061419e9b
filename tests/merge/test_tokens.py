"""Tokens: what counts as one, and that nothing gets lost."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.merge.tokens import inner_lines, tokens


@given(st.text(st.sampled_from("ab1.-+eE\"'\\/*[]{}(),; \t\n\r=:<>é\u2028"), max_size=40))
def test_tokens_are_the_text(text: str) -> None:
    assert "".join(tokens(text)) == text


def test_lines_inside_strings_and_comments() -> None:
    text = 'a = "one\ntwo\nthree"; // no "\nb /* four\nfive */ c\n"unfinished\n\n'
    assert inner_lines(text) == {1, 2, 4, 6, 7}
    assert inner_lines('a = "b";\nc = 1;\n') == frozenset()
