"""Sources without a project."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync import config, registry
from urdfsync.diagnostics import ConfigError, Diagnostic
from urdfsync.domain import Target
from urdfsync.engine import source as sources
from urdfsync.engine.generate import Package
from urdfsync.files import shown
from urdfsync.modelica.names import class_name, is_class_name, is_identifier, is_package_name
from urdfsync.output.console import StyledLine, findings, html, line

_SUFFIX = "Parameters"


class WholeRecord(msgspec.Struct, frozen=True):
    """A whole robot as one record of Modelica."""

    text: str
    class_: str
    within: str
    """The package that it is in; empty for none."""
    diagnostics: tuple[Diagnostic, ...]

    def _repr_html_(self) -> str:
        lines: list[StyledLine] = findings(self.diagnostics, quiet=False, verbose=False)
        return html([*lines, *(line((text, "")) for text in self.text.splitlines())])


def record(
    source: Path | str,
    *,
    class_: str = "",
    within: str = "",
    domain: str = "urdf",
    arguments: Mapping[str, str] | None = None,
) -> WholeRecord:
    """Return the record of a source, as `urdfsync record` writes it; for xacro, with its `arguments`.

    The record is called `class_`, or by the source. Raises SourceError for a source that can't be read, and ConfigError
    for a name that can't be used.
    """
    source, target, form = Path(source), _target(class_, within, Path(source)), registry.domain(domain)
    text = sources.read_file_source(source, arguments or {}, config.ros_package_path(os.environ))
    with text.locating():
        snapshot, reading = sources.read(form, form.permissive_options(), text.content, text.name)
    reading = msgspec.structs.replace(reading, snapshot=snapshot)
    recorded = form.record(reading, shown(source), target, form.options())
    if recorded is None:
        message = f"the domain `{form.name}` has no record of a whole model"
        raise ConfigError.of("no-record", message, hint="use `urdfsync build`")
    artifact, told = recorded
    generated = Package([artifact], sources.domain_templates(form), target.package)
    all_findings = [*text.diagnostics, *map(text.locate, (*reading.diagnostics, *told))]
    diagnostics = tuple(sorted(all_findings, key=lambda finding: finding.line))
    return WholeRecord(generated.content(artifact.path).decode(), target.name, within, diagnostics)


def _target(name: str, within: str, source: Path) -> Target:
    """Return the class: the chosen one, else one after the source. Raises ConfigError."""
    if name and not is_class_name(name):
        hint = "choose one that begins with a capital and is not reserved by Modelica or urdfsync"
        raise ConfigError.of("modelica-name", f"{name!r} can't be a class", hint=hint)
    if within and not all(is_identifier(part) and is_package_name(part) for part in within.split(".")):
        raise ConfigError.of("modelica-name", f"{within!r} can't be a package", hint="name one like Plant.Robots")
    return Target(within, name or class_name(source.name.partition(".")[0]) + _SUFFIX)
