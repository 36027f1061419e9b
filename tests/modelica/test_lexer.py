"""Tokens and their places, what has no end, and marks of conflicts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.modelica.lexer import Lexer, is_name, is_number, lex, words_in

TOKENS = {
    "\ufeffReal x=.5e-3*1.;": ["Real", "x", "=", ".5e-3", "*", "1.", ";"],
    "a.b[1:2] := x.^2 <> 1e+5": ["a", ".", "b", "[", "1", ":", "2", "]", ":=", "x", ".", "^", "2", "<>", "1e+5"],
    '"a;\\"\n// b" /* c; */ d // "e': ['"a;\\"\n// b"', "d"],
    "'a // ;b' <= 'c\\'d'": ["'a // ;b'", "<=", "'c\\'d'"],
    "größe == x // end": ["größe", "==", "x"],
    "": [],
}


@pytest.mark.parametrize(("text", "words"), TOKENS.items())
def test_tokens_are_those_of_a_compiler(text: str, words: list[str]) -> None:
    assert words_in(text) == words
    assert lex(text)[1] == []


@given(st.text(alphabet=" \n\"'\\ab1.;=/*"))
def test_each_token_is_where_it_begins(text: str) -> None:
    tokens, _ = lex(text)
    assert [text[token.start :][: len(token.text)] for token in tokens] == [token.text for token in tokens]
    assert [token.text for token in tokens].index("") == len(tokens) - 1


@pytest.mark.parametrize(("text", "kind", "line"), [
    ('a;\n"b;\nc', "string", 2), ("a /* b\n;", "comment", 1), ("a;\n\n'b;\nc", "quoted name", 3),
])  # fmt: skip
def test_what_has_no_end_is_told_at_its_beginning(text: str, kind: str, line: int) -> None:
    assert lex(text)[1] == [(f"has a {kind} without an end", line, False)]


def test_escapes_without_a_meaning() -> None:
    lexer = Lexer('a "\\n\\"\\?";\n"\n \\e" \'\\z\'').read_all()
    words = "has the escape `{}`, which Modelica does not define"
    assert [(one.reason, one.line) for one in lexer.strange_escapes()] == [
        (words.format("\\e"), 3), (words.format("\\z"), 3),
    ]  # fmt: skip


@pytest.mark.parametrize(("token", "number", "name"), [
    ("1", True, False), (".5", True, False), (".", False, False), ("", False, False), ("a", False, True),
    ("_a", False, True), ("'a'", False, True), ("'", False, False), ("end", False, False), ("-", False, False),
])  # fmt: skip
def test_numbers_and_names(token: str, number: bool, name: bool) -> None:
    assert (is_number(token), is_name(token)) == (number, name)
