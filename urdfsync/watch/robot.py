"""A watched robot: the files of its last build, and whether they have changed or settled since."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.dependencies.facts import CONTENT, PATH, VARIABLE, Dependencies, Entry, Facts, aged, is_young, look
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.project.config import RobotConfig


class WatchedRobot(msgspec.Struct):
    """One configured robot, and the daemon's plans for it."""

    robot: RobotConfig
    dependencies: Dependencies = {}
    """All that the last build has read or written, and the configuration."""
    seen: Mapping[Entry, Facts] = {}
    """The facts at the last look."""
    changes: Sequence[Entry] = ()
    """What has changed between the last build and the last look."""
    due: float = math.inf
    """When to look at the files next, in seconds of a monotonic clock; infinite at rest."""
    is_told: bool = False
    """Whether `Settling` was reported; the daemon's own writes cause no report."""
    settling: Mapping[Entry, Facts] = {}
    """The facts when the robot began to settle. It has settled if the look at `due` finds the same."""
    invalid_until: float = 0.0
    """The time until an invalid source becomes an error; 0 for a valid source, and once it is an error."""
    is_confirmed: bool = False
    """Whether the last build had nothing to write, with the present configuration."""
    failure: tuple[Diagnostic, ...] | None = None
    """Why the last build failed; None after a success."""
    left_alone: frozenset[tuple[str, str]] = frozenset()
    """Files that the last build did not write, each with the reason: misfits, and stale files."""
    pending: tuple[Path, ...] = ()
    """Files that were written while the package is broken: the command of `--exec` waits for its repair."""

    @property
    def name(self) -> str:
        """The robot's name in the configuration."""
        return self.robot.name

    def settle(self, due: float, *, is_told: bool) -> None:
        """Look at the files again at this time; until then nothing may change."""
        self.due, self.is_told, self.settling, self.invalid_until = due, is_told, self.seen, 0.0

    def take(self, reads: Dependencies, config: Dependencies) -> bool:
        """Take what a build has read; return whether the last build had other entries. Call `look` afterwards."""
        before = self.places
        # without entries, a bug ended the build: do not repeat the build
        self.dependencies = {**reads, **config} if reads else {e: hash(look(*e)) for e in self.dependencies}
        self.seen = {}
        return before != self.places

    def has_seen(self, present: Mapping[Entry, Facts]) -> bool:
        """Return whether the last look found these facts. A file that is young now may have changed since."""
        now = time.time_ns()
        own = {entry: facts for entry, facts in present.items() if entry in self.dependencies}
        is_same = all(self.seen.get(entry) == facts for entry, facts in own.items())
        return is_same and not any(entry[0] == PATH and is_young(facts, now) for entry, facts in own.items())

    def look(self) -> bool:
        """Look at all entries; return whether one of them changed since the last look."""
        before, self.seen = self.seen, {entry: look(*entry) for entry in self.dependencies}
        self.changes = [entry for entry, fact in self.dependencies.items() if hash(self.seen[entry]) != fact]
        if not self.changes:
            self.dependencies = aged(self.dependencies, time.time_ns())
            self.seen = {entry: self.seen[entry] for entry in self.dependencies}
        return self.seen != before

    @property
    def places(self) -> set[Entry]:
        """The entries in which events may come: a process keeps its environment."""
        return {entry for entry in self.dependencies if entry[0] not in (CONTENT, VARIABLE)}

    @property
    def has_changed(self) -> bool:
        """Whether an entry changed between the last build and the last look."""
        return bool(self.changes)

    @property
    def changed_file(self) -> str:
        """The changed file, an input before outputs; empty without a change to report, as of a list of names."""
        package = f"{self.robot.folder}{os.sep}"
        paths = (path for kind, path in self.changes if kind in (PATH, CONTENT))
        return min(paths, key=lambda path: (path.startswith(package), path != str(self.robot.source), path), default="")
