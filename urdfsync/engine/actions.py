"""Actions: a build writes, deletes or leaves each file of a robot, for one reason."""

from __future__ import annotations

import enum
import hashlib
from collections.abc import Iterable
from typing import Self

import msgspec

from urdfsync.domain import Role


class Choice(enum.StrEnum):
    """The user's decision about a file."""

    KEEP = "keep"
    """The file stays as the user has it, until something new would be written."""
    TAKE = "take"
    """The generated text replaces the user's file."""
    MERGE = "merge"
    """Both sides' changes, if they merge cleanly."""
    MERGE_MINE = "merge-mine"
    """Both sides' changes; where they contradict each other, the user's."""
    MERGE_GENERATED = "merge-generated"
    """Both sides' changes; where they contradict each other, the generated ones."""
    EDIT = "edit"
    """The text that the user makes of both sides in an editor."""
    MOVED = "moved"
    """The edit belongs to the element of another name."""
    UNDO = "undo"
    """The text and the base before the last choice, or before a build replaced them."""


class UsersChoice(msgspec.Struct, frozen=True):
    """The user's decision about one file. It holds for the two texts that he saw: one that was saved since stays."""

    choice: Choice
    sides: str
    """`sides_hash` of them."""
    text: str | None = None
    """The text that the user made of both sides, for `Choice.EDIT`; the new name, for `Choice.MOVED`."""


def sides_hash(mine: str | None, generated: str | None) -> str:
    """Return one hash for the texts of both sides, from theirs."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()


class Kind(enum.StrEnum):
    """An effect on a file. What follows from it stands in the properties of an action."""

    WRITE = "write"
    DELETE = "delete"
    LEAVE = "leave"
    CONFLICT = "conflict"
    """It stays although other content is wanted."""


class FileStatus(enum.StrEnum):
    """How a file stands before the build, what asks for most attention first."""

    CONFLICT = "conflict"
    """The user and urdfsync want different things of it."""
    MISSING = "missing"
    """It was written and somebody deleted it."""
    STALE = "stale"
    """The next build writes or deletes it."""
    EDITED = "edited"
    """The user changed it, and there is nothing new for it."""
    ORPHAN = "orphan"
    """Nothing generates it any longer, and it stays because it is the user's or something of the user's needs it."""
    UNKNOWN = "unknown"
    """No build is known to have written it, and nothing generates it."""
    IN_STEP = "in step"


class Reason(enum.StrEnum):
    """Why something happens to a file. What happens, and all words about it, follow."""

    # Word, kind, status (None where there is no file any more), text: the end of a sentence about the path.
    # Then what a dry run says of n such files, and a build if it says something else: in this order.
    # fmt: off
    UPDATE = ("update", Kind.WRITE, FileStatus.STALE, "its generated text changed",
              "{n} file{s} to write", "{n} file{s} written")
    CREATE = "create", Kind.WRITE, FileStatus.STALE, "new"
    RESTORE = ("restore", Kind.WRITE, FileStatus.MISSING, "you deleted it",
               "{n} to restore", "{n} restored because you deleted {them}")
    DELETE = "delete", Kind.DELETE, FileStatus.STALE, "no longer generated", "{n} to delete", "{n} deleted"
    MERGE = ("merge", Kind.WRITE, FileStatus.STALE, "your edits and what is new, merged",
             "{n} to merge with your edits", "{n} merged with your edits")
    UNDO = ("undo", Kind.WRITE, FileStatus.STALE, "it is as you had it before",
            "{n} to give back as you had {them}", "{n} given back as you had {them}")
    MOVE = ("move", Kind.WRITE, FileStatus.STALE, "its path is new; your edits move here",
            "{n} to move with your edits", "{n} moved with your edits")
    INCLUDED = ("included", Kind.LEAVE, FileStatus.EDITED, "you edited it, and it already has what is new",
                "{n} that you edited already {have} what is new")
    KEEP = ("keep", Kind.LEAVE, FileStatus.EDITED, "you edited it; there is nothing new for it",
            "{n} kept because you edited {them}")
    ORPHAN = ("orphan", Kind.LEAVE, FileStatus.ORPHAN, "no longer generated, but you edited it; kept",
              "{n} no longer generated but kept because you edited {them}")
    NEEDED = ("needed", Kind.LEAVE, FileStatus.ORPHAN, "no longer generated, but your files need it; kept",
              "{n} no longer generated but kept because your files need {them}")
    CONFLICT = ("conflict", Kind.CONFLICT, FileStatus.CONFLICT, "you edited it, and its generated text changed too",
                "{n} conflict{s}")
    MARKERS = "markers", Kind.CONFLICT, FileStatus.CONFLICT, "git could not merge the edits of two branches"
    UNOWNED = "unowned", Kind.CONFLICT, FileStatus.CONFLICT, "urdfsync did not write the file that is there"
    ASKED = "asked", Kind.CONFLICT, FileStatus.CONFLICT, "you edited it, and it may belong to another part now"
    UNKNOWN = "unknown", Kind.LEAVE, FileStatus.UNKNOWN, "nothing generates it, and nothing is recorded of it"
    UNCHANGED = "unchanged", Kind.LEAVE, FileStatus.IN_STEP, "nothing to do"
    MOVED_AWAY = "moved-away", Kind.DELETE, FileStatus.STALE, "its path is new; your edits move there"
    FORGET = "forget", Kind.LEAVE, None, "no longer generated, and already gone"
    # fmt: on

    def __new__(cls, word: str, *_: object) -> Self:
        """Return the reason with its word as the value."""
        reason = str.__new__(cls, word)
        reason._value_ = word
        return reason

    def __init__(
        self, _word: str, kind: Kind, status: FileStatus | None, text: str, to_do: str = "", done: str = ""
    ) -> None:
        self.kind, self.status, self.text = kind, status, text
        self.to_do, self.done = to_do, done or to_do


ORPHANS = frozenset(reason for reason in Reason if reason.status is FileStatus.ORPHAN)
"""Actions that leave a file although nothing generates it any longer."""
CONFLICTS = frozenset(reason for reason in Reason if reason.kind is Kind.CONFLICT)
DISPUTED = CONFLICTS | {Reason.MOVE}
"""Actions that the texts, or the user, decide on."""
USERS = frozenset({Reason.KEEP, Reason.INCLUDED, Reason.MERGE, Reason.UNDO, Reason.ORPHAN}) | DISPUTED
"""Actions after which the file still has text of the user's."""


