"""The last build of a robot: its record, and the model and package from this record."""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from operator import itemgetter
from pathlib import PurePath
from typing import Any

import msgspec

from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.common.files import Templates, digest
from urdfsync.domain import Domain, ElementKey, Features, Role, Snapshot, Target, Version
from urdfsync.engine.inspect.package_files import Folder, PackageFiles
from urdfsync.engine.package.generate import Package, generate
from urdfsync.engine.package.imports import RecordedFile
from urdfsync.project.config import RobotConfig
from urdfsync.project.state.notes import Notes
from urdfsync.project.state.record import Record, as_read
from urdfsync.project.state.store import Aside, Store

NO_MODEL = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    UrdfsyncError,
    ValueError,
)
"""Errors that a domain may raise for a recorded snapshot: a stranger may have written the record."""


class LastBuild(msgspec.Struct, frozen=True, dict=True):
    """The last build of a robot, from the record and from this machine's notes."""

    name: str
    """The robot's name in the last build."""
    record: Record
    """The record, united from `records` (see `unite`); without model and files if there are none."""
    records: tuple[Record, ...]
    """The records of all branches that git has united; none if the robot was never built, or if its state is lost."""
    notes: Notes
    _store: Store
    _files: PackageFiles
    _domain: Domain
    _robot: RobotConfig
    _templates: Templates
    texts: Mapping[str, str] = {}
    """Texts of the bases that the user's choices restore, by hash."""

    @cached_property
    def folder(self) -> Folder:
        """The folder of the package in the last build."""
        return Folder(self.record.folder)

    @cached_property
    def source_format(self) -> str:
        """The suffix of the source in the last build if another program read it; empty for a plain source."""
        before = self._store.load_expansion(self.name)
        return PurePath(before.source).suffix if before else ""

    @property
    def target(self) -> Target:
        """Package and class."""
        return Target(self.record.package, self.record.class_)

    @cached_property
    def files(self) -> Mapping[str, str]:
        """The bases of the files that builds have written, by key: as their stamps say, else as recorded.

        Files that a build may not touch are left out.
        """
        recorded = {key: base for key, base in self.record.files.items() if self._files.is_inside(key)}
        stamps = self._files.stamps(self.folder)
        return recorded | {
            key: stamp.base for key, stamp in stamps.items() if key in recorded or self.has_written(stamp.base)
        }

    def base_of(self, key: str, role: Role) -> str | None:
        """Return the base of a file, as its stamp says, else as recorded; None if no build wrote the file."""
        if role is Role.IMPORT:
            return self.files.get(key)
        folder = f"{key.removesuffix('.mo')}/package.mo"
        stamp = self._files.stamp(key) or (self._files.stamp(folder) if key.endswith(".mo") else None)
        return stamp.base if stamp else self.files.get(key)

    @cached_property
    def edits(self) -> Mapping[str, str]:
        """The id of the file that each edited text belongs to, by the text's hash, for all edits that builds saw."""
        return {**self.record.edits, **self.notes.edits}

    def ids_of_lines(self, lines: Iterable[str]) -> set[str]:
        """Return the ids of the files in which builds here have seen edits with all of these lines."""
        found = [set(self.notes.lines.get(line_hash(line), ())) for line in lines]
        return set.intersection(*found) if found else set()

    def has_written(self, sha256: str) -> bool:
        """Whether a build once wrote the text with this hash, or a choice restores it as generated."""
        return sha256 in self.texts or self._store.has_written(self.name, sha256)

    @cached_property
    def options(self) -> Any:
        """The domain's recorded options; None if this version of urdfsync can't read them."""
        if self.record.generator.domain != self._robot.domain:
            return None
        try:
            return msgspec.convert(self.record.options, self._domain.options)
        except msgspec.ValidationError:
            return None

    @cached_property
    def imports(self) -> Mapping[str, RecordedFile]:
        """The imported files and their copies. If a file has several records, the copy's hash decides."""
        parts = (part for record in self.records for part in record.parts())
        imports = dict[str, RecordedFile]()
        for name, entry in sorted((item for part in parts for item in part.imports.items()), key=itemgetter(0)):
            if name not in imports or not imports[name].is_intact:
                key, is_noted = self.folder.key(entry.target), hash_of(entry) in self.notes.imports
                file = RecordedFile(entry, self._files.read(key), self.files.get(key), is_noted)
                if name not in imports or file.is_intact:
                    imports[name] = file
        return imports

    @cached_property
    def version(self) -> Version | None:
        """The model of the last complete build; None if there was none, or if it is lost."""
        snapshot = self.read(self.record.snapshot)
        return None if snapshot is None else Version(snapshot, self.record.imports, self.options)

    @cached_property
    def formers(self) -> tuple[Version, ...]:
        """The versions with the numbers of parts: of the last, incomplete build, then of the complete ones."""
        models = (self.seen, *(self.read(record.snapshot) for record in self.records))
        imports = {key: file.entry for key, file in self.imports.items()}
        return tuple(Version(model, imports) for model in models if model is not None)

    @cached_property
    def elements(self) -> Mapping[ElementKey, Features]:
        """The elements of the model; empty without a model."""
        return {} if self.version is None else self._domain.features(self.version.snapshot)

    @cached_property
    def seen(self) -> Snapshot | None:
        """The model that the last build read, if that build was incomplete."""
        return self.read(self.record.open.snapshot) if self.record.open else None

    @property
    def seen_ids(self) -> Mapping[str, str]:
        """The ids of the parts of that model, as in `Record.ids`."""
        return self.record.open.ids if self.record.open else {}

    @cached_property
    def branches(self) -> tuple[tuple[Record, Snapshot, Mapping[ElementKey, Features]], ...]:
        """The records of all branches whose models can be read, with these models and their elements."""
        models = ((record, self.read(record.snapshot)) for record in self.records)
        return tuple((record, model, self._domain.features(model)) for record, model in models if model is not None)

    @property
    def is_united(self) -> bool:
        """Whether git has united the records of several branches."""
        return len(self.records) > 1

    def read(self, recorded: Mapping[str, Any] | None) -> Snapshot | None:
        """Return a recorded model; None if this domain can't read the record: a stranger may have written it."""
        if not recorded or self.record.generator.domain != self._robot.domain:
            return None
        try:
            return as_read(recorded, self._domain.model)
        except NO_MODEL:
            return None

    @cached_property
    def package(self) -> Package | None:
        """The package from the recorded model with the present templates; None if it can't be generated."""
        return None if self.version is None else self.package_like(self.version.snapshot)

    def package_like(self, now: Snapshot) -> Package | None:
        """Return the package from the recorded model, in the order of another model; None as for `package`."""
        if self.version is None:
            return None
        options = self.options or self._robot.options
        try:
            snapshot = self._domain.arranged(self.version.snapshot, now)
            version = msgspec.structs.replace(self.version, snapshot=snapshot)
            return generate(self._domain, version, self.target, options, self._templates)
        except NO_MODEL:
            return None

    @contextlib.contextmanager
    def passing_over_invalid(self) -> Iterator[None]:
        """Pass over errors if the recorded model is invalid; raise them if it gives a package: then they are ours."""
        try:
            yield
        except NO_MODEL:
            if self.package is not None:
                raise

    def base(self, sha256: str | None) -> str | None:
        """Return the stored generated text with this hash; None if there is none."""
        return self.texts.get(sha256) or self._store.base(self.name, sha256) if sha256 else None

    @cached_property
    def aside(self) -> Mapping[str, Aside]:
        """The texts that builds and choices replaced, by path below the package."""
        return self._store.aside(self.name)


def hash_of(recorded: Any) -> str:
    """Return the hash by which this machine notes a recorded value."""
    return digest(msgspec.json.encode(recorded, order="sorted"))


def option_values(options: msgspec.Struct) -> dict[str, Any]:
    """Return a domain's options for the record: plain data, without None and empty tables."""
    values = msgspec.json.decode(msgspec.json.encode(options))
    return {name: value for name, value in values.items() if value not in (None, {})}


def lines_of(text: str) -> Counter[str]:
    """Return the lines of a text that have more than blanks, without their indents."""
    return Counter(line.strip() for line in text.splitlines() if line.strip())


def line_hash(line: str) -> str:
    """Return the hash by which notes know a line of an edit."""
    return digest(line.encode())[:16]
