"""The recorded state of one robot, text ↔ value: `.urdfsync/robots/<robot>.state`, which is committed.

Each line stands alone and says one fact; blank lines between them keep neighbours apart. So git unites two states line
by line (`merge=union`). What then stands twice with different values is ambiguous until the next complete build.
Nothing in it is an absolute path, a time or a host name.
"""

from __future__ import annotations

import functools
import posixpath
import re
from collections.abc import Collection, Iterator, Mapping
from typing import Any

import msgspec

from urdfsync.diagnostics import StateError
from urdfsync.domain import Import, Snapshot
from urdfsync.files import digest
from urdfsync.state.record import RESOURCES, FileRecord, Generator, Open, Record, UsersChoice

FORMAT = 1
"""Raised when an older urdfsync could misread what a newer one records."""

_HEADER = "# What urdfsync built last for this robot. Written by urdfsync: commit it, don't edit it.\n"
_HASH = re.compile(r"[0-9a-f]{64}")
_PLAIN = re.compile(r"\w[\w.-]*(?:/\w[\w.-]*)*")
"""Form of nearly all paths, which can't lead elsewhere."""
_HINT = "restore it from version control, or let `urdfsync build --full` make it anew"

_FACTS: Mapping[str, Any] = {
    "format": int,
    "sum": str,
    "package": str,
    "class": str,
    "folder": str,
    "domain": str,
    "revision": int,
    "templates": str,
    "option": tuple[str, Any],
    "model": tuple[str, str | None, Any],
    "import": tuple[str, Import],
    "choice": tuple[str, UsersChoice],
    "seen": tuple[str, str | None, Any],
    "renamed": tuple[str, str, str],
}
"""The words that lines begin with, and the type of the JSON value behind each. A `file` has its hash and its path."""
_DECODERS = {word: msgspec.json.Decoder(kind) for word, kind in _FACTS.items()}
_SUM = "sum "
"""Begins the line with the hash of all others. Where git has united two states, it does not fit, or is left out."""
_HEADINGS = ("package", "class", "folder", "domain", "revision", "templates")
_PLACE = ("package", "class", "folder")


def dumps(record: Record) -> str:
    """The record as text: the same value gives the same text everywhere."""
    below = len(record.folder) + 1
    lines = {_line(word, value) for word, value in _facts(record)}
    files = set()
    for key, file in record.files.items():
        files |= {(key[below:], sha256) for sha256 in file.hashes}
    listed = [f"file {sha256}  {path}" for path, sha256 in sorted(files)]
    if not record.is_united:
        lines.add(_line("sum", _sum([*lines, *listed])))
    return "\n".join(f"{line}\n" for line in [_HEADER.rstrip(), *sorted(lines), *listed])


def _line(word: str, value: object) -> str:
    return f"{word} {msgspec.json.encode(value, order='sorted').decode()}"


def _sum(lines: Collection[str]) -> str:
    return digest("\n".join(sorted(lines)).encode())


def _facts(record: Record) -> Iterator[tuple[str, object]]:
    generator = record.generator
    yield "format", FORMAT
    yield from zip(_PLACE, (record.package, record.class_, record.folder), strict=True)
    yield from (("domain", generator.domain), ("revision", generator.revision), ("templates", generator.templates))
    yield from (("option", item) for item in record.options.items())
    if record.snapshot is not None:
        yield from (("model", fact) for fact in _elements(record.snapshot))
    yield from (("import", (key, entry)) for key, entries in record.imports.items() for entry in entries)
    if record.open:
        yield from (("choice", item) for item in record.open.choices.items())
        yield from (("seen", fact) for fact in _elements(record.open.seen))
        yield from (("renamed", (*key, name)) for key, name in record.open.renamed.items())


def _elements(snapshot: Snapshot) -> Iterator[tuple[Any, ...]]:
    """Each element of a model: its kind, its name and itself; without a name what is no mapping of elements."""
    for part, value in snapshot.items():
        if isinstance(value, Mapping) and value:
            yield from ((part, name, element) for name, element in value.items())
        else:
            yield part, None, value


@functools.lru_cache(maxsize=8)  # the daemon reads each state after a build and before the next: 3 of 90 ms
def loads(text: str, file: str, *, strict: bool = True) -> Record:
    """The record in `text`, which errors call `file`.

    Raises StateError with file and line for text that is no record, that names files outside of its package, or that a
    newer urdfsync wrote. Unless `strict`, lines that can't be read are passed over.
    """
    values: dict[str, list[Any]] = {word: [] for word in (*_FACTS, "file")}
    lines = dict[str, int]()
    for number, content in enumerate(text.split("\n"), 1):
        if content and not content.startswith("#"):
            lines.setdefault(content, number)
    for content, number in lines.items():
        try:
            word, value = _parse(content)
        except (KeyError, ValueError, RecursionError) as error:
            if strict:
                raise _broken(file, number, _what_is_wrong(content, error)) from None
            continue
        if word == "format" and value > FORMAT:
            message = f"a newer urdfsync wrote this state (format {value}; this one knows {FORMAT})"
            raise StateError.of("newer-state", message, file, number, hint="update urdfsync")
        values[word].append(value)
    missing = [word for word in ("format", *_HEADINGS) if not values[word]]
    if missing:
        raise _broken(file, 1, f"it has no {', '.join(missing)}" if lines else "the recorded state is empty")
    facts = [content for content in lines if not content.startswith(_SUM)]
    record = _record(values, is_whole=values["sum"] == [_sum(facts)])
    for path in _strange_paths(record):
        number = next((number for content, number in lines.items() if path in content), 1)
        message = f"the recorded path {path!r} does not belong to the package `{record.package}`"
        raise _broken(file, number, message)
    return record


