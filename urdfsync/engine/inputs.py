"""What a build of one robot starts from: configuration, source, templates, the record, and the files on disk."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies import file_type
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError, UrdfsyncError
from urdfsync.domain import Dependency, Domain, Lookup, Snapshot, Target, Templates, Version
from urdfsync.engine import imports, parents, source
from urdfsync.engine.actions import Action
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import PackageFiles
from urdfsync.engine.parents import Parents
from urdfsync.engine.source import Source
from urdfsync.engine.users_files import UsersFiles, find_users_files
from urdfsync.files import shown
from urdfsync.state import replaced
from urdfsync.state.record import RESOURCES, FileRecord, Generator, Record
from urdfsync.state.replaced import Replaced
from urdfsync.state.store import REPLACED, Store

NO_MODEL = (KeyError, TypeError, AttributeError, ValueError)
"""Errors that a domain raises for a recorded snapshot that is none of its own."""


class Inputs(msgspec.Struct, frozen=True, dict=True):
    """Everything that is known of a robot before its source is parsed."""

    config: Config
    robot: RobotConfig
    options: BuildOptions
    domain: Domain
    files: PackageFiles
    parents: Parents
    store: Store
    record: Record | None
    """The last complete build, and what is open since; None if there is no record, or it is lost."""
    former_name: str | None
    """Name of the robot in the last build, if it has another one now."""
    written: Mapping[str, FileRecord | None]
    """What builds that are not complete have written since, by key; None for a file that they deleted."""
    templates: Templates
    source: Source
    generator: Generator

    @cached_property
    def folder(self) -> str:
        """Key of the package's folder."""
        return self.files.key(self.robot.folder)

    @cached_property
    def old_folder(self) -> str:
        """Key of the package's folder in the last build."""
        return self.record.folder if self.record else self.folder

    @property
    def has_moved(self) -> bool:
        """Whether the package has another folder than in the last build."""
        return self.folder != self.old_folder

    @cached_property
    def old_target(self) -> Target:
        """Package and class of the last build."""
        return Target(self.record.package, self.record.class_) if self.record else self.robot.target

    @cached_property
    def recorded_files(self) -> Mapping[str, FileRecord]:
        """The recorded files by key, with what was written since; those that a build may not touch are left out."""
        found = {**(self.record.files if self.record else {}), **self.written}
        return {key: one for key, one in found.items() if one is not None and self.files.is_inside(key)}

    def key(self, path: str) -> str:
        """Return the key of a file by its path below the package."""
        return f"{self.folder}/{path}"

    def old_key(self, path: str) -> str:
        """Return the key that a file had in the last build, by its path below the package."""
        return f"{self.old_folder}/{path}"

    def path(self, key: str) -> str:
        """Return the path of a file below the package, by its key."""
        return key.removeprefix(f"{self.folder}/")

    def old_path(self, key: str) -> str:
        """Return the path of a file of the last build below the package as it was, by its key."""
        return key.removeprefix(f"{self.old_folder}/")

    def users_classes(
        self, edited: Iterable[Action], actions: Iterable[Action], written: Mapping[str, str]
    ) -> dict[str, str]:
        """Return the texts of edited files, and of the user's own ones in the package, by key.

        `actions` are those on all files of urdfsync's; `written` are texts that files are about to get.
        """
        own = self.files.classes(self.folder) - {action.path for action in actions if not action.handed_to_user}
        keys = {action.path for action in edited} | own
        return {key: written.get(key) or self.files.any_text(key) for key in sorted(keys)}

    @cached_property
    def users_files(self) -> UsersFiles:
        """The user's models outside of the package, by whether they mention it, as it is or as it was."""
        former = self.files.path(self.old_folder) if self.has_moved else None
        names = {folder.name for folder in (self.robot.folder, former) if folder}
        return find_users_files(self.config, self.robot, names, former)

    @property
    def last_name(self) -> str:
        """The robot's name in the last build."""
        return self.former_name or self.robot.name

    def base(self, sha256: str) -> str | None:
        """Return the text with this hash that was generated last; None if it is lost."""
        return self.store.base(self.last_name, sha256)

    @cached_property
    def replaced(self) -> Mapping[str, Replaced]:
        """What stood in files that the last build wrote over, by path below the package."""
        return replaced.read(self.store.contents(REPLACED, self.last_name))

    @property
    def has_same_generator(self) -> bool:
        """Whether what turned the model into files is what it was in the last complete build."""
        record = self.record
        return bool(
            record
            and record.generator == self.generator
            and self.old_target == self.robot.target
            and record.options == option_values(self.robot.options)
        )

    @cached_property
    def last(self) -> Version | None:
        """The model of the last complete build; None if there was none, or it is lost, or united and not whole."""
        record = self.record
        if record is None or record.snapshot is None or (record.is_united and self.last_package is None):
            return None
        return self.version(record, record.snapshot)

    @cached_property
    def last_package(self) -> Package | None:
        """The package of the last complete build, from today's templates; None if it is not known."""
        return self.recorded_package(self.record.snapshot) if self.record and self.record.snapshot is not None else None

    def recorded_package(self, snapshot: Snapshot) -> Package | None:
        """Return the package of a recorded model; None if there can't be one, as of a model that is not whole."""
        record = self.record
        if record is None or record.generator.domain != self.robot.domain:
            return None
        options = self.recorded_options or self.robot.options
        try:
            imported = self.version(record, snapshot).imports or {}
            return generate(self.domain, snapshot, imported, self.old_target, options, self.templates)
        except (*NO_MODEL, OutputError):
            return None

    def version(self, record: Record, snapshot: Snapshot) -> Version:
        """Return a recorded model with its imports."""
        imported = {
            key: found
            for key, known in record.imports.items()
            if (found := known[0] if len(known) == 1 else self.recorded_imports.find(key)[0])
        }
        return Version(snapshot, imported, self.recorded_options)

    @cached_property
    def recorded_options(self) -> Any:
        """The options of the last complete build; None if they are not as this program has them."""
        if self.record is None or self.record.generator.domain != self.robot.domain:
            return None
        try:
            return msgspec.convert(self.record.options, self.domain.options)
        except msgspec.ValidationError:
            return None

    def dependencies(self, snapshot: Snapshot, lines: Mapping[str, int]) -> Sequence[Dependency]:
        """Return the files that a model refers to."""
        lookup = Lookup(self.robot.source, self.robot.package_paths + self.options.package_paths)
        return imports.find_dependencies(self.domain, snapshot, lookup, self.robot.options, lines)

    @cached_property
    def recorded_imports(self) -> imports.Recorded:
        """The imports of the last build, and how their copies in the package are read."""
        bases = {self.old_path(key): one.hashes for key, one in self.recorded_files.items()}
        found = dict(self.record.imports) if self.record else {}
        for key, one in self.record.open.imports.items() if self.record and self.record.open else ():
            found[key] = (*found.get(key, ()), one)
        files, folder = self.files, self.old_folder  # not `self`, which would hold itself then
        return imports.Recorded(
            found,
            copy=lambda target: files.read(f"{folder}/{target}"),
            bases={path: hashes for path, hashes in bases.items() if path.startswith(RESOURCES)},
            moved=self.has_moved,
        )

    def changed_options(self) -> tuple[str, ...]:
        """Return the options that are others than in the last build; none if more than options changed, or nothing."""
        before, record = self.recorded_options, self.record
        if before is None or record is None or record.generator != self.generator:
            return ()
        if self.old_target != self.robot.target:
            return ()
        names = self.robot.options.__struct_fields__
        return tuple(name for name in names if getattr(before, name) != getattr(self.robot.options, name))


