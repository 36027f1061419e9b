"""Finds the numbers in the bytes of a file, and replaces some of them: all other bytes stay.

Bytes become text without loss: UTF-16 and UTF-32 as such, all other encodings byte by byte, since they write numbers as
ASCII does.
"""

from __future__ import annotations

import codecs
import re
import struct
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

NUMBER = re.compile(
    r"(?:(?<![\w.)\]}])[-+])?(?<![\w.])(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?\d++)?+(?![\w.])", re.ASCII
)
_TINY = 1e-200
"""Stands for zero in `neighbour`: half of it is no other neighbour of zero, as it would be of the smallest float."""
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
    """A piece of a file's text: a number, or the empty place where something is inserted."""

    file: Path
    start: int
    text: str
    line: int


def decoded(content: bytes) -> str:
    """Return the text of a file. Raises UnicodeDecodeError."""
    return content.decode(_encoding(content))


def _encoding(content: bytes) -> str:
    return next((name for mark, name in _WIDE if content.startswith(mark)), "latin-1")


def find_literals(file: Path, content: bytes) -> list[Literal]:
    """Return all numbers in a file; none if the file is no text."""
    try:
        text = decoded(content)
    except UnicodeDecodeError:
        return []
    if "\0" in text:
        return []
    return literals_in(file, text, 0, len(text))


def literals_in(file: Path, text: str, start: int, end: int) -> list[Literal]:
    """Return the numbers of a piece of a file's text."""
    found, line, last = list[Literal](), text.count("\n", 0, start) + 1, start
    for match in NUMBER.finditer(text, start, end):
        line += text.count("\n", last, match.start())
        last = match.start()
        found.append(Literal(file, last, match[0], line))
    return found


def replaced(contents: Mapping[Path, bytes], changes: Mapping[Literal, str]) -> dict[Path, bytes]:
    """Return the contents of the files that `changes` touch, with new texts of literals."""
    return {
        file: _with_texts(contents[file], [(literal, new) for literal, new in changes.items() if literal.file == file])
        for file in {literal.file for literal in changes}
    }


def _with_texts(content: bytes, changes: Iterable[tuple[Literal, str]]) -> bytes:
    text = decoded(content)
    for literal, new in sorted(changes, reverse=True):
        text = f"{text[: literal.start]}{new}{text[literal.start + len(literal.text) :]}"
    return text.encode(_encoding(content))


def neighbour(value: float, number: int) -> float:
    """Return the float that is `number` steps of the last binary digit away from a value; from a tiny one for zero."""
    (bits,) = struct.unpack("<q", struct.pack("<d", value or _TINY))
    (result,) = struct.unpack("<d", struct.pack("<q", bits + number))
    return float(result)
