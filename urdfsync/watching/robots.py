"""The robots that the daemon watches: what matters to each, what it was when it was built, and whether it settled."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import Diagnostic
from urdfsync.planning.memory import Memory
from urdfsync.watching.samples import Sample, Sampler, alike, changed
from urdfsync.watching.scope import Scope, scope
from urdfsync.watching.settling import Settler, Times


class Watched(msgspec.Struct):
    """One robot, for as long as the configuration says the same of it."""

    robot: RobotConfig
    scope: Scope
    settler: Settler[Sample]
    built: Sample | None = None
    """What the last build saw; None if everything has to be built anyway."""
    settled: Sample = msgspec.field(default_factory=dict)
    """What has settled, and is about to be built."""
    announced: bool = False
    """Whether the listener was told that something is going on."""
    trouble: tuple[Diagnostic, ...] = ()
    """What was said last of a source that is no model."""
    busy: bool = False
    """Whether the last build did anything but look."""
    failed: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None if it did not."""
    special: frozenset[tuple[str, str]] = frozenset()
    """The files that the last build left alone for some reason, each with what it did instead of writing."""

    @property
    def name(self) -> str:
        """As in the configuration."""
        return self.robot.name

    def is_input(self, path: str) -> bool:
        """Whether the robot is built from this file of its scope."""
        return path not in self.scope.outputs


class Robots:
    """All robots that are watched, and samples of their files."""

    def __init__(self, times: Times, package_paths: Sequence[Path], memory: Memory | None = None) -> None:
        """`package_paths` are where to look for packages beside those of the configuration."""
        self._times, self._package_paths, self._memory = times, package_paths, memory
        self._sampler = Sampler()
        self._config: Config | None = None
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
        """All files of a robot as they are now."""
        return self._sampler.sample(watched.scope.files())

    def look(self, path: str) -> Sample:
        """A file that belongs to no robot, as it is now."""
        return self._sampler.sample([path])

    def has_news(self, watched: Watched, paths: Iterable[str]) -> bool:
        """Whether something is not as the last build saw it, if it may be one of these paths; at little cost."""
        built = watched.built
        if built is None:
            return True
        if all(path in built for path in paths):
            return any(self._sampler.may_differ(path, built[path]) for path in paths)
        files = set(watched.scope.files())  # a folder, or a place where a link leads to
        return files != built.keys() or any(self._sampler.may_differ(path, built[path]) for path in files)

    def inputs_differ(self, watched: Watched, before: Sample) -> bool:
        """Whether what a robot is built from differs from what it was in a sample; hashes what may differ."""
        now = self._sampler.sample(watched.scope.ingredients())
        known = {path: entry for path, entry in before.items() if watched.is_input(path)}
        return any(changed(known, now)) or bool(now.keys() - known.keys())

    def is_as_built(self, watched: Watched) -> bool:
        """Whether all is as the last build saw it; if so, it is remembered as it is now."""
        now = self.sample(watched)
        if watched.built is None or not alike(watched.built, now):
            return False
        watched.built = now
        return True

    def tidy(self, others: Iterable[str]) -> None:
        """Forget the hashes of files that do not matter any more, but for `others`."""
        self._sampler.keep([*others, *(path for watched in self for path in watched.scope.files())])

    def distrust(self) -> None:
        """Hash everything again, whatever stat values say."""
        self._sampler.forget()
        if self._memory:
            self._memory.distrust()

    def _scope(self, robot: RobotConfig) -> Scope:
        if self._config is None:
            raise LookupError(robot.name)
        return scope(self._config, robot, self._package_paths, self._memory)
