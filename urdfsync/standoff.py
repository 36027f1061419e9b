"""Files that both sides changed, and what the user may decide about them: neutral values."""

from __future__ import annotations

import dataclasses
import enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from urdfsync.merge import Merge


class Choice(enum.StrEnum):
    """What to do with a file that conflicts."""

    KEEP = "keep"
    """The file stays as the user has it, until something new would be written."""
    TAKE = "take"
    """The generated text replaces the user's file."""
    MERGE = "merge"
    """Both sides' changes, if they can be merged without doubt."""


@dataclasses.dataclass(frozen=True, slots=True)
class Standoff:
    """One text file that conflicts: the three texts as they are, line endings included."""

    path: str
    """Where the generated text would go, as in the manifest: relative to the configuration's folder, with `/`."""
    owner: str
    """The element that it belongs to, in the domain's words."""
    base: str | None
    """What urdfsync wrote last; None if that is not known, or if it never wrote the file."""
    mine: str
    generated: str
    merge: Merge | None
    """None without a base. Its `text` is None if the sides contradict each other, or if the result makes no sense."""
    origin: str | None = None
    """Where the user's file is, if its element has another name now; None if it is at `path`."""
    rejected: str = ""
    """Why a merge without contradictions is not offered, as in `the merge declares x twice`; empty if it is."""

    @property
    def place(self) -> str:
        """Where the user's file is."""
        return self.origin or self.path
