"""Actions: a build writes, deletes or leaves each file of a robot, for one reason."""

from __future__ import annotations

import enum
import functools
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
    """A merge of both sides' changes, if these do not contradict each other."""
    MERGE_MINE = "merge-mine"
    """A merge of both sides' changes; for each contradiction, the user's side."""
    MERGE_GENERATED = "merge-generated"
    """A merge of both sides' changes; for each contradiction, the generated side."""
    MERGE_THEIRS = "merge-theirs"
    """A merge of two branches; for each contradiction, the side of the other branch."""
    EDIT = "edit"
    """A text that the user merged in an editor."""
    MOVED = "moved"
    """The edit moves to the file of another element."""
    UNDO = "undo"
    """The file gets back the text and the base that a choice or a build replaced."""


class UsersChoice(msgspec.Struct, frozen=True):
    """The user's decision about one file. Builds ignore it once the user's or the generated text changes."""

    choice: Choice
    sides: str
    """`sides_hash` of the two texts that the user saw."""
    text: str | None = None
    """The user's text for `Choice.EDIT`; the new name for `Choice.MOVED`."""


def sides_hash(mine: str | None, generated: str | None) -> str:
    """Return one hash for both sides, from the hashes of the user's and the generated text."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()


class Kind(enum.StrEnum):
    """An effect on a file. The properties of `Action` tell its consequences."""

    WRITE = "write"
    DELETE = "delete"
    LEAVE = "leave"
    CONFLICT = "conflict"
    """The file stays, although the generated text differs."""


class FileStatus(enum.StrEnum):
    """The state of a file before the build, the most urgent first."""

    CONFLICT = "conflict"
    """The user and the source changed the file."""
    MISSING = "missing"
    """A build wrote the file, and the user deleted it."""
    STALE = "stale"
    """The next build writes or deletes the file."""
    EDITED = "edited"
    """The user changed the file, and its generated text did not change."""
    ORPHAN = "orphan"
    """The file is no longer generated, but stays: the user edited it, or the user's files need it."""
    UNKNOWN = "unknown"
    """The file is not generated, and no known build wrote it."""
    IN_STEP = "in step"


