"""One file's entry in the manifest."""

from __future__ import annotations

import enum

import msgspec

from urdfsync.domain import Role


class Choice(enum.StrEnum):
    """The user's decision about a file in conflict."""

    KEEP = "keep"
    """The file stays as the user has it, until something new would be written."""
    TAKE = "take"
    """The generated text replaces the user's file."""
    MERGE = "merge"
    """Both sides' changes, if they merge cleanly."""


class RecordState(enum.StrEnum):
    """State of a file after the last build."""

    GENERATED = "generated"
    EDITED = "edited"
    CONFLICT = "conflict"
    WAITING = "waiting"
    """A change for it waits until the robot's conflicts are resolved."""
    ORPHAN = "orphan"


class FileRecord(msgspec.Struct, frozen=True, omit_defaults=True):
    """One file's entry in the manifest; `base` is a text hash, None if urdfsync never wrote the file.

    Imported files have the hash of their bytes instead.
    """

    owner: str
    role: Role
    base: str | None = None
    state: RecordState = RecordState.GENERATED
    origin: str | None = None
    """Path that the user's file still has, while it waits to move here with its renamed element."""
    replaced_hash: str | None = msgspec.field(name="stands", default=None)
    """Text hash of another element's file, which urdfsync wrote here; it stays while `origin` waits to move here."""
    choice: Choice | None = None
    """The user's decision, while it waits for another conflict to be resolved."""
    chosen_for: str | None = None
    """Hash of both sides' hashes; the choice holds while neither side changes."""

    @property
    def written_hash(self) -> str | None:
        """Text hash of what urdfsync wrote at this very path."""
        return self.replaced_hash if self.origin else self.base
