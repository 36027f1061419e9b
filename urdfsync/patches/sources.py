"""Reads a robot's source with other contents of its files, without writing any of them."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync import config as configuration
from urdfsync import registry
from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies.facts import read_unrecorded
from urdfsync.domain import Role, Version
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package.generate import generate
from urdfsync.engine.sources import expansion, source
from urdfsync.engine.sources.source import Source
from urdfsync.engine.sources.translators import XACRO, find_translator
from urdfsync.files import shown
from urdfsync.modelica.values import literals, read_values
from urdfsync.state.store import Store

Key: TypeAlias = tuple[str, str]
"""A value of a record: the path of its file below the package's folder, and its path in the record."""
Contents: TypeAlias = Mapping[Path, bytes]
"""Contents of files that override the disk, by absolute path."""


class Look(NamedTuple):
    """A robot as its source gives it."""

    text: Source
    texts: Mapping[str, str]
    """The generated records, by path below the package's folder."""
    values: Mapping[Key, tuple[float, ...] | str | None]
    """Numbers of all values in these records, or texts."""
    lines: Mapping[str, int]
    """Line of each element in the expanded source."""


class SourceReader:
    """Reads the source of one robot."""

    def __init__(self, config: Config, robot: RobotConfig, options: BuildOptions) -> None:
        """Raises UrdfsyncError for a source that can't be read."""
        self._config, self._robot, self._options = config, robot, options
        self._text = source.read_source(config, robot, Store(config.root), options)
        paths = (config.root, robot.source, (*robot.package_paths, *options.package_paths))
        self._inputs = expansion.SourceFiles(*paths)
        content = read_unrecorded(robot.source) if self._text.expansion and not robot.command else b""
        self._translator = find_translator(robot.domain, robot.source, content) or XACRO
        names = self._text.expansion.files if self._text.expansion else ()
        found = [path for name in names if (path := self._inputs.path(name)) and path.is_file()]
        others = [robot.source, *(path for _, path in self._companions(robot)), config.file, *robot.command_inputs]
        self.files = [path for path in dict.fromkeys([*found, *others]) if path.is_file()]

    def contents(self) -> dict[Path, bytes]:
        """Return the contents of all files that the source is made of, and of the configuration. Raises OSError."""
        return {path: read_unrecorded(path) for path in self.files}

    @property
    def name(self) -> str:
        """The robot's name."""
        return self._robot.name

    def is_fed(self, contents: Contents) -> bool:
        """Whether these contents change what the robot is read from. Raises UrdfsyncError."""
        if not contents.keys() & {*self.files}:
            return False
        return bool(contents.keys() & {*self._robot.command_inputs}) or self.read(contents) != self._unchanged

    @functools.cached_property
    def _unchanged(self) -> tuple[RobotConfig, Source]:
        return self.read({})

    def _companions(self, robot: RobotConfig) -> list[tuple[str, Path]]:
        """Return the companions of the source: option and path of each, in the order of `Source.companions`."""
        domain = registry.domain(robot.domain)
        kinds = [kind for kind in domain.companions if getattr(robot.options, kind.option)]
        return [(kind.option, self._config.root / getattr(robot.options, kind.option)) for kind in kinds]

    def read(self, contents: Contents) -> tuple[RobotConfig, Source]:
        """Return the robot's configuration and its source for these contents. Raises UrdfsyncError."""
        config, robot, text = self._config, self._robot, self._text
        if config.file in contents:
            read = contents[config.file].decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
            robots = configuration.parse(read, config.file, shown(config.file)).robots
            robot = next((each for each in robots if each.name == robot.name), robot)
        if text.expansion and not robot.command:
            given = {str(path): content for path, content in contents.items()}
            made = expansion.expand(self._inputs, robot.arguments or {}, given, self._translator)
            text = Source(
                made.text.encode(), text.name, self._inputs.places(made), (), made, companions=text.companions
            )
        elif robot.source in contents:
            text = msgspec.structs.replace(text, content=contents[robot.source])
        places = dict(self._companions(robot))
        companions = tuple(
            msgspec.structs.replace(each, content=contents.get(places.get(each.option, Path()), each.content))
            for each in text.companions
        )
        return robot, msgspec.structs.replace(text, companions=companions)


def look(reader: SourceReader, inputs: Inputs, generation: Generation, contents: Contents) -> Look:
    """Read a robot's source with these contents, and generate its records. Raises UrdfsyncError."""
    robot, text = reader.read(contents)
    snapshot, reading = source.read(inputs.domain, robot.options, text)
    source.check_options(inputs.config, robot, reading)
    version = Version(snapshot, generation.imported.imports)
    package = generate(inputs.domain, version, robot.target, robot.options, inputs.templates)
    records = [path for path, artifact in package.artifacts.items() if artifact.role is Role.RECORD]
    texts = {path: package.content(path).decode() for path in records}
    values = {
        (path, value.path): value.text if (number := literals(value.text)) is None else number
        for path, text_of_record in texts.items()
        for value in read_values(text_of_record)
    }
    return Look(text, texts, values, reading.lines)
