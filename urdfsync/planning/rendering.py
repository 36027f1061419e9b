"""A robot's package as it is generated from its source now, with nothing of the user's in it. Writes nothing."""

from __future__ import annotations

from collections.abc import Mapping

from urdfsync.config import Config, RobotConfig, shown
from urdfsync.domain import Import, Snapshot
from urdfsync.planning import inputs
from urdfsync.planning.generate import Generated, generate
from urdfsync.planning.situation import Request, Situation


class Rendering:
    """The source of a robot, and packages made from it or from an amended copy of it.

    Raises UrdfsyncError for whatever is wrong with source, state or templates.
    """

    def __init__(self, config: Config, robot: RobotConfig, request: Request) -> None:
        situation = Situation(config, robot, request)
        self.robot, self.domain = robot, situation.domain
        self.content = situation.content
        """The source's bytes."""
        self._templates = situation.templates
        self.snapshot, self._imports = _model(situation)
        """The model of the source, and what is imported for it."""
        inputs.check_options(config, robot, self.domain, self.snapshot)

    def package(self, content: bytes) -> Mapping[str, bytes]:
        """The Modelica files of the package by their path below it; `content` is the source or an amended copy."""
        snapshot = self.snapshot
        if content != self.content:
            snapshot, _ = inputs.read(self.domain, self.robot.options, content, shown(self.robot.source))
        generated = self._generate(snapshot)
        texts = {path: generated.content(path) for path in generated.artifacts}
        orders = {path: "".join(f"{name}\n" for name in names) for path, names in generated.orders.items()}
        return texts | {path: text.encode() for path, text in orders.items()}

    @property
    def owners(self) -> Mapping[str, str]:
        """The element that each file belongs to, in the domain's words, by its path below the package."""
        return {path: artifact.owner for path, artifact in self._generate(self.snapshot).artifacts.items()}

    def _generate(self, snapshot: Snapshot) -> Generated:
        robot = self.robot
        return generate(self.domain, snapshot, self._imports, robot.target, robot.options, self._templates)


def _model(situation: Situation) -> tuple[Snapshot, Mapping[str, Import]]:
    """The recorded model if it still is that of the source, else the one that is read from it."""
    last, recorded = situation.last, situation.recorded
    if last and recorded and situation.heading(recorded.source.snapshot).source == recorded.source:
        return last.snapshot, last.imports or {}
    from urdfsync.planning.renewal import Renewal

    now = Renewal(situation).now
    return now.snapshot, now.imports or {}
