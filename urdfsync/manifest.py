"""The recorded state of one robot, text ↔ value.

Two files in `.urdfsync/robots/`, both committed: `<robot>.toml`, which people review and which is made here, and
`<robot>.json` with the model (see `modelfile`). Neither holds absolute paths, times or host names.
"""

from __future__ import annotations

import hashlib
import posixpath
import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias, TypeVar

import msgspec
import tomli_w

from urdfsync import tomlfile
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.state.record import FileRecord

FORMAT = 1
"""Raised when an older urdfsync could misread what a newer one records."""

_HEADER = """\
# What urdfsync last built for this robot. Written by urdfsync: commit it, don't edit it.
# base is the hash of the text that a file last took into account, line endings normalised.

"""
_ORDER = "package.order"
_PARENT = "../package.order"
"""The parent package's order file, as it stands in the text."""
_PLAIN = re.compile(r"\w[\w.-]*(?:/\w[\w.-]*)*")
"""What nearly all paths are: nothing that could lead elsewhere."""
REPAIR = "restore it from version control, or let `urdfsync build --repair` make it again"
"""What to do about a state that can't be read."""


class Generator(msgspec.Struct, frozen=True):
    """What turned the model into files."""

    domain: str
    revision: int
    fingerprint: str
    """Hash of templates, options and revision."""


class Source(msgspec.Struct, frozen=True):
    """What was read, and the hash of the JSON file that holds it as a snapshot."""

    path: str
    hash: str
    snapshot: str


class DependencyRecord(msgspec.Struct, frozen=True, omit_defaults=True):
    """One file that the source refers to; the hashes are None if it was never found."""

    uri: str
    target: str
    source_hash: str | None = None
    target_hash: str | None = None
    converter: int | None = None
    unreadable: str | None = None
    """Hash of the source that was found last, if `unreadable_by` (the converter's version) could not read it."""
    unreadable_by: int | None = None


class Manifest(msgspec.Struct, frozen=True, kw_only=True):
    """The state of one robot after a build.

    The keys of `files` and `orders` are POSIX paths relative to the configuration's folder, like
    `folder`, the package's own; in the text they are relative to `folder`. `orders` has the names
    that urdfsync owns in each `package.order` file. What lies outside of the package is not recorded,
    but for the parent's `package.order`: a later build must not touch it.
    """

    format: int = FORMAT
    package: str
    class_: str = msgspec.field(name="class")
    folder: str
    source: Source
    generator: Generator
    options: Mapping[str, Any] | None = None
    """The domain's options of the build as TOML has them, without those that are None; None in older states."""
    names: Mapping[str, Mapping[str, str]] = {}
    dependencies: Mapping[str, DependencyRecord] = {}
    orders: Mapping[str, tuple[str, ...]] = {}
    files: Mapping[str, FileRecord] = {}

    @property
    def recorded(self) -> Manifest:
        """What comes back from the manifest's text: sorted, and without what lies outside of the package."""
        inside, above = f"{self.folder}/", _order_above(self.folder)
        return msgspec.structs.replace(
            self,
            names={kind: dict(sorted(names.items())) for kind, names in sorted(self.names.items()) if names},
            dependencies=dict(sorted(self.dependencies.items())),
            orders={
                path: names for path, names in sorted(self.orders.items()) if path == above or path.startswith(inside)
            },
            files={
                path: _with_origin(record, inside, len(inside)) if record.origin else record
                for path, record in sorted(self.files.items())
                if path.startswith(inside)
            },
        )


_Keys: TypeAlias = tuple[str, ...]
"""Those of a table in the text, outermost first."""
_Name = TypeVar("_Name")
_Value = TypeVar("_Value")


