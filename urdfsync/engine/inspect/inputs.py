"""Inputs of a build of one robot: configuration, source, templates, the last build, and the files on disk."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Collection, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.common.dependencies.places import real
from urdfsync.common.dependencies.reads import is_file, read_file
from urdfsync.common.diagnostics import ConfigError, Diagnostic, OutputError, Severity, UrdfsyncError
from urdfsync.common.files import Templates, digest, shown
from urdfsync.common.version import __version__
from urdfsync.domain import Domain, registry
from urdfsync.domain.matching import Doubt
from urdfsync.engine.actions import Action
from urdfsync.engine.inspect import parents
from urdfsync.engine.inspect.commits import PastCommit, read_commits
from urdfsync.engine.inspect.last_build import LastBuild, hash_of, option_values
from urdfsync.engine.inspect.package_files import Folder, PackageFiles, key_of
from urdfsync.engine.inspect.parents import Parents
from urdfsync.engine.inspect.users_files import UsersFiles, read_saved_facts, read_users_files
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.sources import source
from urdfsync.engine.sources.source import Source
from urdfsync.modelica.files import text_of
from urdfsync.project.config import Config, RobotConfig, find_own_library
from urdfsync.project.git.unmerged import find_unmerged
from urdfsync.project.state.notes import Use
from urdfsync.project.state.record import Generator, Record, unite
from urdfsync.project.state.store import Store

if TYPE_CHECKING:
    from urdfsync.merge import Merge


class Replaced(NamedTuple):
    """A replaced text with its stamp, and the text of its base by hash, if it is known."""

    text: bytes
    base: Mapping[str, str]
    doubt: Doubt | None = None
    """The question that the choice about it answers."""


class Settled(msgspec.Struct):
    """The files that the user's choices have changed, by their present keys."""

    actions: dict[str, Action] = msgspec.field(default_factory=dict)
    contents: dict[str, bytes | None] = msgspec.field(default_factory=dict)
    """New contents with their stamps; None for no file."""
    texts: dict[str, str] = msgspec.field(default_factory=dict)
    """Texts of the bases of `contents`, by hash."""
    bases: dict[str, str | None] = msgspec.field(default_factory=dict)
    """Bases of imported files, which have no stamps."""
    before: dict[str, Replaced] = msgspec.field(default_factory=dict)
    """Texts before the choices."""
    names: Mapping[str, str] = {}
    """New names by old names, before the choices."""
    keys: set[str] = msgspec.field(default_factory=set)
    """Keys of the choices that were applied."""
    doubts: dict[str, Doubt] = msgspec.field(default_factory=dict)
    """The questions that are open after the choices, by key: a choice was undone, or settled git's markers only."""


class Inputs(msgspec.Struct, frozen=True, dict=True):
    """All inputs of a build. Files of the package and of the user, bases and commits are read when asked for."""

    config: Config
    robot: RobotConfig
    options: BuildOptions
    domain: Domain
    templates: Templates
    generator: Generator
    source: Source
    store: Store
    last: LastBuild
    files: PackageFiles
    folder: Folder
    parents: Parents
    program: str
    """Hash of the program and the templates; this machine's notes are valid only for this hash."""
    damage: Diagnostic | None = None
    """A warning if lines of the recorded state can't be read."""
    settled: Settled = msgspec.field(default_factory=Settled)
    """The user's choices, if `files` and `last` already include the choices."""
    apart: frozenset[str] = frozenset()
    """The keys of unmerged files whose versions are paired by the parts that their stamps name."""

    def laid_over(self, contents: Mapping[str, bytes | None], left_by_git: Mapping[str, Merge | None]) -> Inputs:
        """Return the inputs with other contents of files (see `PackageFiles`)."""
        files = self.files.laid_over(contents, left_by_git)
        return msgspec.structs.replace(self, files=files, last=msgspec.structs.replace(self.last, _files=files))

    @property
    def former_name(self) -> str | None:
        """The robot's name in the last build, if it differs."""
        return self.last.name if self.last.name != self.robot.name else None

    @property
    def is_merging(self) -> bool:
        """Whether the user allows merges: by the configuration, or for this command."""
        return self.options.merges or self.robot.on_conflict == "merge"

    @property
    def has_moved(self) -> bool:
        """Whether the package has another folder than in the last build."""
        return self.folder != self.last.folder

    @cached_property
    def unmerged_paths(self) -> set[str]:
        """The real paths that git could not merge, in the repositories of the configuration and of the source."""
        return find_unmerged((self.config.root, Path(real(self.robot.source)).parent))

    @cached_property
    def unmerged(self) -> frozenset[str]:
        """The keys of the package's files that git could not merge."""
        below = os.path.join(os.path.realpath(self.robot.folder), "")  # noqa: PTH118 - git's paths are strings
        inside = (path.removeprefix(below) for path in self.unmerged_paths if path.startswith(below))
        return frozenset(self.folder.key(path.replace(os.sep, "/")) for path in inside)

    @cached_property
    def commits(self) -> tuple[PastCommit, ...]:
        """The commits that an edit of unknown origin may come from; none in a clone, which has other branches."""
        return (*read_commits(self.config.root, self.files),) if self.last.notes.written else ()

    @cached_property
    def users_files(self) -> UsersFiles:
        """The user's models outside of the package, and which of them mention the package's present or former names."""
        former = self.files.path(self.last.folder) if self.has_moved else None
        names = {folder.name for folder in (self.robot.folder, former) if folder}
        names |= {old for old, new in self.last.record.former.items() if new in names}
        return read_users_files(self.config, self.robot, names, former)

    def read_unsaved_uses(self) -> dict[str, Use]:
        """Return names that mean other parts now, by file, if neither the file nor the record was replaced since."""
        uses = self.last.notes.uses
        if uses and self.last.notes.model != hash_of(self.last.record.snapshot):
            return {}
        return {path: use for path, use in uses.items() if use.facts == read_saved_facts(Path(path))}

    def look_for_class(self, name: str) -> Path | None:
        """Return the folder or file of a top-level class outside of the package; None if there is none."""
        if own := find_own_library(name, self.robot.target.package):
            return own
        for path in (self.robot.output / name, self.robot.output / f"{name}.mo"):
            if is_file(path / "package.mo" if path.suffix != ".mo" else path):
                return path
        return self.users_files.tops.get(name)

    def users_text(self, path: Path) -> str:
        """Return the text of the configuration, or of a user's file; empty for an unreadable file."""
        if path in self.users_files.all:
            return text_of(self.users_files.all[path])
        try:
            return text_of(read_file(path))  # the configuration may be a link, and `users` may have named the file once
        except OSError:
            return ""


