"""Generates one robot from its present source: model, imported files, and the texts of its package."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.files import shown
from urdfsync.domain import Domain, ElementKey, Lookup, Reading, Role, Version
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import with_line_ends
from urdfsync.engine.package import imports
from urdfsync.engine.package.generate import Package, generate
from urdfsync.engine.package.imports import Imported
from urdfsync.engine.renames import check_declared, find_matching, pending
from urdfsync.engine.sources import source
from urdfsync.engine.sources.source import Source


class Generation(msgspec.Struct, frozen=True):
    """The model of a source, and the package that follows from it."""

    now: Version
    """The model of the source, with its imports."""
    reading: Reading
    """The reading of the source, with the line of each element."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings about source, options and imports, at the lines that the user wrote."""
    imported: Imported
    package: Package

    def content(self, path: str, role: Role, mine: bytes) -> bytes | None:
        """Return a file's content, with the line ends of `mine` in texts; None for a missing import."""
        if role is Role.IMPORT:
            return self.imported.contents.get(path)
        return with_line_ends(self.package.content(path), mine)


def generate_robot(inputs: Inputs) -> Generation:
    """Parse the source, import the files that it refers to, and generate the package.

    Only texts with new data are rendered. Raises SourceError, ConfigError or OutputError.
    """
    if inputs.options.removes:
        nothing = Package((), inputs.templates, inputs.robot.target.package)
        return Generation(inputs.last.version or Version(None), Reading(None, ()), (), Imported(), nothing)
    domain, robot, options, last = inputs.domain, inputs.robot, inputs.options, inputs.last
    file = shown(robot.source)
    with inputs.source.locating():
        snapshot, reading = source.read(domain, robot.options, inputs.source)
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
        version = with_numbers(domain, Version(snapshot, imported.imports), last.formers, pending(inputs))
        noted = last.notes.texts if last.notes.program == inputs.program and not options.full else {}
        package = generate(domain, version, robot.target, robot.options, inputs.templates, noted, last.base)
    for path in package.artifacts:
        package.hash(path)  # renders the text, if it is new: a fault of a template is told here
    return Generation(version, reading, tuple(map(inputs.source.locate, findings)), imported, package)


def with_numbers(domain: Domain, new: Version, formers: Sequence[Version], declared: Mapping[str, str] = {}) -> Version:
    """Return a version whose numbered parts have the numbers of former versions; `declared` has renames of elements."""

    def find_renames(old: Version) -> Mapping[ElementKey, str]:
        return find_matching(domain, old.snapshot, new.snapshot, declared).renames

    return msgspec.structs.replace(new, snapshot=domain.numbered(new, formers, find_renames))


def generated_texts(
    inputs: Inputs, generation: Generation, amended: tuple[Source, Any] | None = None
) -> Mapping[str, bytes]:
    """Return the Modelica files of the package by path; `amended` has another source and other options."""
    package = generation.package
    if amended is not None:
        text, options = amended
        snapshot, _ = source.read(inputs.domain, options, text)
        version = with_numbers(inputs.domain, Version(snapshot, generation.imported.imports), [generation.now])
        package = generate(inputs.domain, version, inputs.robot.target, options, inputs.templates)
    orders = {path: "".join(f"{name}\n" for name in names).encode() for path, names in package.orders.items()}
    return {path: package.content(path) for path in package.artifacts} | orders
