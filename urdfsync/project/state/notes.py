"""This machine's notes on its own work on one robot, `.urdfsync/notes/<robot>.json`.

They are not committed, and safe to lose. Builds skip work only by these notes, never by the committed state.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.dependencies import localfile
from urdfsync.common.dependencies.places import is_clone
from urdfsync.common.dependencies.reads import depend_on


class Use(msgspec.Struct, frozen=True):
    """Names in a user's file that belong to other parts since the file was saved."""

    facts: tuple[int, ...]
    """Stat values of the file."""
    names: Mapping[str, str]
    """The new names of the parts that the user meant, by the names in the file."""


class Notes(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
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
    edits: Mapping[str, str] = {}
    """The id of the file that each edited text belongs to, by the text's hash: all edits that builds here have seen."""
    lines: Mapping[str, Sequence[str]] = {}
    """The ids of the files to which these edits have added a line, by the line's hash."""
    uses: Mapping[str, Use] = {}
    """Names that mean other parts now, by absolute path of a user's file."""
    model: str = ""
    """Hash of the recorded model in which these names mean other parts; git may bring another record."""


def load(state_folder: Path, robot: str) -> Notes:
    """Return this machine's notes on a robot; empty notes if there are none."""
    file = place(state_folder, robot)
    depend_on(file)
    try:
        notes = msgspec.json.decode(localfile.read(file) or b"", type=Notes)
    except (ValueError, RecursionError):
        return Notes()
    if is_clone():  # of this machine's work, a clone may skip conversions, but it has no history
        return Notes(program=notes.program, texts=notes.texts, imports=notes.imports, expansion=notes.expansion)
    return notes


def save(state_folder: Path, robot: str, notes: Notes) -> dict[str, None]:
    """Write the notes on a robot, if there is a state folder; return the path of the file, as a key.

    If writing fails, the next build repeats the work. A clone has no notes.
    """
    if not state_folder.is_dir() or is_clone():
        return {}
    file = str(place(state_folder, robot))
    localfile.replace(file, msgspec.json.encode(notes, order="sorted"))
    return {file: None}


def place(state_folder: Path, robot: str) -> Path:
    """Return the file of the notes on a robot."""
    return state_folder / "notes" / f"{robot}.json"
