"""One robot generated from its source as it is now: model, imported files, and the texts of its package.

Of the package of the last build, texts whose template and data are still the same need not be rendered.
"""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from functools import cached_property

import msgspec

from urdfsync import changes
from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Role, Target, Version
from urdfsync.engine import imports, source
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.imports import Imported
from urdfsync.engine.inputs import NO_MODEL, Inputs
from urdfsync.engine.rules import DesiredFile, renamed_files
from urdfsync.files import normalised, shown, text_digest
from urdfsync.state.record import RecordState


class Generation(msgspec.Struct, frozen=True, dict=True):
    """What one build generates; files are named by their keys."""

    inputs: Inputs
    now: Version
    """The model of the source, with its imports."""
    lines: Mapping[str, int]
    """Line of each element in the source."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings about source, options and imports."""
    imported: Imported
    package: Package
    last_package: Package | None
    """The package of the recorded model, from today's templates; None if there is none."""
    recovered_packages: tuple[Package, ...]
    """The packages of the models that `--repair` could read."""
    changed: frozenset[str]
    """Paths below the package whose text may differ from the last build's."""

    def _recorded_hash(self, path: str) -> str | None:
        """Return the recorded hash of a text that is as in the last build."""
        if path in self.changed or self.inputs.recorded is None:
            return None
        record = self.inputs.recorded.files.get(self.inputs.old_key(path))
        if record is None or record.state not in (RecordState.GENERATED, RecordState.EDITED):
            return None  # in other states the base may be older
        return record.base

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

        It may be kept, on disk, recorded, or rendered again. A file that the user moved has its base under the key that
        it had.
        """
        # from the cheapest to the dearest; what does not have the hash is never taken, so the order changes no result
        inputs, recorded = self.inputs, self.inputs.recorded
        if (known := inputs.bases.get(sha256)) is not None:
            return known
        packages = [self.package, *self.recovered_packages]
        if self.last_package and recorded and recorded.generator == inputs.generator:
            packages.insert(0, self.last_package)
        same = [other for other, record in recorded.files.items() if record.base == sha256] if recorded else []
        for place in dict.fromkeys((key, *same)):
            mine, path = inputs.files.read(place), inputs.old_path(place)
            if mine is not None and text_digest(mine) == sha256:
                return normalised(mine).decode(errors="surrogateescape")
            for package in packages:
                if path in package.artifacts and package.hash(path) == sha256:
                    return package.content(path).decode()
        recorded_texts = inputs.model.bases.values() if inputs.model else ()
        return next((text for text in recorded_texts if text_digest(text.encode()) == sha256), None)

    def desired_files(self) -> dict[str, DesiredFile]:
        """Return every file that the package should have, by key."""
        found = {
            self.inputs.key(path): DesiredFile(artifact.role, artifact.owner, self.hash(path))
            for path, artifact in self.package.artifacts.items()
        }
        for name, entry in self.imported.imports.items():
            at_hand = entry.target not in self.imported.hashes_only
            found[self.inputs.key(entry.target)] = DesiredFile(Role.IMPORT, name, entry.target_hash, at_hand)
        return found

    def desired_orders(self) -> dict[str, tuple[str, ...]]:
        """Return urdfsync's lines of each `package.order`, the parent's included, by key."""
        inputs, folder = self.inputs, self.inputs.robot.folder
        orders = {inputs.key(path): names for path, names in self.package.orders.items()}
        if folder.parent != inputs.robot.output and inputs.parents.listed:
            orders[inputs.files.key(folder.parent / "package.order")] = (folder.name,)
        return orders

    @cached_property
    def rewritten(self) -> frozenset[tuple[str, str]]:
        """Path and hash of the last texts of files that get another text or none; of records, only those that go."""
        found, orphans = set[tuple[str, str | None]](), set[tuple[str, str | None]]()
        recorded, now = self.inputs.recorded, self.package.artifacts
        for key, record in recorded.files.items() if recorded else ():
            path = self.inputs.old_path(key)
            may_differ = path in self.changed or record.state in (RecordState.WAITING, RecordState.CONFLICT)
            stays = path in now and (record.role is Role.RECORD or not may_differ)
            if stays or record.role is Role.IMPORT:
                continue
            into = orphans if record.state is RecordState.ORPHAN and path not in now else found
            into.add((path, record.written_hash))
            if record.origin:
                into.add((self.inputs.old_path(record.origin), record.base))
        # orphans alone take no name away
        return frozenset((path, sha256) for path, sha256 in (found | orphans if found else found) if sha256)

    @cached_property
    def changes(self) -> Changes | None:
        """What changed in the model since the last build; None if that is not known."""
        return self._changes_since(self.inputs.last)

    @cached_property
    def changes_since_complete(self) -> Changes | None:
        """What changed since the last build after which nothing waited; None if that is not known."""
        complete = self.inputs.last_complete
        return self.changes if complete is self.inputs.last else self._changes_since(complete)

    def _changes_since(self, version: Version | None) -> Changes | None:
        if version is None:
            return None
        try:
            found = changes.compare(version, self.now, self.inputs.domain, self.inputs.robot.options)
        except NO_MODEL:
            return None
        options = self.inputs.changed_options() if found.generator else ()
        return msgspec.structs.replace(found, options=options) if options else found

    def renamed_files(self) -> dict[str, str]:
        """Return new and old key of text files whose element was renamed, or whose package moved.

        Also of those whose element an older urdfsync gave another identifier.
        """
        inputs, recorded = self.inputs, self.inputs.recorded
        if recorded is None:
            return {}
        texts = {
            inputs.old_path(key): record
            for key, record in recorded.files.items()
            if record.role is not Role.IMPORT and record.state is not RecordState.ORPHAN
        }
        last = self.last_package.artifacts if self.last_package else {}
        before = {path: (a.owner, a.template) for path, a in last.items() if path in texts}
        names: Mapping[str, Mapping[str, str]] = {}
        if inputs.last and last:
            names = inputs.domain.names(inputs.last.snapshot, Target(recorded.package, recorded.class_))
        other = {
            f"{kind.removesuffix('s')} {name}"
            for kind, identifiers in recorded.names.items()
            for name, identifier in identifiers.items()
            if names.get(kind, {}).get(name, identifier) != identifier
        }
        if other:
            written = {path: (r.owner, str(r.role)) for path, r in texts.items() if r.owner in other}
            today = {path: (a.owner, str(a.role)) for path, a in last.items()}
            for old_path, path in changes.moved_files(written, today, {}).items():
                before[old_path] = (last[path].owner, last[path].template)
        now = {path: (a.owner, a.template) for path, a in self.package.artifacts.items()}
        if before == now and inputs.folder == inputs.old_folder and not any(r.origin for r in texts.values()):
            return {}
        renamed = changes.moved_files(before, now, self.changes.renames if self.changes else {})
        targets = {inputs.old_key(path): inputs.key(renamed.get(path, path)) for path in texts}
        return renamed_files(recorded.files, targets, {inputs.key(path) for path in now})


def generate_robot(inputs: Inputs) -> Generation:
    """Parse the source, import the files that it refers to, and generate the package; no text is rendered yet.

    Raises SourceError, ConfigError or OutputError for whatever is wrong.
    """
    domain, robot, options, recorded = inputs.domain, inputs.robot, inputs.options, inputs.recorded
    snapshot, reading = source.read(domain, robot.options, inputs.content, shown(robot.source))
    found = (*reading.diagnostics, *source.check_options(inputs.config, robot, domain, snapshot))
    imported = imports.bring_in(
        domain,
        inputs.dependencies(snapshot, reading.lines),
        inputs.recorded_imports(),
        shown(robot.source),
        options.full,
        lambda done, total: options.progress(f"{robot.name}: imports", done, total),
    )
    now = Version(snapshot, imported.imports, inputs.generator.fingerprint)
    last_package, recovered = None, []
    if inputs.last and recorded:
        with contextlib.suppress(*NO_MODEL):
            last_package = _package(inputs, inputs.last, Target(recorded.package, recorded.class_))
    package = _package(inputs, now, robot.target)
    for model in inputs.recovered.models.values() if inputs.recovered and recorded else ():
        with contextlib.suppress(*NO_MODEL):
            recovered.append(_package(inputs, inputs.version(model), robot.target))
    changed = frozenset(package.artifacts)
    if last_package and recorded and recorded.generator == inputs.generator and not options.full:
        changed = package.changed_since(last_package)
    found = (*found, *imported.diagnostics)
    return Generation(inputs, now, reading.lines, found, imported, package, last_package, tuple(recovered), changed)


def _package(inputs: Inputs, version: Version, target: Target) -> Package:
    """Generate the package of a model."""
    options = inputs.robot.options
    return generate(inputs.domain, version.snapshot, version.imports or {}, target, options, inputs.templates)
