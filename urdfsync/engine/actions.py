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
    """The user's file stays until the generated text changes."""
    TAKE = "take"
    """The generated text replaces the user's file."""
    MERGE = "merge"
    """Both sides' changes, if they merge cleanly."""
    MERGE_MINE = "merge-mine"
    """Both sides' changes; where they contradict each other, the user's."""
    MERGE_GENERATED = "merge-generated"
    """Both sides' changes; where they contradict each other, the generated ones."""
    EDIT = "edit"
    """A text that the user made of both sides in an editor."""
    MOVED = "moved"
    """The edit belongs to another element, which the user names."""
    UNDO = "undo"
    """The text and the base that the file had before the last choice, or before a build."""


class UsersChoice(msgspec.Struct, frozen=True):
    """The user's decision about one file. It is ignored once one of the two texts changes."""

    choice: Choice
    sides: str
    """`sides_hash` of the two texts that the user saw."""
    text: str | None = None
    """The user's text for `Choice.EDIT`; the new name for `Choice.MOVED`."""


def sides_hash(mine: str | None, generated: str | None) -> str:
    """Return one hash for both sides, from the hashes of their texts."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()


class Kind(enum.StrEnum):
    """An effect on a file. The properties of `Action` give its consequences."""

    WRITE = "write"
    DELETE = "delete"
    LEAVE = "leave"
    CONFLICT = "conflict"
    """The file stays, although the generated text differs."""


class FileStatus(enum.StrEnum):
    """The state of a file before the build, the most urgent first."""

    CONFLICT = "conflict"
    """The user and the source changed it."""
    MISSING = "missing"
    """It was written, and the user deleted it."""
    STALE = "stale"
    """The next build writes or deletes it."""
    EDITED = "edited"
    """The user changed it, and its generated text did not change."""
    ORPHAN = "orphan"
    """Nothing generates it any longer. It stays because the user edited it, or the user's files need it."""
    UNKNOWN = "unknown"
    """No known build wrote it, and nothing generates it."""
    IN_STEP = "in step"


class Reason(enum.StrEnum):
    """The reason of an action. The reason decides the effect on the file, and all words about it."""

    # Each reason has a word, kind, status (None without a file), and the end of a sentence that begins with the path.
    # Then the words for n such files in a dry run and, if they differ, after a build. Output keeps this order.
    # fmt: off
    UPDATE = ("update", Kind.WRITE, FileStatus.STALE, "its generated text changed",
              "{n} file{s} to write", "{n} file{s} written")
    CREATE = "create", Kind.WRITE, FileStatus.STALE, "new"
    RESTORE = ("restore", Kind.WRITE, FileStatus.MISSING, "you deleted it",
               "{n} to restore", "{n} restored because you deleted {them}")
    DELETE = "delete", Kind.DELETE, FileStatus.STALE, "no longer generated", "{n} to delete", "{n} deleted"
    MERGE = ("merge", Kind.WRITE, FileStatus.STALE, "your edits and the generated changes, merged",
             "{n} to merge with your edits", "{n} merged with your edits")
    UNDO = ("undo", Kind.WRITE, FileStatus.STALE, "it is as you had it before",
            "{n} to give back as you had {them}", "{n} given back as you had {them}")
    MOVE = ("move", Kind.WRITE, FileStatus.STALE, "its path is new; your edits move here",
            "{n} to move with your edits", "{n} moved with your edits")
    INCLUDED = ("included", Kind.LEAVE, FileStatus.EDITED, "you edited it, and your text already has all changes",
                "{n} that you edited already {have} all changes")
    KEEP = ("keep", Kind.LEAVE, FileStatus.EDITED, "you edited it; its generated text did not change",
            "{n} kept because you edited {them}")
    ORPHAN = ("orphan", Kind.LEAVE, FileStatus.ORPHAN, "no longer generated, but you edited it; kept",
              "{n} no longer generated but kept because you edited {them}")
    NEEDED = ("needed", Kind.LEAVE, FileStatus.ORPHAN, "no longer generated, but your files need it; kept",
              "{n} no longer generated but kept because your files need {them}")
    CONFLICT = ("conflict", Kind.CONFLICT, FileStatus.CONFLICT, "you edited it, and its generated text changed too",
                "{n} conflict{s}")
    MARKERS = "markers", Kind.CONFLICT, FileStatus.CONFLICT, "git could not merge the edits of two branches"
    UNOWNED = "unowned", Kind.CONFLICT, FileStatus.CONFLICT, "this file exists, and urdfsync did not write it"
    ASKED = "asked", Kind.CONFLICT, FileStatus.CONFLICT, "you edited it, and it may belong to another part now"
    UNKNOWN = "unknown", Kind.LEAVE, FileStatus.UNKNOWN, "urdfsync neither generates this file nor has a record of it"
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
"""Actions that keep a file that is no longer generated."""
CONFLICTS = frozenset(reason for reason in Reason if reason.kind is Kind.CONFLICT)
DISPUTED = CONFLICTS | {Reason.MOVE}
"""Actions that depend on the texts of both sides, or on the user's choice."""
USERS = frozenset({Reason.KEEP, Reason.INCLUDED, Reason.MERGE, Reason.UNDO, Reason.ORPHAN}) | DISPUTED
"""Actions after which the file still has the user's text."""


