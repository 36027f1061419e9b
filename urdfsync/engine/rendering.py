"""A robot's package as it is generated from its source now, without the user's edits. Writes nothing."""

from __future__ import annotations

from collections.abc import Mapping

from urdfsync.config import Config, RobotConfig
from urdfsync.domain import Import, Snapshot
from urdfsync.engine import source
from urdfsync.engine.generate import Package, generate
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inputs import inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.files import shown


class Rendering:
    """The source of a robot, and packages made from it or from an amended copy of it.

    Raises UrdfsyncError for whatever is wrong with source, state or templates.
    """

    def __init__(self, config: Config, robot: RobotConfig, options: BuildOptions) -> None:
        inputs = inspect(config, robot, options)
        self.robot, self.domain = robot, inputs.domain
        self.source, self.content = inputs.source, inputs.source.content
        self._templates = inputs.templates
        self._imports: Mapping[str, Import]
        with inputs.source.locating():
            generation = generate_robot(inputs)
        self.snapshot, self._imports = generation.now.snapshot, generation.imported.imports
        source.check_options(config, robot, self.domain, self.snapshot)

    def package(self, content: bytes) -> Mapping[str, bytes]:
        """Return the Modelica files of the package by path; `content` is the source or an amended copy."""
        snapshot = self.snapshot
        if content != self.content:
            snapshot, _ = source.read(self.domain, self.robot.options, content, shown(self.robot.source))
        package = self._generate(snapshot)
        texts = {path: package.content(path) for path in package.artifacts}
        orders = {path: "".join(f"{name}\n" for name in names) for path, names in package.orders.items()}
        return texts | {path: text.encode() for path, text in orders.items()}

    @property
    def owners(self) -> Mapping[str, str]:
        """The element that each file belongs to, in the domain's words, by path."""
        return {path: artifact.owner for path, artifact in self._generate(self.snapshot).artifacts.items()}

    def _generate(self, snapshot: Snapshot) -> Package:
        robot = self.robot
        return generate(self.domain, snapshot, self._imports, robot.target, robot.options, self._templates)
