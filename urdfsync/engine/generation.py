"""One robot generated from its source as it is now: model, imported files, and the texts of its package."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property
from typing import Any

import msgspec

from urdfsync import changes
from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import ChangeClass, ElementKey, Features, Lookup, Role, Version, displaced
from urdfsync.engine import imports, source
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.imports import Imported
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.last_build import NO_MODEL, option_values
from urdfsync.engine.renames import check_declared, find_matching_since, pending
from urdfsync.files import shown
from urdfsync.matching import Matching, without_exchanges
from urdfsync.state.record import FileRecord

GONE = "_gone"
"""Stands behind the name of a removed element if another element has that name now."""


class Generation(msgspec.Struct, frozen=True, dict=True):
    """The model and the package of one build, and their differences from the last complete build."""

    inputs: Inputs
    now: Version
    """The model of the source, with its imports."""
    lines: Mapping[str, int]
    """Line of each element in the source."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings about source, options and imports."""
    imported: Imported
    package: Package

    @cached_property
    def matching(self) -> Matching:
        """The matches between the elements of the last complete build and those of now.

        A stranger may have written the recorded model: names count as exchanged only if the package on disk agrees.
        """
        declared, last = pending(self.inputs), self.inputs.last
        matching = self._match(declared)
        if last.version is None or not matching.renames:
            return matching
        old = self.elements_before
        if last.record.is_united:  # a united record has elements of both branches: a name may mean either
            return Matching(without_exchanges(matching, old).renames)
        found = {key: new for key, new in matching.renames.items() if key[1] not in declared}
        exchanged = {f"{kind} {name}" for (kind, name), new in found.items() if (kind, new) in old}
        return matching if self._agrees(exchanged) else without_exchanges(matching, old)

    def _agrees(self, owners: Collection[str]) -> bool:
        """Whether the unedited records of these elements equal those of the recorded model."""
        last, files, package = self.inputs.last, self.inputs.files, self.inputs.last.package
        if package is None or not owners:
            return not owners
        for path, artifact in package.artifacts.items():
            if artifact.owner in owners and artifact.role is Role.RECORD:
                on_disk = files.hash(last.folder.key(path), Role.RECORD)
                recorded = last.files.get(last.folder.key(path), FileRecord()).hashes
                if last.record.open and on_disk in last.notes.written:
                    continue  # an incomplete build has renewed the record
                if on_disk in recorded and package.hash(path) != on_disk:
                    return False
        return True

    @property
    def renames(self) -> Mapping[ElementKey, str]:
        """Renamed elements since the last complete build: old element → new name."""
        return self.matching.renames

    @cached_property
    def other_elements(self) -> Mapping[str, str]:
        """Maps each name that another element has now to the new name of the element that had it before."""
        last = self.inputs.last
        if not (self.renames and last.version):
            return {}
        gone = {name: f"{name}{GONE}" for _, name in displaced(self.renames)}
        return {**gone, **{key[1]: new for key, new in self.renames.items() if key in self.elements_now}}

    @cached_property
    def has_exchanges(self) -> bool:
        """Whether an element has the former name of another one."""
        return any((kind, new) in self.elements_before for (kind, _), new in self.renames.items())

    @cached_property
    def elements_before(self) -> Mapping[ElementKey, Features]:
        """The elements of the last complete build, with their features."""
        last = self.inputs.last.version
        return {} if last is None else self.inputs.domain.features(last.snapshot)

    @cached_property
    def elements_now(self) -> Mapping[ElementKey, Features]:
        """The elements of the source, with their features."""
        return self.inputs.domain.features(self.now.snapshot)

    @property
    def undeclared_renames(self) -> Mapping[ElementKey, str]:
        """The renames that the configuration does not declare: a declaration may be taken back."""
        return self._match({}).renames if pending(self.inputs) else self.renames

    def _match(self, declared: Mapping[str, str]) -> Matching:
        last, domain = self.inputs.last, self.inputs.domain
        if last.version is None:
            return Matching()
        open_ = last.record.open.renamed if last.record.open else {}
        versions = last.version.snapshot, last.seen, open_, self.now.snapshot
        return find_matching_since(domain, *versions, declared)

    @cached_property
    def changes(self) -> Changes | None:
        """Changes since the last complete build; None if unknown, and for a removed robot."""
        last, robot = self.inputs.last, self.inputs.robot
        if last.version is None or self.inputs.options.removes:
            return None
        try:
            differences = changes.compare(last.version, self.now, self.inputs.domain, robot.options, self.matching)
        except NO_MODEL:
            return None
        if differences.change_class.rank >= ChangeClass.STRUCTURAL.rank and last.package is None:
            return None  # git may have merged two models into an invalid one
        if self.inputs.domain.describe is None and differences.changes and last.package is not None:
            differences = changes.by_texts(differences, self.package.changed_models(last.package))
        is_same = last.record.generator == self.inputs.generator and last.target == robot.target
        if is_same and last.record.options == option_values(robot.options):
            return differences
        options: list[str] = []
        if is_same and last.options is not None:
            names = robot.options.__struct_fields__
            options = [name for name in names if getattr(last.options, name) != getattr(robot.options, name)]
        return msgspec.structs.replace(differences, generator=True, options=tuple(options))

    @cached_property
    def paths_by_hash(self) -> Mapping[str, str]:
        """The path of each generated text, by its hash."""
        return {self.package.hash(path): path for path in self.package.artifacts}

    @property
    def is_structural(self) -> bool:
        """Whether files or names may come or go. False if only numbers changed since the last complete build."""
        if self.changes is None or self.changes.change_class.rank >= ChangeClass.STRUCTURAL.rank:
            return True
        return bool(self.respelled)

    @cached_property
    def respelled(self) -> Mapping[str, tuple[str, str]]:
        """Recorded classes to which this program gives another name, see `LastBuild.respelled`."""
        last = self.inputs.last
        classes = (last.folder.path(key) for key in last.files if key.endswith(".mo"))
        return {} if all(path in self.package.artifacts for path in classes) else last.respelled

    @cached_property
    def moves(self) -> dict[str, str]:
        """The old key of each text file that moves with its element or with the package, by its new key."""
        inputs, last = self.inputs, self.inputs.last
        texts = set(map(last.folder.path, last.files))
        if not (self.is_structural or inputs.has_moved):
            return {}
        recorded = last.package.artifacts if last.package else {}
        before = {path: (file.owner, file.template) for path, file in recorded.items() if path in texts}
        for path, (respelled, _) in self.respelled.items():
            before[path] = recorded[respelled].owner, recorded[respelled].template
        now = {path: (file.owner, file.template) for path, file in self.package.artifacts.items()}
        if before == now and not (inputs.has_moved or self.renames):
            return {}
        renamed = changes.moved_files(before, now, self.renames)
        pairs = ((renamed.get(path, path), path) for path in texts)
        keys = ((inputs.folder.key(new), last.folder.key(old)) for new, old in pairs if new in now)
        return {new: old for new, old in keys if new != old}


