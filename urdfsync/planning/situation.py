"""What one robot's plan rests on: configuration, source, templates, recorded state, and what is on disk."""

from __future__ import annotations

import contextlib
import functools
import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync import manifest, registry
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError
from urdfsync.domain import Dependency, Import, Lookup, Role, Snapshot, Version
from urdfsync.files import digest, text_digest
from urdfsync.manifest import Generator, Manifest
from urdfsync.modelfile import Model
from urdfsync.planning import imports, inputs, leftovers, parents
from urdfsync.planning.disk import Disk
from urdfsync.state.store import State, Store

if TYPE_CHECKING:
    from urdfsync.planning.memory import Memory
    from urdfsync.standoff import Choice
    from urdfsync.state.repair import Recovered

NO_MODEL = (KeyError, TypeError, AttributeError, ValueError)
"""What a domain raises for a recorded snapshot that is none of its own."""

Progress = Callable[[str, int, int], None]
"""Told of a step of the work: what it is, how much of it is done, and of how much."""


def in_silence(what: str, done: int, total: int) -> None:
    """Tell nobody of the work."""


class Request(msgspec.Struct, frozen=True):
    """How to build."""

    full: bool = False
    """Look at everything again, even if nothing changed."""
    dry: bool = False
    """Write nothing."""
    draw: bool = False
    """Also draw the main model's diagram into the state folder."""
    package_paths: tuple[Path, ...] = ()
    """Where to look for packages after the configured folders."""
    wait: float = 60.0
    """Seconds to wait for another build to finish."""
    repair: bool = False
    """Make a recorded state that can't be read again, from what can be told of it and from the files."""
    choices: Mapping[str, Choice] = msgspec.field(default_factory=dict)
    """What the user wants of files that conflict, by their path in the manifest."""
    jobs: int | None = None
    """How many processes may work at once; None for one per core."""
    progress: Progress = in_silence
    memory: Memory | None = None
    """For a process that builds again and again."""


class Situation:
    """Everything that is known of a robot before anything is read or rendered.

    Raises UrdfsyncError for whatever is wrong with it.
    """

    def __init__(self, config: Config, robot: RobotConfig, request: Request) -> None:
        self.config, self.robot, self.request = config, robot, request
        self.domain = registry.domain(robot.domain)
        self.disk = Disk(config, robot, request.memory.seen(robot.name) if request.memory and not request.full else {})
        if request.memory:
            request.memory.invalidate(robot.name)
            for path in parents.files(robot):
                with contextlib.suppress(OutputError):  # it may be a link
                    self.disk.look(path)
        self.parents = parents.check(config, robot, self.domain.uses(robot.options))
        self.store = Store(config.root, shown, request.memory)
        self.folder = self.disk.key(robot.folder)
        self.recovered: Recovered | None = None
        """What could be saved of a state that can't be read, if that was asked for."""
        self.state: State | None = self._load(robot.name)
        self.former: str | None = None if self.state else leftovers.former(self.store, config, self.folder)
        """The name that the robot had in the last build, if it has another one now."""
        if self.former:
            self.state = self.store.load(self.former)
        self.templates = inputs.templates(config, robot, self.domain, request.memory)
        self.content = inputs.read_source(config, robot)
        self.generator = Generator(robot.domain, self.domain.revision, self._fingerprint())
        self._check_revision()

    def _load(self, name: str) -> State | None:
        try:
            return self.store.load(name)
        except StateError:
            if not self.request.repair:
                raise
        from urdfsync.state.repair import recover

        file, beside = map(shown, self.store.paths(name))
        self.recovered = recover(*self.store.texts(name), file, beside)
        manifest = self.rebuilt({})
        model = self.recovered.model(manifest) if manifest else None
        return State(manifest, model, intact=False) if manifest else None

    def rebuilt(self, generated: Mapping[str, str]) -> Manifest | None:
        """The manifest of the last build, made again if that was asked for; `generated` are hashes by path."""
        if self.recovered is None:
            return self.recorded
        from urdfsync.state.repair import rebuilt

        roles = {**dict.fromkeys(generated, Role.MODEL), **self.recovered.roles}
        mine = {path: self.disk.found(path, role).hash for path, role in roles.items()}
        return rebuilt(self.recovered, mine, generated)

    @property
    def recorded(self) -> Manifest | None:
        """What the last build recorded; None if there was none."""
        return self.state.manifest if self.state else None

    @functools.cached_property
    def last(self) -> Version | None:
        """The model of the last build; None if there was none, or if it is lost."""
        if self.state is None or self.state.model is None or not self.state.intact:
            return None
        return self.version(self.state.model)

    @functools.cached_property
    def settled(self) -> Version | None:
        """The model of the last build after which nothing waited, without imports if that is not the last one."""
        model = self.state.model if self.state else None
        if self.last is None or model is None or model.since is None:
            return self.last
        return Version(model.since, None, self.last.generator)

    @property
    def written_by(self) -> int | None:
        """The domain's revision in the last build after which nothing waited; None if there was none."""
        since = self.state.model.since_revision if self.state and self.state.model else msgspec.UNSET
        if since is not msgspec.UNSET:
            return since
        return self.recorded.generator.revision if self.recorded else None

    def version(self, model: Model) -> Version:
        """A recorded model, with the imports that the manifest has of it."""
        dependencies = self.recorded.dependencies if self.recorded else {}
        imported = {
            key: Import(record.target, facts.source_hash, record.target_hash or "", facts.converter, facts.facts)
            for key, facts in model.imports.items()
            if (record := dependencies.get(key)) is not None
        }
        return Version(model.snapshot, imported, self.recorded.generator.fingerprint if self.recorded else "")

    def dumps(self, recorded: Manifest) -> str:
        """The text of a manifest."""
        memory = self.request.memory
        return manifest.dumps(recorded, memory.tables if memory else None)

    def key(self, path: str) -> str:
        """How manifest and plan call a file of the package; `path` is below its folder."""
        return f"{self.folder}/{path}"

    def old_key(self, path: str) -> str:
        """The same where the package stood in the last build."""
        return f"{self.recorded.folder}/{path}" if self.recorded else self.key(path)

    def heading(self, snapshot: str) -> Manifest:
        """The manifest of this build without the lists in it; `snapshot` is the hash of the JSON file."""
        source = manifest.Source(self.robot.source_text, self._source_hash, snapshot)
        target = self.robot.target
        return Manifest(
            package=target.package, class_=target.name, folder=self.folder, source=source, generator=self.generator
        )

    @functools.cached_property
    def _source_hash(self) -> str:
        return text_digest(self.content)

    def dependencies(self, snapshot: Snapshot, lines: Mapping[str, int]) -> Sequence[Dependency]:
        """The files that a model refers to."""
        lookup = Lookup(self.robot.source, self.robot.package_paths + self.request.package_paths)
        return imports.sought(self.domain, snapshot, lookup, self.robot.options, lines)

    def _fingerprint(self) -> str:
        facts = {
            "class": self.robot.target.name,
            "options": msgspec.to_builtins(self.robot.options),
            "package": self.robot.target.package,
            "revision": self.domain.revision,
            "templates": self.templates.digest,
        }
        return digest(json.dumps(facts, sort_keys=True).encode())

    def _check_revision(self) -> None:
        recorded = self.recorded.generator if self.recorded else self.generator
        if recorded.domain == self.robot.domain and recorded.revision > self.domain.revision:
            message = f"a newer urdfsync built robot `{self.robot.name}`; this one would undo its improvements"
            file = shown(self.store.folder / "robots" / f"{self.robot.name}.toml")
            raise StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, hint="update urdfsync"))
