"""What a build does with each file of a robot, and why."""

from __future__ import annotations

import enum
from collections.abc import Iterable

import msgspec

from urdfsync.domain import Role
from urdfsync.state.record import Choice, sides_hash


class Kind(enum.StrEnum):
    """What happens to a file."""

    UNCHANGED = "unchanged"
    CREATE = "create"
    RESTORE = "restore"
    ADOPT = "adopt"
    UPDATE = "update"
    KEEP = "keep"
    CONFLICT = "conflict"
    UNOWNED = "unowned-conflict"
    DELETE = "delete"
    ORPHAN = "orphan"
    NEEDED = "needed"
    INCLUDED = "included"
    MERGE = "merge"
    MOVE = "move"
    UNDO = "undo"
    LEAVE = "leave"
    FORGET = "forget"


WRITES = frozenset({Kind.CREATE, Kind.RESTORE, Kind.UPDATE, Kind.DELETE, Kind.MERGE, Kind.MOVE, Kind.UNDO, Kind.LEAVE})
"""Actions that change a file."""
DELETES = frozenset({Kind.DELETE, Kind.LEAVE})
"""Actions that take a file away."""
CONFLICTS = frozenset({Kind.CONFLICT, Kind.UNOWNED})
"""Actions that leave a file alone although other content is wanted."""
DISPUTED = CONFLICTS | {Kind.MOVE}
"""Actions that the texts, or the user, decide on."""
USERS = frozenset({Kind.KEEP, Kind.INCLUDED, Kind.MERGE, Kind.MOVE, Kind.UNDO, Kind.CONFLICT, Kind.ORPHAN})
"""Actions after which the file still has text of the user's."""

_REASONS = {
    Kind.UNCHANGED: "nothing to do",
    Kind.CREATE: "new",
    Kind.RESTORE: "you deleted it",
    Kind.ADOPT: "it already equals the generated text",
    Kind.UPDATE: "its generated text changed",
    Kind.KEEP: "you edited it; there is nothing new for it",
    Kind.CONFLICT: "you edited it, and its generated text changed too",
    Kind.UNOWNED: "urdfsync did not write the file that is there",
    Kind.DELETE: "no longer generated",
    Kind.ORPHAN: "no longer generated, but you edited it; kept",
    Kind.NEEDED: "no longer generated, but your files need it; kept",
    Kind.FORGET: "no longer generated, and already gone",
    Kind.INCLUDED: "you edited it, and it already has what is new",
    Kind.MERGE: "your edits and what is new, merged",
    Kind.MOVE: "its element was renamed; your edits move here",
    Kind.UNDO: "it is as you had it before the last build",
    Kind.LEAVE: "its element was renamed; your edits move to its new file",
}


class Action(msgspec.Struct, frozen=True):
    """What happens to one file, and the hashes that the decision rests on; `path` is as in the record."""

    path: str
    kind: Kind
    role: Role
    owner: str = ""
    base: str | None = None
    generated: str | None = None
    origin: str | None = None
    """Path of the user's file, if its element was renamed; None if it is at `path`."""
    choice: Choice | None = None
    """The user's decision about it."""
    mine: str | None = None
    """Hash of the file on disk; None if there is none."""
    result: str | None = None
    """Hash of the merged text; None if nothing is merged."""
    held: bool = False
    """Waits until the robot's other conflicts are resolved."""

    @property
    def sides(self) -> str:
        """One hash for the texts of both sides: a choice holds as long as it is the same."""
        return sides_hash(self.mine, self.generated)

    @property
    def reason(self) -> str:
        """Why, as the end of a sentence that begins with the path."""
        return _REASONS[self.kind]

    @property
    def waits_for(self) -> str:
        """What it waits for, if it does, as a clause."""
        if not self.held:
            return ""
        waits = "resolved, waits until the other" if self.choice else "waits until the"
        return f"{waits} conflicts are resolved"

    @property
    def replaceable(self) -> bool:
        """Whether the generated content can replace what is there, which must be a file."""
        return self.mine is not None

    @property
    def writes(self) -> bool:
        """Whether a file changes now."""
        return self.kind in WRITES and not self.held

    @property
    def released(self) -> bool:
        """Whether the user keeps a file that is no longer generated: urdfsync no longer tracks it."""
        return self.kind is Kind.FORGET and self.choice is Choice.KEEP


class Actions(tuple[Action, ...]):
    """The actions for all files of a robot, in the order of their paths."""

    __slots__ = ()

    def __new__(cls, actions: Iterable[Action] = ()) -> Actions:
        """Sort the actions by path."""
        return super().__new__(cls, sorted(actions, key=lambda action: action.path))

    @property
    def decided(self) -> tuple[Action, ...]:
        """All actions but `unchanged`: for most builds a few of thousands."""
        return tuple(action for action in self if action.kind is not Kind.UNCHANGED)