class Reason(enum.StrEnum):
    """The reason of an action. The reason decides the effect on the file, and the words in messages."""

    # Each reason has a word, kind, status (None without a file), and the rest of a sentence after the path.
    # Then the words for n such files: in a dry run, and after a build if these words differ. Output has this order.
    # fmt: off
    UPDATE = ("update", Kind.WRITE, FileStatus.STALE, "it differs from its generated text",
              "{n} file{s} to write", "{n} file{s} written")
    CREATE = "create", Kind.WRITE, FileStatus.STALE, "new"
    RESTORE = ("restore", Kind.WRITE, FileStatus.MISSING, "you deleted it",
               "{n} to restore", "{n} restored because you deleted {them}")
    DELETE = "delete", Kind.DELETE, FileStatus.STALE, "unedited, and not generated here", "{n} to delete", "{n} deleted"
    MERGE = ("merge", Kind.WRITE, FileStatus.STALE, "your edits and the generated changes, merged",
             "{n} to merge with your edits", "{n} merged with your edits")
    UNDO = ("undo", Kind.WRITE, FileStatus.STALE, "your former text is back",
            "{n} to set back to your former text", "{n} set back to your former text")
    MOVE = ("move", Kind.WRITE, FileStatus.STALE, "its path is new; your edits move here",
            "{n} to move with your edits", "{n} moved with your edits")
    KEEP = ("keep", Kind.LEAVE, FileStatus.EDITED, "you edited it; its generated text has nothing new",
            "{n} kept because you edited {them}")
    ORPHAN = ("orphan", Kind.LEAVE, FileStatus.ORPHAN, "no longer generated, but you edited it; kept",
              "{n} orphan{s} kept because you edited {them}")
    NEEDED = ("needed", Kind.LEAVE, FileStatus.ORPHAN, "no longer generated, but your files need it; kept",
              "{n} orphan{s} kept because your files need {them}")
    CONFLICT = ("conflict", Kind.CONFLICT, FileStatus.CONFLICT, "you edited it, and its generated text changed too",
                "{n} conflict{s}")
    MARKERS = "markers", Kind.CONFLICT, FileStatus.CONFLICT, "git could not merge the edits of two branches"
    UNOWNED = "unowned", Kind.CONFLICT, FileStatus.CONFLICT, "this file exists, and urdfsync did not write it"
    ASKED = "asked", Kind.CONFLICT, FileStatus.CONFLICT, "you edited it, and it may belong to another part now"
    SECOND = "second", Kind.CONFLICT, FileStatus.CONFLICT, "another edited file belongs to the same part"
    RENAMED = "renamed", Kind.CONFLICT, FileStatus.CONFLICT, "it uses a name that has changed"
    UNKNOWN = "unknown", Kind.LEAVE, FileStatus.UNKNOWN, "urdfsync neither generates this file nor has a record of it"
    UNCHANGED = "unchanged", Kind.LEAVE, FileStatus.IN_STEP, "nothing to do"
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
"""Reasons to keep a file that is no longer generated."""
CONFLICTS = frozenset(reason for reason in Reason if reason.kind is Kind.CONFLICT)
SO_FAR = "so far"
"""The word before the former name of a file whose part is renamed."""
_OF_COPIES = {
    Reason.DELETE: "an unedited copy of {}",
    Reason.RENAMED: "it is your copy of {}, and it uses a name that has changed",
    Reason.UNKNOWN: "its stamp is that of {}: it is a copy, and your own once you delete the stamp",
}
"""The words about a copy, by reason."""
DISPUTED = CONFLICTS | {Reason.MOVE}
"""Reasons of actions that depend on the user's and the generated text, or on the user's choice."""
USERS = frozenset({Reason.KEEP, Reason.MERGE, Reason.UNDO, Reason.ORPHAN}) | DISPUTED
"""Reasons of actions after which the file still has the user's text or edits."""


