"""Reads a robot's source with other contents of its files, without writing any of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.analysis.patches.literals import find_literals
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.files import shown
from urdfsync.domain import Role, Version, registry
from urdfsync.engine.generation import Generation, with_numbers
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package.generate import generate
from urdfsync.engine.sources import expansion, source
from urdfsync.engine.sources.source import Source
from urdfsync.engine.sources.translators import XACRO, find_translator
from urdfsync.modelica.values import literals, read_values
from urdfsync.project import config as configuration
from urdfsync.project.config import Config, RobotConfig

Key: TypeAlias = tuple[str, str]
"""A value of a record: the path of its file below the package's folder, and its path in the record."""
Contents: TypeAlias = Mapping[Path, bytes]
"""Contents of files that override the disk, by absolute path."""


class Look(NamedTuple):
    """A robot as its source gives it."""

    text: Source
    values: Mapping[Key, tuple[float, ...] | str | None]
    """Numbers of all values in the records, or texts."""
    places: Mapping[str, tuple[str, int]]
    """File and line of each element, as the user wrote them."""


class SourceReader:
    """Reads the source of one robot."""

    def __init__(self, config: Config, robot: RobotConfig, options: BuildOptions, text: Source) -> None:
        self._config, self._robot, self._text = config, robot, text
        paths = (config.root, robot.source, (*robot.package_paths, *options.package_paths))
        self._inputs = expansion.SourceFiles(*paths)
        content = read_unrecorded(robot.source) if self._text.expansion and not robot.command else b""
        self._translator = find_translator(robot.domain, robot.source, content) or XACRO
        names = self._text.expansion.files if self._text.expansion else ()
        found = [path for name in names if (path := self._inputs.path(name)) and path.is_file()]
        others = [robot.source, *(path for _, path in self._companions(robot)), *robot.command_inputs]
        self.files = [path for path in dict.fromkeys([*found, *others]) if path.is_file()]
        self._unchanged: Sequence[float] = ()
        self._unchanged = self.numbers({})

    def contents(self) -> dict[Path, bytes]:
        """Return the contents of all files that the source is made of, and of the configuration. Raises OSError."""
        return {path: read_unrecorded(path) for path in (*self.files, self._config.file)}

    @property
    def can_grow(self) -> bool:
        """Whether the source may have any further attribute: a translator may refuse one."""
        return not self._text.expansion or self._translator is XACRO

    @property
    def name(self) -> str:
        """The robot's name."""
        return self._robot.name

    def numbers(self, contents: Contents) -> Sequence[float]:
        """Return all numbers of the source with these contents, of its companions, and of the inputs of a command."""
        if self._unchanged and not contents.keys() & {*self.files, self._config.file}:
            return self._unchanged
        robot, text = self.read(contents) if contents else (self._robot, self._text)
        given = [contents.get(path) or read_unrecorded(path) for path in robot.command_inputs]
        texts = [text.content, *(each.content for each in text.companions), msgspec.json.encode(robot.options), *given]
        return [each.value for content in texts for each in find_literals(Path(), content)]

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
    text, reading, package = inputs.source, generation.reading, generation.package
    if contents:
        robot, text = reader.read(contents)
        snapshot, reading = source.read(inputs.domain, robot.options, text)
        source.check_options(inputs.config, robot, reading)
        version = with_numbers(inputs.domain, Version(snapshot, generation.imported.imports), [generation.now])
        package = generate(inputs.domain, version, robot.target, robot.options, inputs.templates)
    values = {
        (path, value.path): value.text if (number := literals(value.text)) is None else number
        for path, artifact in package.artifacts.items()
        if artifact.role is Role.RECORD
        for value in read_values(package.content(path).decode())
    }
    places = {path: reading.place(path, text.name) for path in reading.lines}
    return Look(
        text,
        values,
        {path: text.place(line) if file == text.name else (file, line) for path, (file, line) in places.items()},
    )
