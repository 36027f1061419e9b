"""Plans one robot: reads its source and its state, renders what is stale, and decides. Writes nothing.

What `build` writes, a dry run shows and a check judges is one and the same plan.
"""

from __future__ import annotations

import dataclasses
import json
import stat
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from urdfsync import imports, manifest, packages, parents, registry
from urdfsync.config import Config, RobotConfig, shown, templates_folder
from urdfsync.decide import Decision, Disk, decide, encode
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, SourceError, StateError
from urdfsync.difference import Version
from urdfsync.domain import Dependency, Domain, Import, Lookup, Reading, Role, Snapshot
from urdfsync.files import digest, kind_of, templates_digest, text_digest
from urdfsync.manifest import Generator, Manifest
from urdfsync.plan import CONFLICTS, Kind, State, Wanted
from urdfsync.state import leftovers
from urdfsync.state.store import Store
from urdfsync.state.transactions import Change

if TYPE_CHECKING:
    from urdfsync.changes import Changes
    from urdfsync.generate import Generated

NO_MODEL = (KeyError, TypeError, AttributeError, ValueError)
"""What a domain raises for a recorded snapshot that is none of its own."""

Progress = Callable[[str, int, int], None]
"""Told of a step of the work: what it is, how much of it is done, and of how much."""


@dataclasses.dataclass(frozen=True, slots=True)
class Request:
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
    progress: Progress = lambda _what, _done, _total: None


@dataclasses.dataclass(frozen=True, slots=True)
class Work:
    """What there is to do for one robot."""

    decision: Decision
    manifest: str | None
    """None if the recorded one stays, and so is `model`."""
    model: str | None
    contents: Mapping[str, bytes] = dataclasses.field(default_factory=dict)
    diagnostics: tuple[Diagnostic, ...] = ()
    drawing: str | None = None
    changes: Changes | None = None


