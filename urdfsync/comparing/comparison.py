"""What comparing a source with another version of it found: a neutral value for `report`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import msgspec

from urdfsync.difference import ChangeClass, Effect
from urdfsync.outcome import Exit, Result

if TYPE_CHECKING:
    from urdfsync.changes import Changes


class Comparison(msgspec.Struct, frozen=True):
    """A source as it is now, compared with an older version of it."""

    result: Result
    """What a build would do; against another version than the last build, an action for each file that differs."""
    source: str
    """The source, as people see it."""
    against: str | None = None
    """The other version, as the user named it; None for the last build."""
    missing: str = ""
    """Why there is no older version to compare with; empty if there is one."""
    effects: tuple[Effect, ...] = ()
    """What the changes do to the model as a whole."""
    edited: frozenset[str] = frozenset()
    """The files among the actions that the user has edited."""

    @property
    def changes(self) -> Changes | None:
        """What changed in the model; None if nothing did, or if nothing is known of the older version."""
        return self.result.changes

    @property
    def change_class(self) -> ChangeClass:
        """How far the changes reach."""
        return self.changes.change_class if self.changes else ChangeClass.NONE

    @property
    def in_step(self) -> bool:
        """Whether both versions give the same package, and the package on disk needs nothing."""
        return self.result.in_step and self.change_class in (ChangeClass.NONE, ChangeClass.UNMODELLED)


def exit_code(comparisons: Iterable[Comparison]) -> Exit:
    """The worst of all: an error, a lock, being out of step; a conflict is no more than that."""
    comparisons = list(comparisons)
    if any(one.result.failed and not one.result.locked for one in comparisons):
        return Exit.ERROR
    if any(one.result.locked for one in comparisons):
        return Exit.LOCKED
    return Exit.IN_STEP if all(one.in_step for one in comparisons) else Exit.OUT_OF_STEP
