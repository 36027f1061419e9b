"""The planned hashes: what a build is about to write, put aside before its first write.

`planned.json` in the state folder. It goes when the build is complete, so what stands there is of a build that was
killed: the next one finishes it.
"""

from __future__ import annotations

from pathlib import Path

import msgspec

from urdfsync.dependencies import file_type
from urdfsync.files import TEMPORARY
from urdfsync.state import file_operations

FILE = "planned.json"
DRAFT = f".{FILE}{TEMPORARY}"
"""The file's name until all new files are written; nothing has changed as long as it has that."""


class PlannedFile(msgspec.Struct, frozen=True, omit_defaults=True):
    """The change of one file, by SHA-256 (hex) of its bytes; None stands for no file."""

    path: str
    """POSIX, from the configuration's folder."""
    old: str | None = None
    new: str | None = None
    is_moved: bool = False
    """As in `transaction.FileChange`."""


class PlannedBuild(file_operations.Bound, frozen=True):
    """The planned changes of one build."""

    robot: str
    token: str
    """Part of the temporary files' names: hexadecimal."""
    files: tuple[PlannedFile, ...]
    emptied: tuple[str, ...] = ()
    """Folders that go if the build leaves them empty, innermost first."""


def is_interrupted(state_folder: Path) -> bool:
    """Whether a build is changing files, or was when its process ended. Needs no lock."""
    return file_type(state_folder / FILE, follow=False) != 0


def parse(file: Path, content: bytes | None) -> PlannedBuild | None:
    """The planned hashes in the content of their file; None if they were not written in this very place.

    A file that a stranger has committed is not believed: what is under temporary names would be taken for urdfsync's.
    """
    try:
        planned = msgspec.json.decode(content or b"", type=PlannedBuild)
        return planned if file_operations.is_bound(file, planned) else None
    except (OSError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None