def generate_robot(inputs: Inputs) -> Generation:
    """Parse the source, import the files that it refers to, and generate the package; no text is rendered yet.

    Raises SourceError, ConfigError or OutputError.
    """
    if inputs.options.removes:
        nothing = Package((), inputs.templates, inputs.robot.target.package)
        return Generation(inputs, inputs.last.version or Version(None), {}, (), Imported(), nothing)
    with inputs.source.locating():
        return _generate(inputs)


def _generate(inputs: Inputs) -> Generation:
    domain, robot, options, last = inputs.domain, inputs.robot, inputs.options, inputs.last
    file = shown(robot.source)
    snapshot, reading = source.read(domain, robot.options, inputs.source.content, file)
    findings = [
        *inputs.source.diagnostics,
        *reading.diagnostics,
        *source.check_options(inputs.config, robot, reading),
        *check_declared(inputs, snapshot),
    ]
    lookup = Lookup(robot.source, robot.package_paths + options.package_paths)
    dependencies = imports.find_dependencies(domain, snapshot, lookup, robot.options, reading.lines)
    imported = imports.import_files(
        domain, robot, options, dependencies, last.imports, file, has_moved=inputs.has_moved
    )
    lines = {dependency.key: dependency.line for dependency in dependencies}
    findings += imported.diagnostics
    for key, finding in domain.imports.findings(imported.imports, snapshot) if domain.imports else ():
        findings.append(msgspec.structs.replace(finding, file=file, line=lines.get(key, 0)))
    package = generate(domain, snapshot, imported.imports, robot.target, robot.options, inputs.templates)
    if last.notes.program == inputs.program and not options.full:
        package.skip(last.notes.texts, last.base)
    return Generation(inputs, Version(snapshot, imported.imports), reading.lines, tuple(findings), imported, package)


def generated_texts(generation: Generation, amended: tuple[bytes, Any] | None = None) -> Mapping[str, bytes]:
    """Return the Modelica files of the package by path; `amended` are another source and other options."""
    inputs, package = generation.inputs, generation.package
    if amended is not None:
        content, options = amended
        snapshot, _ = source.read(inputs.domain, options, content, shown(inputs.robot.source))
        imported, target = generation.imported.imports, inputs.robot.target
        package = generate(inputs.domain, snapshot, imported, target, options, inputs.templates)
    orders = {path: "".join(f"{name}\n" for name in names).encode() for path, names in package.orders.items()}
    return {path: package.content(path) for path in package.artifacts} | orders
