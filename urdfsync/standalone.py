"""A source to one record, without a configuration, a package or a state."""

from __future__ import annotations

from pathlib import Path

import msgspec

from urdfsync import config, registry
from urdfsync.config import shown
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError, Severity, SourceError, UrdfsyncError
from urdfsync.domain import Domain, Reading, Target, Templates
from urdfsync.engine import source as source_
from urdfsync.engine.generate import Package
from urdfsync.files import kind_of, normalised, put, templates_digest
from urdfsync.modelica.names import class_name, is_class_name, is_identifier, is_package_name

_SUFFIX = "Parameters"


class Record(msgspec.Struct, frozen=True):
    """The text of a record, and what there is to say about its source."""

    target: Target
    """Its class, and the package that it says it stands in."""
    text: str
    diagnostics: tuple[Diagnostic, ...]


def make(source: Path, domain_name: str, name: str, within: str, file: Path | None) -> Record:
    """The record of a source, of class `name` within package `within`, either of which may be empty.

    Without a name it is called like the `file` that it goes into, if a class can be, or else after the source.
    Raises ConfigError for names that can't be, SourceError for a source that can't be read as a model.
    """
    domain = registry.domain(domain_name)
    target = Target(_package(within), _class_name(source, name, file))
    options = domain.options()
    snapshot, reading = source_.read(domain, options, _content(source), shown(source))
    return _render(domain, msgspec.structs.replace(reading, snapshot=snapshot), shown(source), target)


def write(record: Record, source: Path, file: Path, force: bool) -> bool:
    """Write the record of a source, as a whole or not at all; whether that was necessary.

    A file that holds something else is replaced with `force` only, the source never. Raises OutputError for that, and
    for what can't be written.
    """
    try:
        found = _present(file)
        if found is not None and normalised(found) == record.text.encode():
            return False
        if found is not None and file.samefile(source):
            raise _problem("output-is-source", "the record would replace its source", file, "name another file")
        if found is not None and not force:
            message, hint = "the file exists, and holds something else", "name another one, or replace it with --force"
            raise _problem("file-exists", message, file, hint)
        put(file.resolve(), record.text.encode())
    except OSError as error:
        hint = "check that its folder exists and may be written to, and that there is space on the disk"
        raise _problem("output-not-writable", f"it can't be written: {error.strerror}", file, hint) from None
    return True


def _render(domain: Domain, reading: Reading, file: str, target: Target) -> Record:
    found = domain.record(reading, file, target, domain.options())
    if found is None:
        message = f"the domain `{domain.name}` has no record of a whole model"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-record", message, hint="use `urdfsync build`"))
    folders = (config.templates_folder(domain),)
    generated = Package([found.artifact], Templates(folders, templates_digest(folders)))
    text = generated.content(found.artifact.path).decode()
    said = sorted([*reading.diagnostics, *found.diagnostics], key=lambda diagnostic: diagnostic.line)
    return Record(target, text, tuple(said))


def _class_name(source: Path, chosen: str, file: Path | None) -> str:
    if chosen and not is_class_name(chosen):
        hint = "choose a name with a capital first that neither Modelica nor urdfsync has a use for"
        raise ConfigError(Diagnostic(Severity.ERROR, "modelica-name", f"{chosen!r} can't be a class", hint=hint))
    stem = file.stem if file is not None else ""
    if chosen or is_class_name(stem):
        return chosen or stem
    return class_name(source.name.partition(".")[0]) + _SUFFIX


def _package(within: str) -> str:
    for part in within.split(".") if within else ():
        if not is_identifier(part) or not is_package_name(part):
            message, hint = f"{within!r} can't be a package", "name one like Plant.Robots"
            raise ConfigError(Diagnostic(Severity.ERROR, "modelica-name", message, hint=hint))
    return within


def _content(source: Path) -> bytes:
    try:
        return source.read_bytes()
    except OSError as error:
        message, hint = f"the source can't be read: {error.strerror}", "name a file that is there and may be read"
        raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(source), hint=hint)) from None


def _present(file: Path) -> bytes | None:
    """What a file holds; None if there is none."""
    try:
        mode = file.stat().st_mode
    except FileNotFoundError:
        return None
    if not file.is_file():
        raise _problem("output-in-the-way", f"{kind_of(mode)} is in its place", file, "name a file")
    return file.read_bytes()


def _problem(code: str, message: str, file: Path, hint: str) -> UrdfsyncError:
    return OutputError(Diagnostic(Severity.ERROR, code, message, shown(file), hint=hint))
