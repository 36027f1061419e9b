"""The record of a robot: the files that urdfsync wrote last, to tell edits from exports.

The record is committed, so a stranger may have changed it: it never decides which text a build generates or restores. A
build that ends with a conflict keeps the recorded model, but renews the bases of files that it writes.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any, get_args

import msgspec

from urdfsync.domain import ElementKey, Import, Role, Snapshot, plain
from urdfsync.matching import Doubt

RESOURCES = "Resources/"
"""The folder of imported files, below the package."""


def as_recorded(snapshot: Snapshot) -> dict[str, Any]:
    """Return a snapshot for the state: plain data, with lists of named elements as mappings by name."""
    data: dict[str, Any] = plain(snapshot)
    parts = {part: data.pop(part) for part in _named(snapshot.__class__)}
    return data | {part: {one.pop("name"): one for one in elements} for part, elements in parts.items() if elements}


def as_read(data: Mapping[str, Any], model: Any) -> Snapshot:
    """Return the snapshot from a result of `as_recorded`. Raises ValueError, TypeError or AttributeError."""
    parts = {part: data.get(part, {}) for part in _named(model)}
    lists = {part: [{"name": name, **one[name]} for name in sorted(one)] for part, one in parts.items()}
    return msgspec.convert({**data, **lists}, model)


@functools.cache
def _named(model: Any) -> tuple[str, ...]:
    """Return the fields of a struct that are lists of structs with names."""
    items = {field.encode_name: (*get_args(field.type), None)[0] for field in msgspec.structs.fields(model)}
    return tuple(name for name, item in items.items() if "name" in getattr(item, "__struct_fields__", ()))


class Generator(msgspec.Struct, frozen=True):
    """The program that turned the model into files."""

    domain: str
    release: str
    """The version of urdfsync, such as `1.4.0`."""
    templates: str


class Question(msgspec.Struct, frozen=True):
    """The question whether an edited file belongs to another part. Each clone asks it until the user answers."""

    mine: str
    """Hash of the edited text; empty if the user turned the class into a folder."""
    doubt: Doubt


class Open(msgspec.Struct, frozen=True):
    """The model that the last, incomplete build read."""

    seen: Mapping[str, Any] = {}
    renamed: Mapping[ElementKey, str] = {}
    """Names in this model by renamed elements of the last complete build."""
    asked: Mapping[str, Question] = {}
    """The questions that the user has not answered yet, by the file's key."""
    imports: Mapping[str, tuple[Import, ...]] = {}
    """The imports that incomplete builds have renewed, by key."""


class Record(msgspec.Struct, frozen=True, kw_only=True):
    """The files that urdfsync wrote last for one robot.

    Keys of `files` are POSIX paths from the configuration's folder; so is `folder`, the folder of the package. Derived
    values are not recorded.
    """

    package: str
    class_: str
    folder: str
    generator: Generator
    options: Mapping[str, Any] = {}
    """The domain's options as JSON data, without options that are None."""
    snapshot: Mapping[str, Any] | None = None
    """The model of the last complete build (see `as_recorded`); None without a model, or if git has doubled an
    element."""
    variants: tuple[Mapping[str, Any], ...] = ()
    """If git has doubled an element: the model with its first value, and with its last value."""
    renamed: Mapping[str, str] = {}
    """The declared renames that the last complete build has applied: they are not applied again."""
    former: Mapping[str, str] = {}
    """The present identifier of each renamed element, by each identifier that it had before: an edit that was made
    before a rename may come later, by a merge of git."""
    confirmed: frozenset[str] = frozenset()
    """Hashes of the user's texts for which he has confirmed the file."""
    edits: Mapping[str, str] = {}
    """The id of the file that each edited text belongs to, by the text's hash. An edit alone does not change the
    record: the next build that does adds it."""
    former_ids: Mapping[str, tuple[str, ...]] = {}
    """The ids of the parts that had a name and have it no more, by owner."""
    imports: Mapping[str, tuple[Import, ...]] = {}
    """The imports of the last complete build by key. A file has several if git has united two states."""
    files: Mapping[str, str] = {}
    """The generated text of each file by its hash, and each imported file by the hash of its bytes."""
    ids: Mapping[str, str] = {}
    """The lasting ids of renamed parts, by owner: kind and name. Other parts have the id of their owner's name."""
    open: Open | None = None
    """None if the last build was complete."""
    is_united: bool = False
    """Whether git has united two states since the last complete build, or lines are missing."""


def role_of(path: str) -> Role:
    """Return the role of a recorded file that is no longer generated, by its path below the package."""
    if path.startswith(RESOURCES):
        return Role.IMPORT
    return Role.PACKAGE if path.rpartition("/")[2] == "package.mo" else Role.RECORD
