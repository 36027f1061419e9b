"""One robot generated from its source as it is now: model, imported files, and the texts of its package.

Of the package of the last build, texts whose template and data are still the same need not be rendered.
"""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import msgspec

from urdfsync import profiling
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic
from urdfsync.diff import changes
from urdfsync.diff.changes import Changes
from urdfsync.domain import ElementKey, Role, Snapshot, Target, Version
from urdfsync.engine import imports, source
from urdfsync.engine.dangling import DanglingNames, lost_names
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.imports import Imported
from urdfsync.engine.inputs import NO_MODEL, Inputs
from urdfsync.engine.renames import renamed_files
from urdfsync.engine.rules import DesiredFile
from urdfsync.files import digest, normalised, text_digest
from urdfsync.state.record import FileRecord, RecordState

_AS_GENERATED = (RecordState.GENERATED, RecordState.EDITED)
"""States of files whose base is what the last build generated."""


@dataclass(frozen=True)
class Generation:
    """What one build generates; files are named by their keys."""

    inputs: Inputs
    snapshot: Snapshot
    lines: Mapping[str, int]
    diagnostics: tuple[Diagnostic, ...]
    """Findings about source and options."""
    imported: Imported
    now: Version
    package: Package
    last_package: Package | None
    """The package of the recorded model, from today's templates; None if there is none."""
    recovered_packages: tuple[Package, ...]
    """The packages of the models that `--repair` could read."""
    changed: frozenset[str]
    """Paths below the package whose text may differ from the last build's."""

    def hash(self, path: str) -> str:
        """Return the hash of what would be written, by the path below the package."""
        return self._recorded_hash(path) or self.package.hash(path)

    def content(self, key: str) -> bytes:
        """Return what would be written."""
        path = self.inputs.path(key)
        recorded = self._recorded_hash(path)
        known = None if recorded is None else self.inputs.bases.get(recorded)
        return self.package.content(path) if known is None else known.encode()

    def base(self, key: str, sha256: str) -> str | None:
        """Return the text that was written last at a key of the last build, by its hash; None if it is lost.

        A file that the user moved has its base under the key that it had.
        """
        known = self.inputs.bases.get(sha256)
        if known is not None:
            return known
        files = self.inputs.recorded.files if self.inputs.recorded else {}
        keys = [key, *(other for other, record in files.items() if record.base == sha256 and other != key)]
        found = (self._find_base(other, sha256) for other in keys)
        return next((text for text in found if text is not None), None)

    def _find_base(self, key: str, sha256: str) -> str | None:
        inputs, path = self.inputs, self.inputs.old_path(key)
        mine = inputs.files.read(key)
        if mine is not None and text_digest(mine) == sha256:
            return normalised(mine).decode(errors="surrogateescape")
        recorded = inputs.state.model.bases if inputs.state and inputs.state.model else {}
        candidates = [text.encode() for text in recorded.values()]
        same_generator = inputs.recorded is not None and inputs.recorded.generator == inputs.generator
        packages = [self.last_package if same_generator else None, self.package, *self.recovered_packages]
        candidates += [package.content(path) for package in packages if package and path in package.artifacts]
        return next((text.decode() for text in candidates if text_digest(text) == sha256), None)

    def _recorded_hash(self, path: str) -> str | None:
        """Return the recorded hash of a text that is as in the last build."""
        if path in self.changed or self.inputs.recorded is None:
            return None
        record = self.inputs.recorded.files.get(self.inputs.old_key(path))
        return record.base if record is not None and record.state in _AS_GENERATED else None

    # The package

    def desired_files(self) -> dict[str, DesiredFile]:
        """Return every file that the package should have, by key."""
        key = self.inputs.key
        texts = {
            key(path): DesiredFile(artifact.role, artifact.owner, self.hash(path))
            for path, artifact in self.package.artifacts.items()
        }
        imported = {
            key(entry.target): DesiredFile(
                Role.IMPORT, name, entry.target_hash, entry.target not in self.imported.hashes_only
            )
            for name, entry in self.imported.imports.items()
        }
        return texts | imported

    def desired_orders(self) -> dict[str, tuple[str, ...]]:
        """Return urdfsync's lines of each `package.order`, the parent's included, by key."""
        inputs, folder = self.inputs, self.inputs.robot.folder
        orders = {inputs.key(path): names for path, names in self.package.orders.items()}
        if folder.parent != inputs.robot.output and inputs.parents.listed:
            orders[inputs.files.key(folder.parent / "package.order")] = (folder.name,)
        return orders

    # Changes and renames

    @cached_property
    def changes(self) -> Changes | None:
        """What changed in the model since the last build; None if that is not known."""
        return self._changes_since(self.inputs.last)

    @cached_property
    def changes_since_complete(self) -> Changes | None:
        """What changed since the last build after which nothing waited; None if that is not known."""
        complete = self.inputs.last_complete
        return self.changes if complete is self.inputs.last else self._changes_since(complete)

    @profiling.stage("comparing")
    def _changes_since(self, version: Version | None) -> Changes | None:
        if version is None:
            return None
        try:
            return changes.compare(version, self.now, self.inputs.domain, self.inputs.robot.options)
        except NO_MODEL:
            return None

    def renamed_files(self) -> dict[str, str]:
        """Return new and old key of text files whose element was renamed, or whose package moved."""
        inputs, recorded = self.inputs, self.inputs.recorded
        if recorded is None:
            return {}
        last = self.last_package.artifacts if self.last_package else {}
        texts = {
            inputs.old_path(key): record
            for key, record in recorded.files.items()
            if record.role is not Role.IMPORT and record.state is not RecordState.ORPHAN
        }
        before = {path: (a.owner, a.template) for path, a in last.items() if path in texts}
        for path, old_path in self._reidentified_files().items():
            before[old_path] = (last[path].owner, last[path].template)
        now = {path: (a.owner, a.template) for path, a in self.package.artifacts.items()}
        renamed = changes.moved_files(before, now, self.changes.renames if self.changes else {})
        targets = {inputs.old_key(path): inputs.key(renamed.get(path, path)) for path in texts}
        return renamed_files(recorded.files, targets, {inputs.key(path) for path in now})

    def _reidentified_files(self) -> Mapping[str, str]:
        """Return today's and recorded path of files whose element an older urdfsync gave another identifier."""
        inputs, recorded = self.inputs, self.inputs.recorded
        if inputs.last is None or recorded is None or self.last_package is None:
            return {}
        names = inputs.domain.names(inputs.last.snapshot, Target(recorded.package, recorded.class_))
        owners = {
            f"{kind.removesuffix('s')} {name}"
            for kind, identifiers in recorded.names.items()
            for name, identifier in identifiers.items()
            if names.get(kind, {}).get(name, identifier) != identifier
        }
        if not owners:
            return {}
        files = {inputs.old_path(key): (one.owner, str(one.role)) for key, one in recorded.files.items()}
        today = {path: (one.owner, str(one.role)) for path, one in self.last_package.artifacts.items()}
        moved = changes.moved_files({path: key for path, key in files.items() if key[0] in owners}, today, {})
        return {new: old for old, new in moved.items()}

    def _renamed_identifiers(self) -> dict[str, str]:
        """Return old and new identifiers of elements since the last complete build."""
        inputs, complete, recorded = self.inputs, self.inputs.last_complete, self.inputs.recorded
        if complete is None or recorded is None:
            return {}
        renames: Mapping[ElementKey, str] = self.changes_since_complete.renames if self.changes_since_complete else {}
        try:
            target = Target(recorded.package, recorded.class_)
            is_last = complete is inputs.last
            old = recorded.names if is_last else inputs.domain.names(complete.snapshot, target)
        except NO_MODEL:
            return {}
        new = inputs.domain.names(self.snapshot, inputs.robot.target)
        found = {}
        for kind, identifiers in old.items():
            for name, identifier in identifiers.items():
                now = renames.get((kind.removesuffix("s"), name), name)
                found[identifier] = new.get(kind, {}).get(now, identifier)
        return {before: after for before, after in found.items() if before != after}

    # Names that the package loses

    @cached_property
    def dangling(self) -> DanglingNames:
        """Finds uses of the names that the package loses."""
        return DanglingNames(
            self.inputs, list(self.package.artifacts), lambda path: self.content(self.inputs.key(path))
        )

    @cached_property
    def replaced(self) -> dict[str, str]:
        """Hashes of the last texts of files that get another text or none, by path; of records, only those that go."""
        inputs, recorded, now = self.inputs, self.inputs.recorded, self.package.artifacts
        if recorded is None or inputs.recovered is not None:
            return {}
        found = {}
        for key, record in recorded.files.items():
            path = inputs.old_path(key)
            stays = path in now and (record.role is Role.RECORD or not self._may_differ(path, record))
            is_text = record.role in (Role.MODEL, Role.RECORD, Role.PACKAGE) and record.state is not RecordState.ORPHAN
            if is_text and not stays and record.base is not None:
                found[path] = record.base
        return found

    @cached_property
    def lost_names(self) -> dict[str, str]:
        """The names that the package loses, with their new names."""
        inputs, recorded = self.inputs, self.inputs.recorded
        before = {path: self.base(inputs.old_key(path), sha256) or "" for path, sha256 in self.replaced.items()}
        if recorded is None or not before:
            return {}
        records = {inputs.old_path(key): record for key, record in recorded.files.items()}
        changed = [path for path in self.package.artifacts if self._may_differ(path, records.get(path))]
        now = {path: self.content(inputs.key(path)).decode() for path in changed}
        package = inputs.robot.target.package
        moved = {recorded.package.rpartition(".")[2]: package} if recorded.package != package else {}
        return {**lost_names(before, now, self._renamed_identifiers(), self.dangling.is_inherited), **moved}

    def lost_use(self, key: str, text: str) -> tuple[str, int] | None:
        """Return the first name in a text for a file that the package loses, with its line; None if there is none."""
        return self.dangling.first_use(key, text, self.lost_names) if self.lost_names else None

    def _may_differ(self, path: str, record: FileRecord | None) -> bool:
        """Return whether the text of a generated file may differ from what was written last."""
        waits = record is None or record.state in (RecordState.WAITING, RecordState.CONFLICT)
        return waits or path in self.changed


