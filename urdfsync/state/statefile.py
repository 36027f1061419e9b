"""Reads and writes the recorded state of one robot: `.urdfsync/robots/<robot>.state`, which is committed.

Each line states one fact alone; blank lines keep the lines apart. So git can unite two states line by line
(`merge=union`). If git keeps two values of a fact, the fact is ambiguous until the next complete build. The file has no
absolute path, no time and no host name. An unreadable line is skipped, with a warning.
"""

from __future__ import annotations

import functools
import posixpath
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.domain import Import
from urdfsync.files import digest
from urdfsync.state.record import RESOURCES, Generator, Open, Question, Record
from urdfsync.version import __version__

_HEADER = "# What urdfsync built last for this robot. Written by urdfsync: commit it, don't edit it.\n"
_HASH = re.compile(r"[0-9a-f]{16}(?:[0-9a-f]{48})?")
_PLAIN = re.compile(r"\w[\w.-]*(?:/\w[\w.-]*)*")
"""A quick check that nearly all paths in packages pass: a matching path can't lead out of the package."""
_HINT = "restore the file from version control, or build: a build writes a new file"

_FACTS: Mapping[str, Any] = {
    "sum": str,
    "release": str,
    "package": str,
    "class": str,
    "folder": str,
    "domain": str,
    "templates": str,
    "option": tuple[str, Any],
    "model": tuple[str, str | None, Any],
    "import": tuple[str, Import],
    "declared": tuple[str, str],
    "former": tuple[str, str],
    "id": tuple[str, str],
    "confirmed": str,
    "edit": tuple[str, str],
    "former-id": tuple[str, str],
    "seen": tuple[str, str | None, Any],
    "seen-import": tuple[str, Import],
    "renamed": tuple[str, str, str],
    "asked": tuple[str, Question],
}
"""The first words of lines, and the type of the JSON value after each word. After `file` come a hash and a path."""
_DECODERS = {word: msgspec.json.Decoder(kind) for word, kind in _FACTS.items()}
_SUM = "sum "
"""The beginning of the line with the hash of all other lines. If git has united two states, this hash is wrong."""
_PLACE = ("package", "class", "folder")
_HEADINGS = (*_PLACE, "domain", "release", "templates")


def dumps(record: Record) -> str:
    """Return the record as text: the same value gives the same text everywhere."""
    below = len(record.folder) + 1
    lines = {f"{word} {msgspec.json.encode(value, order='sorted').decode()}" for word, value in _facts(record)}
    files = sorted((key[below:], sha256) for key, sha256 in record.files.items())
    listed = [f"file {sha256}  {path}" for path, sha256 in files]
    if not record.is_united:
        lines.add(f'{_SUM}"{_sum([*lines, *listed])}"')
    return "\n".join(f"{line}\n" for line in [_HEADER.rstrip(), *sorted(lines), *listed])


def _sum(lines: Iterable[str]) -> str:
    return digest("\n".join(sorted(lines)).encode())


def _facts(record: Record) -> Iterator[tuple[str, object]]:
    generator = record.generator
    headings = record.package, record.class_, record.folder, generator.domain, generator.release, generator.templates
    yield from zip(_HEADINGS, headings, strict=True)
    yield from (("option", item) for item in record.options.items())
    if record.snapshot is not None:
        yield from (("model", fact) for fact in _elements(record.snapshot))
    yield from (("declared", names) for names in record.renamed.items())
    yield from (("former", names) for names in record.former.items())
    yield from (("id", item) for item in record.ids.items())
    yield from (("confirmed", sha256) for sha256 in record.confirmed)
    yield from (("edit", item) for item in record.edits.items())
    yield from (("former-id", (owner, part)) for owner, ids in record.former_ids.items() for part in ids)
    yield from (("import", (key, entry)) for key, entries in record.imports.items() for entry in entries)
    if record.open:
        seen = record.open.imports
        yield from (("seen-import", (key, entry)) for key, entries in seen.items() for entry in entries)
        yield from (("seen", fact) for fact in _elements(record.open.seen))
        yield from (("renamed", (*key, name)) for key, name in record.open.renamed.items())
        yield from (("asked", item) for item in record.open.asked.items())


def _elements(snapshot: Mapping[str, Any]) -> Iterator[tuple[Any, ...]]:
    """Yield each element of a model: kind, name and element; the name is None unless the value is a mapping."""
    for part, value in snapshot.items():
        if isinstance(value, Mapping) and value:
            yield from ((part, name, element) for name, element in value.items())
        else:
            yield part, None, value