def _parse(content: str) -> tuple[str, Any]:
    """The word and the value of a line. Raises KeyError or ValueError."""
    word, _, rest = content.partition(" ")
    if word == "file":
        sha256, _, path = rest.partition("  ")
        if not path or not _HASH.fullmatch(sha256):
            raise ValueError("no hash and path")
        return word, (path, sha256)
    return word, _DECODERS[word].decode(rest)


def _record(values: Mapping[str, list[Any]], is_whole: bool) -> Record:
    """The record that facts make; of headings that are there twice, the last ones."""
    package, class_, folder, domain, _, templates = (values[word][-1] for word in _HEADINGS)
    is_placed = all(len(values[word]) == 1 for word in _PLACE)
    options = dict(values["option"])
    hashes: dict[str, list[str]] = {}
    for path, sha256 in values["file"] if is_placed else ():  # else nobody knows where these files are
        hashes.setdefault(f"{folder}/{path}", []).append(sha256)
    imports: dict[str, tuple[Import, ...]] = {}
    for key, entry in values["import"]:
        imports[key] = (*imports.get(key, ()), entry)
    open_ = None
    if values["seen"]:
        choices = dict(values["choice"])
        renamed = {(kind, old): new for kind, old, new in values["renamed"]}
        seen = _snapshot(values["seen"])
        is_known = seen is not None and len(renamed) == len(values["renamed"])
        open_ = Open(
            choices if len(choices) == len(values["choice"]) else {},
            (seen or {}) if is_known else {},
            renamed if is_known else {},
        )
    return Record(
        package=package,
        class_=class_,
        folder=folder,
        generator=Generator(domain, max(values["revision"]), templates),
        options=options,
        snapshot=_snapshot(values["model"]),
        imports=imports,
        files={key: FileRecord(tuple(values)) for key, values in sorted(hashes.items())},
        open=open_,
        is_united=not is_whole,
    )


def _snapshot(facts: list[tuple[str, str | None, Any]]) -> Snapshot | None:
    """Return the model that its elements make; None if there are none, or if one stands twice."""
    elements = {(part, name): element for part, name, element in facts}
    if not facts or len(elements) < len(facts):
        return None
    model = {part: element for (part, name), element in elements.items() if name is None}
    for (part, name), element in elements.items():
        if name is not None:
            if not isinstance(model.get(part), dict):
                model[part] = {}
            model[part][name] = element
    return model


def _what_is_wrong(content: str, error: Exception) -> str:
    if re.match(r"[<>=|]{7}", content):
        return "unresolved merge markers"
    reason = "" if isinstance(error, KeyError) else f": {str(error)[:1].lower()}{str(error)[1:]}"
    return f"this is not a state file of urdfsync{reason}"


def _broken(file: str, line: int, message: str) -> StateError:
    return StateError.of("broken-state", message, file, line, hint=_HINT)


def _strange_paths(record: Record) -> Iterator[str]:
    """Recorded paths of files that no build of this package writes: the state may be a stranger's."""
    folder, package = record.folder, record.package.split(".")
    if not (_is_normal(folder) and folder.split("/")[-len(package) :] == package):
        yield folder
    below = len(folder) + 1
    paths = [key[below:] for key in record.files]
    targets = [entry.target for entries in record.imports.values() for entry in entries]
    yield from (
        path for path in paths if not (_is_inside(path) and (path.startswith(RESOURCES) or path.endswith(".mo")))
    )
    yield from (path for path in targets if not (_is_inside(path) and path.startswith(RESOURCES)))


def _is_inside(path: str) -> bool:
    """Whether a path from a folder is that of a file below it, hidden ones apart."""
    return bool(_PLAIN.fullmatch(path)) or (
        _is_normal(path) and not any(part.startswith(".") for part in path.split("/"))
    )


def _is_normal(path: str) -> bool:
    """Whether a path is relative, with forward slashes, without detours and control characters."""
    is_absolute = path.startswith("/") or re.match(r"[A-Za-z]:", path) is not None
    is_printable = not any(ord(char) < 32 or ord(char) == 127 for char in path)
    return not is_absolute and is_printable and "\\" not in path and posixpath.normpath(path) == path