class Action(msgspec.Struct, frozen=True):
    """The decision about one file, and the hashes that it rests on; `path` is the file's key.

    An action changes only `path`: a file that moves has two actions, MOVE and MOVED_AWAY.
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
    """Whether it waits until the robot's conflicts are resolved."""
    is_left_by_git: bool = False
    """Whether git left another text in the file, such as markers. `mine` is the hash of its meaning (see `united`)."""

    @property
    def kind(self) -> Kind:
        """The effect on the file now: a waiting action leaves it."""
        return Kind.WRITE if self.is_left_by_git and self.reason.kind is Kind.LEAVE else self.reason.kind

    @property
    def status(self) -> FileStatus | None:
        """The file's state before the build; None if there is no file any more."""
        return self.reason.status

    @property
    def replaces(self) -> str:
        """Return the clause that it replaces a text that git made of two versions; empty if it does not."""
        return "replaces git's merge of two branches" if self.is_left_by_git and self.kind is not Kind.CONFLICT else ""

    @property
    def text(self) -> str:
        """The reason, and why it waits, as the end of a sentence that begins with the path; for scripts.

        People read `output.phrases.reason`.
        """
        return "; ".join(filter(None, (self.reason.text, self.replaces, self.waits_for)))

    @property
    def writes(self) -> bool:
        """Whether it changes a file now."""
        return self.kind in (Kind.WRITE, Kind.DELETE) and not self.is_waiting

    @property
    def is_deletion(self) -> bool:
        """Whether the file is deleted now: a waiting action leaves it."""
        return self.kind is Kind.DELETE

    @property
    def is_conflict(self) -> bool:
        """Whether the file stays, although the generated text differs."""
        return self.kind is Kind.CONFLICT

    @property
    def keeps_text(self) -> bool:
        """Whether the text on disk stays, even if it is not the generated one."""
        stays = self.kind in (Kind.LEAVE, Kind.CONFLICT) and self.status is not FileStatus.IN_STEP
        return self.is_waiting or stays

    @property
    def sides(self) -> str:
        """One hash for the texts of both sides: a choice holds while it is the same."""
        return sides_hash(self.mine, self.generated)

    @property
    def waits_for(self) -> str:
        """Why it waits, as a clause; empty if it does not."""
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
        """All actions except those on unchanged files: in most builds, a few out of thousands."""
        return tuple(action for action in self if action.reason not in (Reason.UNCHANGED, Reason.UNKNOWN))
