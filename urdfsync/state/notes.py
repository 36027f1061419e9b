"""This machine's notes on its own work on one robot, `.urdfsync/notes/<robot>.json`.

They are not committed, and safe to lose. Builds skip work only by these notes, never by the committed state. A copy of
the notes, such as a committed copy, is ignored: it has another inode or time.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync.answers.dependencies import note_content
from urdfsync.answers.facts import MAX_FILE, STAT
from urdfsync.answers.places import is_clone
from urdfsync.files import TEMPORARY
from urdfsync.state import file_operations


class Use(msgspec.Struct, frozen=True):
    """Names in a user's file that belong to other parts since the file was saved."""

    facts: tuple[int, ...]
    """Stat values of the file."""
    names: Mapping[str, str]
    """The new names of the parts that the user meant, by the names in the file."""


class Notes(file_operations.Bound, frozen=True, kw_only=True, omit_defaults=True):
    """This machine's notes on one robot."""

    program: str = ""
    """Hash of the program and the templates that made the texts and imports; another program makes them again."""
    texts: Mapping[str, tuple[str, str]] = {}
    """Two hashes for each text, by path below the package: of its template and data, and of the text."""
    imports: frozenset[str] = frozenset()
    """Hashes of the imports that this machine converted."""
    expansion: str = ""
    """Hash of the source that this machine expanded."""
    written: frozenset[str] = frozenset()
    """Hashes of recorded texts and imported files that this machine generated."""
    renamed: Mapping[str, str] = {}
    """New identifiers by old identifiers, from the last build that wrote anything."""
    proposals: Mapping[str, tuple[str, str]] = {}
    """Two hashes for each proposed merge, by path: of the proposal and of its two sides. A person changed a proposal if
    its hash differs."""
    model: str = ""
    """Hash of the last recorded model."""
    edited: Mapping[str, str] = {}
    """Hashes of the edited files at the last build, by key."""
    uses: Mapping[str, Use] = {}
    """Names that mean other parts now, by absolute path of a user's file."""
    said: frozenset[str] = frozenset()
    """Hashes of the findings of the last build."""


def load(state_folder: Path, robot: str) -> Notes:
    """Return this machine's notes on a robot; empty notes if there are none."""
    file = place(state_folder, robot)
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0)  # opening a pipe must not block
    try:
        with os.fdopen(os.open(file, flags), "rb") as opened:
            status = os.fstat(opened.fileno())
            content = opened.read() if status.st_size <= MAX_FILE else b""
        note_content(STAT, file, content)
        notes = msgspec.json.decode(content, type=Notes)
    except (OSError, ValueError, RecursionError):
        return Notes()
    if (notes.inode, notes.written_at) != (status.st_ino, status.st_mtime_ns):
        return Notes()
    if is_clone():  # of this machine's work, a clone may skip conversions, but it has no history
        return Notes(program=notes.program, texts=notes.texts, imports=notes.imports, expansion=notes.expansion)
    return notes


def save(state_folder: Path, robot: str, notes: Notes) -> None:
    """Write the notes on a robot, if there is a state folder.

    If writing fails, the next build repeats the work.
    """
    file = place(state_folder, robot)
    temporary = file.with_name(f".{file.name}{TEMPORARY}")
    with contextlib.suppress(OSError):
        if is_clone() or not state_folder.is_dir() or state_folder.is_symlink() or file.parent.is_symlink():
            return  # a repository may have committed a link to another folder
        file_operations.make_folder(file.parent)
        file_operations.remove(temporary)  # a killed process left this file
        file_operations.write_bound(temporary, notes)
        file_operations.replace(temporary, file)


def place(state_folder: Path, robot: str) -> Path:
    """Return the file of the notes on a robot."""
    return state_folder / "notes" / f"{robot}.json"
