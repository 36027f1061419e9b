"""Files that both sides changed, and what the user may decide about them: neutral values."""

from __future__ import annotations

import enum
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, NamedTuple

import msgspec

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


class Standoff(msgspec.Struct, frozen=True):
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
    """Why there is no merge although the sides need not contradict each other, as a clause; empty if there is one."""

    @property
    def place(self) -> str:
        """Where the user's file is."""
        return self.origin or self.path


class Aside(NamedTuple):
    """Where the texts of a conflict are put aside, as paths below the robot's folder of conflicts."""

    generated: str
    base: str | None
    merge: str | None


def aside(standoff: Standoff, folder: str) -> Aside:
    """Where the texts of a conflict are put aside; `folder` is the package's, as in `standoff.path`.

    A proposal with markers in it is no Modelica, and not called so.
    """
    path = PurePosixPath(standoff.path).relative_to(folder)
    stem, suffix = path.with_suffix("").as_posix(), path.suffix
    merge = standoff.merge
    return Aside(
        generated=f"{stem}.generated{suffix}",
        base=None if standoff.base is None else f"{stem}.base{suffix}",
        merge=None if merge is None else f"{stem}.merge{'.txt' if merge.text is None else suffix}",
    )
