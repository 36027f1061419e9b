"""Reads TOML: plain data, the line of every key, and errors with file and line."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from typing import Any

import tomli

from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.modelica.markers import find_markers

DEEPEST = 50
"""Deepest nesting of tables and lists; real files need a few levels."""

_PLACE = r"\(at (?:line (\d+), column (\d+)|end of document)\)$"
_KEY = r"""(?:"(?:[^"\\]|\\.)*+"|'[^']*+'|[A-Za-z0-9_-]++)"""
_LINE = re.compile(rf"\s*+(\[\[?)?+\s*+({_KEY}(?:\s*+\.\s*+{_KEY})*+)\s*+[=\]]")
"""A line that opens a table, or sets a key."""
_QUOTED = r"'([^']*)'"


def parse(text: str, file: str, error: type[UrdfsyncError]) -> dict[str, Any]:
    """Parse a document to nested dictionaries, not deeper than `DEEPEST`.

    Raises `error` with file, line and column if the document is not TOML.
    """
    line, column, hint = 0, 0, ""
    message = f"tables and lists are nested more than {DEEPEST} deep"
    try:
        document = tomli.loads(text)
        if all(len(path) <= DEEPEST for path, _ in strings(document)):
            return document
    except RecursionError:
        pass  # too deep, as `message` says
    except tomli.TOMLDecodeError as problem:
        message = str(problem)
        if found := find_markers(text):
            line = found[0][1]
            message, hint = "unresolved merge markers", "settle the merge"
        elif place := re.search(_PLACE, message):
            line, column = int(place[1] or text.rstrip().count("\n") + 1), int(place[2] or 0)
            message = message[0].lower() + message[1 : place.start()].rstrip().replace("\n", " ")
            if twice := re.match(r"cannot declare \((.*)\) twice", message):
                message = f"the table `{'.'.join(re.findall(_QUOTED, twice[1]))}` is there twice"
                hint = "put the keys of both into one table"
            elif message == "cannot overwrite a value":
                message, hint = "a key is set twice", "remove one of the two"
            elif message == "invalid value":
                hint = "put strings into quotes"
            elif "\\" in text.split("\n")[line - 1]:
                hint = "write paths with `/`, or in single quotes"
    except ValueError:  # from int(), which refuses to read thousands of digits
        message = "a number has too many digits"
    raise error(Diagnostic(Severity.ERROR, "toml-syntax", message, file, line, column, hint))


def strings(document: dict[str, Any]) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield every key and every string of a document, with its path; the key of a list's item is its index."""
    waiting: list[tuple[tuple[str, ...], dict[str, Any] | list[Any]]] = [((), document)]
    while waiting:
        path, table = waiting.pop()
        for key, value in table.items() if isinstance(table, dict) else enumerate(table):
            place = (*path, str(key))
            yield place, str(key)
            if isinstance(value, str):
                yield place, value
            elif isinstance(value, dict | list):
                waiting.append((place, value))


def find_lines(text: str) -> tuple[dict[tuple[str, ...], int], dict[tuple[str, ...], list[int]]]:
    """Return the first line of each key or table, and the lines of the items of each array of tables, `[[…]]`.

    The keys of both are full paths; lines count from 1.
    """
    lines: dict[tuple[str, ...], int] = {}
    items: dict[tuple[str, ...], list[int]] = {}
    for number, (line, (opens, path)) in enumerate(zip(text.split("\n"), _paths(text), strict=True), start=1):
        for length in range(1, min(len(path), DEEPEST) + 1):
            lines.setdefault(path[:length], number)
        if opens and line.lstrip().startswith("[["):
            items.setdefault(path, []).append(number)
    return lines, items


def _paths(text: str) -> Iterator[tuple[bool, tuple[str, ...]]]:
    """Yield for each line whether it opens a table, and the full path of its key, or of the table that contains it."""
    header: tuple[str, ...] = ()
    for line in text.split("\n"):
        keys: tuple[str, ...] = ()
        if match := _LINE.match(line):
            with contextlib.suppress(
                tomli.TOMLDecodeError, RecursionError
            ):  # a line of a long string may look like a key
                keys = tuple(_parts(match[2]))
        opens = bool(match and match[1] and keys)
        yield opens, keys if opens else header + keys
        header = keys if opens else header


def _parts(key: str) -> Iterator[str]:
    """Yield the parts of a dotted key. Raises TOMLDecodeError, or RecursionError for too many parts."""
    if not ('"' in key or "'" in key):  # much faster
        yield from map(str.strip, key.split("."))
        return
    table: Any = tomli.loads(f"{key} = 0")
    while isinstance(table, dict):
        ((part, table),) = table.items()
        yield part


def without_table(text: str, *table: str) -> str:
    """Return the text without a table, the tables inside, and the comments that touch them."""
    lines, paths = re.findall(r"[^\n]*\n|[^\n]+", text), list(_paths(text))
    starts = [number for number, (opens, _) in enumerate(paths) if opens]
    begins = []  # first lines of the tables, with the comments above
    for start in starts:
        while start and _is_comment(lines[start - 1]):
            start -= 1
        begins.append(start)
    remaining = lines[: min(begins, default=len(lines))]
    for start, begin, end in zip(starts, begins, [*begins, len(lines)][1:], strict=True):
        part = lines[begin:end]
        if paths[start][1][: len(table)] == table:
            last = max(
                number for number in range(start, end) if lines[number].strip() and not _is_comment(lines[number])
            )
            part = lines[last + 1 : end]
            blank = next((number for number, line in enumerate(part) if not line.strip()), len(part))
            part = part[blank + 1 :]
            while end == len(lines) and not part and remaining and not remaining[-1].strip():
                remaining.pop()
        remaining += part
    return "".join(remaining)


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


def nearest(lines: dict[tuple[str, ...], int], *path: str) -> int:
    """Return the line of the key at `path`, else of the nearest table above it; 0 without one."""
    paths = (path[:length] for length in range(len(path), 0, -1))
    return next((lines[prefix] for prefix in paths if prefix in lines), 0)
