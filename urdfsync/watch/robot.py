"""A watched robot: the files of its last build, and whether they have changed or settled since."""

from __future__ import annotations

import math
import stat
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.answers.dependencies import Dependencies
from urdfsync.answers.facts import CONTENTS, LSTAT, STAT, STAT_TYPE, VARIABLE, Entry, check_path, read_unrecorded
from urdfsync.config import RobotConfig
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.package_files import note_state, unchanged_state

_TOLD = (STAT, STAT_TYPE, LSTAT)
"""Kinds of entries whose changes are reported, inputs first; not lists of folders, not other robots' states."""

Looks: TypeAlias = dict[Entry, "str | tuple[int, ...]"]
"""The state of each entry: the hash of a file's content, without its times, or the facts of any other entry."""


def look_at(entry: Entry, facts: tuple[int, ...] | None = None) -> str | tuple[int, ...]:
    """Return the state of an entry, by default with its present facts."""
    facts = check_path(*entry) if facts is None else facts
    if entry[0] not in CONTENTS:
        return facts
    if len(facts) == 1 or not stat.S_ISREG(facts[0]):
        return (stat.S_IFMT(facts[0]) if facts[0] > 0 else facts[0],)
    try:
        state = unchanged_state(entry[1], facts) or note_state(entry[1], facts, read_unrecorded(entry[1]))
    except OSError as error:
        return (-(error.errno or 1),)
    return state.sha256


def _recall(reads: Dependencies, entry: Entry, facts: tuple[int, ...]) -> str | tuple[int, ...]:
    """Return the state of an entry as a build read it: the content's hash, or the facts if a file changed meanwhile."""
    known = unchanged_state(entry[1], facts)
    if sha256 := reads.hashes.get(entry) or (known and known.sha256):
        return sha256
    seen = look_at(entry, facts)
    return seen if isinstance(seen, tuple) or check_path(*entry) == facts else facts


class WatchedRobot(msgspec.Struct):
    """One configured robot, and the daemon's plans for it."""

    robot: RobotConfig
    built: Looks = {}
    """The state of all files that the last build has read or written."""
    seen: Looks = {}
    """The state at the last look."""
    due: float = math.inf
    """When to look at the files next, in seconds of a monotonic clock; infinite at rest."""
    is_told: bool = False
    """Whether `Settling` was reported; the daemon's own writes cause no report."""
    sample: Looks | None = None
    """The state at the look before the last; None if an event came since. Two equal looks: the robot has settled."""
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

    def take(self, reads: Dependencies, config: Looks) -> bool:
        """Take the entries and the configuration of a build; return whether the last build had other entries."""
        before, entries = self.built.keys(), reads.entries
        if not entries:  # a bug ended the build: do not repeat the build
            self.built = {entry: look_at(entry) for entry in before} | config
            return False
        self.built = {
            entry: _recall(reads, entry, facts) for entry, facts in entries.items() if entry[0] != VARIABLE
        } | config
        return before != self.built.keys()

    def look(self) -> bool:
        """Look at all entries; return whether one of them changed since the last look."""
        before, self.seen = self.seen, {entry: look_at(entry) for entry in self.built}
        return self.seen != before

    @property
    def has_changed(self) -> bool:
        """Whether an entry changed between the last build and the last look."""
        return self.seen != self.built

    @property
    def changed_file(self) -> str:
        """The changed file, an input before outputs; empty without a change to report."""
        changed = (entry for entry in self.built if entry[0] in _TOLD and self.seen[entry] != self.built[entry])
        return min(changed, key=lambda entry: (_TOLD.index(entry[0]), entry[1]), default=("", ""))[1]
