"""The journal of a transaction: what it changes, and how far it is. It says enough to finish the transaction.

`journal/<phase>.json` in the state folder. Phases follow each other by renaming the file. The next build believes a
journal only if this checkout wrote it, and only about files that a build writes.
"""

from __future__ import annotations

import enum
import os
from collections.abc import Callable, Sequence
from pathlib import Path, PurePath
from typing import NoReturn

import msgspec

from urdfsync.dependencies import list_folder
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.files import TEMPORARY, Tree
from urdfsync.state import file_operations

FORMAT = 3
"""Raised when another urdfsync could misread a journal. Before 3, files stood in `undo/`, and builds could go back."""
_REPAIR = "`urdfsync build --repair` sets it aside; files that are half way are shown as conflicts then"
_OLD_PHASES = ("undo",)


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


class Journal(msgspec.Struct, frozen=True):
    """One transaction. The last step is the one that records the others."""

    robot: str
    token: str
    """Part of the temporary files' names: hexadecimal."""
    steps: tuple[Step, ...]
    made: tuple[str, ...] = ()
    """Folders that the transaction makes, outermost first."""
    emptied: tuple[str, ...] = ()
    """Folders that go if the transaction leaves them empty, innermost first."""
    inode: int = 0
    written: int = 0
    """Inode and time of change (ns) of the journal's own file."""
    format: int = FORMAT


class _Formatted(msgspec.Struct):
    format: int = 0


def journal_file(folder: Path, phase: Phase) -> Path:
    """Where the journal is in a state folder."""
    return folder / "journal" / f"{phase}.json"


def unfinished_file(folder: Path) -> Path:
    """Where a journal is while it is written."""
    return folder / "journal" / f"new{TEMPORARY}"


def find_phase(folder: Path) -> Phase | None:
    """The phase of the transaction that a state folder has, None if it has none."""
    names = _names(folder / "journal")
    return next((phase for phase in reversed(Phase) if f"{phase}.json" in names), None)


def is_pending(folder: Path) -> bool:
    """Whether a state folder has a transaction, or traces of one that an older urdfsync began."""
    return find_phase(folder) is not None or _is_old(folder)


def save(folder: Path, journal: Journal) -> None:
    """Write a journal, bound to its file, for the phase PREPARE; as a whole or not at all. Raises OSError."""

    def encode(inode: int, written: int) -> bytes:
        return msgspec.json.encode(msgspec.structs.replace(journal, inode=inode, written=written))

    file_operations.remove(unfinished_file(folder))  # of a run that was killed here
    file_operations.write_bound(unfinished_file(folder), encode)
    file_operations.replace(unfinished_file(folder), journal_file(folder, Phase.PREPARE))


def load(root: Path, folder: Path, phase: Phase, shown: Callable[[Path], str]) -> Journal:
    """The journal of this phase.

    Raises StateError, and changes nothing, for a journal that an older or newer urdfsync wrote or that was not written
    in this checkout, OutputError for what is no regular file.
    """
    file = journal_file(folder, phase)
    content = Tree(root, shown).read(file) or b""
    try:
        version = msgspec.json.decode(content, type=_Formatted).format
        journal = msgspec.json.decode(content, type=Journal) if version == FORMAT else None
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        _refuse(shown(file), "the journal of an interrupted build can't be read", _REPAIR)
    if version > FORMAT:
        _refuse(shown(file), "a newer urdfsync was interrupted here", "update urdfsync", "newer-state")
    if journal is None:
        refuse_old(folder, shown)
    if not file_operations.is_bound(file, journal.inode, journal.written) or not _is_token(journal.token):
        _refuse(shown(file), "the journal of an interrupted build was not written in this checkout", _REPAIR)
    return journal


def refuse_old(folder: Path, shown: Callable[[Path], str]) -> NoReturn:
    """Say that an older urdfsync was interrupted here. Raises StateError."""
    message = "an older urdfsync was interrupted here; `undo/` may hold files that you saved meanwhile"
    hint = f"finish the build with that urdfsync, or move {shown(folder / 'journal')} and {shown(folder / 'undo')} away"
    _refuse(shown(folder / "journal"), message, hint, "older-state")


def set_aside(folder: Path) -> Path:
    """Give a journal another name, so that nobody acts on it. Raises OSError."""
    phase = find_phase(folder) or Phase.APPLY
    aside = folder / "journal" / "refused.json"
    file_operations.replace(journal_file(folder, phase), aside)
    return aside


def check_paths(
    paths: Sequence[Path], trees: Sequence[Tree], folder: Path, shown: Callable[[Path], str], source: Path | None = None
) -> None:
    """Refuse files that no build writes, and links on the way to a file. Raises StateError or OutputError.

    `trees` are the configuration's folder and the outputs; `source` is the journal that names the files, None for a
    build that is about to write them.
    """
    for path in paths:
        tree = next((tree for tree in trees if tree.covers(path)), None)
        if tree is None:
            message = "an interrupted build was writing this file, but it is in no output folder now"
            hint = "bring back the `output` that the robot had, build, then change it"
            _refuse(shown(path), message if source else "the file is in no output folder", hint, "outside")
        if not _is_written(path, tree, folder):
            message, hint = f"{shown(path)} is no file that a build writes", _REPAIR if source else ""
            _refuse(shown(source or path), message, hint, "broken-journal" if source else "outside")
        tree.check_folder(path.parent)


def check_folders(paths: Sequence[Path], trees: Sequence[Tree], folder: Path, shown: Callable[[Path], str]) -> None:
    """Refuse folders in which no build writes. Raises StateError or OutputError."""
    for path in paths:
        tree = next((tree for tree in trees if tree.covers(path)), None)
        hidden = tree is None or any(part.startswith(".") for part in path.relative_to(tree.root).parts)
        if tree is None or (hidden and path != folder and folder not in path.parents):
            _refuse(shown(path), "an interrupted build made this folder, but it is in no output folder now", _REPAIR)
        tree.check_folder(path.parent)


def _is_written(path: Path, tree: Tree, folder: Path) -> bool:
    """Whether a file is of a package, around one, or of the state."""
    if path.is_relative_to(folder):
        return _is_state(path.relative_to(folder))
    parts = path.relative_to(tree.root).parts
    if any(part.startswith(".") for part in parts):  # `.git` among them
        return False
    if parts[-1].endswith(".mo") or parts[-1] == "package.order":
        return True
    return "Resources" in parts[1:-1]


def _is_state(path: PurePath) -> bool:
    """Whether a path in the state folder is that of a file that transactions write."""
    top, suffix = path.parts[0], path.suffix
    if len(path.parts) == 1:
        return top == ".gitignore"
    if len(path.parts) == 2 and top in ("robots", "svg"):
        return suffix in ((".toml", ".json") if top == "robots" else (".svg",))
    return top == "conflicts"


def _is_old(folder: Path) -> bool:
    """Whether an older urdfsync has left files in `undo/`, or a journal of a phase that is no more."""
    journals = _names(folder / "journal")
    return any(f"{phase}.json" in journals for phase in _OLD_PHASES) or bool(_names(folder / "undo"))


def _is_token(token: str) -> bool:
    return bool(token) and all(char in "0123456789abcdef" for char in token)


def _names(folder: Path) -> list[str]:
    try:
        return list_folder(os.fspath(folder))
    except (FileNotFoundError, NotADirectoryError):
        return []


def _refuse(file: str, message: str, hint: str, code: str = "broken-journal") -> NoReturn:
    raise StateError(Diagnostic(Severity.ERROR, code, message, file, hint=hint))
