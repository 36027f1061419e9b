"""The records of a robot on disk: their numbers, and how fitted ones get into them as edits."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from urdfsync.analysis.checks.package import RobotPackage, read_package
from urdfsync.analysis.identification.results import FittedNumber
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.files import failure, put, shown
from urdfsync.domain import Role, registry
from urdfsync.domain.experiment import Sample
from urdfsync.domain.regressor import Regressor
from urdfsync.engine.options import BuildOptions
from urdfsync.modelica.parser import parse
from urdfsync.modelica.stamp import with_stamp
from urdfsync.modelica.values import Value, literals, read_values
from urdfsync.project.config import Config, RobotConfig

_NOISE = 0.1
"""A change below this fraction of its standard error is not written: it says nothing, and collides with exports."""
_ITEM = re.compile(r"\[(\d)\]$")
_ELEMENT = re.compile(r"(\w+) (.*)", re.DOTALL)


class RecordValue(NamedTuple):
    """One value in one record."""

    path: str
    """The record's path below the package."""
    value: Value

    @property
    def numbers(self) -> tuple[float, ...] | str | None:
        """The numbers of the value, or its text; None for a formula."""
        return literals(self.value.text)


class Records:
    """The records of a robot, which agree with its source but for the user's edits."""

    def __init__(self, config: Config, package: RobotPackage) -> None:
        self.config, self.package, self.notes = config, package, tuple[Diagnostic, ...]()
        artifacts = package.generation.package.artifacts
        self.paths = [path for path, artifact in artifacts.items() if artifact.role is Role.RECORD]
        self.values = _by_element({path: _text(package.on_disk[path]) for path in self.paths})
        """Values by element, then by path: a link may have a record of its own, and be in that of the whole robot."""
        self._edited = dict(self._edits())
        models = [path for path in package.changed if path not in self.paths]
        if models:
            message = f"{', '.join(models[:3])} edited: the fit takes links and joints as they are generated"
            self.notes = (Diagnostic(Severity.NOTE, "identify", message, shown(package.robot.folder)),)

    def _edits(self) -> Iterator[tuple[tuple[str, str], dict[str, tuple[float, ...]]]]:
        generated = _by_element({path: _text(self.package.generated[path]) for path in self.paths})
        for element, paths in self.values.items():
            edits = dict[str, tuple[float, ...]]()
            for path, copies in paths.items():
                before = generated.get(element, {}).get(path)
                edited = copies[0]
                if before is None or before[0].value.text == edited.value.text:
                    continue
                numbers, message = edited.numbers, f"{element}: {path} is edited to `{edited.value.text}`"
                place = shown(self.package.robot.folder / edited.path), edited.value.line
                if not isinstance(numbers, tuple):
                    raise ConfigError.of("identify", f"{message}, which is no number", *place, hint="write a number")
                if path == "inertial.mass" and numbers[0] <= 0:
                    raise ConfigError.of("identify", message, *place, hint="write a mass above 0")
                if numbers != before[0].numbers:
                    edits[path] = numbers
            if edits and (match := _ELEMENT.fullmatch(element)):
                yield (match[1], match[2]), edits

    def regressor(self) -> Regressor:
        """Return the model of the robot with its edits. Raises UrdfsyncError."""
        robot, inputs = self.package.robot, self.package.inputs
        physics = registry.domain(robot.domain).identification
        if physics is None:
            message = f"robot `{robot.name}` has no joints whose efforts a log could show"
            raise ConfigError.of("identify", message, shown(self.config.file))
        source, imports = inputs.source, self.package.generation.now.imports or {}
        texts = self.package.on_disk
        place = shown(robot.source)
        sample = Sample(source.content, place, robot.target, robot.options, imports, texts, source.companions)
        return physics.read_regressor(sample, self._edited)

    def has(self, element: str, path: str) -> bool:
        """Return whether a number is in a record."""
        return _ITEM.sub("", path) in self.values.get(element, {})

    def write(self, numbers: Sequence[FittedNumber]) -> tuple[str, ...]:
        """Write numbers into the records, as a user would; return the files. Raises UrdfsyncError.

        Nothing is written if one of the files changed since it was read, or if one can't be written. A number stays if
        its change is far below its standard error.
        """
        changes = dict[str, list[tuple[Value, str]]]()
        values = dict[tuple[str, str], list[float]]()
        for number in numbers:
            if not number.is_written or abs(number.after - number.before) < _NOISE * number.conditional:
                continue
            item, path = _ITEM.search(number.path), _ITEM.sub("", number.path)
            numbers_on_disk = self.values[number.element][path][0].numbers
            after = values.setdefault((number.element, path), [*map(float, numbers_on_disk or ())])
            after[int(item[1]) - 1 if item else 0] = float(f"{number.after:.6g}")
        for (element, path), after in values.items():
            words = ", ".join(repr(each).removesuffix(".0") for each in after)
            for record, value in self.values[element][path]:
                changes.setdefault(record, []).append((value, f"{{{words}}}" if value.text.startswith("{") else words))
        folder, contents, former = self.package.robot.folder, dict[Path, bytes](), dict[Path, bytes]()
        for path, of_file in changes.items():
            before = former[folder / path] = read_unrecorded(folder / path)
            if with_stamp(before, None) != self.package.on_disk[path]:
                raise ConfigError.of("identify", "the file was saved meanwhile", shown(folder / path), hint="try again")
            text = _text(before)
            for value, new in sorted(of_file, key=lambda each: -each[0].start):
                text = text[: value.start] + new + text[value.start + len(value.text) :]
            contents[folder / path] = text.encode(errors="surrogateescape")
        written = list[Path]()
        for file, content in contents.items():
            try:
                put(file, content)
            except OSError as error:
                for done in written:  # half of a fit is none
                    put(done, former[done])
                raise failure(error, file) from None
            written.append(file)
        return tuple(file.relative_to(self.config.root).as_posix() for file in contents)


