"""The words of Modelica texts: enough to compare, count and place what generated files declare."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

from urdfsync.modelica.lexer import is_name, lex
from urdfsync.modelica.names import KEYWORDS

Kind = Literal["string", "number", "name", "keyword", "mark"]


class Word(NamedTuple):
    """A token and its kind; comments and white space are none."""

    kind: Kind
    text: str


_VALUE = re.compile(r""""(?:\\.|[^"\\])*"|(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?""", re.ASCII)
_OPEN, _CLOSE = "({[", ")}]"


def words(text: str) -> list[Word]:
    """The tokens of a text."""
    return [Word(_kind(token.text), token.text) for token in lex(text)[0][:-1]]


def _kind(text: str) -> Kind:
    if text in KEYWORDS:
        return "keyword"
    return "name" if is_name(text) else "string" if text[0] == '"' else "number" if text[0].isdigit() else "mark"


def grammar_kinds(text: str) -> str:
    """What a parser's grammar sees of a text: kinds of strings, numbers and names, and all other words themselves."""
    return " ".join(word.text if word.kind in ("keyword", "mark") else word.kind[0] for word in words(text))


def without_values(text: str) -> str:
    """The text with every string and every number replaced by a zero: what is left are its names and its structure."""
    return _VALUE.sub("0", text)


def without_annotations(sequence: Sequence[Word]) -> list[Word]:
    """The words that stand in no annotation."""
    result: list[Word] = []
    depth = -1
    for word in sequence:
        if depth < 0 and word == Word("keyword", "annotation"):
            depth = 0
        elif depth < 0:
            result.append(word)
        elif word.kind == "mark":
            depth += (word.text in _OPEN) - (word.text in _CLOSE)
            depth = depth or -1
    return result


def unbalanced(sequence: Sequence[Word]) -> str:
    """The brackets that have no partner, an empty text if all have."""
    stack = ""
    for word in sequence:
        if word.kind == "mark" and word.text in _OPEN:
            stack += word.text
        elif word.kind == "mark" and word.text in _CLOSE:
            if not stack or _OPEN.index(stack[-1]) != _CLOSE.index(word.text):
                return stack + word.text
            stack = stack[:-1]
    return stack


def qualified_names(sequence: Sequence[Word]) -> Iterator[str]:
    """Names with all their dots: `a.b.c` once, as it stands."""
    text = " ".join(word.text for word in sequence if word.kind != "string")
    return (name.replace(" ", "") for name in re.findall(r"[^\W\d]\w*(?: \. [^\W\d]\w*)*", text))