class Planner:
    """The plan of one robot, from what is on disk at this moment. Raises UrdfsyncError for whatever is wrong."""

    def __init__(self, config: Config, robot: RobotConfig, request: Request) -> None:
        self._config, self._robot, self._request = config, robot, request
        self._domain = registry.domain(robot.domain)
        self._parents = parents.check(config, robot, self._domain.uses)
        self._store = Store(config.root, shown)
        self._disk = Disk(config, robot)
        self._folder = self._disk.key(robot.folder)
        self._state = self._store.load(robot.name)
        self._former = None if self._state else leftovers.former(self._store, config, self._folder)
        if self._former:
            self._state = self._store.load(self._former)
        self._templates = _templates(config, robot, self._domain)
        self._content = _read_source(config, robot)
        self._generator = Generator(robot.domain, self._domain.revision, self._fingerprint())
        self._check_revision()

    def work(self) -> Work:
        """What there is to do."""
        return self._if_unchanged() or self._afresh()

    def stands(self) -> bool:
        """Whether the recorded state still is what the plan rests on: another build may have been at work."""
        return self._store.stands()

    def changes(self, work: Work) -> tuple[list[Change], list[Path]]:
        """The files to write for that, the manifest last, and the folders that are empty then, innermost first."""
        changes, emptied = [], set[Path]()
        above = self._disk.path(self._state.manifest.folder).parent if self._state else self._robot.output
        for action in work.decision.actions:
            if action.writes:
                path, deleted = self._disk.path(action.path), action.kind is Kind.DELETE
                content = None if deleted else work.contents[action.path]
                changes.append(Change(path, content, self._disk.seen(action.path)))
                emptied.update(folder for folder in path.parents if deleted and above in folder.parents)
        if work.drawing is not None:
            changes += self._store.drawing(self._robot.name, work.drawing)[1]
        if work.manifest is not None:
            changes += self._store.changes(self._robot.name, work.manifest, work.model, self._former)
        return changes, sorted(emptied, key=lambda folder: len(folder.parts), reverse=True)

    def drawing(self, work: Work) -> Path | None:
        """Where the diagram is then, None if there is none."""
        return None if work.drawing is None else self._store.drawing(self._robot.name, work.drawing)[0]

    def _fingerprint(self) -> str:
        facts = {
            "class": self._robot.target.name,
            "options": msgspec.to_builtins(self._robot.options),
            "package": self._robot.target.package,
            "revision": self._domain.revision,
            "templates": templates_digest(self._templates),
        }
        return digest(json.dumps(facts, sort_keys=True).encode())

    def _check_revision(self) -> None:
        recorded = self._state.manifest.generator if self._state else self._generator
        if recorded.domain == self._robot.domain and recorded.revision > self._domain.revision:
            message = f"a newer urdfsync built robot `{self._robot.name}`; this one would undo its improvements"
            file = shown(self._store.folder / "robots" / f"{self._robot.name}.toml")
            raise StateError(Diagnostic(Severity.ERROR, "newer-state", message, file, hint="update urdfsync"))

    def _if_unchanged(self) -> Work | None:
        """The work if the recorded state still holds and no file needs to be written; None if it has to be redone.

        Nothing that reads sources or renders templates is imported on this way.
        """
        state = self._state
        again = self._request.full or self._request.draw or self._former
        if state is None or state.model is None or not state.intact or again:
            return None
        recorded = state.manifest
        if self._heading(recorded.source.snapshot) != _heading_of(recorded) or self._parents.created:
            return None
        if any(record.state in (State.CONFLICT, State.WAITING) for record in recorded.files.values()):
            return None
        try:
            dependencies = self._dependencies(state.model.snapshot, {})
        except NO_MODEL:
            return None  # the recorded snapshot is not the domain's: the source is read again
        if not imports.unchanged(dependencies, recorded.dependencies, self._domain.converter):
            return None
        wanted = {
            key: Wanted(record.role, record.owner, record.base)
            for key, record in recorded.files.items()
            if record.base is not None and record.state is not State.ORPHAN
        }
        decision = decide(self._disk, recorded, wanted, recorded.orders, {}, self._parents)
        if any(action.writes or action.kind in CONFLICTS for action in decision.actions):
            return None
        renewed = msgspec.structs.replace(recorded, files=decision.files, orders=decision.orders)
        left_out = imports.reminder(dependencies, recorded.dependencies, shown(self._robot.source))
        return Work(decision, manifest.dumps(renewed), None, diagnostics=left_out)

    def _heading(self, snapshot: str) -> Manifest:
        """The manifest of this build without the lists in it."""
        robot = self._robot
        source = manifest.Source(robot.source_text, digest(self._content), snapshot)
        target = robot.target
        return Manifest(
            package=target.package, class_=target.name, folder=self._folder, source=source, generator=self._generator
        )

    def _dependencies(self, snapshot: Snapshot, lines: Mapping[str, int]) -> Sequence[Dependency]:
        lookup = Lookup(self._robot.source, self._robot.package_paths + self._request.package_paths)
        found = self._domain.dependencies(snapshot, lookup, self._robot.options, lines)
        if imports.all_found(found):
            return found
        lookup = dataclasses.replace(lookup, packages=packages.find(lookup.package_paths, lookup.source))
        return self._domain.dependencies(snapshot, lookup, self._robot.options, lines)

    def _afresh(self) -> Work:
        """Read, import, render and plan."""
        from urdfsync.generate import generate

        robot, domain = self._robot, self._domain
        reading = self._read()
        snapshot = manifest.plain(reading.snapshot or {})
        imported = self._import(snapshot, reading)
        generated = generate(domain, snapshot, imported.imports, robot.target, robot.options, self._templates)
        texts = {self._key(path): output.content for path, output in generated.files.items()}
        wanted, orders = self._wanted(generated, imported)
        recorded = self._state.manifest if self._state else None
        decision = decide(self._disk, recorded, wanted, orders, texts, self._parents)
        model = manifest.dump_model(snapshot, imported.imports)
        renewed = msgspec.structs.replace(
            self._heading(manifest.text_hash(model)),
            names=domain.names(snapshot, robot.target),
            dependencies=imported.records,
            orders=decision.orders,
            files=decision.files,
        )
        contents = texts | {self._key(path): content for path, content in imported.contents.items()}
        contents |= {key: encode(text) for key, text in decision.texts.items()}
        said = [*reading.diagnostics, *imported.diagnostics, *self._parents.diagnostics, *self._moved(decision)]
        said.sort(key=lambda found: (found.file, found.line))
        drawing = self._drawing(snapshot, imported.imports)
        if recorded and recorded.folder != self._folder and any(action.held for action in decision.actions):
            # the record of the old place is needed until the package can move
            return Work(decision, None, None, contents, tuple(said), drawing)
        changes = self._changes(snapshot, imported.imports)
        return Work(decision, manifest.dumps(renewed), model, contents, tuple(said), drawing, changes)

    def _changes(self, snapshot: Snapshot, imported: Mapping[str, Import]) -> Changes | None:
        """What is new in the model since the last build; None if nothing is, or nothing is known of that build."""
        if self._state is None or self._state.model is None or not self._state.intact:
            return None
        from urdfsync.changes import compare

        recorded, model = self._state.manifest, self._state.model
        before = {
            key: Import(record.target, facts.source_hash, record.target_hash or "", facts.converter, facts.facts)
            for key, facts in model.imports.items()
            if (record := recorded.dependencies.get(key)) is not None
        }
        old = Version(model.snapshot, before, recorded.generator.fingerprint)
        new = Version(snapshot, imported, self._generator.fingerprint)
        try:
            found = compare(old, new, self._domain, self._robot.options)
        except NO_MODEL:
            return None  # what is recorded is no model of the domain
        return found if found.changes or found.generator else None

    def _moved(self, decision: Decision) -> list[Diagnostic]:
        """What there is to say if robot or package had another name in the last build."""
        place = shown(self._config.file), self._robot.lines[""]
        said = [leftovers.renamed(self._former, self._robot.name, *place)] if self._former else []
        if self._state and self._state.manifest.folder != self._folder:
            said += leftovers.left_behind(self._disk, self._state.manifest, decision.actions, self._folder, *place)
        return said

    def _wanted(
        self, generated: Generated, imported: imports.Imported
    ) -> tuple[dict[str, Wanted], dict[str, tuple[str, ...]]]:
        """All files that the package should have, and the names in every `package.order`, the parent's included."""
        wanted = {
            self._key(path): Wanted(output.role, output.owner, text_digest(output.content))
            for path, output in generated.files.items()
        }
        for key, entry in imported.imports.items():
            wanted[self._key(entry.target)] = Wanted(Role.IMPORT, key, entry.target_hash)
        orders = {self._key(path): names for path, names in generated.orders.items()}
        folder = self._robot.folder
        if folder.parent != self._robot.output and self._parents.listed:
            orders[self._disk.key(folder.parent / "package.order")] = (folder.name,)
        return wanted, orders

    def _read(self) -> Reading:
        reading = self._domain.read(self._content, shown(self._robot.source), self._robot.options)
        if reading.snapshot is None or any(d.severity is Severity.ERROR for d in reading.diagnostics):
            raise SourceError(*reading.diagnostics)
        return reading

    def _import(self, snapshot: Snapshot, reading: Reading) -> imports.Imported:
        state, name = self._state, self._robot.name
        files = state.manifest.files if state else {}
        recorded = imports.Recorded(
            records=state.manifest.dependencies if state else {},
            facts=state.model.imports if state and state.model else {},
            copy=lambda target: self._disk.read(self._old_key(target)),
            base=lambda target: record.base if (record := files.get(self._old_key(target))) else None,
            moved=state is not None and state.manifest.folder != self._folder,
        )
        return imports.bring_in(
            self._domain,
            self._dependencies(snapshot, reading.lines),
            recorded,
            shown(self._robot.source),
            self._request.full,
            lambda done, total: self._request.progress(f"{name}: imports", done, total),
        )

    def _key(self, path: str) -> str:
        return f"{self._folder}/{path}"

    def _old_key(self, path: str) -> str:
        return f"{self._state.manifest.folder}/{path}" if self._state else self._key(path)

    def _drawing(self, snapshot: Snapshot, imported: Mapping[str, Import]) -> str | None:
        if not self._request.draw:
            return None
        return self._domain.drawing(snapshot, imported, self._robot.target, self._robot.options)


