"""A watched robot: the files of its last build, and whether they have changed or settled since."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import RobotConfig
from urdfsync.dependencies.facts import PATH, VARIABLE, Entry, Facts, is_young
from urdfsync.dependencies.record import FactList
from urdfsync.diagnostics import Diagnostic


class WatchedRobot(msgspec.Struct):
    """One configured robot, and the daemon's plans for it."""

    robot: RobotConfig
    facts: FactList = msgspec.field(default_factory=FactList)
    """Facts about all that the last build has read or written, and about the configuration."""
    index: Mapping[Entry, int] = {}
    """The number of each entry."""
    seen: Sequence[Facts] = ()
    """The facts at the last look."""
    changes: Sequence[Entry] = ()
    """What has changed between the last build and the last look."""
    due: float = math.inf
    """When to look at the files next, in seconds of a monotonic clock; infinite at rest."""
    is_told: bool = False
    """Whether `Settling` was reported; the daemon's own writes cause no report."""
    sample: Sequence[Facts] | None = None
    """The facts at the look before the last; None if an event came since. Two equal looks: the robot has settled."""
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
        """Look at the files at this time, and forget earlier looks."""
        self.due, self.is_told, self.sample, self.invalid_until = due, is_told, None, 0.0

    def take(self, facts: FactList, config: FactList) -> bool:
        """Take what a build has read; return whether the last build had other entries. Call `look` afterwards."""
        before = set(self.facts.entries)
        # without entries, a bug ended the build: do not repeat the build
        self.facts = facts.extended(config) if facts.entries else self.facts.renewed()
        self.index, self.seen = {entry: number for number, entry in enumerate(self.facts.entries)}, ()
        return before != set(self.facts.entries)

    def has_seen(self, present: Mapping[Entry, Facts]) -> bool:
        """Return whether the last look found these facts. A file that is young now may have changed since."""
        now = time.time_ns()
        own = {entry: self.index[entry] for entry in present.keys() & self.index.keys()}
        is_same = all(self.seen[number : number + 1] == [present[entry]] for entry, number in own.items())
        return is_same and not any(entry[0] == PATH and is_young(present[entry], now) for entry in own)

    def look(self) -> bool:
        """Look at all entries; return whether one of them changed since the last look."""
        before, self.seen = self.seen, list(self.facts.look())
        self.changes = list(self.facts.changes(self.seen))
        if not self.changes:
            self.facts = self.facts.aged()
        return self.seen != before

    @property
    def places(self) -> set[Entry]:
        """The entries in which events may come: a process keeps its environment."""
        return {entry for entry in self.facts.entries if entry[0] != VARIABLE}

    @property
    def has_changed(self) -> bool:
        """Whether an entry changed between the last build and the last look."""
        return bool(self.changes)

    @property
    def changed_file(self) -> str:
        """The changed file, an input before outputs; empty without a change to report, as of a list of names."""
        package = f"{self.robot.folder}{os.sep}"
        paths = (path for kind, path in self.changes if kind == PATH)
        return min(paths, key=lambda path: (path.startswith(package), path != str(self.robot.source), path), default="")