def inspect(config: Config, robot: RobotConfig, options: BuildOptions) -> Inputs:
    """Read all inputs of a robot's build. Raises UrdfsyncError for faulty inputs."""
    domain, store = registry.domain(robot.domain), Store(config.root)
    files = PackageFiles(config, robot)
    folder = Folder(files.key(robot.folder))
    above = Parents(listed=False) if options.removes else parents.check(config, robot, domain.uses(robot.options))
    (records, damage), name = store.load(robot.name), robot.name
    others = {files.key(other.folder): other.name for other in config.robots if other.name != robot.name}
    # another robot may have built in a folder: its files must not be deleted
    records = tuple(one for one in records if one.folder not in _folders(store, others.get(one.folder, "")))
    if folder not in {record.folder for record in records} and os.path.lexists(robot.folder):
        _refuse_taken(config, robot, store, folder)
    if not records:  # the folder may have the package of a robot that is no longer configured
        name = next((name for name, places in read_orphaned_robots(store, config) if folder in places), name)
        records = store.load(name)[0] if name != robot.name else ()
    damage, notes = damage or store.find_damaged_base(name), store.notes(name)
    if options.adopts and any(record.snapshot is not None for record in records):
        message, hint = f"robot `{robot.name}` was built already", "`urdfsync resolve` settles its conflicts"
        place = shown(config.file), robot.lines[""]
        raise OutputError.of("already-built", message, *place, hint=hint)
    templates = source.templates(config, robot, domain)
    text = Source(b"", "") if options.removes else source.read_source(config, robot, store, options, name)
    generator = Generator(robot.domain, __version__, templates.digest)
    nothing = Record(
        package=robot.target.package,
        class_=robot.target.name,
        folder=str(folder),
        generator=generator,
        options=option_values(robot.options),
    )
    program = digest(f"{registry.program(robot.domain)} {templates.digest}".encode())
    if notes.program != program:  # another program wrote these texts and imports
        notes = msgspec.structs.replace(notes, texts={}, imports=frozenset())
    record = unite(records or [nothing])
    last = LastBuild(name, record, records, notes, store, files, domain, robot, templates)
    read = domain, templates, generator, text, store, last, files, folder, above
    return Inputs(config, robot, options, *read, program, damage)


def _folders(store: Store, name: str) -> set[str]:
    """Return the keys of the folders in which a robot was built last; none without a readable record."""
    with contextlib.suppress(UrdfsyncError):
        return {record.folder for record in store.load(name)[0]} if name else set()
    return set()


def _refuse_taken(config: Config, robot: RobotConfig, store: Store, folder: Folder) -> None:
    """Refuse a folder in which another robot was built last: its edits are there. Raises ConfigError.

    Raises StateError or OutputError if another robot's record is unreadable: the folder may be its last one.
    """
    for other in config.robots:
        if other.name != robot.name and folder in {record.folder for record in store.load(other.name)[0]}:
            message = f"robot `{robot.name}`: its package is so far that of robot `{other.name}`, with its edits"
            hint = f"build `{other.name}` first; to exchange two packages, build one of them with a third name first"
            raise ConfigError.of("package-taken", message, shown(config.file), robot.lines["package"], hint=hint)


def read_orphaned_robots(store: Store, config: Config) -> Iterator[tuple[str, Collection[str]]]:
    """Yield robots with a record but no configuration, and the keys of their folders; none for an unreadable record."""
    # a robot counts if its record file exists: if the disk ignores case, `arm` and `Arm` share one
    names = store.names()
    configured = {robot.name.casefold() for robot in config.robots if os.path.lexists(store.path(robot.name))}
    for name in names:
        if name.casefold() not in configured:
            try:
                records, _ = store.load(name)
            except UrdfsyncError:
                records = ()
            yield name, {record.folder for record in records}


def read_stray_states(config: Config) -> list[Diagnostic]:
    """Return a note if robots with recorded state are missing in the configuration."""
    store = Store(config.root)
    built = set(store.names())
    heirs = {key_of(robot.folder, config.root) for robot in config.robots if robot.name not in built}
    stray = [name for name, folders in read_orphaned_robots(store, config) if heirs.isdisjoint(folders)]
    if not stray:
        return []
    listed = ", ".join(f"`{name}`" for name in stray)
    message = f"the recorded state of {listed} exists, but the configuration has no such robot"
    folder = shown(store.folder / "robots")
    hint = f"add the robot again, or delete {folder}/{stray[0]}.* and its package"
    return [Diagnostic(Severity.NOTE, "stray-state", message, shown(config.file), hint=hint)]