def _heading_of(recorded: Manifest) -> Manifest:
    return msgspec.structs.replace(recorded, names={}, dependencies={}, orders={}, files={})


def _templates(config: Config, robot: RobotConfig, domain: Domain) -> list[Path]:
    """The robot's template folders, best first. Raises ConfigError for one that does not exist."""
    folders = [robot.templates] if robot.templates else []
    for folder in folders:
        if not folder.is_dir():
            message = f"robot `{robot.name}`: the template folder {shown(folder)} does not exist"
            line, hint = robot.lines.get("templates", 0), "create it, or take `templates` out"
            raise ConfigError(Diagnostic(Severity.ERROR, "no-templates", message, shown(config.file), line, hint=hint))
    return [*folders, templates_folder(domain)]


def _read_source(config: Config, robot: RobotConfig) -> bytes:
    try:
        if stat.S_ISREG(robot.source.stat().st_mode):
            return robot.source.read_bytes()
        reason = f"is {kind_of(robot.source.stat().st_mode)}"
    except OSError as error:
        reason = "does not exist" if isinstance(error, FileNotFoundError) else f"can't be read: {error.strerror}"
    message = f"robot `{robot.name}`: the source {shown(robot.source)} {reason}"
    line = robot.lines.get("source", 0)
    hint = "correct `source`, or export the file again"
    raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(config.file), line, hint=hint))
