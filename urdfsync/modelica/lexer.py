"""Cut Modelica text into the tokens that a compiler sees, each with its line."""

from __future__ import annotations

import re
from typing import NamedTuple

from urdfsync.modelica.names import KEYWORDS

_TOKEN = re.compile(
    r"""
    (?P<blank>\s+)
    | (?P<comment>//[^\n]*|/\*.*?(?:\*/|\Z))
    | (?P<string>"(?:[^"\\]|\\.)*(?:"|\Z))
    | (?P<quoted>'(?:[^'\\\n]|\\.)*'|')
    | (?P<other>:=|==|<=|>=|<>|[^\W\d]\w*|\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|.)
    """,
    re.VERBOSE | re.DOTALL,
)
_COMMENT = re.compile(r"/\*.*?\*/|//.*", re.DOTALL)
_STRING = re.compile(r'"(?:[^"\\]|\\.)*"', re.DOTALL)

_MARKER = re.compile(r"(<{7}|\|{7}|={7}|>{7})(\s|$)")


class Fault(NamedTuple):
    """Something wrong in a text: words that continue a sentence (`lacks ; before x`), and the line, from 1."""

    reason: str
    line: int
    is_repetition: bool = False
    """Whether something is only there twice: the text could be read."""


class Token(NamedTuple):
    """One token, and the line in which it begins, from 1."""

    text: str
    line: int


def lex(text: str) -> tuple[list[Token], list[Fault]]:
    """Return the tokens of a text without blanks and comments, and what has no end. An empty token ends the list."""
    found, faults = [], []
    line = 1
    for match in _TOKEN.finditer(text.removeprefix("\ufeff")):
        word, kind = match[0], match.lastgroup
        if kind == "comment" and not _COMMENT.fullmatch(word):
            faults.append(Fault("has a comment without an end", line))
        elif kind == "string" and not _STRING.fullmatch(word):
            faults.append(Fault("has a string without an end", line))
        elif word == "'":
            faults.append(Fault("has a quoted name without an end", line))
        if kind not in ("blank", "comment"):
            found.append(Token(word, line))
        line += word.count("\n")
    found.append(Token("", line))
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
