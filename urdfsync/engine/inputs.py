"""What a build of one robot starts from: configuration, source, templates, recorded state, and the files on disk."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import msgspec

from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, StateError, UrdfsyncError
from urdfsync.domain import Dependency, Domain, Import, Lookup, Role, Snapshot, Target, Templates, Version
from urdfsync.engine import imports, parents, source
from urdfsync.engine.actions import Action
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import PackageFiles
from urdfsync.engine.parents import Parents
from urdfsync.files import digest, shown, text_digest
from urdfsync.state import manifest, repair
from urdfsync.state.bases import BaseStore
from urdfsync.state.manifest import Generator, Manifest
from urdfsync.state.modelfile import Model
from urdfsync.state.record import FileRecord
from urdfsync.state.store import State, Store

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
    state: State | None
    """What the last build recorded; None if there was none, or it is lost."""
    former_name: str | None
    """Name of the robot in the last build, if it has another one now."""
    recovered: repair.RecoveredState | None
    """What `--repair` could read of a broken state."""
    templates: Templates
    content: bytes
    """Bytes of the source."""
    generator: Generator

    @cached_property
    def recorded(self) -> Manifest | None:
        """The manifest of the last build; None if there was none."""
        return self.state.manifest if self.state else None

    @cached_property
    def model(self) -> Model | None:
        """What the last build recorded of its model; None if there was none, or it is lost."""
        return self.state.model if self.state else None

    @cached_property
    def folder(self) -> str:
        """Key of the package's folder."""
        return self.files.key(self.robot.folder)

    @cached_property
    def old_folder(self) -> str:
        """Key of the package's folder in the last build."""
        return self.recorded.folder if self.recorded else self.folder

    @cached_property
    def own_folders(self) -> tuple[str, ...]:
        """Keys of the folders in which a build may delete and move files: the package's, now and in the last build.

        A former folder counts only if a build in this checkout wrote it: a manifest may be a stranger's.
        """
        manifests = self.recovered.manifests if self.recovered else filter(None, [self.recorded])
        former = {manifest.folder for manifest in manifests} - {self.folder}
        if former:
            former &= self.store.written_folders(self.former_name or self.robot.name)
        return self.folder, *sorted(former)

    def own(self, recorded: Manifest) -> tuple[dict[str, FileRecord], dict[str, tuple[str, ...]]]:
        """Return the recorded files that a build may delete and move, and the lines that it may take out of orders."""
        inside, is_inside = tuple(f"{folder}/" for folder in self.own_folders), self.files.is_inside
        around = "" if recorded.folder in self.own_folders else inside  # the parent's `package.order`, too
        files = {key: one for key, one in recorded.files.items() if key.startswith(inside) and is_inside(key)}
        orders = {key: names for key, names in recorded.orders.items() if key.startswith(around) and is_inside(key)}
        return files, orders

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
        own = self.files.classes(self.folder) - {action.path for action in actions}
        keys = {action.path for action in edited} | own
        return {key: written.get(key) or self.files.any_text(key) for key in sorted(keys)}

    @cached_property
    def bases(self) -> BaseStore:
        """The texts that urdfsync wrote last, as far as they are stored."""
        return self.store.bases(self.former_name or self.robot.name)

    @cached_property
    def source_hash(self) -> str:
        """Text hash of the source."""
        return text_digest(self.content)

    @cached_property
    def last(self) -> Version | None:
        """The model of the last build; None if there was none, or it is lost."""
        if self.state is None or self.model is None or not self.state.intact:
            return None
        return self.version(self.model)

    @cached_property
    def last_complete(self) -> Version | None:
        """The model of the last build after which nothing waited; without imports if that is not the last build."""
        if self.last is None or self.model is None or self.model.since is None:
            return self.last
        return Version(self.model.since, None, self.last.generator, self.last.options)

    @property
    def complete_revision(self) -> int | None:
        """The domain's revision in the last build after which nothing waited; None if there was none."""
        since = self.model.since_revision if self.model else msgspec.UNSET
        if since is not msgspec.UNSET:
            return since
        return self.recorded.generator.revision if self.recorded else None

    def version(self, model: Model) -> Version:
        """Return a recorded model with the imports that the manifest has of it."""
        dependencies = self.recorded.dependencies if self.recorded else {}
        imported = {
            key: Import(record.target, facts.source_hash, record.target_hash or "", facts.converter, facts.facts)
            for key, facts in model.imports.items()
            if (record := dependencies.get(key)) is not None
        }
        generator = self.recorded.generator.fingerprint if self.recorded else ""
        return Version(model.snapshot, imported, generator, self._recorded_options)

    @property
    def _recorded_options(self) -> Any:
        """The options of the last build; None if they are not recorded, or not as this program has them."""
        recorded = self.recorded
        if recorded is None or recorded.options is None or recorded.generator.domain != self.robot.domain:
            return None
        try:
            return msgspec.convert(recorded.options, self.domain.options)
        except msgspec.ValidationError:
            return None

    def heading(self, model_hash: str) -> Manifest:
        """Return the manifest of this build without its lists; `model_hash` is the text hash of the recorded model."""
        target = self.robot.target
        return Manifest(
            package=target.package,
            class_=target.name,
            folder=self.folder,
            source=manifest.Source(self.robot.source_text, self.source_hash, model_hash),
            generator=self.generator,
            options=manifest.option_values(self.robot.options),
        )

    def dependencies(self, snapshot: Snapshot, lines: Mapping[str, int]) -> Sequence[Dependency]:
        """Return the files that a model refers to."""
        lookup = Lookup(self.robot.source, self.robot.package_paths + self.options.package_paths)
        return imports.find_dependencies(self.domain, snapshot, lookup, self.robot.options, lines)

    def recorded_imports(self) -> imports.Recorded:
        """Return the imports of the last build, and how their copies in the package are read."""
        recorded = self.recorded or self.heading("")
        imported = (key for key, record in recorded.files.items() if record.role is Role.IMPORT)
        return imports.Recorded(
            records=recorded.dependencies,
            facts=self.model.imports if self.model else {},
            copy=lambda target: self.files.read(self.old_key(target)),
            bases={self.old_path(key): recorded.files[key].base for key in imported},
            moved=self.old_folder != self.folder,
        )

    def changed_options(self) -> tuple[str, ...]:
        """Return the options that are others than in the last build; none if more than options changed, or nothing."""
        before, recorded = self._recorded_options, self.recorded
        if before is None or recorded is None or recorded.generator.revision != self.domain.revision:
            return ()
        robot, revision = self.robot, self.domain.revision
        if _fingerprint(robot.target, before, revision, self.templates.digest) != recorded.generator.fingerprint:
            return ()
        names = robot.options.__struct_fields__
        return tuple(name for name in names if getattr(before, name) != getattr(robot.options, name))


