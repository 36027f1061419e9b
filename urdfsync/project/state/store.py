"""Reads and writes `.urdfsync/`: the record and the bases of each robot."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import TypeAlias

import msgspec

from urdfsync.common.dependencies.reads import list_folder, walk_files
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.files import Tree, digest, normalised, shown
from urdfsync.domain.matching import Doubt
from urdfsync.project.config import STATE_FOLDER, is_robot_name
from urdfsync.project.state import bases, expansion, notes, statefile
from urdfsync.project.state.expansion import Expansion
from urdfsync.project.state.notes import Notes
from urdfsync.project.state.record import Record
from urdfsync.project.state.transaction import FileChange

SUFFIX = ".state"
_FOR_GIT = {
    ".gitignore": """\
# Written by urdfsync. robots/, bases/ and schema.json belong into version control, everything else is safe to lose.
/*
!/.gitignore
!/.gitattributes
!/schema.json
!/robots/
!/bases/
""",
    ".gitattributes": """\
# Written by urdfsync. Lines of recorded states and bases stand alone: git unites those of two branches.
/robots/*.state merge=union -diff linguist-generated
/robots/*.expanded merge=union
/bases/** merge=union -diff -text linguist-generated
""",
}

StateHashes: TypeAlias = Mapping[Path, str | None]
"""Hashes of the loaded bytes by file of the state; None for a missing file."""


class Aside(msgspec.Struct, frozen=True, omit_defaults=True):
    """One replaced text, saved as a plain file below `.urdfsync/aside/`."""

    file: str
    """Path of the saved text below the robot's folder in `.urdfsync/aside/`."""
    after: str | None = None
    """Hash of the bare text that replaced the saved text; None if the build deleted the file."""
    base: Mapping[str, str] = {}
    """The text of the saved text's base, by hash; empty if it is unknown."""
    beside: Mapping[str, str] = {}
    """The texts of unedited models that the same build deleted, by path below the package."""
    doubt: Doubt | None = None
    """The question that a choice about the saved text has answered."""


def saved_name(path: str, content: bytes) -> str:
    """Return the path of a saved version, which has a hash of its content: `Elbow.base-1f0c3a52.mo` for any version."""
    place = PurePosixPath(path)
    stem = re.sub(r"-[0-9a-f]{8}\Z", "", place.stem)
    return place.with_name(f"{stem}-{digest(normalised(content))[:8]}{place.suffix}").as_posix()


class Store:
    """The state folder of one configuration during one build."""

    def __init__(self, root: Path) -> None:
        self.folder = root / STATE_FOLDER
        self._tree = Tree(root)
        self._contents: dict[Path, bytes | None] = {}
        """Content of each loaded file; None for a missing file."""
        self._notes: dict[str, Notes] = {}

    def names(self) -> list[str]:
        """The robots that have a record, by their names."""
        try:
            files = list_folder(self.folder / "robots")
        except OSError:  # the folder is missing, or `load` reports the error
            return []
        return sorted(filter(is_robot_name, (name.removesuffix(SUFFIX) for name in files if name.endswith(SUFFIX))))

    def load(self, robot: str) -> tuple[tuple[Record, ...], Diagnostic | None]:
        """Return the robot's records, one for each branch that git has united, and a warning if one is damaged.

        Raises StateError for the record of a newer urdfsync, OutputError for a link or a folder in its place.
        """
        path = self.path(robot)
        content = self._bytes(path)
        if content is None:
            return (), None
        return statefile.loads(content.decode(errors="replace").replace("\r\n", "\n"), shown(path))

    def load_expansion(self, robot: str) -> Expansion | None:
        """Return the robot's last expanded source; None if it is missing or unreadable."""
        content = self._bytes(self.expansion(robot))
        return None if content is None else expansion.loads(content)

    def notes(self, robot: str) -> Notes:
        """Return this machine's notes on a robot."""
        if robot not in self._notes:
            self._notes[robot] = notes.load(self.folder, robot)
        return self._notes[robot]

    def base(self, robot: str, sha256: str) -> str | None:
        """Return a robot's generated text with this hash (see `text_hash`); None if the text is lost or former."""
        return (self.bases(robot, sha256[0]) or {}).get(sha256)

    def has_written(self, robot: str, sha256: str) -> bool:
        """Whether a build of a robot, in any clone, once wrote the text with this hash."""
        return sha256 in (self.bases(robot, sha256[0]) or {})

    def bases(self, robot: str, digit: str) -> Mapping[str, str | None] | None:
        """Return a robot's generated texts with this first digit of the hash, by hash; None if the file is missing.

        A former text is None.
        """
        content = self._bytes(self.base_file(robot, digit))
        return None if content is None else bases.loads(content)

    def find_damaged_base(self, robot: str) -> Diagnostic | None:
        """Return a warning about the first unreadable line in the bases; None if there is none."""
        for file in self.base_files(robot):
            if line := bases.find_damage(self._bytes(file) or b""):
                return statefile.damage(shown(file), line, "it has no text of this hash")
        return None

    def aside(self, robot: str) -> Mapping[str, Aside]:
        """Return the saved former texts, by path below the package; nothing if the list can't be read."""
        try:
            index = msgspec.json.decode(self._bytes(self.aside_file(robot)) or b"{}", type=dict[str, Aside])
        except (ValueError, RecursionError):  # a stranger may have written the list
            return {}
        return {
            path: one for path, one in index.items() if all(map(statefile.is_inside, (path, one.file, *one.beside)))
        }

    def aside_text(self, robot: str, file: str) -> bytes | None:
        """Return a saved former text, by its path below the robot's folder."""
        return self._bytes(self.aside_file(robot, file))

    # --- places ---------------------------------------------------------------------------------------------------

    def path(self, robot: str) -> Path:
        """The file of the robot's record."""
        return self.folder / "robots" / f"{robot}{SUFFIX}"

    def expansion(self, robot: str) -> Path:
        """The file of the robot's expanded source."""
        return self.folder / "robots" / f"{robot}.expanded"

    def base_file(self, robot: str, digit: str) -> Path:
        """The file with those bases of the robot whose hashes begin with `digit`."""
        return self.folder / "bases" / robot / digit

    def base_files(self, robot: str) -> list[Path]:
        """The files of a robot's bases."""
        return [self.base_file(robot, digit) for digit in bases.DIGITS]

    def aside_file(self, robot: str, path: str = "index.json") -> Path:
        """Return the file of a saved former text, by path below the robot's folder; or the file of the list."""
        return self.folder / "aside" / robot / path

    def drawing(self, robot: str) -> Path:
        """The file of the robot's diagram. Safe to lose."""
        return self.folder / "svg" / f"{robot}.svg"

    def conflicts(self, robot: str) -> Path:
        """The folder with versions of files in conflict. Safe to lose."""
        return self.folder / "conflicts" / robot

    # --- changes --------------------------------------------------------------------------------------------------

    def save(self, path: Path, content: bytes | None) -> list[FileChange]:
        """Return the change that writes this content to a file; for None, the change that deletes the file.

        A file that differs only in line ends needs no change.
        """
        old = self._bytes(path)
        if content == old or (old is not None and content == normalised(old)):
            return []
        return [FileChange(path, content, None if old is None else digest(old))]

    def save_aside(self, robot: str, index: Mapping[str, Aside], new: Mapping[str, bytes]) -> list[FileChange]:
        """Return the writes of former texts; `new` has texts by file. No text is ever deleted."""
        changes = [change for file, text in new.items() for change in self.save(self.aside_file(robot, file), text)]
        listed = msgspec.json.encode(index, order="sorted") if index else None
        return changes + self.save(self.aside_file(robot), listed)

    def conflict_files(self, robot: str) -> dict[str, bytes]:
        """Return the saved versions of conflicts, by path below the robot's folder."""
        folder = self.conflicts(robot)
        # raises OutputError for a symbolic link, which may lead to the whole disk
        existing = map(Path, walk_files(folder)) if self._tree.check_folder(folder) else ()
        return {path.relative_to(folder).as_posix(): self._bytes(path) or b"" for path in existing}

    def save_conflicts(self, robot: str, contents: Mapping[str, bytes]) -> list[FileChange]:
        """Return the writes of versions in the robot's folder, by path.

        Other files are deleted if their names say what they hold; all else in the folder is a person's.
        """
        folder, existing = self.conflicts(robot), self.conflict_files(robot)
        persons = {path for path, text in existing.items() if text.strip() and path != saved_name(path, text)}
        wanted = dict.fromkeys(sorted(existing)) | dict(contents)
        kept = (path for path in wanted if path not in persons)
        return [change for path in kept for change in self.save(folder / path, wanted[path])]

    def remove(self, robot: str) -> list[FileChange]:
        """Return the deletions of all recorded state of a robot; files of a person's among its conflicts stay."""
        files = (*self.base_files(robot), self.drawing(robot), self.expansion(robot), notes.place(self.folder, robot))
        changes = [change for path in (*files, self.path(robot)) for change in self.save(path, None)]
        return [*self.save_conflicts(robot, {}), *changes]

    def for_git(self) -> list[FileChange]:
        """Return the writes of missing `.gitignore` and `.gitattributes`; existing files stay as they are."""
        files = {self.folder / name: text.encode() for name, text in _FOR_GIT.items()}
        missing = {path: content for path, content in files.items() if self._bytes(path) is None}
        return [change for path, content in missing.items() for change in self.save(path, content)]

    def hashes(self) -> StateHashes:
        """The hashes of all loaded files, without bases.

        Hashing the bases takes 20 ms with 1,000 links; a transaction checks the bases that it replaces.
        """
        loaded, below = self._contents.items(), self.folder / "bases"
        files = ((path, content) for path, content in loaded if below not in path.parents)
        return {path: None if content is None else digest(content) for path, content in files}

    def is_unchanged(self, hashes: StateHashes) -> bool:
        """Whether all these files still have these hashes."""
        tree = Tree(self._tree.root)  # only a new `Tree` finds new folders
        contents = ((tree.read(path), before) for path, before in hashes.items())
        return all((None if content is None else digest(content)) == before for content, before in contents)

    def _bytes(self, path: Path) -> bytes | None:
        if path not in self._contents:
            self._contents[path] = self._tree.read(path)
        return self._contents[path]
