"""One robot generated from its source as it is now: model, imported files, and the texts of its package.

Of the package of the last complete build, texts whose template and data are still the same need not be rendered.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property

import msgspec

from urdfsync import changes
from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import ElementKey, Role, Version
from urdfsync.engine import imports, source
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.imports import Imported
from urdfsync.engine.inputs import NO_MODEL, Inputs
from urdfsync.engine.renames import check_declared, find_renames_since
from urdfsync.engine.rules import DesiredFile
from urdfsync.files import shown
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
    changed: frozenset[str]
    """Paths below the package whose text may differ from that of the last complete build."""

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
        known = None if recorded is None else self.inputs.base(recorded)
        return self.package.content(path) if known is None else known.encode()

    def is_rendered(self, path: str, hashes: Collection[str]) -> bool:
        """Whether one of these hashes is that of a text which the recorded models give at a path of the last build.

        That proves that urdfsync wrote it. Hashes in the record, and texts in the bases, may be a stranger's.
        """
        packages = (package for package in self._recorded_packages if package and path in package.artifacts)
        return any(package.hash(path) in hashes for package in packages)

    @cached_property
    def _recorded_packages(self) -> tuple[Package | None, ...]:
        """The packages of the last complete build, and of the model last seen, by which later builds renewed files."""
        record = self.inputs.record
        seen = self.inputs.recorded_package(record.open.seen) if record and record.open else None
        return self.inputs.last_package, seen

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
        found, last = {}, self.inputs.last_package
        for key in self.inputs.recorded_files:
            path = self.inputs.old_path(key)
            artifact = last.artifacts.get(path) if last else None
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
        """Return the lines of each `package.order` that follow from the last complete build, by key.

        Without its model they are those of the recorded files: their order is lost then.
        """
        inputs, found = self.inputs, dict[str, tuple[str, ...]]()
        if inputs.record is None or (inputs.record.snapshot is None and not inputs.record.is_united):
            return found
        if inputs.last_package:
            found = {inputs.old_key(path): names for path, names in inputs.last_package.orders.items()}
        else:
            for key in inputs.recorded_files:
                folder, _, name = key.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
                if f"{folder}/".startswith(inputs.old_key("")) and key.endswith(".mo"):
                    order = f"{folder}/package.order"
                    found[order] = (*found.get(order, ()), name)
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
        inputs, last = self.inputs, self.inputs.last_package
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
    if options.removes:
        nothing = Package((), inputs.templates, robot.target.package)
        return Generation(inputs, inputs.last or Version({}), {}, (), Imported(), nothing, frozenset())
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
    package = generate(domain, snapshot, imported.imports, robot.target, robot.options, inputs.templates)
    changed, record = frozenset(package.artifacts), inputs.record
    is_known = record is not None and record.open is None and not record.is_united and not inputs.written
    if is_known and inputs.last_package and inputs.has_same_generator and not options.full:
        changed = package.changed_since(inputs.last_package)
    return Generation(inputs, now, reading.lines, tuple(found), imported, package, changed)
