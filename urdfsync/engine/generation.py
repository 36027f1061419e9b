"""One robot generated from its source as it is now: model, imported files, and the texts of its package.

Of the package of the last complete build, texts whose template and data are still the same need not be rendered.
"""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any

import msgspec

from urdfsync import changes
from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import ElementKey, Role, Snapshot, Target, Version
from urdfsync.engine import imports, source
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.imports import Imported
from urdfsync.engine.inputs import NO_MODEL, Inputs
from urdfsync.engine.renames import check_declared, find_renames_since
from urdfsync.engine.rules import DesiredFile
from urdfsync.files import normalised, shown, text_digest
from urdfsync.state.record import role_of


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
    last_packages: tuple[Package, ...]
    """The package of the recorded model, from today's templates; several if it is not known which model that is."""
    changed: frozenset[str]
    """Paths below the package whose text may differ from that of the last complete build."""

    @property
    def last_package(self) -> Package | None:
        """The package of the last complete build; None if it is not known."""
        return self.last_packages[0] if len(self.last_packages) == 1 and self.inputs.last else None

    def _recorded_hash(self, path: str) -> str | None:
        """Return the recorded hash of a text that is as in the last complete build."""
        record = self.inputs.recorded_files.get(self.inputs.old_key(path))
        if path in self.changed or record is None or len(record.hashes) != 1:
            return None
        return record.generated

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
        """Return the text with this hash that was written last at a key of the last build; None if it is lost.

        It may be kept, recorded, on disk, or rendered again. A file that the user moved has its base under the key that
        it had.
        """
        # from the cheapest to the dearest; what does not have the hash is never taken, so the order changes no result
        inputs = self.inputs
        known = inputs.bases.get(sha256) or (inputs.record.texts.get(sha256) if inputs.record else None)
        if known is not None and text_digest(known.encode()) == sha256:
            return known
        same = [other for other, record in inputs.recorded_files.items() if sha256 in record.hashes]
        for place in dict.fromkeys((key, *same)):
            mine, path = inputs.files.read(place), inputs.old_path(place)
            if mine is not None and text_digest(mine) == sha256:
                return normalised(mine).decode(errors="surrogateescape")
            for package in (*self.last_packages, self.package):
                if path in package.artifacts and package.hash(path) == sha256:
                    return package.content(path).decode()
        return None

    def is_rendered(self, path: str, hashes: Collection[str]) -> bool:
        """Whether one of these hashes is that of a text that was written last, as it is rendered here."""
        packages = (package for package in (*self.last_packages, *self._seen_packages) if path in package.artifacts)
        return any(package.hash(path) in hashes for package in packages)

    @cached_property
    def _seen_packages(self) -> tuple[Package, ...]:
        """The package of the model last seen: builds that are not complete have renewed files from it."""
        record = self.inputs.record
        return tuple(_recorded_packages(self.inputs, [record.open.seen])) if record and record.open else ()

    def desired_files(self) -> dict[str, DesiredFile]:
        """Return every file that the package should have, by key."""
        found = {
            self.inputs.key(path): DesiredFile(artifact.role, artifact.owner, self.hash(path))
            for path, artifact in self.package.artifacts.items()
        }
        for name, entry in self.imported.imports.items():
            found[self.inputs.key(entry.target)] = DesiredFile(Role.IMPORT, name, entry.target_hash)
        return found

    def recorded_roles(self) -> dict[str, tuple[Role, str]]:
        """Return role and owner of each recorded file, by key."""
        found = {}
        for key in self.inputs.recorded_files:
            path = self.inputs.old_path(key)
            artifact = next((p.artifacts[path] for p in self.last_packages if path in p.artifacts), None)
            found[key] = (artifact.role, artifact.owner) if artifact else (role_of(path), "")
        return found

    def desired_orders(self) -> dict[str, tuple[str, ...]]:
        """Return urdfsync's lines of each `package.order`, the parent's included, by key."""
        inputs, folder = self.inputs, self.inputs.robot.folder
        orders = {inputs.key(path): names for path, names in self.package.orders.items()}
        if folder.parent != inputs.robot.output and inputs.parents.listed:
            orders[inputs.files.key(folder.parent / "package.order")] = (folder.name,)
        return orders

    def recorded_orders(self) -> dict[str, tuple[str, ...]]:
        """Return the lines of each `package.order` that follow from the last complete build, by key."""
        inputs, found = self.inputs, dict[str, tuple[str, ...]]()
        if inputs.record is None or not inputs.record.snapshots:
            return found
        for package in self.last_packages:
            found |= {inputs.old_key(path): names for path, names in package.orders.items()}
        if "." in inputs.old_target.package:
            above, _, name = inputs.old_folder.rpartition("/")
            found[f"{above}/package.order" if above else "package.order"] = (name,)
        return {key: names for key, names in found.items() if inputs.files.is_inside(key)}

    @cached_property
    def renames(self) -> Mapping[ElementKey, str]:
        """Elements that have another name since the last complete build: old element → new name."""
        return self._find_renames(self.inputs.robot.renamed)

    @property
    def recognised_renames(self) -> Mapping[ElementKey, str]:
        """The renames without those that are declared, or follow from these: what is declared may be taken back."""
        return self._find_renames({}) if self.inputs.robot.renamed else self.renames

    def _find_renames(self, declared: Mapping[str, str]) -> Mapping[ElementKey, str]:
        inputs = self.inputs
        if inputs.last is None or inputs.record is None:
            return {}
        last, open_ = inputs.last.snapshot, inputs.record.open
        try:
            return find_renames_since(inputs.domain, last, open_, self.now.snapshot, declared)
        except NO_MODEL:
            return {}

    @cached_property
    def changes(self) -> Changes | None:
        """What changed since the last complete build; None if that is not known, and for a robot that is removed."""
        inputs = self.inputs
        if inputs.last is None or inputs.options.removes:
            return None
        try:
            found = changes.compare(inputs.last, self.now, inputs.domain, inputs.robot.options, self.renames)
        except NO_MODEL:
            return None
        if inputs.has_same_generator:
            return found
        return msgspec.structs.replace(found, generator=True, options=inputs.changed_options())

    @cached_property
    def moves(self) -> dict[str, str]:
        """New and old key of text files whose element was renamed, or whose package moved."""
        inputs, last = self.inputs, self.last_package
        hashes = {inputs.old_path(key): one.hashes for key, one in inputs.recorded_files.items() if not one.is_users}
        texts = set(hashes)
        if inputs.has_moved:  # the record may be a stranger's, and the folder the user's
            texts = {path for path in texts if self.is_rendered(path, hashes[path])}
        before = {path: (a.owner, a.template) for path, a in last.artifacts.items() if path in texts} if last else {}
        now = {path: (a.owner, a.template) for path, a in self.package.artifacts.items()}
        if before == now and not inputs.has_moved:
            return {}
        renamed = changes.moved_files(before, now, self.renames)
        pairs = ((inputs.key(renamed.get(path, path)), inputs.old_key(path)) for path in texts)
        return {new: old for new, old in pairs if new != old and inputs.path(new) in now}


