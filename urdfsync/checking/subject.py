"""What there is to check of one robot: the package on disk, the one that is generated, and where they differ."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfsync.checking import edits, workspace
from urdfsync.checking.diagnosis.package import Package
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.domain import Domain
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.rendering import Rendering
from urdfsync.outcome import Result


class Subject:
    """One robot as it is now. Nothing is written.

    Raises UrdfsyncError for whatever is wrong with source, state or templates, OSError for what can't be read.
    """

    def __init__(self, config: Config, robot: RobotConfig, request: BuildOptions) -> None:
        self.config, self.robot = config, robot
        self.result: Result = next(iter(build(config, [robot], request)))
        """What a build would do."""
        if self.result.failed:
            raise UrdfsyncError(*self.result.diagnostics)
        self.rendering = Rendering(config, robot, request)
        self.disk: Mapping[str, bytes] = workspace.package_texts(robot.folder)
        """The Modelica files of the package on disk, by their path below it; none if there is no package."""

    @property
    def domain(self) -> Domain:
        """The robot's domain."""
        return self.rendering.domain

    @property
    def built(self) -> bool:
        """Whether there is a package on disk."""
        return bool(self.disk)

    @property
    def in_step(self) -> bool:
        """Whether the package on disk is what a build would leave."""
        return self.built and self.result.in_step

    @functools.cached_property
    def generated(self) -> Mapping[str, bytes]:
        """The files of the package as it is generated, by their path below it."""
        return self.rendering.package(self.rendering.content)

    def generated_from(self, content: bytes) -> Mapping[str, bytes]:
        """The files of the package as it is generated from the source, or from an amended copy of it."""
        same = content == self.rendering.content
        return self.generated if same else self.rendering.package(content)

    @functools.cached_property
    def around(self) -> Mapping[str, bytes]:
        """The files around the package, by their path below the output folder; see `workspace.surroundings`."""
        return workspace.surroundings(self.config, self.robot, self.texts)

    @functools.cached_property
    def users_files(self) -> Mapping[Path, bytes]:
        """The user's files outside of the package, by their absolute path; see `workspace.users_files`."""
        return workspace.users_files(self.config, self.robot)

    @property
    def texts(self) -> Mapping[str, bytes]:
        """What is checked: the package on disk, or what would be generated if there is none."""
        return self.disk or self.generated

    @functools.cached_property
    def package(self) -> Package:
        """The same, with what is known of its files."""
        robot = self.robot
        edited = edits.edited(self.generated, self.disk) if self.in_step else ()
        return Package(robot.target.package, robot.folder, self.texts, shown, self.rendering.owners, edited)

    @property
    def models(self) -> Sequence[str]:
        """The classes that have to compile by themselves, by their names below the package, the main one first."""
        return self.domain.models(self.rendering.snapshot, self.robot.target, self.robot.options)

    @functools.cached_property
    def edited(self) -> Sequence[str]:
        """The edited files that have a part in the main model."""
        benches = {f"{name.replace('.', '/')}.mo" for name in self.models[1:]}
        return [path for path in self.package.edited if path not in benches]

    @functools.cached_property
    def telling(self) -> Sequence[str]:
        """Those of them in which more than comments and blanks differ."""
        return [path for path in self.edited if not edits.is_cosmetic(self.generated[path], self.disk[path])]

    @property
    def findings(self) -> list[Diagnostic]:
        """Errors that a build would report, and what a thorough reading of the source says beyond warnings."""
        robot = self.robot
        reading = self.domain.read(self.rendering.content, shown(robot.source), robot.options, thorough=True)
        errors = [one for one in self.result.diagnostics if one.severity is Severity.ERROR]
        said = [one for one in reading.diagnostics if one.severity is not Severity.WARNING]
        return list(dict.fromkeys([*errors, *said]))
