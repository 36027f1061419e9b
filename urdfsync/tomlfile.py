"""TOML text to plain data, with errors that name file and line, and the line of every key."""

from __future__ import annotations

import re
import tomllib
from typing import Any, TypeAlias

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

_PLACE = re.compile(r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)$")
_PART = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'([^']*)'|([A-Za-z0-9_-]+))\s*(\.)?""")
_HEADER = re.compile(r"\s*\[\[?")
_MARKER = re.compile(r"^(<{7}|={7}|>{7})(\s|$)")


def marker_line(text: str) -> int:
    """The first line that is a merge marker of a version control system, counted from 1; 0 if there is none."""
    lines = enumerate(text.splitlines(), start=1)
    return next((number for number, line in lines if _MARKER.match(line)), 0)


def parse(text: str, file: str, error: type[UrdfsyncError], hint: str = "") -> dict[str, Any]:
    """The document as nested dictionaries. Raises `error` with file, line and column if it is not TOML."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        message, line, column = _explain(problem, text)
        found = Diagnostic(Severity.ERROR, "toml-syntax", message, file, line, column, hint)
        raise error(found) from None


def _explain(problem: tomllib.TOMLDecodeError, text: str) -> tuple[str, int, int]:
    if marker := marker_line(text):
        return "unresolved merge markers", marker, 0
    message = str(problem)
    place = _PLACE.search(message)
    if place is None:
        return message, 0, 0
    line, column = place.groups()
    message = message[: place.start()].replace("\n", " ")
    return message[0].lower() + message[1:], int(line or len(text.splitlines())), int(column or 0)


Lines: TypeAlias = dict[tuple[str, ...], int]
"""Where each key, by its full path, first stands in a document; lines count from 1."""


def lines(text: str) -> Lines:
    """The line of every key and of every table."""
    found: Lines = {}
    header: tuple[str, ...] = ()
    for number, line in enumerate(text.splitlines(), start=1):
        opening = _HEADER.match(line)
        keys = _keys(line, opening.end() if opening else 0)
        if opening:
            header = keys
        path = keys if opening else header + keys
        for length in range(1, len(path) + 1):
            found.setdefault(path[:length], number)
    return found


def nearest(found: Lines, *path: str) -> int:
    """The line of the key at `path`, or else of the nearest table above it; 0 if there is none."""
    paths = (path[:length] for length in range(len(path), 0, -1))
    return next((found[prefix] for prefix in paths if prefix in found), 0)


def _keys(line: str, start: int) -> tuple[str, ...]:
    """The dotted key that begins at `start`; empty if nothing there is one."""
    keys = []
    while part := _PART.match(line, start):
        quoted, literal, bare, more = part.groups()
        keys.append(next(text for text in (quoted, literal, bare) if text is not None))
        start = part.end()
        if not more:
            return tuple(keys) if line[start : start + 1] in ("=", "]") else ()
    return ()
