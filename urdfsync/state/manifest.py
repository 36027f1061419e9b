"""The recorded state of one robot, text ↔ value.

Two files in `.urdfsync/robots/`, both committed: `<robot>.toml`, which people review and which is made here, and
`<robot>.json` with the model (see `modelfile`). Neither holds absolute paths, times or host names.
"""

from __future__ import annotations

import functools
import posixpath
import re
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec
import tomli_w

from urdfsync import tomlfile
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.domain import Role
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
        names = {kind: dict(sorted(names.items())) for kind, names in sorted(self.names.items()) if names}
        orders = {path: order for path, order in self.orders.items() if path == above or path.startswith(inside)}
        return msgspec.structs.replace(
            self,
            names=names,
            dependencies=dict(sorted(self.dependencies.items())),
            orders=dict(sorted(orders.items())),
            files={path: record for path, record in sorted(self.files.items()) if path.startswith(inside)},
        )


def dumps(manifest: Manifest) -> str:
    """The manifest as text: the same value gives the same text everywhere."""
    manifest = manifest.recorded
    above, below = _order_above(manifest.folder), len(manifest.folder) + 1
    document = msgspec.to_builtins(msgspec.structs.replace(manifest, files={}))
    orders = {_PARENT if path == above else path[below:]: list(names) for path, names in manifest.orders.items()}
    document["orders"] = dict(sorted(orders.items()))
    optional = ("names", "dependencies", "orders", "files")
    kept = {key: value for key, value in document.items() if value is not None and (value or key not in optional)}
    plain = {key: value for key, value in kept.items() if not isinstance(value, dict)}
    tables: list[Mapping[str, Any]] = [{key: value} for key, value in kept.items() if key not in plain]
    for path, record in manifest.files.items():
        entry = msgspec.structs.replace(record, origin=record.origin[below:]) if record.origin else record
        tables.append({"files": {path[below:]: entry}})
    return "\n".join([_HEADER + tomli_w.dumps(plain), *(_table(msgspec.json.encode(table)) for table in tables)])


@functools.lru_cache(maxsize=20_000)  # serves "one mass changed in the daemon": nearly all tables are as they were
def _table(data: bytes) -> str:
    """A table as TOML, from JSON."""
    return tomli_w.dumps(msgspec.json.decode(data))


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
        message, _, place = str(error).partition(" - at `$")
        line = tomlfile.nearest(tomlfile.key_lines(text), *_wrong_keys(data, place))
        message = f"this is no state of urdfsync: {message[0].lower()}{message[1:]}"
        raise StateError(Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=REPAIR)) from None
    for is_own, path, keys in _paths(manifest):
        if not is_own:
            line = tomlfile.nearest(tomlfile.key_lines(text), *keys)
            message = f"the recorded path {path!r} does not belong to the package `{manifest.package}`"
            hint = "restore the state from version control, or delete it: a build then adopts what is as it would be"
            raise StateError(Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=hint))
    folder, files = manifest.folder, {}
    for path, record in sorted(manifest.files.items()):
        origin = record.origin and f"{folder}/{record.origin}"
        files[f"{folder}/{path}"] = msgspec.structs.replace(record, origin=origin) if origin else record
    orders = {
        _order_above(folder) if path == _PARENT else f"{folder}/{path}": names
        for path, names in manifest.orders.items()
    }
    return msgspec.structs.replace(manifest, files=files, orders=dict(sorted(orders.items())))


def option_values(options: msgspec.Struct) -> dict[str, Any]:
    """A domain's options as the manifest has them: TOML has lists in the place of tuples, and no None."""
    values = msgspec.json.decode(msgspec.json.encode(options))
    return {name: value for name, value in values.items() if value is not None}


def check_format(value: object, file: str, text: str = "") -> None:
    """Refuse a format that this program does not know; `text` is the TOML that it is in. Raises StateError."""
    if not isinstance(value, int) or 1 <= value <= FORMAT:
        return
    line = tomlfile.nearest(tomlfile.key_lines(text), "format")
    if value > FORMAT:
        raise newer_state(value, file, line)
    message = f"this is no state of urdfsync: there is no format {value}"
    raise StateError(Diagnostic(Severity.ERROR, "broken-state", message, file, line, hint=REPAIR))


def newer_state(value: int, file: str, line: int) -> StateError:
    """Return the error of a state whose format only a newer urdfsync knows."""
    message = f"a newer urdfsync wrote this state (format {value}; this one knows {FORMAT})"
    return StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, line, hint="update urdfsync"))


def _wrong_keys(data: Mapping[str, Any], place: str) -> list[str]:
    """The keys to a wrong value, whose place msgspec names without the key of its entry: `.files[...].role`."""
    keys = re.findall(r"\w+", place)
    if "[...]" in place:
        for key, entry in data[keys[0]].items():
            try:
                msgspec.convert({**data, keys[0]: {key: entry}}, Manifest)
            except msgspec.ValidationError:
                return [keys[0], key, *keys[1:]]
    return keys


def _paths(manifest: Manifest) -> Iterator[tuple[bool, str, tuple[str, ...]]]:
    """Every path in the text: whether a build writes such a file of the package, the path, and the keys to it."""
    folder, package = manifest.folder, manifest.package.split(".")
    yield _is_normal(folder) and folder.split("/")[-len(package) :] == package, folder, ("folder",)
    yield _is_text(manifest.source.path), manifest.source.path, ("source", "path")
    for path, record in manifest.files.items():
        yield _is_of_role(path, record.role), path, ("files", path)
        if record.origin is not None:
            yield _is_of_role(record.origin, record.role), record.origin, ("files", path, "origin")
    for path, names in manifest.orders.items():
        is_own = set(names) <= {package[-1]} if path == _PARENT else _is_inside(path)
        yield is_own and posixpath.basename(path) == _ORDER, path, ("orders", path)
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
    """Whether a path from a folder is that of a file below it, hidden ones apart."""
    if _PLAIN.fullmatch(path):
        return True
    return _is_normal(path) and not any(part.startswith(".") for part in path.split("/"))


def _order_above(folder: str) -> str:
    return posixpath.join(posixpath.dirname(folder), _ORDER)
