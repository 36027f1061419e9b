"""Marks the lines of a rendered text with the lines of the templates that they come from."""

from __future__ import annotations

import re
from collections.abc import Iterator

from jinja2.ext import Extension
from jinja2.lexer import Token, TokenStream

MARK = re.compile(r"\0([^\0]*)\0([0-9]*)\0")
"""A template's file and line, in front of their text; no text of a model contains NUL."""
BLANK = re.compile(r"\A(?:\0[^\0]*\0[0-9]*\0|\s)*")
"""The marks and blanks at the beginning of a line."""


class MarkLines(Extension):
    """Puts a `MARK` before each line of a template's text, through macros and captured blocks as well."""

    def filter_stream(self, stream: TokenStream) -> Iterator[Token]:
        """See Jinja."""
        for token in stream:
            value = token.value
            if token.type == "data":
                lines = enumerate(value.split("\n"), token.lineno)
                value = "\n".join(f"\0{stream.filename}\0{number}\0{line}" for number, line in lines)
            yield Token(token.lineno, token.type, value)
