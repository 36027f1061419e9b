"""TOML text to plain data, with errors that name file and line, and the line of every key."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, TypeAlias

import tomli

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

DEEPEST = 50
"""Tables and lists within each other; nothing that urdfsync reads needs more than a few."""

_PLACE = r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)$"
_PART = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'([^']*)'|([A-Za-z0-9_-]+))\s*(\.)?""")
_HEADER = re.compile(r"\s*\[\[?")
_MARKER = r"^(<{7}|={7}|>{7})(\s|$)"
_TWICE = r"Cannot declare \((.*)\) twice"
_WORD = r"'([^']*)'"


def marker_line(text: str) -> int:
    """The first line that is a merge marker of a version control system, counted from 1; 0 if there is none."""
    lines = enumerate(text.split("\n"), start=1)
    return next((number for number, line in lines if re.match(_MARKER, line)), 0)


def parse(text: str, file: str, error: type[UrdfsyncError], hint: str = "") -> dict[str, Any]:
    """The document as nested dictionaries, no deeper than `DEEPEST`.

    Raises `error` with file, line and column if it is not TOML; `hint` is what to do about that, if nothing more
    exact is known.
    """
    line = column = 0
    try:
        document = tomli.loads(text)
    except tomli.TOMLDecodeError as problem:
        message, line, column, better = _explain(problem, text)
        hint = hint or better
    except RecursionError:
        message = _TOO_DEEP
    except ValueError:  # from int(), which refuses to read thousands of digits
        message = "a number has too many digits"
    else:
        if not _is_too_deep(document):
            return document
        message = _TOO_DEEP
    raise error(Diagnostic(Severity.ERROR, "toml-syntax", message, file, line, column, hint)) from None


_TOO_DEEP = f"tables and lists are nested more than {DEEPEST} deep"


def _is_too_deep(document: dict[str, Any]) -> bool:
    """Whether anything lies deeper than `DEEPEST`; by levels, since a robot's record has thousands of tables."""
    level: list[Any] = [document]
    for _ in range(DEEPEST):
        items = (table.values() if isinstance(table, dict) else table for table in level)
        level = [item for values in items for item in values if isinstance(item, dict | list)]
        if not level:
            return False
    return any(level)


def strings(table: dict[str, Any] | list[Any], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str]]:
    """Every key and every string of a document, with its path; a list's items count by their number."""
    for key, value in table.items() if isinstance(table, dict) else enumerate(table):
        here = (*path, str(key))
        yield here, str(key)
        if isinstance(value, str):
            yield here, value
        elif isinstance(value, dict | list):
            yield from strings(value, here)


def _explain(problem: tomli.TOMLDecodeError, text: str) -> tuple[str, int, int, str]:
    """Message, line, column and hint."""
    if marker := marker_line(text):
        return "unresolved merge markers", marker, 0, "settle the merge"
    message = str(problem)
    place = re.search(_PLACE, message)
    if place is None:
        return message, 0, 0, ""
    lines = text.rstrip().split("\n")
    line, column = int(place[1] or len(lines)), int(place[2] or 0)
    message = message[: place.start()].replace("\n", " ")
    if message == "Cannot overwrite a value":
        key = ".".join(_keys(lines[line - 1])) if line <= len(lines) else ""
        return f"`{key}` is set twice" if key else "a key is set twice", line, 0, "remove one of them"
    if table := re.match(_TWICE, message):
        name = ".".join(re.findall(_WORD, table[1]))
        return f"the table `{name}` is there twice", line, 0, "put the keys of both into one table"
    hint = "strings stand in quotes" if message == "Invalid value" else ""
    return message[0].lower() + message[1:], line, column, hint


Lines: TypeAlias = dict[tuple[str, ...], int]
"""Where each key, by its full path, first stands in a document; lines count from 1."""


def lines(text: str) -> Lines:
    """The line of every key and of every table."""
    found: Lines = {}
    header: tuple[str, ...] = ()
    for number, line in enumerate(text.split("\n"), start=1):
        keys = _keys(line)
        if _HEADER.match(line):
            path = header = keys
        else:
            path = header + keys
        for length in range(1, min(len(path), DEEPEST) + 1):
            found.setdefault(path[:length], number)
    return found


def nearest(found: Lines, *path: str) -> int:
    """The line of the key at `path`, or else of the nearest table above it; 0 if there is none."""
    paths = (path[:length] for length in range(len(path), 0, -1))
    return next((found[prefix] for prefix in paths if prefix in found), 0)


def _keys(line: str) -> tuple[str, ...]:
    """The dotted key that a line sets, or the table that it opens; empty if it does neither."""
    opening = _HEADER.match(line)
    start = opening.end() if opening else 0
    keys = []
    while part := _PART.match(line, start):
        quoted, literal, bare, more = part.groups()
        keys.append(_unescaped(quoted) if quoted is not None else bare if literal is None else literal)
        start = part.end()
        if not more:
            return tuple(keys) if line[start : start + 1] in ("=", "]") else ()
    return ()


def _unescaped(quoted: str) -> str:
    try:
        return str(tomli.loads(f'key = "{quoted}"')["key"]) if "\\" in quoted else quoted
    except tomli.TOMLDecodeError:
        return quoted
