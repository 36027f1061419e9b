"""The last build of a robot: what the state records of it, and the model and the package that follow from that."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import msgspec

from urdfsync.config import RobotConfig
from urdfsync.diagnostics import OutputError
from urdfsync.domain import Domain, Import, Role, Target, Templates, Version
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.imports import RecordedFile
from urdfsync.engine.package_files import Folder, PackageFiles
from urdfsync.engine.rules import NEVER_WRITTEN, OnDisk
from urdfsync.state.record import FileRecord, Record
from urdfsync.state.store import PutAside, Store

NO_MODEL = (KeyError, TypeError, AttributeError, ValueError)
"""Errors that a domain raises for a recorded snapshot that is none of its own."""


class LastBuild(msgspec.Struct, frozen=True, dict=True):
    """The last complete build of a robot."""

    name: str
    """The robot's name then."""
    record: Record
    """Without a model and files if the robot was never built, or if its state is lost."""
    _store: Store
    _files: PackageFiles
    _domain: Domain
    _robot: RobotConfig
    _templates: Templates

    @cached_property
    def folder(self) -> Folder:
        """Where the package was."""
        return Folder(self.record.folder)

    @property
    def target(self) -> Target:
        """Package and class."""
        return Target(self.record.package, self.record.class_)

    @cached_property
    def files(self) -> Mapping[str, FileRecord]:
        """The recorded files by key; those that a build may not touch are left out."""
        return {key: file for key, file in self.record.files.items() if self._files.is_inside(key)}

    def file(self, key: str, role: Role, on_disk: OnDisk, generated: str | None) -> FileRecord:
        """Return the record of a file as it is on disk.

        A text in the bases is urdfsync's own, whatever is recorded: a build that a save overtook may have written it,
        or git has put it back.
        """
        record = self.files.get(key, NEVER_WRITTEN)
        if not isinstance(on_disk, str) or role is Role.IMPORT or on_disk in (generated, *record.hashes):
            return record
        return record if self.base(on_disk) is None else FileRecord((on_disk,))

    @cached_property
    def options(self) -> Any:
        """The domain's options; None if they are not as this program has them."""
        if self.record.generator.domain != self._robot.domain:
            return None
        try:
            return msgspec.convert(self.record.options, self._domain.options)
        except msgspec.ValidationError:
            return None

    @cached_property
    def imports(self) -> Mapping[str, RecordedFile]:
        """The imported files, and their copies in the package; of several records of a file, the one of its copy."""
        return {key: self._recorded_file(entries) for key, entries in self.record.imports.items()}

    def _recorded_file(self, entries: Sequence[Import]) -> RecordedFile:
        files = list[RecordedFile]()
        for entry in entries:
            key = self.folder.key(entry.target)
            files.append(RecordedFile(entry, self._files.read(key), self.files.get(key, NEVER_WRITTEN).hashes))
        return next((file for file in files if file.is_intact), files[0])

    @cached_property
    def version(self) -> Version | None:
        """The model; None if there was none, or it is lost, or united and not whole."""
        if self.record.snapshot is None or (self.record.is_united and self.package is None):
            return None
        return self._version

    @cached_property
    def _version(self) -> Version:
        imports = {key: file.entry for key, file in self.imports.items()}
        return Version(self.record.snapshot or {}, imports, self.options)

    @cached_property
    def package(self) -> Package | None:
        """The package, from today's templates; None if there can't be one, as of a model that is not whole."""
        if self.record.snapshot is None or self.record.generator.domain != self._robot.domain:
            return None
        options = self.options or self._robot.options
        try:
            imports: Mapping[str, Import] = self._version.imports or {}
            return generate(self._domain, self.record.snapshot, imports, self.target, options, self._templates)
        except (*NO_MODEL, OutputError):
            return None

    def base(self, sha256: str | None) -> str | None:
        """Return the text with this hash that was generated once; None if it is not stored."""
        return self._store.base(self.name, sha256) if sha256 else None

    @cached_property
    def put_aside(self) -> PutAside:
        """Texts of the user's that the build wrote over, and the names that it changed."""
        return self._store.put_aside(self.name)


def option_values(options: msgspec.Struct) -> dict[str, Any]:
    """Return a domain's options as they are recorded: plain data, without None and empty tables."""
    values = msgspec.json.decode(msgspec.json.encode(options))
    return {name: value for name, value in values.items() if value not in (None, {})}
