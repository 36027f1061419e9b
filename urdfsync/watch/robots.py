"""The robots that the daemon watches: their paths, what the last build saw of them, and what has changed since."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from pathlib import Path

import msgspec

from urdfsync import uptodate
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.dependencies import NO_STAT, stat_of
from urdfsync.diagnostics import Diagnostic, OutputError
from urdfsync.engine.cache import Cache
from urdfsync.engine.package_files import FileState, FileStates, PackageFiles
from urdfsync.watch.debounce import Debouncer, Times
from urdfsync.watch.input_files import InputFiles, InputStates, same_content
from urdfsync.watch.paths import RobotPaths, find_robot_paths

_IN_THE_WAY = FileState(NO_STAT, "", "")
"""An output that is no file, or can't be read."""


class WatchedRobot(msgspec.Struct):
    """One robot, as long as the configuration has one of its name."""

    robot: RobotConfig
    paths: RobotPaths
    debouncer: Debouncer[tuple[InputStates, FileStates]]
    built: InputStates | None = None
    """Inputs of the last build; None if the robot has to be built anyway."""
    settled: InputStates = msgspec.field(default_factory=dict)
    """Inputs that have settled, and are about to be built."""
    touched_outputs: frozenset[str] = frozenset()
    """Outputs that may have changed since the last build."""
    is_announced: bool = False
    """Whether the user was told that something is going on."""
    source_errors: tuple[Diagnostic, ...] = ()
    """Last findings about an invalid source."""
    failure: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None if it did not."""
    left_alone: frozenset[tuple[str, str]] = frozenset()
    """Files that the last build did not write although they differ, each with the kind of its action."""

    @property
    def name(self) -> str:
        """As in the configuration."""
        return self.robot.name

    def has_only_files(self, paths: Iterable[str]) -> bool:
        """Return whether all paths are files of the robot, and none a folder or link on the way to them."""
        inputs = self.built or self.paths.inputs
        return all(path in inputs or path in self.paths.outputs for path in paths)

    def touch_outputs(self, paths: AbstractSet[str]) -> None:
        """Note that something may have changed at these paths: outputs there have to settle, too."""
        outputs = self.paths.outputs
        self.touched_outputs |= outputs.intersection(paths) if self.has_only_files(paths) else outputs

    def rest(self) -> None:
        """Note that nothing is left to do: the settled inputs are built."""
        self.built, self.touched_outputs, self.is_announced = self.settled, frozenset(), False
        self.debouncer.rest()


class WatchedRobots:
    """All robots that are watched, and the states of their files.

    Inputs are sampled here. What builds saw of outputs is in the cache; they are compared with that.
    """

    def __init__(self, times: Times, package_paths: Sequence[Path], inputs: InputFiles, cache: Cache) -> None:
        """`package_paths` are where to look for packages beside those of the configuration."""
        self._times, self._package_paths, self._inputs, self._cache = times, package_paths, inputs, cache
        self._config: Config
        self._robots: dict[str, WatchedRobot] = {}

    def __iter__(self) -> Iterator[WatchedRobot]:
        return iter(self._robots.values())

    def use(self, config: Config, robots: Iterable[RobotConfig]) -> None:
        """Watch these robots, and build all. Of those that were watched before, the last results are still known."""
        self._config, before, self._robots = config, self._robots, {}
        for robot in robots:
            paths = self._find_paths(robot)
            watched = before.get(robot.name) or WatchedRobot(robot, paths, Debouncer(self._times))
            watched.robot, watched.paths, watched.built = robot, paths, None
            self._robots[robot.name] = watched
        self._cache.forget_others(self._robots)

    def named(self, names: Iterable[str]) -> list[WatchedRobot]:
        """Return the robots of these names, without those that are not watched any more."""
        return [self._robots[name] for name in names if name in self._robots]

    @property
    def paths(self) -> Mapping[str, RobotPaths]:
        """The paths of each robot."""
        return {watched.name: watched.paths for watched in self}

    def renew_paths(self, watched: WatchedRobot) -> bool:
        """Find the paths of a robot again, after a build. Returns whether they have changed."""
        before, watched.paths = watched.paths, self._find_paths(watched.robot)
        return watched.paths != before

    def inputs(self, watched: WatchedRobot) -> InputStates:
        """Return the inputs of a robot as they are now."""
        return self._inputs.read_all(watched.paths.input_files())

    def outputs(self, watched: WatchedRobot, paths: Iterable[str]) -> FileStates:
        """Return some outputs as they are now."""
        seen = self._cache.states(watched.name)
        files = PackageFiles(self._config, watched.robot, seen)
        return {path: _read_output(files, path, seen.get(path)) for path in paths}

    def has_changed_at(self, watched: WatchedRobot, paths: AbstractSet[str]) -> bool:
        """Return whether anything differs from what the last build saw, if it may have changed at these paths."""
        built, outputs = watched.built, watched.paths.outputs
        if built is None:
            return True
        inputs: AbstractSet[str] = built.keys()
        if watched.has_only_files(paths):
            inputs, outputs = inputs & paths, outputs.intersection(paths)
        elif {*watched.paths.input_files()} != inputs:
            return True
        if any(self._inputs.may_differ(path, built[path]) for path in inputs):
            return True
        return bool(self._changed_outputs(watched, self.outputs(watched, outputs)))

    def is_as_built(self, watched: WatchedRobot, now: InputStates) -> bool:
        """Return whether all files are as the last build saw them, if the inputs are as in `now`.

        If so, their states are kept as they are now; if not, the outputs that differ have to settle.
        """
        if watched.built is None or not same_content(watched.built, now):
            return False
        begin, seen = uptodate.read_clocks(), self._cache.states(watched.name)
        outputs = self.outputs(watched, seen)
        if outputs != seen:  # else nothing had to be hashed
            if changed := self._changed_outputs(watched, outputs):
                watched.touched_outputs |= changed
                return False
            self._note_outputs(watched, outputs, begin)
        watched.built = now
        return True

    def has_built_all(self, watched: WatchedRobot) -> bool:
        """Return whether the last build of a robot wrote nothing, and so saw all outputs as they are."""
        return self._cache.is_current(watched.name)

    def note_outputs(self, watched: WatchedRobot) -> None:
        """Take the outputs as they are now for what the last build saw, since it has failed somewhere."""
        begin = uptodate.read_clocks()
        self._note_outputs(watched, self.outputs(watched, watched.paths.outputs), begin)

    def _note_outputs(self, watched: WatchedRobot, outputs: FileStates, begin: tuple[int, int]) -> None:
        folder = self._config.root / STATE_FOLDER
        self._cache.note_states(watched.name, outputs, begin, lambda: uptodate.read_clock(folder))

    def _changed_outputs(self, watched: WatchedRobot, now: FileStates) -> set[str]:
        seen = self._cache.states(watched.name)
        return {path for path, state in now.items() if _content(seen.get(path, _IN_THE_WAY)) != _content(state)}

    def _find_paths(self, robot: RobotConfig) -> RobotPaths:
        return find_robot_paths(self._config, robot, self._package_paths, self._cache)


def _read_output(files: PackageFiles, path: str, seen: FileState | None) -> FileState | None:
    """Return the state of an output; of thousands nearly all are as they were seen."""
    try:
        return seen if seen and stat_of(os.lstat(path)) == seen.stat else files.state(path)
    except FileNotFoundError:
        return None
    except (OutputError, OSError):
        return _IN_THE_WAY


def _content(state: FileState | None) -> str | None:
    return state.sha256 if state else None
