"""A robot that the daemon watches: its files when they were last read, and whether they have settled."""

from __future__ import annotations

import errno
import math
import os
import stat
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.config import RobotConfig
from urdfsync.dependencies import read_unrecorded, stat_of
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.package_files import note_state, unchanged_state
from urdfsync.engine.xacro_worker import find_matches
from urdfsync.watch.paths import RobotPaths

Hashes: TypeAlias = Mapping[str, str]
"""Hashes of files by absolute path; of what is no file, a word."""


def read_state(path: str, *, follow: bool = True) -> str:
    """Return the hash of a file's content; of what is no file, or can't be read, and of a link not followed, a word."""
    try:
        status = os.stat(path, follow_symlinks=follow)  # noqa: PTH116 - many, and often
        if not stat.S_ISREG(status.st_mode):
            return "folder" if stat.S_ISDIR(status.st_mode) else "other"
        facts = stat_of(status)
        state = unchanged_state(path, facts) or note_state(path, facts, read_unrecorded(path))
    except OSError as error:
        return "missing" if error.errno in (errno.ENOENT, errno.ENOTDIR) else f"error {error.errno}"
    return state.sha256


class WatchedRobot(msgspec.Struct):
    """One robot, as long as the configuration has one of its name; and what the daemon is about to do with it."""

    robot: RobotConfig
    paths: RobotPaths
    hashes: Hashes = {}
    """Of inputs and outputs, when they were last read."""
    due: float = math.inf
    """When to look at the files next, in seconds of a monotonic clock; infinite at rest."""
    is_told: bool = False
    """Whether the user was told that the robot is under way; not of looks after the daemon's own builds."""
    sample: Hashes | None = None
    """The look before, since the last event; None if there was none. Two that are the same mean: settled."""
    invalid_until: float = 0.0
    """Until when the exporter of an invalid source may be at work; 0 if it is valid, or known to stay invalid."""
    built: Hashes | None = None
    """All files before and after the last build, which changed none; None if the robot has to be built."""
    failure: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None if it did not."""
    changed_file: str = ""
    """A file that had changed at the last look, an input before outputs; empty if none had."""
    left_alone: frozenset[tuple[str, str]] = frozenset()
    """Files that the last build did not write although they differ, each with the kind of its action; and misfits."""
    pending: tuple[Path, ...] = ()
    """Files that were written while the package is broken: the command of `--exec` waits until it is not."""

    @property
    def name(self) -> str:
        """Its name in the configuration."""
        return self.robot.name

    def settle(self, due: float, *, is_told: bool) -> None:
        """Look at the files at this time, and forget earlier looks."""
        self.due, self.is_told, self.sample, self.invalid_until = due, is_told, None, 0.0

    def read_files(self) -> None:
        """Read all inputs, those in the template folder and those that patterns match included, and all outputs."""
        inputs, outputs, templates = set(self.paths.inputs), self.paths.outputs, self.robot.templates
        for folder, _, names in os.walk(templates) if templates else ():
            inputs.update(os.path.join(folder, name) for name in names)  # noqa: PTH118
        for pattern in self.paths.patterns:
            inputs.update(find_matches(pattern))
        self.hashes = self._read(inputs | outputs)

    def _read(self, paths: Iterable[str]) -> Hashes:
        outputs = self.paths.outputs  # a build refuses links there
        return {path: read_state(path, follow=path not in outputs) for path in paths}

    def has_files(self, paths: Collection[str]) -> bool:
        """Whether all paths are files of the robot, not folders or links on the way to one."""
        return all(path in self.hashes or path in self.paths.outputs for path in paths)

    def has_changed(self, paths: Collection[str] = ()) -> bool:
        """Whether files have changed since they were last read; with `paths`, at these alone.

        If one of them is no file of the robot, but a folder or a link on the way to one, all are read.
        """
        before, looked_at = self.hashes, set(paths)
        if looked_at and looked_at <= before.keys():
            self.hashes = {**before, **self._read(looked_at)}
        else:
            self.read_files()
            looked_at = before.keys() | self.hashes.keys()
        changed = [path for path in looked_at if before.get(path) != self.hashes.get(path)]
        self.changed_file = min(changed, key=lambda path: (path not in self.paths.inputs, path), default="")
        return bool(changed)

    def has_new_input(self, before: Hashes) -> bool:
        """Whether an input is other than before: a user saved it, since the daemon writes none."""
        changed = [path for path in self.paths.inputs if path in before and before[path] != self.hashes[path]]
        self.changed_file = min(changed, default="")
        return bool(changed)
