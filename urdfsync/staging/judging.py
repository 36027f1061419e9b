"""Judges what is being committed: staged sources against staged outputs; builds where that is wanted and safe.

Where the working tree has what is staged, it is judged itself; else a mirror of what is staged. A build writes
only for robots whose sources are the same in both, and whose files nobody has put aside to bring them back later.
"""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

import msgspec

from urdfsync import config as configuration
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.diagnostics import ConfigError, UrdfsyncError
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_if_current, plan_robot
from urdfsync.outcome import Exit, Result, exit_code
from urdfsync.staging.mirror import Mirror
from urdfsync.staging.staged import Index
from urdfsync.staging.verdict import Verdict
from urdfsync.staging.worktree import Worktree, around
from urdfsync.state.store import Store

_FINE = (Kind.UNCHANGED, Kind.KEEP, Kind.INCLUDED, Kind.ORPHAN, Kind.NEEDED, Kind.FORGET)
"""What happens to files that are as they should be."""


class Judge:
    """Judges the robots of one configuration after another."""

    def __init__(
        self, index: Index, folder: Path, request: BuildOptions, writing: bool, aside: Collection[str]
    ) -> None:
        """`writing` allows builds; `aside` are files of which changes will be brought back when all is over.

        `folder` is where git is asked again what is staged.
        """
        self._index, self._folder, self._writing, self._aside = index, folder, writing, aside
        self._dry, self._wet = (msgspec.structs.replace(request, dry=dry) for dry in (True, False))

    def verdicts(self, path: str) -> list[Verdict]:
        """What is wrong with the robots of a tracked configuration. Raises UrdfsyncError if it can't be read."""
        file = self._index.top / path
        if path in self._index.changed:
            with Mirror(self._index) as mirror:
                staging = _Staging(self._index, mirror, file)
                tree = Worktree(self._index, staging.real, self._dry)
                found = [self._in_mirror(staging, tree, robot, {path}) for robot in staging.real.robots]
                return [verdict for verdict in found if verdict]
        tree = Worktree(self._index, configuration.load(file), self._dry)
        inputs = {robot.name: tree.inputs(robot, self._index.changed) for robot in tree.config.robots}
        differing = [r for r in tree.config.robots if inputs[r.name] or tree.products(r, self._index.changed)]
        same = [robot for robot in tree.config.robots if robot not in differing]
        found = [self._on_disk(tree, robot, None) for robot in same if not tree.is_committed(robot)]
        if differing:
            with Mirror(self._index) as mirror:
                staging = _Staging(self._index, mirror, file)
                found += [self._in_mirror(staging, tree, robot, inputs[robot.name]) for robot in differing]
        return [verdict for verdict in found if verdict]

    def _in_mirror(
        self, staging: _Staging, tree: Worktree, robot: RobotConfig, hindering: Collection[str]
    ) -> Verdict | None:
        """The verdict on a robot of which the working tree does not have what is staged."""
        result = staging.result(robot.name, self._dry)
        if result is None:
            return _verdict(tree, robot, tree.lacking(tree.sources(robot)))
        if hindering:
            return _verdict(tree, robot, tree.expected(robot, result.actions), result, hindering)
        return self._on_disk(tree, robot, result)

    def _on_disk(self, tree: Worktree, robot: RobotConfig, staged: Result | None) -> Verdict | None:
        """The verdict on a robot that is not in step or not staged, but has the same sources in the working tree.

        `staged` is what a build would do with what is staged, if that is not the same as with the working tree.
        """
        concerned = None if staged is None else [action for action in staged.actions if action.kind not in _FINE]
        settled = tree.settled(robot)
        if settled is not None:
            add = tree.lacking(tree.files(robot, settled if concerned is None else concerned))
            return _verdict(tree, robot, add, None if add else staged)
        blocking = self._blocking(tree, robot)
        if self._writing and not blocking:
            (result,) = build(tree.config, [robot], self._wet)
            add = self._written(tree, robot, result.actions if concerned is None else concerned)
            fine = exit_code([result]) is Exit.IN_STEP and not add
            return _verdict(tree, robot, add, staged if fine else result)
        (result,) = [staged] if staged else build(tree.config, [robot], self._dry)
        if result.in_step and not _records(tree.config, robot, self._wet):
            return _verdict(tree, robot, tree.lacking(tree.files(robot, result.actions)))
        return _verdict(tree, robot, tree.expected(robot, result.actions), result, blocking)

    def _written(self, tree: Worktree, robot: RobotConfig, actions: Collection[Action]) -> tuple[str, ...]:
        """What has to be staged after a build."""
        index = Index(self._folder)
        add = Worktree(index, tree.config, self._dry).lacking(tree.files(robot, actions))
        # the state of a robot that has another name now went with it
        robots = self._index.path(tree.config.root / STATE_FOLDER / "robots")
        former = (path for path in index.changed - self._index.changed if path.rpartition("/")[0] == robots)
        return tuple(dict.fromkeys((*add, *former)))

    def _blocking(self, tree: Worktree, robot: RobotConfig) -> Collection[str]:
        """The files that keep a build from writing: their changes, put aside, would meet what it writes.

        If they can't be brought back, all tracked files return to what is staged. So the recorded state has to be
        tracked, lest it stay behind alone.
        """
        if not self._aside:
            return ()
        found = tree.inputs(robot, self._aside)
        folder = self._index.path(robot.folder)
        if self._writing:
            found |= tree.products(robot, self._aside)
        if self._writing and folder is not None and self._index.below(folder):
            states = map(self._index.path, tree.state(robot))
            found |= {path for path in states if path is not None and not self._index.tracks(path)}
        return found


