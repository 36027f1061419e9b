"""A robot that the daemon watches: its files, as they are and as the last build left them."""

from __future__ import annotations

import errno
import os
import stat
import time
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from typing import TypeAlias

import msgspec

from urdfsync.config import RobotConfig
from urdfsync.dependencies import NO_STAT, read_unrecorded, stat_of
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.package_files import FileState, state_of
from urdfsync.watch.debounce import Debouncer
from urdfsync.watch.paths import RobotPaths

States: TypeAlias = Mapping[str, FileState]
"""Files by absolute path. A path without a readable file has a word for its hashes, such as `missing`."""

_COARSE_TICK = 2_000_000_000
"""No clock of a file system is coarser (ns): that of FAT."""


def read_state(path: str, known: FileState | None = None, *, follow: bool = True) -> FileState:
    """Return the state of a path; an error is a state, too. A link is one where it is not followed.

    The file is hashed unless `known` has its stat values. A racy state has none, so it is hashed again next time.
    """
    try:
        status = os.stat(path, follow_symlinks=follow)  # noqa: PTH116 - many, and often
        if not stat.S_ISREG(status.st_mode):
            word = "folder" if stat.S_ISDIR(status.st_mode) else "other"
            return FileState(NO_STAT, word, word)
        facts = stat_of(status)
        if known is not None and known.stat == facts:
            return known
        content = read_unrecorded(path)
    except OSError as error:
        word = "missing" if error.errno in (errno.ENOENT, errno.ENOTDIR) else f"error {error.errno}"
        return FileState(NO_STAT, word, word)
    is_racy = max(facts[-2:]) > time.time_ns() - _COARSE_TICK
    return state_of(NO_STAT if is_racy else facts, content)


def find_changes(old: States, new: States) -> set[str]:
    """Return the paths that only one of two samples has, or that have other content."""
    return {*(old.keys() ^ new.keys()), *(path for path in old.keys() & new.keys() if old[path][1:] != new[path][1:])}


class WatchedRobot(msgspec.Struct):
    """One robot, as long as the configuration has one of its name."""

    robot: RobotConfig
    paths: RobotPaths
    debouncer: Debouncer
    files: States = msgspec.field(default_factory=dict)
    """Inputs and outputs when they were last read."""
    built: States | None = None
    """All files as the last build left them; None if the robot has to be built anyway."""
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

    def read_files(self) -> States:
        """Read all inputs and outputs."""
        outputs = self.paths.outputs
        paths = {*self.paths.input_files(), *outputs}
        self.files = {path: read_state(path, self.files.get(path), follow=path not in outputs) for path in paths}
        return self.files

    def changed_inputs(self, settled: States) -> set[str]:
        """Return the inputs that have other content than a sample; not those that the sample did not have."""
        changes = find_changes(settled, self.files) - self.paths.outputs
        return {path for path in changes if path in settled and path in self.files}

    def is_as_built(self) -> bool:
        """Return whether all files have the content that the last build saw, when they were last read."""
        if self.built is None or find_changes(self.built, self.files):
            return False
        self.built = self.files  # with the stat values that are not racy any more
        return True

    def has_only_files(self, paths: AbstractSet[str]) -> bool:
        """Return whether all paths are files of the robot, and none a folder or link on the way to them."""
        return all(path in self.files or path in self.paths.outputs for path in paths)

    def has_changed_at(self, paths: AbstractSet[str]) -> bool:
        """Return whether anything differs from what the last build saw, if it may have changed at these paths."""
        if self.built is None or not paths <= self.built.keys():
            self.read_files()
            return not self.is_as_built()
        before = {path: self.built[path] for path in paths}
        now = {path: read_state(path, old, follow=path not in self.paths.outputs) for path, old in before.items()}
        return bool(find_changes(before, now))

    def rest(self) -> None:
        """Note that nothing is left to do: the files that were last read are as the build left them."""
        self.built, self.is_announced = self.files, False
        self.debouncer.rest()
