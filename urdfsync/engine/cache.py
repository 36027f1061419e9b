"""What the daemon keeps between builds. Dropping it changes no byte.

Each value stands with all that it was made from, so a value is never used for anything else. There is one value of a
kind: the cache is as large as one robot. Only the states of files are kept for every robot.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable
from typing import Any, TypeVar

from urdfsync import uptodate
from urdfsync.dependencies import NO_STAT
from urdfsync.engine.package_files import FileStates

_FEW = 4
"""Hashing so few files again is quicker than reading the file system's clock."""
_Value = TypeVar("_Value")


class Cache:
    """Last values of some kinds, and what the last plan of each robot saw of its files."""

    def __init__(self) -> None:
        self._values: dict[str, tuple[Hashable, Any]] = {}
        self._states: dict[str, FileStates] = {}

    def get(self, kind: str, key: Hashable, make: Callable[[], _Value]) -> _Value:
        """Return the value of a kind that was made from `key`, or make it. If `make` raises, the last value stays.

        Serves the rows "one mass changed in the daemon" of docs/speed.md: with 1,000 links, reading the recorded
        state alone takes as long as all else.
        """
        known = self._values.get(kind)
        if known is None or known[0] != key:
            self._values[kind] = key, make()
        value: _Value = self._values[kind][1]
        return value

    def put(self, kind: str, key: Hashable, value: object) -> None:
        """Store what `get` would make."""
        self._values[kind] = key, value

    def states(self, robot: str) -> FileStates:
        """Return what the last plan of a robot saw of outputs and recorded state."""
        return self._states.get(robot, {})

    def note_states(
        self, robot: str, states: FileStates, begin: tuple[int, int], read_clock: Callable[[], uptodate.Clock | None]
    ) -> None:
        """Keep what a plan that began at `begin` saw. Files that changed shortly before are hashed again next time."""
        before = self.states(robot)
        new = {path: state for path, state in states.items() if state and before.get(path) is not state}
        racy = {path: state for path, state in new.items() if state.stat != NO_STAT}
        if len(racy) > _FEW and (clock := read_clock()):
            elapsed = uptodate.elapsed_since(begin)
            racy = {path: state for path, state in racy.items() if uptodate.is_racy(state.stat, clock, elapsed)}
        self._states[robot] = {**states, **{path: state._replace(stat=NO_STAT) for path, state in racy.items()}}

    def forget_others(self, robots: Collection[str]) -> None:
        """Drop the file states of all other robots."""
        self._states = {robot: states for robot, states in self._states.items() if robot in robots}