def generate_robot(inputs: Inputs) -> Generation:
    """Parse the source, import the files that it refers to, and generate the package; no text is rendered yet.

    Raises SourceError, ConfigError or OutputError for whatever is wrong.
    """
    domain, robot, options = inputs.domain, inputs.robot, inputs.options
    last_packages = tuple(_recorded_packages(inputs, inputs.record.snapshots if inputs.record else ()))
    if options.removes:
        nothing = Package((), inputs.templates, robot.target.package)
        return Generation(inputs, inputs.last or Version({}), {}, (), Imported(), nothing, last_packages, frozenset())
    snapshot, reading = source.read(domain, robot.options, inputs.source.content, shown(robot.source))
    found = (
        *inputs.source.diagnostics,
        *reading.diagnostics,
        *source.check_options(inputs.config, robot, domain, snapshot),
        *check_declared(inputs, snapshot),
    )
    dependencies = inputs.dependencies(snapshot, reading.lines)
    imported = imports.bring_in(
        domain,
        dependencies,
        inputs.recorded_imports,
        shown(robot.source),
        options.full or inputs.has_moved,  # no copy of a former folder serves: it may be the user's
        lambda done, total: options.progress(f"{robot.name}: imports", done, total),
    )
    lines = {one.key: one.line for one in dependencies}
    found += (
        *imported.diagnostics,
        *(
            msgspec.structs.replace(one, file=shown(robot.source), line=lines.get(key, 0))
            for key, one in domain.import_findings(imported.imports)
        ),
    )
    now = Version(snapshot, imported.imports)
    package = _package(inputs, now, robot.target, robot.options)
    changed = frozenset(package.artifacts)
    is_complete = inputs.record is not None and inputs.record.open is None and not inputs.written
    if is_complete and last_packages and inputs.has_same_generator and not options.full:
        changed = package.changed_since(last_packages[0])
    return Generation(inputs, now, reading.lines, tuple(found), imported, package, last_packages, changed)


def _recorded_packages(inputs: Inputs, snapshots: Iterable[Snapshot]) -> Iterator[Package]:
    """Yield the package of each recorded model, as far as it can be generated."""
    record = inputs.record
    if record is None or record.generator.domain != inputs.robot.domain:
        return
    for snapshot in snapshots:
        with contextlib.suppress(*NO_MODEL):
            options = inputs.recorded_options or inputs.robot.options
            yield _package(inputs, inputs.version(record, snapshot), inputs.old_target, options)


def _package(inputs: Inputs, version: Version, target: Target, options: Any) -> Package:
    """Generate the package of a model."""
    return generate(inputs.domain, version.snapshot, version.imports or {}, target, options, inputs.templates)