def inspect(config: Config, robot: RobotConfig, options: BuildOptions) -> Inputs:
    """Read all that a build of a robot starts from. Raises UrdfsyncError for whatever is wrong with it."""
    domain = registry.domain(robot.domain)
    files = PackageFiles(config, robot)
    around = parents.check(config, robot, domain.uses(robot.options))
    store, folder = Store(config.root), files.key(robot.folder)
    state, recovered = _load(store, files, robot.name, options)
    former = None
    if state is None:  # was it built into this folder by another name, which is no longer configured?
        former = next((name for name, its_folder in orphaned_robots(store, config) if its_folder == folder), None)
        state = store.load(former) if former else None
    templates = source.templates(config, robot, domain)
    content = source.read_source(config, robot)
    fingerprint = _fingerprint(robot.target, robot.options, domain.revision, templates.digest)
    generator = Generator(robot.domain, domain.revision, fingerprint)
    recorded = state.manifest.generator if state else generator
    if recorded.domain == robot.domain and recorded.revision > domain.revision:
        message = f"a newer urdfsync built robot `{robot.name}`; this one would undo its improvements"
        file = shown(store.folder / "robots" / f"{robot.name}.toml")
        raise StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, hint="update urdfsync"))
    return Inputs(
        config, robot, options, domain, files, around, store, state, former, recovered, templates, content, generator
    )


def _load(
    store: Store, files: PackageFiles, robot: str, options: BuildOptions
) -> tuple[State | None, repair.RecoveredState | None]:
    """Load the recorded state; with `--repair`, what is left of a broken one."""
    try:
        return store.load(robot), None
    except StateError:
        if not options.repair:
            raise
    manifest_file, model_file = map(shown, store.paths(robot))
    recovered = repair.recover(*store.texts(robot), manifest_file, model_file)
    mine = {key: files.hash(key, role) for key, role in recovered.roles.items()}
    recorded = repair.rebuilt(recovered, mine, {})
    if recorded is None:
        return None, recovered
    return State(recorded, recovered.model(recorded), intact=False), recovered


def _fingerprint(target: Target, options: Any, revision: int, templates: str) -> str:
    """Hash all that shapes the output beside the model; `templates` is the hash of the templates."""
    facts = {
        "class": target.name,
        "options": msgspec.to_builtins(options),
        "package": target.package,
        "revision": revision,
        "templates": templates,
    }
    return digest(json.dumps(facts, sort_keys=True).encode())


def orphaned_robots(store: Store, config: Config) -> Iterator[tuple[str, str | None]]:
    """Yield robots that have a state and are not configured, with the key of their folder; None if it can't be read."""
    known = {robot.name.casefold() for robot in config.robots}
    for name in store.names():
        if name.casefold() not in known:
            try:
                state = store.load(name)
            except UrdfsyncError:
                state = None
            yield name, state.manifest.folder if state else None
