"""Inputs of a build of one robot: configuration, source, templates, the last build, and the files on disk."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies import file_type
from urdfsync.diagnostics import OutputError, StateError, UrdfsyncError
from urdfsync.domain import Domain, Templates
from urdfsync.engine import parents, source
from urdfsync.engine.last_build import LastBuild, option_values
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import Folder, PackageFiles
from urdfsync.engine.parents import Parents
from urdfsync.engine.source import Source
from urdfsync.engine.users_files import UsersFiles, find_users_files
from urdfsync.files import shown
from urdfsync.state.record import Generator, Record
from urdfsync.state.store import Store


class Inputs(msgspec.Struct, frozen=True, dict=True):
    """Everything that a build reads before it parses the source."""

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
    """Of the package now."""
    parents: Parents

    @property
    def former_name(self) -> str | None:
        """Name of the robot in the last build, if it has another one now."""
        return self.last.name if self.last.name != self.robot.name else None

    @property
    def has_moved(self) -> bool:
        """Whether the package has another folder than in the last build."""
        return self.folder != self.last.folder

    @cached_property
    def users_files(self) -> UsersFiles:
        """The user's models outside of the package, by whether they mention it, as it is or as it was."""
        former = self.files.path(self.last.folder) if self.has_moved else None
        names = {folder.name for folder in (self.robot.folder, former) if folder}
        return find_users_files(self.config, self.robot, names, former)


def inspect(config: Config, robot: RobotConfig, options: BuildOptions) -> Inputs:
    """Read all that a build of a robot starts from. Raises UrdfsyncError for whatever is wrong with it."""
    domain, store = registry.domain(robot.domain), Store(config.root)
    files = PackageFiles(config, robot)
    folder = Folder(files.key(robot.folder))
    above = Parents(listed=False) if options.removes else parents.check(config, robot, domain.uses(robot.options))
    record, name = store.load(robot.name, strict=not options.full), robot.name
    if record is None:  # was it built into this folder by another name, which is no longer configured?
        name = next((name for name, place in orphaned_robots(store, config) if place == folder), name)
        record = store.load(name) if name != robot.name else None
    if options.adopts and record and (record.snapshot is not None or record.is_united):
        message, hint = f"robot `{robot.name}` was built already", "`urdfsync resolve` settles its conflicts"
        place = shown(config.file), robot.lines[""]
        raise OutputError.of("already-built", message, *place, hint=hint)
    templates = source.templates(config, robot, domain)
    text = Source(b"", "") if options.removes else source.read_source(config, robot, store, options, name)
    generator = Generator(robot.domain, domain.revision, templates.digest)
    if record and record.generator.domain == robot.domain and record.generator.revision > domain.revision:
        message = f"a newer urdfsync built robot `{robot.name}`; this older one can't build it"
        file = shown(store.path(robot.name))
        raise StateError.of("newer-state", message, file, hint="update urdfsync")
    record = record or Record(
        package=robot.target.package,
        class_=robot.target.name,
        folder=str(folder),
        generator=generator,
        options=option_values(robot.options),
    )
    last = LastBuild(name, record, store, files, domain, robot, templates)
    return Inputs(config, robot, options, domain, templates, generator, text, store, last, files, folder, above)


def orphaned_robots(store: Store, config: Config) -> Iterator[tuple[str, str | None]]:
    """Yield robots with a record that are not configured, and the key of their folder; None if it can't be read."""
    # not by its listed name: a file system that folds case has one record for `arm` and `Arm`
    configured = {robot.name.casefold() for robot in config.robots if file_type(store.path(robot.name), follow=False)}
    for name in store.names():
        if name.casefold() not in configured:
            try:
                record = store.load(name)
            except UrdfsyncError:
                record = None
            yield name, record.folder if record else None
