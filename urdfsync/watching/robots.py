"""The robots that the daemon watches: what matters to each, what it was when it was built, and whether it settled."""

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
from urdfsync.watching.samples import Sample, Sampler, alike
from urdfsync.watching.scope import Scope, scope
from urdfsync.watching.settling import Settler, Times

_IN_THE_WAY: FileState = FileState(NO_STAT, "", "")
"""An output that is no file, or can't be read."""


class Watched(msgspec.Struct):
    """One robot, for as long as the configuration says the same of it."""

    robot: RobotConfig
    scope: Scope
    settler: Settler[tuple[Sample, FileStates]]
    built: Sample | None = None
    """What it is built from, as it was when there was nothing left to do; None if it has to be built anyway."""
    settled: Sample = msgspec.field(default_factory=dict)
    """What has settled, and is about to be built."""
    noticed: frozenset[str] = frozenset()
    """The outputs that may have changed since there was nothing left to do."""
    announced: bool = False
    """Whether the listener was told that something is going on."""
    trouble: tuple[Diagnostic, ...] = ()
    """What was said last of a source that is no model."""
    failed: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None if it did not."""
    special: frozenset[tuple[str, str]] = frozenset()
    """The files that the last build left alone for some reason, each with what it did instead of writing."""

    @property
    def name(self) -> str:
        """As in the configuration."""
        return self.robot.name

    def knows(self, paths: Iterable[str]) -> bool:
        """Whether all these are files of its own, and not folders, or places where links lead to."""
        inputs = self.built or self.scope.inputs
        return all(path in inputs or path in self.scope.outputs for path in paths)

    def notice(self, paths: AbstractSet[str]) -> None:
        """Something may have changed at these paths: outputs there have to settle, too."""
        outputs = self.scope.outputs
        self.noticed |= outputs.intersection(paths) if self.knows(paths) else outputs

    def rest(self) -> None:
        """There is nothing left to do: what has settled is what it is built from."""
        self.built, self.noticed, self.announced = self.settled, frozenset(), False
        self.settler.rest()


class Robots:
    """All robots that are watched, and how their files are."""

    def __init__(self, times: Times, package_paths: Sequence[Path], memory: Cache) -> None:
        """`package_paths` are where to look for packages beside those of the configuration.

        The memory has what builds saw of outputs, with which they are compared; only what robots are built from is
        sampled.
        """
        self._times, self._package_paths, self._memory = times, package_paths, memory
        self._sampler = Sampler()
        self._config: Config
        self._robots: dict[str, Watched] = {}

    def __iter__(self) -> Iterator[Watched]:
        return iter(self._robots.values())

    def load(self, config: Config, robots: Iterable[RobotConfig]) -> None:
        """Watch these robots; of those that were watched before, it is still known what was said of them."""
        self._config, before = config, self._robots
        self._robots = {}
        for robot in robots:
            watched = before.get(robot.name) or Watched(robot, self._scope(robot), Settler(self._times))
            watched.robot, watched.scope, watched.built = robot, self._scope(robot), None
            self._robots[robot.name] = watched
        self._memory.forget_others(self._robots)

    def named(self, names: Iterable[str]) -> list[Watched]:
        """The robots of these names, without those that are watched no more."""
        return [self._robots[name] for name in names if name in self._robots]

    @property
    def scopes(self) -> Mapping[str, Scope]:
        """What matters to each robot."""
        return {watched.name: watched.scope for watched in self}

    def renew(self, watched: Watched) -> None:
        """Find out again what matters to a robot, after a build."""
        watched.scope = self._scope(watched.robot)

    def sample(self, watched: Watched) -> Sample:
        """What a robot is built from, as it is now."""
        return self._sampler.sample(watched.scope.ingredients())

    def outputs(self, watched: Watched, paths: Iterable[str]) -> FileStates:
        """Some outputs as they are now; hashed is what is not known, and what can't be trusted."""
        seen = self._memory.states(watched.name)
        disk = PackageFiles(self._config, watched.robot, seen)
        return {path: _look(disk, path, seen.get(path)) for path in paths}

    def look(self, path: str) -> Sample:
        """A file that belongs to no robot, as it is now."""
        return self._sampler.sample([path])

    def has_news(self, watched: Watched, paths: AbstractSet[str]) -> bool:
        """Whether something is not as the last build saw it, if it may be one of these paths; at little cost."""
        built, outputs = watched.built, watched.scope.outputs
        if built is None:
            return True
        if watched.knows(paths):
            inputs, outputs = built.keys() & paths, outputs.intersection(paths)
        elif (inputs := {*watched.scope.ingredients()}) != built.keys():
            return True
        if any(self._sampler.may_differ(path, built[path]) for path in inputs):
            return True
        return bool(self._changed(watched, self.outputs(watched, outputs)))

    def confirm(self, watched: Watched, now: Sample) -> bool:
        """Whether all is as the last build saw it, if a robot is built from what is `now`; else outputs are noticed.

        If so, it is remembered as it is now.
        """
        if watched.built is None or not alike(watched.built, now):
            return False
        begin, seen = uptodate.read_clocks(), self._memory.states(watched.name)
        outputs = self.outputs(watched, seen)
        if outputs != seen:  # else nothing had to be hashed
            if changed := self._changed(watched, outputs):
                watched.noticed |= changed
                return False
            self._memory.note_states(watched.name, outputs, begin, self._clock)
        watched.built = now
        return True

    def is_known(self, watched: Watched) -> bool:
        """Whether the last build saw all outputs as it has left them: it wrote nothing."""
        return self._memory.is_current(watched.name)

    def take_stock(self, watched: Watched) -> None:
        """Let the outputs be known as they are now, since a build has failed, however far it came."""
        begin = uptodate.read_clocks()
        outputs = self.outputs(watched, watched.scope.outputs)
        self._memory.note_states(watched.name, outputs, begin, self._clock)

    def tidy(self, others: Iterable[str]) -> None:
        """Forget the samples of files that do not matter any more, but for `others`."""
        self._sampler.keep([*others, *(path for watched in self for path in watched.scope.ingredients())])

    def rehash_all(self) -> None:
        """Hash everything again, whatever the system says of it."""
        self._sampler.forget()
        self._memory.rehash_all()

    def _changed(self, watched: Watched, now: FileStates) -> set[str]:
        """The outputs that are not as they were seen last."""
        seen = self._memory.states(watched.name)
        return {path for path, entry in now.items() if _content(seen.get(path, _IN_THE_WAY)) != _content(entry)}

    def _clock(self) -> uptodate.Clock | None:
        return uptodate.read_clock(self._config.root / STATE_FOLDER)

    def _scope(self, robot: RobotConfig) -> Scope:
        return scope(self._config, robot, self._package_paths)


def _look(disk: PackageFiles, path: str, seen: FileState | None) -> FileState | None:
    """An output as plans see it; there are thousands, and nearly all are as they were seen."""
    try:
        return seen if seen and stat_of(os.lstat(path)) == seen[0] else disk.state(path)
    except FileNotFoundError:
        return None
    except (OutputError, OSError):
        return _IN_THE_WAY


def _content(seen: FileState | None) -> str | None:
    return seen[1] if seen else None
