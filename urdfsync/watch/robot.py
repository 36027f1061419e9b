"""A robot that the daemon watches: its files when they were last read, and whether they have settled."""

from __future__ import annotations

import errno
import math
import os
import stat
import time
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import NamedTuple, TypeAlias

import msgspec

from urdfsync.config import RobotConfig
from urdfsync.dependencies import is_young, read_unrecorded, stat_of
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.xacro_worker import find_matches
from urdfsync.files import digest
from urdfsync.watch.paths import RobotPaths

Hashes: TypeAlias = Mapping[str, str]
"""Hashes of files by absolute path; of what is no file, a word."""


class SeenFile(NamedTuple):
    """A path when it was read."""

    sha256: str
    """Hex; a word for what is no file."""
    stat: tuple[int, ...] | None = None
    """None if it has to be read again whatever the system says of it, since it has just changed."""


def read_state(path: str, known: SeenFile | None = None, *, follow: bool = True) -> SeenFile:
    """Read a path; what can't be read has a state, too, and so has a link that is not followed.

    A file is not read again if `known` has its stat values.
    """
    try:
        status = os.stat(path, follow_symlinks=follow)  # noqa: PTH116 - many, and often
        facts = stat_of(status)
        if known is not None and known.stat == facts:
            return known
        if not stat.S_ISREG(status.st_mode):
            return SeenFile("folder" if stat.S_ISDIR(status.st_mode) else "other")
        content = read_unrecorded(path)
    except OSError as error:
        return SeenFile("missing" if error.errno in (errno.ENOENT, errno.ENOTDIR) else f"error {error.errno}")
    return SeenFile(digest(content), None if is_young(facts, time.time_ns()) else facts)


class Resting(msgspec.Struct, frozen=True):
    """The last build left all files as they were, or failed."""

    due = math.inf


class Unsettled(msgspec.Struct, frozen=True):
    """Files may have changed; the robot is built once two looks in a row show the same."""

    due: float
    """When to look, in seconds of a monotonic clock."""
    sample: Hashes | None = None
    """The last look; None if there was none since the last event."""
    is_told: bool = True
    """Whether the user knows. He is not told that the daemon looks again after its own build."""
    shrunk: str = ""
    """Hash of a source that has lost many elements, and is looked at longer."""


class Invalid(msgspec.Struct, frozen=True):
    """The source is no valid model; it is looked at again and again, since the exporter may be at work."""

    due: float
    since: float


class WatchedRobot(msgspec.Struct):
    """One robot, as long as the configuration has one of its name."""

    robot: RobotConfig
    paths: RobotPaths
    state: Resting | Unsettled | Invalid
    files: dict[str, SeenFile] = msgspec.field(default_factory=dict)
    """Inputs and outputs by absolute path, when they were last read."""
    built: Hashes | None = None
    """All files before and after the last build, which changed none; None if the robot has to be built."""
    failure: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None if it did not."""
    changed_file: str = ""
    """One file that was other at the last look, an input before outputs; empty if none was."""
    left_alone: frozenset[tuple[str, str]] = frozenset()
    """Files that the last build did not write although they differ, each with the kind of its action; and misfits."""
    pending: tuple[Path, ...] = ()
    """Files that were written while the package is broken: the command of `--exec` waits until it is not."""

    @property
    def name(self) -> str:
        """As in the configuration."""
        return self.robot.name

    @property
    def is_resting(self) -> bool:
        """Whether nothing is to be done for it."""
        return isinstance(self.state, Resting)

    @property
    def is_told(self) -> bool:
        """Whether the user was told that the robot is under way."""
        return isinstance(self.state, Invalid) or (isinstance(self.state, Unsettled) and self.state.is_told)

    @property
    def hashes(self) -> Hashes:
        """All files, when they were last read."""
        return {path: state.sha256 for path, state in self.files.items()}

    def read_files(self) -> Hashes:
        """Read all inputs, those in the template folder and those that patterns match included, and all outputs."""
        inputs, outputs, templates = set(self.paths.inputs), self.paths.outputs, self.robot.templates
        for folder, _, names in os.walk(templates) if templates else ():
            inputs.update(os.path.join(folder, name) for name in names)  # noqa: PTH118
        for pattern in self.paths.patterns:
            inputs.update(find_matches(pattern))
        known = self.files
        self.files = {path: read_state(path, known.get(path)) for path in inputs}
        self.files |= {path: read_state(path, known.get(path), follow=False) for path in outputs}
        return self.hashes

    def has_changed(self, paths: Collection[str] = ()) -> bool:
        """Return whether files have changed since they were last read; with `paths`, at these alone.

        If one of them is no file of the robot, but a folder or a link on the way to one, all are read.
        """
        if not paths or not self.files.keys() >= set(paths):
            before = self.hashes
            now = self.read_files()
            changed = [path for path in before.keys() | now.keys() if now.get(path) != before.get(path)]
        else:
            old = {path: self.files[path] for path in paths}
            new = {path: read_state(path, old[path], follow=path not in self.paths.outputs) for path in paths}
            self.files |= new
            changed = [path for path in paths if new[path].sha256 != old[path].sha256]
        self.changed_file = min(changed, key=lambda path: (path not in self.paths.inputs, path), default="")
        return bool(changed)