class Action(msgspec.Struct, frozen=True):
    """The decision about one file, and the hashes that it rests on; `path` is the file's key.

    Whoever acts on it takes `path` for all that it changes: a file that moves has two actions, MOVE and MOVED_AWAY.
    """

    KEYS = ("path", "origin", "status", "kind", "reason", "is_waiting", "owner", "role", "text")

    path: str
    reason: Reason
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
    is_waiting: bool = False
    """Waits until the robot's other conflicts are resolved."""
    is_left_by_git: bool = False
    """Whether git left another text in the file, such as one with markers: `mine` is what it stands for."""

    @property
    def kind(self) -> Kind:
        """The effect on the file, once it waits for nothing."""
        return Kind.WRITE if self.is_left_by_git and self.reason.kind is Kind.LEAVE else self.reason.kind

    @property
    def status(self) -> FileStatus | None:
        """How the file stands before the build; None where there is no file any more."""
        return self.reason.status

    @property
    def replaces(self) -> str:
        """Say that it takes the place of what git has made of two versions, as a clause; empty if it does not."""
        return "in the place of what git left there" if self.is_left_by_git and self.kind is not Kind.CONFLICT else ""

    @property
    def text(self) -> str:
        """Why it happens, and what it waits for, as the end of a sentence that begins with the path; for scripts.

        People read `output.phrases.reason`.
        """
        return "; ".join(filter(None, (self.reason.text, self.replaces, self.waits_for)))

    @property
    def writes(self) -> bool:
        """Whether a file changes now."""
        return self.kind in (Kind.WRITE, Kind.DELETE) and not self.is_waiting

    @property
    def is_deletion(self) -> bool:
        """Whether there is no file any more, once the action waits for nothing."""
        return self.kind is Kind.DELETE

    @property
    def is_conflict(self) -> bool:
        """Whether a file stays although other content is wanted."""
        return self.kind is Kind.CONFLICT

    @property
    def keeps_text(self) -> bool:
        """Whether the text on disk stays, and need not be the generated one."""
        stays = self.kind in (Kind.LEAVE, Kind.CONFLICT) and self.status is not FileStatus.IN_STEP
        return self.is_waiting or stays

    @property
    def sides(self) -> str:
        """One hash for the texts of both sides: a choice holds as long as it is the same."""
        return sides_hash(self.mine, self.generated)

    @property
    def waits_for(self) -> str:
        """The reason why it waits, as a clause; empty if it does not."""
        return "waits until the conflicts are resolved" if self.is_waiting else ""

    @property
    def is_on_disk(self) -> bool:
        """Whether there is a file that the generated content can replace."""
        return self.mine is not None


class Actions(tuple[Action, ...]):
    """The actions for all files of a robot, in the order of their paths."""

    __slots__ = ()

    def __new__(cls, actions: Iterable[Action] = ()) -> Actions:
        """Sort the actions by path."""
        return super().__new__(cls, sorted(actions, key=lambda action: action.path))

    @property
    def decided(self) -> tuple[Action, ...]:
        """All actions but on files that are as they should be: for most builds a few of thousands."""
        return tuple(action for action in self if action.reason not in (Reason.UNCHANGED, Reason.UNKNOWN))
