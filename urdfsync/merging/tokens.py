"""Modelica text as tokens, as far as merging two edits of one line needs it.

What is only right as a whole is one token: numbers with sign and exponent, strings, dotted names with their
subscripts, and arrays of nothing but numbers (a vector of which each side changed one element is no value
that anybody asked for). Runs of blanks, ends of line and comments are tokens too, so that the tokens are the text.
"""

from __future__ import annotations

import re

from urdfsync.modelica.names import KEYWORDS

NEWLINE = "\n"
SEPARATORS = frozenset(",;")
"""What stands between the items of a list, and after declarations and equations."""

_STRING = r'"(?:[^"\\]|\\.)*(?:"|\Z)'
_QUOTED_NAME = r"'(?:[^'\\\n]|\\.)*'"
_COMMENT = r"//[^\n]*|/\*.*?(?:\*/|\Z)"
_NUMBER = r"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?"
_ROW = rf"[{{\[][ \t]*{_NUMBER}(?:[ \t]*[,;][ \t]*{_NUMBER})*[ \t]*[}}\]]"
_ROWS = rf"[{{\[][ \t]*{_ROW}(?:[ \t]*[,;][ \t]*{_ROW})*[ \t]*[}}\]]"
_PART = r"[^\W\d]\w*(?:\[[\w ,:.+*-]*\])?"
_NAME = rf"\.?{_PART}(?:\.{_PART})*"

_TOKEN = re.compile(
    rf"""
    {_STRING} | {_QUOTED_NAME} | {_COMMENT} | \n | [^\S\n]+
    | {_ROWS} | {_ROW} | {_NAME}
    | (?<![\w.)\]}}'"]){_NUMBER}          # a sign right after an operand is an operator
    | \d+(?:\.\d*)?(?:[eE][-+]?\d+)?
    | :=|==|<=|>=|<> | .
    """,
    re.VERBOSE | re.DOTALL,
)
_LONG = re.compile(rf"{_STRING}|{_QUOTED_NAME}|{_COMMENT}", re.DOTALL)
_WORD = re.compile(r"""[\w"']|[^\x00-\x7f]""")


def tokens(text: str) -> list[str]:
    """The text cut into tokens; joined they are the text again. It must not begin inside a string or comment."""
    return _TOKEN.findall(text)


def inner_lines(text: str) -> frozenset[int]:
    """Which lines, counted from 0, begin inside a string or comment; the one after an unfinished one included."""
    inner: set[int] = set()
    line = position = 0
    for match in _LONG.finditer(text):
        line += text.count(NEWLINE, position, match.start())
        ends = match[0].count(NEWLINE)
        inner.update(range(line + 1, line + ends + 1))
        line, position = line + ends, match.end()
    return frozenset(inner)


def is_comment(token: str) -> bool:
    """Whether a token is a comment."""
    return token.startswith(("//", "/*"))


def is_trivia(token: str) -> bool:
    """Whether a token means nothing to a compiler: blanks, ends of line, comments."""
    return token.isspace() or is_comment(token)


def is_word(token: str) -> bool:
    """Whether a token stands for something by itself: a name, a number, a string, an array; not an operator."""
    return not is_trivia(token) and _WORD.search(token) is not None


def is_telling(token: str) -> bool:
    """Whether a token tells what is meant rather than how much: a name, a string, a comment; no number, no keyword."""
    return (is_comment(token) or token[0] in "\"'._" or token[0].isalpha()) and token not in KEYWORDS