class Action(msgspec.Struct, frozen=True):
    """The decision about one file, and the hashes behind the decision; `path` is the file's key."""

    KEYS = ("path", "origin", "status", "kind", "reason", "is_waiting", "owner", "role", "text")

    path: str
    reason: Reason
    role: Role
    owner: str = ""
    base: str | None = None
    generated: str | None = None
    origin: str | None = None
    """Path of the file on disk, if it moves to `path`, or would without its conflict; None if it is at `path`."""
    choice: Choice | None = None
    """The user's decision about the file; None without one."""
    mine: str | None = None
    """Hash of the file on disk; None if there is none."""
    is_waiting: bool = False
    """Whether the action waits until the robot's conflicts are resolved."""
    is_left_by_git: bool = False
    """Whether the file on disk is git's merge of two branches, and does not equal the text that both meant. Then `mine`
    is the hash of the meant text (see `inspect/united`)."""
    lacks_stamp: bool = False
    """Whether the class on disk has no stamp: then its path says which part it is."""
    copy_of: str = ""
    """The path, below the package, of the generated file with the same id; empty unless this file is another one."""

    @property
    def kind(self) -> Kind:
        """The effect on the file once the action no longer waits."""
        return Kind.WRITE if self.is_left_by_git and self.reason.kind is Kind.LEAVE else self.reason.kind

    @property
    def status(self) -> FileStatus | None:
        """The file's state before the build; None if the file is gone."""
        return self.reason.status

    @property
    def present(self) -> str:
        """The present path of the user's file: for a conflict its old one, for a class in a folder its `package.mo`."""
        is_users = self.status in (FileStatus.EDITED, FileStatus.CONFLICT, FileStatus.ORPHAN)
        if is_users and not self.is_on_disk and self.path.endswith(".mo"):
            return f"{self.path.removesuffix('.mo')}/package.mo"
        return (self.origin if self.is_conflict else None) or self.path

    @property
    def word(self) -> str:
        """The word for people; a conflict or an orphan has the word of its status, and `text` tells its reason."""
        by_status = self.is_conflict or self.reason in ORPHANS
        return "waiting" if self.is_waiting else str(self.status if by_status else self.reason)

    @property
    def cause(self) -> str:
        """The reason in words; an unedited file whose part had another name, or that the user moved, is not new."""
        if self.reason in (Reason.CREATE, Reason.UPDATE) and self.origin:
            return f"{SO_FAR} {self.origin.rpartition('/')[2]}"
        if self.restores_stamp:
            return "its stamp is missing"
        if self.reason is Reason.KEEP and self.lacks_stamp:
            return "you edited it; without its stamp, its path counts: `resolve FILE --keep` stamps it"
        words = _OF_COPIES.get(self.reason, "") if self.copy_of else ""
        return words.format(self.copy_of) or self.reason.text

    @property
    def restores_stamp(self) -> bool:
        """Whether the file on disk lacks its stamp, and nothing else."""
        return self.lacks_stamp and self.reason is Reason.UPDATE

    @property
    def replaces(self) -> str:
        """Return a clause if the action replaces a text that git merged from two versions; empty otherwise."""
        return "replaces git's merge of two branches" if self.is_left_by_git and self.kind is not Kind.CONFLICT else ""

    @property
    def text(self) -> str:
        """The reason, and why the action waits, for scripts: the end of a sentence that begins with the path.

        The output for people has `output.phrases.reason`.
        """
        return "; ".join(filter(None, (self.cause, self.replaces, self.waits_for)))

    @property
    def writes(self) -> bool:
        """Whether the action changes a file now."""
        return self.kind in (Kind.WRITE, Kind.DELETE) and not self.is_waiting

    @property
    def is_deletion(self) -> bool:
        """Whether the action deletes the file, at once or after waiting."""
        return self.kind is Kind.DELETE

    @property
    def is_conflict(self) -> bool:
        """Whether the file stays, although the generated text differs."""
        return self.kind is Kind.CONFLICT

    @property
    def keeps_text(self) -> bool:
        """Whether the file keeps a text on disk that may differ from the generated one."""
        stays = self.kind in (Kind.LEAVE, Kind.CONFLICT) and self.status is not FileStatus.IN_STEP
        return self.is_waiting or stays

    @property
    def sides(self) -> str:
        """One hash for the texts of both sides: the user's choice holds while this hash is the same."""
        return sides_hash(self.mine, self.generated)

    @property
    def waits_for(self) -> str:
        """Why the action waits, as a clause; empty if it does not wait."""
        return "waits for the conflicts" if self.is_waiting else ""

    @property
    def is_on_disk(self) -> bool:
        """Whether there is a file that the generated content can replace."""
        return self.mine is not None


class Actions(tuple[Action, ...]):
    """The actions for all files of a robot, in the order of their paths."""

    def __new__(cls, actions: Iterable[Action] = ()) -> Actions:
        """Sort the actions by path."""
        return super().__new__(cls, sorted(actions, key=lambda action: action.path))

    @functools.cached_property
    def decided(self) -> tuple[Action, ...]:
        """All actions except those on unchanged files: in most builds, a few out of thousands."""
        return tuple(action for action in self if action.reason not in (Reason.UNCHANGED, Reason.UNKNOWN))


def find_deletions(actions: Iterable[Action]) -> set[str]:
    """Return the paths at which no file is left once nothing conflicts: of deleted files, and of files that move."""
    left, deleted = set[str](), set[str]()
    for action in actions:
        deleted |= {key for key in (action.path if action.is_deletion else action.origin,) if key}
        left |= set() if action.is_deletion else {action.path}
    return deleted - left


def find_left_paths(actions: Iterable[Action]) -> set[str]:
    """Return the paths at which no file is left after the build."""
    actions = tuple(actions)
    return find_deletions(actions) & {action.origin or action.path for action in actions if action.writes}
