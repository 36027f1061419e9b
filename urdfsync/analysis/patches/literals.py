"""Finds the numbers in the bytes of a file, and replaces some of them: all other bytes stay.

Bytes become text without loss: UTF-16 and UTF-32 as such, all other encodings byte by byte, since they write numbers as
ASCII does.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Mapping
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

from urdfsync.common.numerals import find_separator

NUMBER = re.compile(
    r"(?:(?<![\w.)\]}])[-+])?(?<![\w.])(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?\d++)?+(?![\w.])", re.ASCII
)
_DECLARATION = re.compile(r".{0,3}<\?xml\b[^>]*>")
"""Its numbers are no numbers of a robot; a byte order mark may stand before it."""
_WITH_COMMA = re.compile(r"(?<![\w.,])\d+,\d+(?![\w.,])", re.ASCII)
_WIDE = (
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
    (b"<\0", "utf-16-le"),
    (b"\0<", "utf-16-be"),
)
"""First bytes of files whose characters have more than one byte."""


class Literal(NamedTuple):
    """A piece of a file's text: a number, or the empty place of a new attribute or element."""

    file: Path
    start: int
    text: str
    line: int
    decimal: str = "."
    """The decimal mark."""
    element: str = ""
    """The beginning of a new element with line end and indentation, such as `<origin`."""
    attribute: str = ""
    """The beginning of a new attribute, such as ` xyz="`; a new element has one, too."""

    @property
    def value(self) -> float:
        """The number."""
        return float(self.text.replace(self.decimal, ".")) + 0.0


def decoded(content: bytes) -> str:
    """Return the text of a file. Raises UnicodeDecodeError."""
    return content.decode(_encoding(content))


def _encoding(content: bytes) -> str:
    return next((name for mark, name in _WIDE if content.startswith(mark)), "latin-1")


def find_literals(file: Path, content: bytes) -> list[Literal]:
    """Return all numbers in a file; none if the file is no text. A table may have decimal commas."""
    try:
        text = decoded(content)
    except UnicodeDecodeError:
        return []
    if "\0" in text:
        return []
    is_european = "<" not in text and find_separator(text)[0] != "," and _WITH_COMMA.search(text)
    declaration = _DECLARATION.match(text)
    return literals_in(file, text, declaration.end() if declaration else 0, len(text), "," if is_european else ".")


def literals_in(file: Path, text: str, start: int, end: int, decimal: str = ".") -> list[Literal]:
    """Return the numbers of a piece of a file's text."""
    found, line, last = list[Literal](), text.count("\n", 0, start) + 1, start
    for match in NUMBER.finditer(text.replace(decimal, "."), start, end):
        line += text.count("\n", last, match.start())
        last = match.start()
        found.append(Literal(file, last, text[last : match.end()], line, decimal))
    return found


def replaced(contents: Mapping[Path, bytes], changes: Mapping[Literal, str]) -> dict[Path, bytes]:
    """Return the contents of the files that `changes` touch, with new texts of literals."""
    return {
        file: _with_texts(contents[file], [(literal, new) for literal, new in changes.items() if literal.file == file])
        for file in {literal.file for literal in changes}
    }


def _with_texts(content: bytes, changes: Iterable[tuple[Literal, str]]) -> bytes:
    """Return a content with new texts of literals, written with decimal points. Attributes join one new element."""
    text, parts, end = decoded(content), list[str](), 0
    for (start, element), group in groupby(sorted(changes, key=_place), _place):
        parts += [text[end:start], element]
        for literal, new in group:
            parts.append(f"{literal.attribute}{new.replace('.', literal.decimal)}{literal.attribute[-1:]}")
            end = start + len(literal.text)
        parts.append("/>" * bool(element))
    return "".join([*parts, text[end:]]).encode(_encoding(content))


def _place(change: tuple[Literal, str]) -> tuple[int, str]:
    return change[0].start, change[0].element
