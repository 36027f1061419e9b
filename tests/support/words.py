"""The words of Modelica texts: enough to compare, count and place what generated files declare."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

from urdfsync.modelica.names import KEYWORDS

Kind = Literal["string", "number", "name", "keyword", "mark"]


class Word(NamedTuple):
    """A token and its kind; comments and white space are none."""

    kind: Kind
    text: str


_WORD = re.compile(
    r"""\s+ | //[^\n]* | /\*.*?\*/
    | (?P<string>"(?:\\.|[^"\\])*")
    | (?P<number>\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)
    | (?P<name>[A-Za-z_]\w*|'(?:\\.|[^'\\])*')
    | (?P<mark>[<>=]=|<>|:=|\.[+\-*/^]|.)""",
    re.VERBOSE | re.DOTALL | re.ASCII,
)
_VALUE = re.compile(r""""(?:\\.|[^"\\])*"|(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?""", re.ASCII)
_OPEN, _CLOSE = "({[", ")}]"


def words(text: str) -> list[Word]:
    """The tokens of a text, in the lexical units of the Modelica specification, chapter 2."""
    result = []
    for match in _WORD.finditer(text):
        kind = match.lastgroup
        if kind == "name" and match.group() in KEYWORDS:
            kind = "keyword"
        if kind is not None:
            result.append(Word(kind, match.group()))  # type: ignore[arg-type]
    return result


def grammar_kinds(text: str) -> str:
    """What a parser's grammar sees of a text: kinds of strings, numbers and names, and all other words themselves."""
    return " ".join(word.text if word.kind in ("keyword", "mark") else word.kind[0] for word in words(text))


def without_values(text: str) -> str:
    """The text with every string and every number replaced by a zero: what is left are its names and its structure."""
    return _VALUE.sub("0", text)


def without_annotations(sequence: Sequence[Word]) -> list[Word]:
    """The words that stand in no annotation."""
    result: list[Word] = []
    position = 0
    while position < len(sequence):
        if sequence[position] == Word("keyword", "annotation"):
            position = _closing(sequence, position + 1) + 1
        else:
            result.append(sequence[position])
            position += 1
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
    parts: list[str] = []
    for word in (*sequence, Word("mark", ";")):
        if word.kind == "name" and (not parts or parts[-1] == "."):
            parts.append(word.text)
        elif word.text == "." and parts and parts[-1] != ".":
            parts.append(".")
        else:
            if parts:
                yield "".join(parts)
            parts = [word.text] if word.kind == "name" else []


def _closing(sequence: Sequence[Word], start: int) -> int:
    """Position of the bracket that closes the one at `start`."""
    depth = 0
    for position in range(start, len(sequence)):
        if sequence[position].kind == "mark":
            depth += sequence[position].text in _OPEN
            depth -= sequence[position].text in _CLOSE
        if depth == 0:
            return position
    raise ValueError("a bracket is never closed")
