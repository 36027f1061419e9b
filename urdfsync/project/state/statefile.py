"""Reads and writes the recorded state of one robot: `.urdfsync/robots/<robot>.state`, which is committed.

Each record is one line of JSON, so git unites the records of two branches, and never mixes them (`merge=union`). The
next complete build replaces them by one. The file has no absolute path, no time and no host name. An unreadable line is
skipped, with a warning.
"""

from __future__ import annotations

import functools
import posixpath
import re
from collections.abc import Callable, Iterator
from typing import TypeVar

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity, StateError
from urdfsync.common.files import digest
from urdfsync.common.version import __version__
from urdfsync.project.state.record import RESOURCES, Generator, Open, Record

_HEADER = "# What urdfsync built last for this robot. Written by urdfsync: commit it, don't edit it.\n"
_HASH = re.compile(r"[0-9a-f]{16}(?:[0-9a-f]{48})?")
_PLAIN = re.compile(r"\w[\w.-]*(?:/\w[\w.-]*)*")
"""A quick check that nearly all paths in packages pass: a matching path can't lead out of the package."""
_HINT = "restore the file from version control, or build: a build writes a new file"


class _Written(msgspec.Struct):
    """The part of a record that all releases can read."""

    generator: Generator


_DECODER = msgspec.json.Decoder(Record)
_RELEASE = msgspec.json.Decoder(_Written)
_Records = TypeVar("_Records", Record, Open)


def dumps(*records: Record) -> str:
    """Return records as text: the same value gives the same text everywhere."""
    return "".join([_HEADER, *(f"{_line(record)}\n" for record in records)])


def key_of(record: Record) -> str:
    """Return the key of a record: a hash of all that it says but its ancestors."""
    return digest(_line(msgspec.structs.replace(record, ancestors=())).encode())[:16]


def _line(record: Record) -> str:
    below = f"{record.folder}/"
    return msgspec.json.encode(_with_keys(record, lambda key: key.removeprefix(below)), order="sorted").decode()


def _with_keys(record: Record, renamed: Callable[[str], str]) -> Record:
    """Return a record whose files have other keys."""

    def with_files(part: _Records) -> _Records:
        return msgspec.structs.replace(part, files={renamed(key): base for key, base in part.files.items()})

    return msgspec.structs.replace(with_files(record), open=record.open and with_files(record.open))


@functools.lru_cache(maxsize=8)  # cached: the daemon reads each state twice per build, 3 of 90 ms
def loads(text: str, file: str) -> tuple[tuple[Record, ...], Diagnostic | None]:
    """Return the last record of each branch, and a warning about the first unreadable line.

    Git unites the lines of branches. A record is not the last one if another record follows from it. `file` is the
    name in diagnostics. Raises StateError for the state of a newer urdfsync.
    """
    records, found = list[Record](), None
    for number, content in enumerate(text.split("\n"), 1):
        if not content or content.startswith("#"):
            continue
        try:
            release = _RELEASE.decode(content).generator.release
            if _numbers(release) > _numbers(__version__):
                message = f"urdfsync {release} wrote this state, and this is {__version__}, which is older"
                raise StateError.of("newer-state", message, file, number, hint="update urdfsync")
            record = _DECODER.decode(content)
        except (ValueError, RecursionError) as error:
            found = found or damage(file, number, _what_is_wrong(content, error))
            continue
        if wrong := next(_find_faults(record), None):
            found = found or damage(file, number, wrong)
            continue
        records.append(_with_keys(record, f"{record.folder}/{{}}".format))
    if not records:
        found = found or damage(file, 1, "it is empty")
    if len(records) < 2:
        return tuple(records), found
    former, by_key = {key for record in records for key in record.ancestors}, {key_of(one): one for one in records}
    # a stranger may have written records that follow from each other
    last = tuple(record for key, record in by_key.items() if key not in former) or tuple(by_key.values())
    return last, found


def _find_faults(record: Record) -> Iterator[str]:
    """Yield what is wrong with the places of a record: a stranger may have written it."""
    folder, package = record.folder, record.package
    if not _is_normal(folder) or folder.split("/")[-len(package.split(".")) :] != package.split("."):
        yield f"{folder!r} is not a folder of the package `{package}`"
    for part in record.parts():
        files = dict.fromkeys(part.files, False) | {one.target: True for one in part.imports.values()}
        wrong = (path for path, is_import in files.items() if not _belongs(path, is_import=is_import))
        yield from (f"the path {path!r} does not belong to the package `{package}`" for path in wrong)
        hashes = (base for base in part.files.values() if not _HASH.fullmatch(base))
        yield from (f"{base!r} is no hash" for base in hashes)


def _numbers(release: str) -> list[int]:
    return [int(number) for number in re.findall(r"\d{1,9}", release)]


def _what_is_wrong(content: str, error: Exception) -> str:
    if re.match(r"[<>=|]{7}", content):
        return "unresolved merge markers"
    return f"no record of urdfsync: {str(error)[:1].lower()}{str(error)[1:]}"


def damage(file: str, line: int, message: str) -> Diagnostic:
    """Return the warning of an unreadable line."""
    message = f"the recorded state is damaged: {message}"
    return Diagnostic(Severity.WARNING, "broken-state", message, file, line, hint=_HINT)


def _belongs(path: str, *, is_import: bool) -> bool:
    """Return whether a build may write to this path below the package: a stranger may have written the path."""
    return is_inside(path) and (path.startswith(RESOURCES) or (path.endswith(".mo") and not is_import))


def is_inside(path: str) -> bool:
    """Whether a relative path leads to a file below its folder that is not hidden."""
    return bool(_PLAIN.fullmatch(path)) or (
        _is_normal(path) and not any(part.startswith(".") for part in path.split("/"))
    )


def _is_normal(path: str) -> bool:
    """Whether a path is relative, with forward slashes, without `..` and control characters."""
    is_absolute = path.startswith("/") or re.match(r"[A-Za-z]:", path) is not None
    is_printable = not any(ord(char) < 32 or ord(char) == 127 for char in path)
    return not is_absolute and is_printable and "\\" not in path and posixpath.normpath(path) == path
