"""The recorded state of one robot, text ↔ value.

Two files in `.urdfsync/robots/`, both committed: `<robot>.toml`, which people review and which is made here, and
`<robot>.json` with the model (see `modelfile`). Neither holds absolute paths, times or host names.
"""

from __future__ import annotations

import contextlib
import hashlib
import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import msgspec
import tomli_w

from urdfsync import tomlfile
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.domain import Role
from urdfsync.state.record import FileRecord, RecordState

FORMAT = 1
"""Raised when an older urdfsync could misread what a newer one records."""

_HEADER = """\
# What urdfsync last built for this robot. Written by urdfsync: commit it, don't edit it.
# base is the hash of the text that a file last took into account, line endings normalised.

"""
_ORDER = "package.order"
_PARENT = "../package.order"
"""The parent package's order file, as it stands in the text."""
_RESOURCES = "Resources/"
"""Where imported files are."""
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
                path: _with_origin(record, inside + (record.origin or "")[len(inside) :])
                for path, record in sorted(self.files.items())
                if path.startswith(inside)
            },
        )


def dumps(manifest: Manifest) -> str:
    """The manifest as text: the same value gives the same text everywhere."""
    manifest = manifest.recorded
    above, below = _order_above(manifest.folder), len(manifest.folder) + 1
    document = msgspec.to_builtins(manifest)
    document["orders"] = {
        _PARENT if path == above else path[below:]: list(names) for path, names in manifest.orders.items()
    }
    document["orders"] = dict(sorted(document["orders"].items()))
    document["files"] = {path[below:]: record for path, record in document["files"].items()}
    for record in document["files"].values():
        if "origin" in record:
            record["origin"] = record["origin"][below:]
    left_out = {key for key in ("names", "dependencies", "orders", "files") if not document[key]}
    left_out |= {"options"} if manifest.options is None else set()
    return _HEADER + tomli_w.dumps({key: value for key, value in document.items() if key not in left_out})


def with_overtaken(planned: bytes, before: Iterable[bytes], keys: Iterable[str]) -> bytes:
    """The text of a manifest after a build that left files alone because somebody saved them in between.

    `planned` is the text as it was planned, `before` are those of the manifests that it replaces, and `keys` are the
    paths of these files. Their records stay as they were, and say that the files conflict. The source counts as
    another one: so no build takes the package for up to date until all of it was looked at again.
    """
    manifest = loads(planned.decode(), "")
    files, orders = dict(manifest.files), dict(manifest.orders)
    known_files: dict[str, FileRecord] = {}
    known_orders: dict[str, tuple[str, ...]] = {}
    for text in before:
        with contextlib.suppress(StateError, UnicodeDecodeError):  # a state that `--repair` is about to replace
            recorded = loads(text.decode(), "")
            known_files |= recorded.files
            known_orders |= recorded.orders
    for key in keys:
        if key in orders or key in known_orders:
            orders[key] = known_orders.get(key, ())
        record = known_files.get(key)
        if record is None and key in files:
            record = FileRecord(files[key].owner, files[key].role)
        if record is not None:
            files[key] = msgspec.structs.replace(record, state=RecordState.CONFLICT)
    source = msgspec.structs.replace(manifest.source, hash="")
    orders = {key: names for key, names in orders.items() if names}
    return dumps(msgspec.structs.replace(manifest, source=source, files=files, orders=orders)).encode()


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
        f"{folder}/{path}": _with_origin(record, f"{folder}/{record.origin}")
        for path, record in sorted(manifest.files.items())
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


def _with_origin(record: FileRecord, origin: str) -> FileRecord:
    """The record with another origin, if it has one."""
    return msgspec.structs.replace(record, origin=origin) if record.origin else record


def _check_places(manifest: Manifest, text: str, file: str) -> None:
    """Refuse every path at which no build has written a file of the package; keys are those of the text."""
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
        yield _is_of_role(path, record.role), path, ("files", path)
        if record.origin is not None:
            yield _is_of_role(record.origin, record.role), record.origin, ("files", path, "origin")
    for path, names in manifest.orders.items():
        own = set(names) <= {steps[-1]} if path == _PARENT else _is_inside(path)
        yield own and posixpath.basename(path) == _ORDER, path, ("orders", path)
    for key, dependency in manifest.dependencies.items():
        yield _is_of_role(dependency.target, Role.IMPORT), dependency.target, ("dependencies", key, "target")


def _is_text(path: str) -> bool:
    return not any(ord(char) < 32 or ord(char) == 127 for char in path)


def _is_normal(path: str) -> bool:
    """Whether a path is relative, with forward slashes, without detours and control characters."""
    absolute = path.startswith("/") or re.match(r"[A-Za-z]:", path) is not None
    return not absolute and _is_text(path) and "\\" not in path and posixpath.normpath(path) == path


def _is_of_role(path: str, role: Role) -> bool:
    """Whether a path below the package is one that a build writes for such a file."""
    return _is_inside(path) and (path.startswith(_RESOURCES) if role is Role.IMPORT else path.endswith(".mo"))


def _is_inside(path: str) -> bool:
    """Whether a path from a folder is that of a file below it."""
    return bool(_PLAIN.fullmatch(path)) or (_is_normal(path) and not any(p.startswith(".") for p in path.split("/")))


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
