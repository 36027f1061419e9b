"""The journal of a transaction: what it changes, and how far it is. It says enough to finish the transaction.

`journal/<phase>.json` in the state folder. Phases follow each other by renaming the file. The next build believes a
journal only if this checkout wrote it, and only about files that a build writes.
"""

from __future__ import annotations

import contextlib
import enum
from pathlib import Path
from typing import NoReturn

import msgspec

from urdfsync.dependencies import list_folder
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.files import TEMPORARY, Tree, shown
from urdfsync.state import file_operations

FORMAT = 4
"""Raised when another urdfsync could misread a journal."""
_ASIDE = "refused.json"
REPAIR = "`urdfsync build --repair` sets the journal aside; files that are half way are shown as conflicts then"


class Phase(enum.StrEnum):
    """How far a transaction is: the name of its journal."""

    PREPARE = "prepare"
    """Temporary files are being written; no target has changed."""
    APPLY = "apply"
    """All temporary files are complete; some targets may have changed."""
    DONE = "done"
    """All targets have changed; temporary files are left."""


class Step(msgspec.Struct, frozen=True, omit_defaults=True):
    """The change of one file, by SHA-256 (hex) of its bytes; None stands for no file."""

    path: str
    """POSIX, from the configuration's folder."""
    old: str | None = None
    new: str | None = None
    is_moved: bool = False
    """As in `transaction.FileChange`."""


class Journal(file_operations.Bound, frozen=True):
    """One transaction."""

    robot: str
    token: str
    """Part of the temporary files' names: hexadecimal."""
    steps: tuple[Step, ...]
    made: tuple[str, ...] = ()
    """Folders that the transaction makes, outermost first."""
    emptied: tuple[str, ...] = ()
    """Folders that go if the transaction leaves them empty, innermost first."""
    format: int = FORMAT


class _JournalFormat(msgspec.Struct):
    format: int = 0


class JournalFolder:
    """The folder of journals below a configuration's folder; it need not exist."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.folder = folder
        self._root = root
        self._new = folder / f"new{TEMPORARY}"

    def file(self, phase: Phase) -> Path:
        """Where the journal is in a phase."""
        return self.folder / f"{phase}.json"

    def names(self) -> list[str]:
        """The names of all journals, perhaps of another urdfsync, but for one that was set aside."""
        with contextlib.suppress(FileNotFoundError, NotADirectoryError):
            return [name for name in list_folder(self.folder) if name.endswith(".json") and name != _ASIDE]
        return []

    def phase(self) -> Phase | None:
        """The phase of the transaction under way, None if there is none."""
        names = self.names()
        return next((phase for phase in reversed(Phase) if f"{phase}.json" in names), None)

    def save(self, journal: Journal) -> None:
        """Write a journal, bound to its file, for the phase PREPARE; as a whole or not at all. Raises OSError."""
        file_operations.remove(self._new)  # of a run that was killed here
        file_operations.write_bound(self._new, journal)
        file_operations.replace(self._new, self.file(Phase.PREPARE))
        file_operations.sync([self.file(Phase.PREPARE)])

    def enter(self, phase: Phase) -> None:
        """Rename the journal. Raises OSError."""
        now = self.phase()
        if now is not None and now is not phase:
            file_operations.replace(self.file(now), self.file(phase))

    def remove(self) -> None:
        """Remove the journal, and what is left of one that was being written. Raises OSError."""
        file_operations.remove(self._new)
        if (now := self.phase()) is not None:
            file_operations.remove(self.file(now))

    def set_aside(self) -> Path:
        """Give a journal another name, so that nobody acts on it. Raises OSError."""
        for name in self.names():
            file_operations.replace(self.folder / name, self.folder / _ASIDE)
        return self.folder / _ASIDE

    def load(self) -> tuple[Journal, Phase]:
        """The journal of the transaction under way, and its phase.

        Raises StateError, and changes nothing, for a journal that another urdfsync wrote or that was not written in
        this checkout, OutputError for what is no regular file, and for a folder that is a link.
        """
        tree = Tree(self._root)
        tree.check_folder(self.folder)  # whatever its files are called: they are not ours to set aside at a link's end
        phase = self.phase()
        if phase is None:
            self._refuse(self.folder, "an older urdfsync was interrupted here")
        file = self.file(phase)
        content = tree.read(file)
        try:
            version = msgspec.json.decode(content or b"", type=_JournalFormat).format
            journal = msgspec.json.decode(content or b"", type=Journal) if version == FORMAT else None
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            self._refuse(file, "the journal of an interrupted build can't be read")
        if version > FORMAT:
            self._refuse(file, "a newer urdfsync was interrupted here", "newer-state", "update urdfsync")
        if journal is None:
            self._refuse(file, "an older urdfsync was interrupted here")
        is_token = journal.token and set(journal.token) <= set("0123456789abcdef")
        if not is_token or not file_operations.is_bound(file, journal):
            self._refuse(file, "the journal of an interrupted build was not written in this checkout")
        return journal, phase

    def _refuse(self, file: Path, message: str, code: str = "broken-journal", hint: str = REPAIR) -> NoReturn:
        raise StateError(Diagnostic(Severity.ERROR, code, message, shown(file), hint=hint))
