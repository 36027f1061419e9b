"""How one robot stands between the index of git and the working tree: what of it is staged, what is not.

Nothing is written, and as long as all is in step, nothing is read or rendered that a build would not look at.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.dependencies import mark_incomplete
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.domain import Snapshot
from urdfsync.engine.actions import DELETES, Action, Kind
from urdfsync.engine.inputs import NO_MODEL, Inputs, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_if_current
from urdfsync.staging.staged import Index

_OWN = (Kind.ORPHAN, Kind.NEEDED, Kind.FORGET)
"""What happens to files that a clone can do without."""


class Worktree:
    """The robots of one configuration, as they are in the working tree."""

    def __init__(self, index: Index, config: Config, request: BuildOptions) -> None:
        """`request` must be a dry one."""
        self.index, self.config, self._request = index, config, request

    def settled(self, robot: RobotConfig) -> Sequence[Action] | None:
        """The plan if a build has nothing to do, found out without reading or rendering anything anew; else None."""
        try:
            work = plan_if_current(self.config, robot, self._request)
        except (UrdfsyncError, OSError):
            return None  # said by the build that this leads to
        return work.actions if work else None

    def is_committed(self, robot: RobotConfig) -> bool:
        """Whether a build has nothing to do, and all of the robot is staged as it is."""
        return self.committed(robot) is not None

    def committed(self, robot: RobotConfig) -> set[str] | None:
        """All of the robot that is staged, if it is staged as it is and a build has nothing to do; else None."""
        actions = self.settled(robot)
        files = None if actions is None else [*self.files(robot, actions)]
        if files is None or self.lacking(files):
            return None
        paths = map(self.index.path, (*files, *_sources(robot)))
        return {path for path in paths if path is not None and self.index.tracks(path)}

    def lacking(self, files: Iterable[Path]) -> tuple[str, ...]:
        """Those of the files that are not staged as they are, gone ones included, by their path in the repository."""
        index = self.index
        found = dict.fromkeys(path for file in files if (path := index.path(file)) is not None)
        return tuple(
            path for path in found if path in index.changed or (not index.tracks(path) and (index.top / path).is_file())
        )

    def files(self, robot: RobotConfig, actions: Iterable[Action]) -> Iterator[Path]:
        """What has to be committed with a robot: outputs that `actions` are about, recorded state, sources."""
        for action in actions:
            if action.kind not in _OWN:
                yield from self._places(action)
        yield from self.state(robot)
        yield from self.sources(robot)

    def expected(self, robot: RobotConfig, actions: Iterable[Action]) -> tuple[str, ...]:
        """What will have to be staged after a build that takes `actions`, by its path in the repository."""
        index = self.index
        files = [
            (place, action.kind in DELETES) for action in actions if action.writes for place in self._places(action)
        ]
        files += [(file, False) for file in self.state(robot)]
        paths = {path: gone for file, gone in files if (path := index.path(file)) is not None}
        coming = (path for path, gone in paths.items() if index.tracks(path) or not gone)
        return tuple(dict.fromkeys((*coming, *self.lacking(self.sources(robot)))))

    def _places(self, action: Action) -> Iterator[Path]:
        place = Path(os.path.normpath(self.config.root / action.path))
        yield place
        folder = place.with_suffix("") / "package.mo"
        if not place.is_file() and place.suffix == ".mo" and folder.is_file():
            yield folder  # the class is a folder by now

    def state(self, robot: RobotConfig) -> list[Path]:
        """The files of the robot's recorded state."""
        folder = self.config.root / STATE_FOLDER / "robots"
        return [folder / f"{robot.name}.toml", folder / f"{robot.name}.json"]

    def sources(self, robot: RobotConfig) -> list[Path]:
        """Source and templates that git does not track, unless it is told to ignore them."""
        paths = {file: path for file in _sources(robot) if (path := self.index.path(file)) is not None}
        untracked = {file: path for file, path in paths.items() if not self.index.tracks(path) and file.is_file()}
        if untracked:
            mark_incomplete()  # git decides
        ignored = self.index.ignored(sorted(set(untracked.values()))) if untracked else set()
        return [file for file, path in untracked.items() if path not in ignored]

    def inputs(self, robot: RobotConfig, among: Collection[str]) -> set[str]:
        """Those of some files of the repository that a build may read.

        Of the files that the source refers to only if the source itself is none of them.
        """
        if not among:
            return set()
        paths = set(map(self.index.path, (self.config.file, robot.source, Path(os.path.realpath(robot.source)))))
        templates = self.index.path(robot.templates) if robot.templates else None
        found = {path for path in among if path in paths or (templates and path.startswith(f"{templates}/"))}
        if found:
            return found
        paths = set(map(self.index.path, self._dependencies(robot)))
        return {path for path in among if path in paths or path.rpartition("/")[2] == "package.xml"}

    def products(self, robot: RobotConfig, among: Collection[str]) -> set[str]:
        """Those of some files of the repository that a build may write, or that are in the place of such a file."""
        paths = {self.index.path(file) for file in (*self.state(robot), *around(robot))}
        folder = self.index.path(robot.folder)
        inside = f"{folder}/" if folder else None
        return {path for path in among if path in paths or (inside and path.startswith(inside))}

    def _dependencies(self, robot: RobotConfig) -> Iterator[Path]:
        try:
            inputs = inspect(self.config, robot, self._request)
            model = inputs.state.model if inputs.state else None
            known = inputs.recorded is not None and inputs.recorded.source.hash == inputs.source.hash
            snapshot: Snapshot = model.snapshot if model is not None and known else _read(inputs)
            found = inputs.dependencies(snapshot, {})
        except (UrdfsyncError, OSError, *NO_MODEL):
            return  # said by the build that this leads to
        for dependency in found:
            for candidate in dependency.candidates:
                yield candidate
                yield Path(os.path.realpath(candidate))


def _read(inputs: Inputs) -> Snapshot:
    return inputs.domain.read(inputs.content, inputs.robot.source_text, inputs.robot.options).snapshot or {}


def _sources(robot: RobotConfig) -> list[Path]:
    """Source and templates, whatever git makes of them."""
    files = [robot.source, Path(os.path.realpath(robot.source))]
    if files[0] != files[1]:
        mark_incomplete()  # nobody takes down where links lead to
    if robot.templates is not None and robot.templates.is_dir():
        files += [path for path in sorted(robot.templates.rglob("*")) if not path.name.startswith(".")]
    return files


def around(robot: RobotConfig) -> Iterator[Path]:
    """The files of the packages around a robot's own that urdfsync reads or writes."""
    folder = robot.folder.parent
    while folder != robot.output:
        yield from (folder / "package.mo", folder / "package.order")
        folder = folder.parent