def generate_robot(inputs: Inputs) -> Generation:
    """Parse the source, import the files that it refers to, and generate the package; no text is rendered yet.

    Raises SourceError, ConfigError or OutputError for whatever is wrong.
    """
    domain, robot = inputs.domain, inputs.robot
    snapshot, reading = source.read(domain, robot.options, inputs.content, shown(robot.source), inputs.options.cache)
    said = (*reading.diagnostics, *source.check_options(inputs.config, robot, domain, snapshot))
    imported = _import(inputs, snapshot, reading.lines)
    now = Version(snapshot, imported.imports, inputs.generator.fingerprint)
    last = _last_package(inputs)  # first: the cache keeps one package, and the next line replaces it
    package = _package(inputs, now, robot.target)
    same = last and inputs.recorded and inputs.recorded.generator == inputs.generator and not inputs.options.full
    with profiling.stage("comparing"):
        changed = package.changed_since(last) if last and same else frozenset(package.artifacts)
    return Generation(
        inputs,
        snapshot,
        reading.lines,
        said,
        imported,
        now,
        package,
        last,
        tuple(_recovered_packages(inputs)),
        changed,
    )


@profiling.stage("meshes")
def _import(inputs: Inputs, snapshot: Snapshot, lines: Mapping[str, int]) -> Imported:
    state, name = inputs.state, inputs.robot.name
    files = state.manifest.files if state else {}

    def base(target: str) -> str | None:
        record = files.get(inputs.old_key(target))
        return record.base if record else None

    recorded = imports.Recorded(
        records=state.manifest.dependencies if state else {},
        facts=state.model.imports if state and state.model else {},
        copy=lambda target: inputs.files.read(inputs.old_key(target)),
        base=base,
        moved=state is not None and state.manifest.folder != inputs.folder,
    )
    return imports.bring_in(
        inputs.domain,
        inputs.dependencies(snapshot, lines),
        recorded,
        shown(inputs.robot.source),
        inputs.options.full,
        lambda done, total: inputs.options.progress(f"{name}: imports", done, total),
    )


def _package(inputs: Inputs, version: Version, target: Target) -> Package:
    """Generate the package of a model. The daemon keeps the last one, which the next build compares with.

    Saves a fifth of a build of 1,000 links in the daemon.
    """
    imported, options = version.imports or {}, inputs.robot.options

    def make() -> Package:
        return generate(inputs.domain, version.snapshot, imported, target, options, inputs.templates)

    if inputs.options.cache is None:
        return make()
    # as bytes, since 0.0 == -0.0 although their texts differ
    model = digest(msgspec.json.encode((version.snapshot, imported)))
    key = inputs.domain.name, model, target, options, inputs.templates
    return inputs.options.cache.get("package", key, make)


def _last_package(inputs: Inputs) -> Package | None:
    last, recorded = inputs.last, inputs.recorded
    if last is None or recorded is None:
        return None
    try:
        return _package(inputs, last, Target(recorded.package, recorded.class_))
    except NO_MODEL:
        return None


def _recovered_packages(inputs: Inputs) -> Sequence[Package]:
    found = []
    for model in inputs.recovered.models.values() if inputs.recovered and inputs.recorded else ():
        with contextlib.suppress(*NO_MODEL):
            found.append(_package(inputs, inputs.version(model), inputs.robot.target))
    return found
