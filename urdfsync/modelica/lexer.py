"""Cut Modelica text into the tokens that a compiler sees, each with its line."""

from __future__ import annotations

import re
from typing import NamedTuple

from urdfsync.modelica.names import KEYWORDS

_TOKEN = re.compile(
    r"""
    (?P<blank>\s+|//[^\n]*|/\*.*?\*/)
    | (?P<endless_comment>/\*.*)
    | "(?:[^"\\]|\\.)*"
    | (?P<endless_string>"(?:[^"\\]|\\.)*)
    | '(?:[^'\\\n]|\\.)*'
    | (?P<endless_name>')
    | :=|==|<=|>=|<>|[^\W\d]\w*|\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|.
    """,
    re.VERBOSE | re.DOTALL,
)
_ENDLESS = {"endless_comment": "comment", "endless_string": "string", "endless_name": "quoted name"}

_MARKER = re.compile(r"(<{7,}|\|{7}|={7}|>{7,})(\s|$)")


class Fault(NamedTuple):
    """Something wrong in a text: words that continue a sentence (`lacks ; before x`), and the line, from 1."""

    reason: str
    line: int
    is_repetition: bool = False
    """Whether something is only there twice: the text could be read."""


class Token(NamedTuple):
    """One token, the line in which it begins, from 1, and its place in the text, from 0."""

    text: str
    line: int
    start: int


def lex(text: str) -> tuple[list[Token], list[Fault]]:
    """Return the tokens of a text without blanks and comments, and what has no end. An empty token ends the list."""
    found, faults, line = [], [], 1
    for match in _TOKEN.finditer(text, text.startswith("\ufeff")):
        word, kind = match[0], match.lastgroup
        if kind in _ENDLESS:
            faults.append(Fault(f"has a {_ENDLESS[kind]} without an end", line))
        if kind not in ("blank", "endless_comment"):
            found.append(Token(word, line, match.start()))
        line += word.count("\n")
    found.append(Token("", line, len(text)))
    return found, faults


def find_markers(text: str) -> list[Fault]:
    """Return the lines that look like conflict markers; they may also stand in a documentation."""
    return [
        Fault(f"has the conflict marker `{marker[1]}`", number)
        for number, line in enumerate(text.split("\n"), start=1)
        if (marker := _MARKER.match(line))
    ]


def is_name(token: str) -> bool:
    """Whether a token can be the name of something, quoted names included."""
    return (token[:1].isalpha() or token[:1] == "_" or (token[:1] == "'" and len(token) > 1)) and token not in KEYWORDS