def inspect(config: Config, robot: RobotConfig, options: BuildOptions) -> Inputs:
    """Read all that a build of a robot starts from. Raises UrdfsyncError for whatever is wrong with it."""
    domain = registry.domain(robot.domain)
    files = PackageFiles(config, robot)
    around = Parents(listed=False) if options.removes else parents.check(config, robot, domain.uses(robot.options))
    store, folder = Store(config.root), files.key(robot.folder)
    record, former = store.load(robot.name, strict=not options.full), None
    if record is None:  # was it built into this folder by another name, which is no longer configured?
        former = next((name for name, its_folder in orphaned_robots(store, config) if its_folder == folder), None)
        record = store.load(former) if former else None
    if options.adopts and record and (record.snapshot is not None or record.is_united):
        message, hint = f"robot `{robot.name}` was built already", "`urdfsync resolve` settles its conflicts"
        place = shown(config.file), robot.lines[""]
        raise OutputError(Diagnostic(Severity.ERROR, "already-built", message, *place, hint=hint))
    templates = source.templates(config, robot, domain)
    text = Source(b"", "") if options.removes else source.read_source(config, robot, store, options, former)
    generator = Generator(robot.domain, domain.revision, templates.digest)
    if record and record.generator.domain == robot.domain and record.generator.revision > domain.revision:
        message = f"a newer urdfsync built robot `{robot.name}`; this older one can't build it"
        file = shown(store.path(robot.name))
        raise StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, hint="update urdfsync"))
    written = _find_written(store, files, {folder, record.folder if record else folder})
    return Inputs(
        *(config, robot, options, domain, files, around, store, record, former, written, templates, text, generator)
    )


def _find_written(store: Store, files: PackageFiles, folders: Collection[str]) -> dict[str, FileRecord | None]:
    """Return the files below `folders` that builds which are not complete have written or deleted, as was planned."""
    found: dict[str, FileRecord | None] = {}
    inside = tuple(f"{folder}/" for folder in folders)
    for one in store.planned_files():
        if (one.new is None or one.record) and one.path.startswith(inside) and files.is_inside(one.path):
            state = files.state(one.path)
            if (state.sha256 if state else None) == one.new:
                found[one.path] = one.record
    return found


def option_values(options: msgspec.Struct) -> dict[str, Any]:
    """Return a domain's options as they are recorded: plain data, without those that are None."""
    values = msgspec.json.decode(msgspec.json.encode(options))
    return {name: value for name, value in values.items() if value is not None}


def orphaned_robots(store: Store, config: Config) -> Iterator[tuple[str, str | None]]:
    """Yield robots with a record that are not configured, and the key of their folder; None if it can't be read."""
    # not by its listed name: a file system that folds case has one record for `arm` and `Arm`
    known = {robot.name.casefold() for robot in config.robots if file_type(store.path(robot.name), follow=False)}
    for name in store.names():
        if name.casefold() not in known:
            try:
                record = store.load(name)
            except UrdfsyncError:
                record = None
            yield name, record.folder if record else None