@functools.lru_cache(maxsize=8)  # cached: the daemon reads each state twice per build, 3 of 90 ms
def loads(text: str, file: str) -> tuple[Record | None, Diagnostic | None]:
    """Return the record in `text`, None without a record, and a warning about the first unreadable line.

    `file` is the name in diagnostics. Lines that name files outside of the package are skipped. Raises StateError for
    the state of a newer urdfsync.
    """
    values: dict[str, list[Any]] = {word: [] for word in (*_FACTS, "file")}
    found: Diagnostic | None = None
    lines = dict[str, int]()
    for number, content in enumerate(text.split("\n"), 1):
        if content and not content.startswith("#"):
            lines.setdefault(content, number)
    for content, number in lines.items():
        try:
            word, value = _parse(content)
        except (KeyError, ValueError, RecursionError) as error:
            found = found or damage(file, number, _what_is_wrong(content, error))
            continue
        if word == "release" and _numbers(value) > _numbers(__version__):
            message = f"urdfsync {value} wrote this state, and this is {__version__}, which is older"
            raise StateError.of("newer-state", message, file, number, hint="update urdfsync")
        values[word].append(value)
    if missing := [word for word in _HEADINGS if not values[word]]:
        return None, found or damage(file, 1, f"it has no {', '.join(missing)}" if lines else "it is empty")
    package, folder = values["package"][-1], values["folder"][-1]
    if not _is_normal(folder) or folder.split("/")[-len(package.split(".")) :] != package.split("."):
        return None, damage(file, _line_of(lines, folder), f"{folder!r} is not a folder of the package `{package}`")
    paths = [("file", value, value[0]) for value in values["file"]]
    paths += [(word, value, value[1].target) for word in ("import", "seen-import") for value in values[word]]
    for word, value, path in paths:
        if not _belongs(path, is_import=word != "file"):
            message = f"the path {path!r} does not belong to the package `{package}`"
            found = found or damage(file, _line_of(lines, path), message)
            values[word].remove(value)
    facts = [content for content in lines if not content.startswith(_SUM)]
    return _record(values, is_whole=values["sum"] == [_sum(facts)]), found


def _line_of(lines: Mapping[str, int], text: str) -> int:
    """Return the number of the first line that contains a text; 1 if no line does."""
    return next((number for content, number in lines.items() if text in content), 1)


def _numbers(release: str) -> list[int]:
    return [int(number) for number in re.findall(r"\d{1,9}", release)]


def _parse(content: str) -> tuple[str, Any]:
    """Return the word and the value of a line. Raises KeyError or ValueError."""
    word, _, rest = content.partition(" ")
    if word == "file":
        sha256, _, path = rest.partition("  ")
        if not path or not _HASH.fullmatch(sha256):
            raise ValueError("no hash and path")
        return word, (path, sha256)
    return word, _DECODERS[word].decode(rest)


def _record(values: Mapping[str, list[Any]], *, is_whole: bool) -> Record:
    """Return the record from facts; of two facts for one of `_HEADINGS`, the last one counts."""
    package, class_, folder, domain, _, templates = (values[word][-1] for word in _HEADINGS)
    is_placed = all(len(values[word]) == 1 for word in _PLACE)
    # with two different folders, the files' paths are unknown
    files = {f"{folder}/{path}": sha256 for path, sha256 in sorted(values["file"] if is_placed else ())}
    former_ids = dict[str, list[str]]()
    for owner, part in values["former-id"]:
        former_ids.setdefault(owner, []).append(part)
    models, open_ = values["model"], None
    is_doubled = _is_doubled(models)
    if values["seen"]:
        renamed = {(kind, old): new for kind, old, new in values["renamed"]}
        seen = None if _is_doubled(values["seen"]) else _model(values["seen"])
        is_known = seen is not None and len(renamed) == len(values["renamed"])
        asked, imports = dict(values["asked"]), _imports(values["seen-import"])
        open_ = Open(seen, renamed, asked, imports) if seen is not None and is_known else Open(imports=imports)
    return Record(
        package=package,
        class_=class_,
        folder=folder,
        generator=Generator(domain, max(values["release"], key=_numbers), templates),
        options=dict(values["option"]),
        snapshot=None if is_doubled else _model(models),
        variants=tuple(_model(facts) or {} for facts in (models, models[::-1])) if is_doubled else (),
        renamed=dict(values["declared"]),
        former=_unique(values["former"]),  # two branches may have renamed one element: then its new name is unknown
        confirmed=frozenset(values["confirmed"]),
        edits=_unique(values["edit"]),
        former_ids={owner: tuple(ids) for owner, ids in former_ids.items()},
        imports=_imports(values["import"]),
        files=files,
        ids=_unique(values["id"]),
        open=open_,
        is_united=not is_whole,
    )


def _unique(facts: Sequence[tuple[str, str]]) -> Mapping[str, str]:
    """Return the values of keys with one value."""
    count = Counter(key for key, _ in facts)
    return {key: value for key, value in facts if count[key] == 1}


def _imports(facts: Iterable[tuple[str, Import]]) -> Mapping[str, tuple[Import, ...]]:
    imports: dict[str, tuple[Import, ...]] = {}
    for key, entry in facts:
        imports[key] = (*imports.get(key, ()), entry)
    return imports


def _is_doubled(facts: Iterable[tuple[str, str | None, Any]]) -> bool:
    """Return whether an element occurs twice."""
    return any(count > 1 for count in Counter((part, name) for part, name, _ in facts).values())


def _model(facts: Iterable[tuple[str, str | None, Any]]) -> Mapping[str, Any] | None:
    """Return the model with these elements, the last ones of each name; None without elements."""
    elements = {(part, name): element for part, name, element in facts}
    if not elements:
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
    return f"no fact of urdfsync{reason}"


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
