"""The journal of a batch of writes, text ↔ value: enough to finish it, and enough to undo it."""

from __future__ import annotations

import enum
from typing import Self

import msgspec

FORMAT = 2
"""Raised when an older urdfsync could misread what a newer one writes."""
MAY_BE_APART = 2
"""Since this format, temporary files may stand in the state folder; before, each stood beside its target."""


class Phase(enum.StrEnum):
    """How far a batch is: the name of its journal. Phases follow each other by renaming the file."""

    PREPARE = "prepare"
    """Temporary files are being written; no target has changed."""
    APPLY = "apply"
    """All temporary files are complete; some targets may have changed."""
    UNDO = "undo"
    """Targets are being put back."""
    DONE = "done"
    """All targets have changed; what is left is to tidy up."""


class Step(msgspec.Struct, frozen=True, omit_defaults=True):
    """The change of one file, by SHA-256 of its bytes; None stands for no file."""

    path: str
    """POSIX, from the configuration's folder."""
    old: str | None = None
    new: str | None = None


class Journal(msgspec.Struct, frozen=True):
    """One batch. The last step is the one that records the others."""

    robot: str
    token: str
    """Part of the temporary files' names."""
    steps: tuple[Step, ...]
    made: tuple[str, ...] = ()
    """Folders that the batch makes, outermost first."""
    emptied: tuple[str, ...] = ()
    """Folders that go if the batch leaves them empty, innermost first."""
    format: int = FORMAT

    def dumps(self) -> bytes:
        """The journal as text."""
        return msgspec.json.encode(self)

    @classmethod
    def loads(cls, content: bytes) -> Self | None:
        """The journal in a text, None if it is none, for example because it is cut short."""
        try:
            return msgspec.json.decode(content, type=cls)
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return None