class Tables:
    """The tables of the last manifest's text, each with what it is made of: what is the same serves again."""

    def __init__(self) -> None:
        self._folder = ""
        self._heads: dict[_Keys, tuple[object, str]] = {}
        self._files: dict[str, tuple[FileRecord, str]] = {}

    def texts(self, manifest: Manifest) -> list[str]:
        """The texts of all tables of a manifest as it is recorded, in their order."""
        if manifest.folder != self._folder:
            self._folder, self._files = manifest.folder, {}
        heads, below = dict(_heads(manifest)), len(manifest.folder) + 1
        self._heads = _renewed(self._heads, heads, lambda keys, made_of: (keys, made_of))
        self._files = _renewed(
            self._files, manifest.files, lambda path, record: (("files", path[below:]), _with_origin(record, "", below))
        )
        found = (*self._heads.values(), *self._files.values())
        return [text for _, text in found]


def dumps(manifest: Manifest, tables: Tables | None = None) -> str:
    """The manifest as text: the same value gives the same text everywhere.

    `tables` are those of a manifest that was written before; they are replaced by those of this one.
    """
    return _HEADER + "\n\n".join((tables or Tables()).texts(manifest.recorded)) + "\n"


def _heads(manifest: Manifest) -> Iterator[tuple[_Keys, object]]:
    """The tables of a manifest without those of its files: the keys of each, and what it is made of."""
    below, above = len(manifest.folder) + 1, _order_above(manifest.folder)
    folder = {"package": manifest.package, "class": manifest.class_, "folder": manifest.folder}
    yield (), {"format": manifest.format, **folder}
    yield ("source",), manifest.source
    yield ("generator",), manifest.generator
    if manifest.options is not None:
        yield ("options",), manifest.options
    yield from ((("names", kind), names) for kind, names in manifest.names.items())
    yield from ((("dependencies", key), dependency) for key, dependency in manifest.dependencies.items())
    orders = {_PARENT if path == above else path[below:]: names for path, names in manifest.orders.items()}
    if orders:
        yield ("orders",), dict(sorted(orders.items()))


def _renewed(
    known: dict[_Name, tuple[_Value, str]],
    wanted: Mapping[_Name, _Value],
    table: Callable[[_Name, _Value], tuple[_Keys, object]],
) -> dict[_Name, tuple[_Value, str]]:
    """What each wanted table is made of, and its text; `table` gives the keys of a table and what is in it."""
    new = [name for name, made_of in wanted.items() if name not in known or known[name][0] != made_of]
    texts = _texts(dict(table(name, wanted[name]) for name in new))
    made = {name: (wanted[name], text) for name, text in zip(new, texts, strict=True)}
    if not made.keys() <= known.keys() or len(known) != len(wanted):
        return {name: made.get(name) or known[name] for name in wanted}
    return {**known, **made}  # in the same order


def _texts(tables: Mapping[_Keys, object]) -> list[str]:
    """The text of each table, without the end of its last line: there are no empty lines but those between tables."""
    document: dict[str, Any] = {}
    for keys, made_of in tables.items():
        inner = document
        for key in keys[:-1]:
            inner = inner.setdefault(key, {})
        inner.update(msgspec.to_builtins({keys[-1]: made_of} if keys else made_of))
    return tomli_w.dumps(document).removesuffix("\n").split("\n\n") if tables else []


def _with_origin(record: FileRecord, prefix: str, cut: int) -> FileRecord:
    """The record with `prefix` in the place of the first `cut` characters of its origin, if it has one."""
    return msgspec.structs.replace(record, origin=prefix + record.origin[cut:]) if record.origin else record


def loads(text: str, file: str) -> Manifest:
    """The manifest in `text`, which errors call `file`.

    Raises StateError with file and line for text that is no manifest, that names files outside of its package, or
    that a newer urdfsync wrote.
    """
    data = tomlfile.parse(text, file, StateError, REPAIR)
    check_format(data.get("format"), file, text)
    try:
        manifest = msgspec.convert(data, Manifest)
    except msgspec.ValidationError as error:
        raise StateError(_broken(str(error), data, text, file)) from None
    _check_places(manifest, text, file)

    folder, above = manifest.folder, _order_above(manifest.folder)
    files = {
        f"{folder}/{path}": _with_origin(record, f"{folder}/", 0) for path, record in sorted(manifest.files.items())
    }
    orders = {above if path == _PARENT else f"{folder}/{path}": names for path, names in manifest.orders.items()}
    return msgspec.structs.replace(manifest, files=files, orders=dict(sorted(orders.items())))