class _Staging:
    """One configuration as it is staged, in a mirror, with the robots that were asked for."""

    def __init__(self, index: Index, mirror: Mirror, file: Path) -> None:
        """Raises ConfigError if it can't be read."""
        self._index, self._mirror = index, mirror
        mirror.bring(index.changed)
        try:
            self._config = configuration.load(mirror.place(file))
        except ConfigError as error:
            raise ConfigError(*map(mirror.diagnostic, error.diagnostics)) from None
        self.real = mirror.config(self._config)

    def result(self, name: str, request: BuildOptions) -> Result | None:
        """What a build would do with a robot; None if nothing."""
        (robot,) = self._config.select([name])
        (real,) = self.real.select([name])
        self._bring(real)
        # packages that a search path inside a mirror can't find, since it is made of links
        elsewhere = tuple(path for path in real.package_paths if path not in robot.package_paths)
        request = msgspec.structs.replace(request, package_paths=request.package_paths + elsewhere)
        try:
            if plan_if_current(self._config, robot, request) is not None:
                return None
        except (UrdfsyncError, OSError):
            pass  # said by the build
        (result,) = build(self._config, [robot], request)
        if result.in_step and not _records(self._config, robot, msgspec.structs.replace(request, dry=False)):
            return None
        return self._mirror.result(result)

    def _bring(self, robot: RobotConfig) -> None:
        """Give everything that a build may write its place."""
        for folder in (robot.folder, self.real.root / STATE_FOLDER):
            self._bring_folder(folder)
        self._mirror.bring(path for file in around(robot) if (path := self._index.path(file)) is not None)
        try:
            state = Store(self._config.root).load(robot.name)
        except UrdfsyncError:
            return  # said by the build
        before = self.real.root / state.manifest.folder if state else robot.folder
        if before != robot.folder:
            self._bring_folder(before)

    def _bring_folder(self, folder: Path) -> None:
        path = self._index.path(folder)
        if path is not None:
            self._mirror.bring_folder(path)


def _verdict(
    tree: Worktree,
    robot: RobotConfig,
    add: Collection[str],
    result: Result | None = None,
    hindering: Collection[str] = (),
) -> Verdict | None:
    """A verdict, unless there is nothing to say."""
    if not add and result is None:
        return None
    folders = tuple(filter(None, map(tree.index.path, (robot.folder, tree.config.root / STATE_FOLDER / "robots"))))
    return Verdict(tree.config.file, robot.name, tuple(add), result, tuple(sorted(hindering)), folders)


def _records(config: Config, robot: RobotConfig, request: BuildOptions) -> bool:
    """Whether a build writes to the recorded state that is committed."""
    folder = config.root / STATE_FOLDER / "robots"
    return any(change.path.parent == folder for change in plan_robot(config, robot, request).writes)
