"""What there is to check of one robot: the package on disk, the one that is generated, and where they differ."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfsync.check import files
from urdfsync.check.files import PackageFiles
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.rendering import Rendering
from urdfsync.files import normalised
from urdfsync.merge.tokens import is_trivia, tokens

_URI = re.compile(r'"modelica://([^/"\\]+)/([^"\\]+)"')


class CheckedPackage:
    """One robot as it is now. Nothing is written.

    Raises UrdfsyncError for whatever is wrong with source, state or templates, OSError for what can't be read.
    """

    def __init__(self, config: Config, robot: RobotConfig, request: BuildOptions) -> None:
        self.config, self.robot = config, robot
        (self.build_result,) = build(config, [robot], request)
        if self.build_result.failed:
            raise UrdfsyncError(*self.build_result.diagnostics)
        self.rendering = Rendering(config, robot, request)
        self.domain = self.rendering.domain
        self.on_disk: Mapping[str, bytes] = files.package_texts(robot.folder)
        """The Modelica files of the package on disk, by their path below it; none if there is no package."""
        self.is_built = bool(self.on_disk)
        self.in_step = self.is_built and self.build_result.in_step
        self.generated = self.rendering.package(self.rendering.content)
        """The files of the package as it is generated, by their path below it."""
        self.texts = self.on_disk or self.generated
        """What is checked."""
        self.around = files.files_around(config, robot, self.texts)
        self.users_files = files.users_files(config, robot)
        edited = edited_files(self.generated, self.on_disk) if self.in_step else []
        self.files = PackageFiles(robot.target.package, robot.folder, self.texts, self.rendering.owners, edited)
        self.models = self.domain.models(self.rendering.snapshot, robot.target, robot.options)
        """The classes that have to compile by themselves, by their names below the package, the main one first."""

    @functools.cached_property
    def edits(self) -> list[str]:
        """The edited files that have a part in the main model."""
        benches = {f"{name.replace('.', '/')}.mo" for name in self.models[1:]}
        return [path for path in self.files.edited if path not in benches]

    @functools.cached_property
    def meaningful_edits(self) -> list[str]:
        """Those of them in which more than comments and blanks differ."""
        return [path for path in self.edits if not is_cosmetic(self.generated[path], self.on_disk[path])]

    def source_diagnostics(self) -> list[Diagnostic]:
        """Errors that a build would report, and what a thorough reading of the source says beyond warnings."""
        errors = [one for one in self.build_result.diagnostics if one.severity is Severity.ERROR]
        robot = self.robot
        reading = self.domain.read(self.rendering.content, shown(robot.source), robot.options, thorough=True)
        return list(
            dict.fromkeys([*errors, *(one for one in reading.diagnostics if one.severity is not Severity.WARNING)])
        )

    def with_one_edit(self, file: str) -> Mapping[str, bytes]:
        """The package with one file edited; the user's own files are in it."""
        own = {path: content for path, content in self.on_disk.items() if path not in self.generated}
        return {**self.generated, **own, file: self.on_disk[file]}

    def missing_resources(self) -> Iterator[Diagnostic]:
        """Files below the package's own folders that its texts refer to and that are not there, once for each text."""
        hint = "`urdfsync build` brings back what it imported; else put the file there"
        for path in sorted(self.on_disk):
            text, addresses = self.files.text(path), set[str]()
            for found in _URI.finditer(text):
                file = self._resource(found[1], found[2])
                if file is not None and found[0] not in addresses and not file.exists():
                    addresses.add(found[0])
                    line = text.count("\n", 0, found.start()) + 1
                    message = f"it refers to `{found[0][1:-1]}`, and there is no such file"
                    yield self.files.diagnostic(Severity.ERROR, "missing-resource", message, path, line, hint=hint)

    def _resource(self, package: str, below: str) -> Path | None:
        """Where a `modelica://` address leads; None if it is not in the robot's package or one around it."""
        own, folder = self.robot.target.package, self.robot.output.joinpath(*package.split("."))
        is_ours = f"{own}.".startswith(f"{package}.") or package.startswith(f"{own}.")
        return folder / below if is_ours and folder.is_dir() else None


def edited_files(generated: Mapping[str, bytes], on_disk: Mapping[str, bytes]) -> list[str]:
    """The Modelica files that differ from what is generated, by their path below the package."""
    paths = (path for path in sorted(generated) if path.endswith(".mo") and path in on_disk)
    return [path for path in paths if normalised(on_disk[path]) != generated[path]]


def is_cosmetic(old: bytes, new: bytes) -> bool:
    """Whether two texts differ in comments, blanks and ends of line only."""
    one, two = ([t for t in tokens(text.decode(errors="replace")) if not is_trivia(t)] for text in (old, new))
    return one == two
