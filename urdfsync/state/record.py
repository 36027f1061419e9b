"""What is recorded of a robot: its last complete build, and what is open since.

The record advances only as a whole. A build that ends with a conflict leaves it as it is, but for the bases of the
files that it renewed, so that the next build compares with the last complete one.
"""

from __future__ import annotations

import enum
import hashlib
from collections.abc import Mapping
from typing import Any

import msgspec

from urdfsync.domain import ElementKey, Import, Role, Snapshot

RESOURCES = "Resources/"
"""Where imported files are, below the package."""


class Choice(enum.StrEnum):
    """The user's decision about a file in conflict."""

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


class FileRecord(msgspec.Struct, frozen=True):
    """The base of one file: the hash of the generated text that it last took into account.

    Imported files have the hash of their bytes. Where git has united two states, a file may have several hashes: then
    its base is ambiguous until the next complete build.
    """

    hashes: tuple[str, ...] = ()
    is_users: bool = False
    """Whether the user keeps a file that was no longer generated. This goes before any hash."""

    @property
    def is_ambiguous(self) -> bool:
        """Whether it is not known which text the file last took into account."""
        return len(self.hashes) > 1

    def base(self, mine: object, generated: str | None) -> str | None:
        """Return the base to compare with; None if urdfsync never wrote the file, or if it is the user's.

        A file that nobody edited has any of the hashes. An edited one with an ambiguous base is not kept in silence:
        its base is none that equals the generated text.
        """
        if self.is_users or not self.hashes:
            return None
        if isinstance(mine, str) and mine in self.hashes:
            return mine
        return next((one for one in self.hashes if one != generated), self.hashes[0])


class Generator(msgspec.Struct, frozen=True):
    """What turned the model into files, beside the options."""

    domain: str
    revision: int
    templates: str
    """Hash of the templates."""


class Open(msgspec.Struct, frozen=True):
    """What the user has decided since the last complete build, and what is needed to recognise renames."""

    choices: Mapping[tuple[str, str], Choice] = {}
    """By the path below the package and `sides_hash`: a choice holds for the two texts that it was made on."""
    seen: Snapshot = {}
    """The model that the last build saw."""
    renamed: Mapping[ElementKey, str] = {}
    """Elements of the last complete build that have another name in the model last seen."""
    imports: Mapping[str, Import] = {}
    """Imported files that were renewed since, as the build that renewed them read them."""


class Record(msgspec.Struct, frozen=True, kw_only=True):
    """The last complete build of one robot, and what is open since.

    `files` are by their keys: POSIX paths relative to the configuration's folder, like `folder`, the package's own.
    What follows from the model is not recorded.
    """

    package: str
    class_: str
    folder: str
    generator: Generator
    options: Mapping[str, Any] = {}
    """The domain's options as JSON has them, without those that are None."""
    snapshots: tuple[Snapshot, ...] = ()
    """The model; none before the first complete build, several if git has united two states of it."""
    imports: Mapping[str, tuple[Import, ...]] = {}
    files: Mapping[str, FileRecord] = {}
    texts: Mapping[str, str] = {}
    """Bases by their hashes, as far as they can't be rendered from the model."""
    open: Open | None = None
    """None if nothing is: the last build was complete."""
    is_ambiguous: bool = False
    """Whether git has united two states, or lines are lost: then generator and model are not known for sure."""

    @property
    def snapshot(self) -> Snapshot | None:
        """The model; None if there is none, or if it is not known which one it is."""
        return self.snapshots[0] if len(self.snapshots) == 1 and not self.is_ambiguous else None


def role_of(path: str) -> Role:
    """Return what a recorded file is that nothing generates any more, by its path below the package."""
    if path.startswith(RESOURCES):
        return Role.IMPORT
    return Role.PACKAGE if path.rpartition("/")[2] == "package.mo" else Role.RECORD


def sides_hash(mine: str | None, generated: str | None) -> str:
    """Return one hash for the texts of both sides, from theirs."""
    return hashlib.sha256(f"{mine} {generated}".encode()).hexdigest()