def option_values(options: msgspec.Struct) -> dict[str, Any]:
    """A domain's options as the manifest has them: TOML has lists in the place of tuples, and no None."""
    values = msgspec.json.decode(msgspec.json.encode(options))
    return {name: value for name, value in values.items() if value is not None}


def text_hash(text: str) -> str:
    """SHA-256 (hex) of a text with its line endings normalised, as in `files.text_digest`."""
    normalised = text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text
    return hashlib.sha256(normalised.encode()).hexdigest()


def check_format(value: object, file: str, text: str = "") -> None:
    """Refuse a format that this program does not know; `text` is the TOML that it is in. Raises StateError."""
    if not isinstance(value, int) or 1 <= value <= FORMAT:
        return
    line = tomlfile.nearest(tomlfile.lines(text), "format")
    if value > FORMAT:
        message = f"a newer urdfsync wrote this state (format {value}; this one knows {FORMAT})"
        raise StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, line, hint="update urdfsync"))
    message = f"this is no state of urdfsync: there is no format {value}"
    raise StateError(Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=REPAIR))


def _check_places(manifest: Manifest, text: str, file: str) -> None:
    """Refuse every path that could lead a build to a file that is not of the package; keys are those of the text."""
    for fine, path, place in _places(manifest):
        if not fine:
            line = tomlfile.nearest(tomlfile.lines(text), *place)
            message = f"the recorded path {path!r} does not belong to the package `{manifest.package}`"
            hint = "restore the state from version control, or delete it: a build then adopts what is as it would be"
            raise StateError(Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=hint))


def _places(manifest: Manifest) -> Iterator[tuple[bool, str, tuple[str, ...]]]:
    """Every path in the text: whether it is fine, the path, and the keys that lead to it."""
    folder, steps = manifest.folder, manifest.package.split(".")
    yield _is_normal(folder) and folder.split("/")[-len(steps) :] == steps, folder, ("folder",)
    yield _is_text(manifest.source.path), manifest.source.path, ("source", "path")
    for path, record in manifest.files.items():
        yield _is_inside(path), path, ("files", path)
        if record.origin is not None:
            yield _is_inside(record.origin), record.origin, ("files", path, "origin")
    for path in manifest.orders:
        own = path == _PARENT or _is_inside(path)
        yield own and posixpath.basename(path) == _ORDER, path, ("orders", path)
    for key, dependency in manifest.dependencies.items():
        yield _is_inside(dependency.target), dependency.target, ("dependencies", key, "target")


def _is_text(path: str) -> bool:
    return not any(ord(char) < 32 or ord(char) == 127 for char in path)


def _is_normal(path: str) -> bool:
    """Whether a path is relative, with forward slashes, without detours and control characters."""
    absolute = path.startswith("/") or re.match(r"[A-Za-z]:", path) is not None
    return not absolute and _is_text(path) and "\\" not in path and posixpath.normpath(path) == path


def _is_inside(path: str) -> bool:
    """Whether a path from a folder is that of a file below it."""
    return bool(_PLAIN.fullmatch(path)) or (_is_normal(path) and path.split("/")[0] not in (".", ".."))


def _order_above(folder: str) -> str:
    return posixpath.join(posixpath.dirname(folder), _ORDER)


def _broken(error: str, data: Mapping[str, Any], text: str, file: str) -> Diagnostic:
    message, _, place = error.partition(" - at `$")
    path = re.findall(r"\w+", place)
    entries = data.get(path[0]) if "[...]" in place else None
    if isinstance(entries, dict):
        path = [path[0], next((key for key, entry in entries.items() if not _fits(path[0], entry)), ""), *path[1:]]
    line = tomlfile.nearest(tomlfile.lines(text), *path)
    message = f"this is no state of urdfsync: {message[0].lower()}{message[1:]}"
    return Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=REPAIR)


def _fits(table: str, entry: object) -> bool:
    kinds = {"dependencies": DependencyRecord, "orders": tuple[str, ...], "files": FileRecord}
    try:
        msgspec.convert(entry, kinds.get(table, dict[str, str]))
    except msgspec.ValidationError:
        return False
    return True
