"""The record of a robot: the model and the files of its last complete build.

The record is committed, so a stranger may have changed it: it never decides which text a build generates or restores. A
build that ends with a conflict keeps the recorded model, and adds what it has read and written.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, get_args

import msgspec

from urdfsync.domain import Import, Role, Snapshot, plain
from urdfsync.domain.matching import Doubt

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


class Open(msgspec.Struct, frozen=True, omit_defaults=True):
    """What incomplete builds have read and written since the last complete build."""

    snapshot: Mapping[str, Any] = {}
    """The model that the last of them read."""
    ids: Mapping[str, str] = {}
    """The lasting ids of renamed parts in this model, as in `Record.ids`."""
    imports: Mapping[str, Import] = {}
    """The imports that they have renewed, by key."""
    files: Mapping[str, str] = {}
    """The files that they have written, as in `Record.files`."""
    asked: Mapping[str, Doubt] = {}
    """The questions whether an edited file belongs to another part, by `edit_key`. Each clone asks until the user
    answers."""
    named: frozenset[str] = frozenset()
    """Hashes of the edited texts of which the user says that their names are right."""


class Record(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The last complete build of one robot: its model, and the files that urdfsync wrote.

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
    """The model (see `as_recorded`); None without a complete build."""
    renamed: Mapping[str, str] = {}
    """The declared renames that this build has applied: they are not applied again."""
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
    imports: Mapping[str, Import] = {}
    """The imports by key."""
    files: Mapping[str, str] = {}
    """The generated text of each file by its hash, and each imported file by the hash of its bytes."""
    ids: Mapping[str, str] = {}
    """The lasting ids of renamed parts, by owner: kind and name. Other parts have the id of their owner's name."""
    open: Open | None = None
    """None if the last build was complete."""
    ancestors: tuple[str, ...] = ()
    """The keys of the last records before this one, the latest first."""

    def parts(self) -> Iterator[Record | Open]:
        """Yield the record, and the builds since then."""
        yield self
        if self.open:
            yield self.open


def edit_key(path: str, mine: str | None) -> str:
    """Return the key of an edit: the hash of its text; the path of a class that the user turned into a folder."""
    return mine or path


def unite(records: Sequence[Record]) -> Record:
    """Return the record of the first branch, with the names and edits of all branches, and all files that they wrote.

    A name or an edit that has several meanings is left out.
    """
    first, *others = records
    files = {key: base for record in reversed(records) for part in record.parts() for key, base in part.files.items()}
    if not others:
        return msgspec.structs.replace(first, files=files)
    former_ids = dict[str, dict[str, None]]()
    for owner, part in ((owner, part) for one in records for owner, ids in one.former_ids.items() for part in ids):
        former_ids.setdefault(owner, {})[part] = None
    return msgspec.structs.replace(
        first,
        renamed={old: new for record in reversed(records) for old, new in record.renamed.items()},
        former=_unique(record.former for record in records),
        confirmed=frozenset().union(*(record.confirmed for record in records)),
        edits=_unique(record.edits for record in records),
        former_ids={owner: tuple(ids) for owner, ids in former_ids.items()},
        files=files,
    )


def _unique(tables: Iterable[Mapping[str, str]]) -> dict[str, str]:
    """Return the values of all tables for the keys with one value."""
    values = dict[str, set[str]]()
    for key, value in (item for table in tables for item in table.items()):
        values.setdefault(key, set()).add(value)
    return {key: one.pop() for key, one in values.items() if len(one) == 1}


def role_of(path: str) -> Role:
    """Return the role of a recorded file that is no longer generated, by its path below the package."""
    if path.startswith(RESOURCES):
        return Role.IMPORT
    return Role.PACKAGE if path.rpartition("/")[2] == "package.mo" else Role.RECORD
