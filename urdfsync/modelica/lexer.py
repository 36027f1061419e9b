"""Cuts Modelica text into tokens, each with its place."""

from __future__ import annotations

import re
from bisect import bisect_left
from functools import cached_property
from typing import NamedTuple

from urdfsync.modelica import markers
from urdfsync.modelica.names import KEYWORDS

_STRING = r'"(?:[^"\\]++|\\.)*+"'
_QUOTED_NAME = r"(?<!\\)'(?:[^'\\\n]|\\.)*+'"  # none begins in another one without an end
_TOKEN = re.compile(
    rf"""
    (?:\s++|//[^\n]*+|/\*.*?\*/|(?P<endless_comment>/\*.*+))*+
    (
      {_STRING}|".*+
      | {_QUOTED_NAME}
      | :=|==|<=|>=|<>|[^\W\d]\w*+|(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?\d++)?  # compilers take .5, too
      | \Z
      | .
    )
    """,
    re.VERBOSE | re.DOTALL,
)
_WORD = 2
"""The number of the group that matches a token."""
STATEMENT = re.compile(
    rf"""(?:[^;"'/]++|{_STRING}|{_QUOTED_NAME}|'|//[^\n]*+|/\*.*?\*/|/(?![/*]))*+;""", re.VERBOSE | re.DOTALL
)
"""Matches a text up to the next semicolon, unless a string or comment before the semicolon has no end."""
_ENDLESS_STRING = re.compile(r'"(?:[^"\\]++|\\.)*+\\?', re.DOTALL)
_ESCAPE = re.compile(r"""\\(['"?\\abfnrtv]|(?P<meaningless>.))""", re.DOTALL)


class Fault(NamedTuple):
    """A fault of a text: the end of a sentence (`lacks ; before x`), and the line, from 1."""

    reason: str
    line: int
    is_repetition: bool = False
    """Whether the fault is only a repetition: the text can be read nevertheless."""


class Token(NamedTuple):
    """One token, and its place in the text, from 0."""

    text: str
    start: int


class Lexer:
    """Cuts a text into tokens, statement by statement, on demand."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.words: list[str] = []
        """The tokens that were read so far; an empty token stands for the end of the text."""
        self.starts: list[int] = []
        """The place of each token in the text."""
        self.position = int(text.startswith("\ufeff"))
        """The place in the text from which the next token is read."""
        self.endless: list[Fault] = []
        """Faults: comments, strings and quoted names without an end."""

    def read_statement(self) -> None:
        """Add the tokens up to the next semicolon, or to the end of the text."""
        statement = STATEMENT.match(self.text, self.position)
        stop, first = statement.end() if statement else len(self.text), len(self.words)
        add_word, add_start = self.words.append, self.starts.append
        for match in _TOKEN.finditer(self.text, self.position, stop):
            add_word(word := match[_WORD])
            add_start(match.start(_WORD))
            if not word:
                break
        if statement:  # more text follows the end of this statement
            del self.words[-1], self.starts[-1]
        elif match["endless_comment"]:
            self._add_endless("comment", match.start("endless_comment"))
        elif self.words[-2:-1] and _ENDLESS_STRING.fullmatch(self.words[-2]):
            self._add_endless("string", self.starts[-2])
        if "'" in self.words[first:]:
            for word, start in zip(self.words[first:], self.starts[first:], strict=True):
                if word == "'":
                    self._add_endless("quoted name", start)
        self.position = stop

    def read_all(self) -> Lexer:
        """Add all tokens of the text, and an empty token at the end."""
        while not self.words or self.words[-1]:
            self.read_statement()
        return self

    def _add_endless(self, kind: str, start: int) -> None:
        self.endless.append(Fault(f"has a {kind} without an end", self.line_at(start)))

    def line_at(self, start: int) -> int:
        """Return the line of a place in the text, from 1."""
        return bisect_left(self._line_ends, start) + 1

    def strange_escapes(self) -> list[Fault]:
        """Return the undefined escapes in the strings and quoted names so far."""
        if "\\" not in self.text:
            return []
        return [
            Fault(f"has the escape `{escape[0]}`, which Modelica does not define", self.line_at(start + escape.start()))
            for word, start in zip(self.words, self.starts, strict=True)
            if word[:1] in {'"', "'"}
            for escape in _ESCAPE.finditer(word)
            if escape["meaningless"]
        ]

    @cached_property
    def _line_ends(self) -> list[int]:
        return [match.start() for match in re.finditer("\n", self.text)]


def words_in(text: str) -> list[str]:
    """Return the tokens of a text, without their places."""
    return Lexer(text).read_all().words[:-1]


def lex(text: str) -> tuple[list[Token], list[Fault]]:
    """Return the tokens of a text, an empty token, and faults: comments, strings and quoted names without an end."""
    lexer = Lexer(text).read_all()
    return list(map(Token, lexer.words, lexer.starts)), lexer.endless


def find_markers(text: str) -> list[Fault]:
    """Return the lines that look like conflict markers; a documentation may also contain such lines."""
    return [Fault(f"has the conflict marker `{sign}`", line) for sign, line in markers.find_markers(text, "<|=>")]


def is_number(token: str) -> bool:
    """Whether a token is a number; a sign is a token of its own."""
    return token[:1].isdecimal() or (token[:1] == "." and len(token) > 1)


def is_name(token: str) -> bool:
    """Whether a token can be a name, quoted or not."""
    return (token[:1].isalpha() or token[:1] == "_" or (token[:1] == "'" and len(token) > 1)) and token not in KEYWORDS