def read_records(config: Config, robot: RobotConfig, wait: float) -> Records:
    """Read the records of a robot. Raises ConfigError if it is out of step or in conflict, or if one is no record."""
    package = read_package(config, robot, BuildOptions(dry=True, wait=wait, jobs=1))
    place = shown(robot.folder)
    if not package.in_step:
        state = "is in conflict" if package.conflicting else "is out of step with its source"
        hint = "resolve the conflicts: `urdfsync resolve`" if package.conflicting else "run `urdfsync build`"
        raise ConfigError.of("identify", f"robot `{robot.name}` {state}", place, hint=hint)
    for path, artifact in package.generation.package.artifacts.items():
        if artifact.role is Role.RECORD:
            text = parse(_text(package.on_disk.get(path, b"")))
            if text.is_broken or [each.kind for each in text.classes] != ["record"]:
                file = shown(robot.folder / path)
                raise ConfigError.of("identify", "the edited file is no single record", file, hint="correct it")
    return Records(config, package)


def _text(content: bytes) -> str:
    return content.decode(errors="surrogateescape")  # with its line ends, so that places in the text are those on disk


def _by_element(texts: Mapping[str, str]) -> dict[str, dict[str, list[RecordValue]]]:
    """Return the values of links and joints by element and path; those of the elements' own records come first."""
    found = dict[str, dict[str, list[RecordValue]]]()
    for path, text in sorted(texts.items(), key=lambda item: "/" not in item[0]):
        prefix = "" if "/" in path else None
        names, values = dict[str, str](), read_values(text)
        for value in values:
            component, _, rest = value.path.rpartition(".")
            if (rest or value.path) == "name" and (prefix is None) == bool(component):
                kind = "link" if value.type.endswith(".Link") else "joint"
                names[component] = f"{kind} {literals(value.text)}"
        for value in values:
            component, _, rest = ("", "", value.path) if prefix == "" else value.path.partition(".")
            if component in names:
                found.setdefault(names[component], {}).setdefault(rest, []).append(RecordValue(path, value))
    return found
