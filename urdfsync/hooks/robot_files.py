"""The files of one robot as git names them: those that a commit needs, and those that a build reads and writes."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

from urdfsync import registry
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.dependencies import mark_incomplete, walk_files
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import Lookup
from urdfsync.engine import source
from urdfsync.engine.actions import DELETES, Action, Kind
from urdfsync.engine.imports import find_dependencies
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.parents import files as parent_files
from urdfsync.hooks.index import Index

_UNNEEDED = (Kind.ORPHAN, Kind.NEEDED, Kind.FORGET)
"""Actions on files that a clone can do without."""


class RobotFiles:
    """The files of one robot, as paths from the top of the repository; those outside of it are left out."""

    def __init__(self, index: Index, config: Config, robot: RobotConfig) -> None:
        self._index, self.config, self.robot = index, config, robot
        folder = config.root / STATE_FOLDER / "robots"
        self.state = index.paths([folder / f"{robot.name}.toml", folder / f"{robot.name}.json"])
        """The recorded state."""
        self.folders = tuple(index.paths([robot.folder, folder]))
        """The folders of the package and of the recorded state."""

    def needed(self, actions: Iterable[Action]) -> list[str]:
        """Return what has to be committed: outputs that `actions` are about, recorded state, untracked sources."""
        needed = (action for action in actions if action.kind not in _UNNEEDED)
        outputs = self._index.paths(place for action in needed for place in self._places(action))
        return [*outputs, *self.state, *self.untracked_sources()]

    def to_stage(self, actions: Iterable[Action]) -> tuple[str, ...]:
        """Return what will have to be staged after a build that takes `actions`."""
        outputs = []
        for action in actions:
            if action.writes:
                paths = self._index.paths(self._places(action))
                outputs += [path for path in paths if self._index.tracks(path) or action.kind not in DELETES]
        return tuple(dict.fromkeys([*outputs, *self.state, *self.untracked_sources()]))

    def untracked_sources(self) -> list[str]:
        """Return source and templates that git does not track, unless it is told to ignore them."""
        robot, index = self.robot, self._index
        files = [robot.source, Path(os.path.realpath(robot.source))]
        if files[0] != files[1]:
            mark_incomplete()  # the target of a link is not recorded as a dependency
        if robot.templates is not None:
            files += sorted(path for path in map(Path, walk_files(robot.templates)) if not path.name.startswith("."))
        untracked = [path for path in index.paths(files) if not index.tracks(path) and (index.top / path).is_file()]
        if untracked:
            mark_incomplete()  # git decides
        ignored = index.ignored(untracked)
        return [path for path in untracked if path not in ignored]

    def find_inputs(self, paths: Collection[str], options: BuildOptions) -> set[str]:
        """Return those of the paths that a build may read.

        Files that the source refers to are found only if neither source nor configuration is among the paths.
        """
        if not paths:
            return set()
        robot, index = self.robot, self._index
        own = index.paths([self.config.file, robot.source, Path(os.path.realpath(robot.source))])
        templates = index.path(robot.templates) if robot.templates else None
        found = {path for path in paths if path in own or (templates and path.startswith(f"{templates}/"))}
        if found:
            return found
        dependencies = set(index.paths(self._dependencies(options)))
        return {path for path in paths if path in dependencies or path.rpartition("/")[2] == "package.xml"}

    def find_outputs(self, paths: Collection[str]) -> set[str]:
        """Return those of the paths that a build may write, or that are in the place of such a file."""
        if not paths:
            return set()
        own = {*self.state, *self._index.paths(map(Path, parent_files(self.robot)))}
        folder = self._index.path(self.robot.folder)
        return {path for path in paths if path in own or (folder and path.startswith(f"{folder}/"))}

    def _places(self, action: Action) -> Iterator[Path]:
        place = Path(os.path.normpath(self.config.root / action.path))
        yield place
        folder = place.with_suffix("") / "package.mo"
        if not place.is_file() and place.suffix == ".mo" and folder.is_file():
            yield folder  # the user made the class a folder

    def _dependencies(self, options: BuildOptions) -> Iterator[Path]:
        """Return the files that the source may refer to; none if that can't be read, which the build reports."""
        robot = self.robot
        lookup = Lookup(robot.source, robot.package_paths + options.package_paths)
        try:
            domain, content = registry.domain(robot.domain), source.read_source(self.config, robot)
            snapshot, reading = source.read(domain, robot.options, content, robot.source_text)
            found = find_dependencies(domain, snapshot, lookup, robot.options, reading.lines)
        except (UrdfsyncError, OSError):
            return
        for dependency in found:
            for candidate in dependency.candidates:
                yield candidate
                yield Path(os.path.realpath(candidate))
