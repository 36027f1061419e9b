"""What there is to check of one robot: the package on disk, the one that is generated, and where they differ."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from urdfsync.check import files
from urdfsync.check.files import PackageFiles
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.rendering import Rendering
from urdfsync.files import normalised
from urdfsync.merging.tokens import is_trivia, tokens

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

    def missing_resources(self) -> Iterator[Diagnostic]:
        """Files of the package's own `Resources` that its texts refer to and that are not there."""
        for path in sorted(self.on_disk):
            for number, line in enumerate(self.files.text(path).splitlines(), 1):
                for package, below in _URI.findall(line):
                    file = self._resource(package, below)
                    if file is not None and not file.exists():
                        message = f"it refers to `modelica://{package}/{below}`, and there is no such file"
                        hint = "`urdfsync build` brings back what it imported; else put the file there"
                        yield self.files.diagnostic(
                            Severity.ERROR, "missing-resource", message, path, number, hint=hint
                        )

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


def with_one_edit(package: CheckedPackage, file: str) -> Mapping[str, bytes]:
    """The package with one file edited; the user's own files are in it."""
    own = {path: content for path, content in package.on_disk.items() if path not in package.generated}
    return {**package.generated, **own, file: package.on_disk[file]}


def build_errors(package: CheckedPackage) -> Sequence[Diagnostic]:
    """Errors that a build would report."""
    return [one for one in package.build_result.diagnostics if one.severity is Severity.ERROR]
